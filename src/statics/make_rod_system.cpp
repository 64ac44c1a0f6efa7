#include "statics/rod_system.h"
#include "statics/se3_system.h"
#include "statics/staggered_system.h"

namespace tendril {

std::unique_ptr<RodSystem> make_rod_system(const RodProblem& problem, const SolveOptions& options, RodMesh mesh) {
  if (options.element == Element::staggered)
    return std::make_unique<StaggeredSystem>(problem, std::move(mesh), options.clamp);
  return std::make_unique<Se3System>(problem, std::move(mesh));
}

}  // namespace tendril
