#include "statics/rod_system.h"
#include "statics/se3_system.h"
#include "statics/staggered_system.h"

namespace tendril {

std::unique_ptr<RodSystem> make_rod_system(const RodProblem& problem, const SolveOptions& options, RodMesh mesh) {
  std::unique_ptr<RodSystem> system;
  if (options.element == Element::staggered) system = std::make_unique<StaggeredSystem>(problem, std::move(mesh), options.clamp);
  else system = std::make_unique<Se3System>(problem, std::move(mesh));
  system->place_springs();
  return system;
}

}  // namespace tendril
