#include "statics/rod_system.h"
#include "statics/se3_system.h"

namespace tendril {

std::unique_ptr<RodSystem> make_rod_system(const RodProblem& problem, const SolveOptions&, RodMesh mesh) {
  return std::make_unique<Se3System>(problem, std::move(mesh));
}

}  // namespace tendril
