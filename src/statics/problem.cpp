#include "statics/problem.h"

namespace tendril {

void RodProblem::check() const { rod.check(); }

}  // namespace tendril
