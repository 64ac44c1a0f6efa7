// method.preform against general planners of the Open Motion Planning Library, for random pairs of places in the engine bay.
//
// The planners look for the shortest way of a ball of the hose's radius and clearance, which knows nothing of bends: its length
// is a bound, not a hose. What a hose could make of it is found by the same descent that method.preform uses, started from the
// planner's way with few vertices. Prints a table.
//   planner_baseline [seconds a planner, 10] [pairs, 3] [seed, 1]
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdio>
#include <cstdlib>

#include "bench/bay_routes.h"
#include "method/preform/preform.h"

namespace {

using namespace tendril;
using namespace tendril::routing;
namespace ob = ompl::base;
namespace og = ompl::geometric;

Vec3 place_of(const ob::State* state) {
  const double* x = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {x[0], x[1], x[2]};
}

/// Straights as FreeSpace judges them: without samples.
class StraightsAreFree final : public ob::MotionValidator {
 public:
  StraightsAreFree(const ob::SpaceInformationPtr& info, const FreeSpace& space) : MotionValidator(info), space_(space) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override { return space_.is_free(place_of(a), place_of(b)); }
  bool checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(a, b)) return true;
    last.second = 0;
    if (last.first) si_->copyState(last.first, a);
    return false;
  }

 private:
  const FreeSpace& space_;
};

/// The way from start to finish; empty when none was found.
template <class Planner>
std::vector<Vec3> planned(const FreeSpace& space, const Vec3& start, const Vec3& finish, double seconds) {
  const auto place = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  for (int k = 0; k < 3; ++k) bounds.setLow(k, space.region().min()[k]), bounds.setHigh(k, space.region().max()[k]);
  place->setBounds(bounds);
  og::SimpleSetup setup(place);
  const auto info = setup.getSpaceInformation();
  setup.setStateValidityChecker([&](const ob::State* state) { return space.is_free(place_of(state)); });
  info->setMotionValidator(std::make_shared<StraightsAreFree>(info, space));
  ob::ScopedState<ob::RealVectorStateSpace> from(place), to(place);
  for (int k = 0; k < 3; ++k) from[k] = start[k], to[k] = finish[k];
  setup.setStartAndGoalStates(from, to);
  setup.setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(info));
  setup.setPlanner(std::make_shared<Planner>(info));
  if (setup.solve(seconds) != ob::PlannerStatus::EXACT_SOLUTION) return {};
  setup.simplifySolution(0.2);
  std::vector<Vec3> way;
  for (const ob::State* state : setup.getSolutionPath().getStates()) way.push_back(place_of(state));
  return way;
}

double length_of(const std::vector<Vec3>& way) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) sum += (way[i + 1] - way[i]).norm();
  return sum;
}

/// The hose that descent makes of a way; 0: none that keeps all demands.
double hose_from(const FreeSpace& space, const Ends& ends, const std::vector<Vec3>& way) {
  PccPoints seed;
  seed.points.push_back(ends.start);
  seed.points.insert(seed.points.end(), way.begin(), way.end());
  seed.points.push_back(ends.finish);
  seed.radii.assign(way.size(), bench::bay_curve().radii.front());
  DescentOptions options;
  options.polish = true;
  const PccPoints curve = fitted(descend(space, bench::bay_curve(), ends, seed, options).curve);
  return violations(space, bench::bay_curve(), ends, curve).empty() ? curve.length() : 0;
}

template <class Planner>
void report(const char* name, const FreeSpace& space, const Ends& ends, double seconds, double best) {
  // Along both ends' straights up to where a bend can begin.
  const double ahead = bench::bay_curve().end_straight + bench::bay_curve().radii.front();
  const Vec3 start = ends.start + ahead * ends.start_along, finish = ends.finish - ahead * ends.finish_along;
  const std::vector<Vec3> way = planned<Planner>(space, start, finish, seconds);
  const double hose = way.empty() ? 0 : hose_from(space, ends, way);
  std::printf("  %-8s %6.2f s   way %9.2f mm   hose ", name, seconds, way.empty() ? NAN : 1e3 * (length_of(way) + 2 * ahead));
  if (hose > 0) std::printf("%9.2f mm, %+.2f %%\n", 1e3 * hose, 100 * (hose / best - 1));
  else std::printf("none that keeps all demands\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10;
  const int pairs = argc > 2 ? std::atoi(argv[2]) : 3, seed = argc > 3 ? std::atoi(argv[3]) : 1;
  if (!(seconds > 0) || pairs < 1 || seed < 1) {
    std::fprintf(stderr, "planner_baseline: seconds, pairs and seed are numbers above 0\n");
    return 1;
  }
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
  const Scene& bay = bench::engine_bay();
  const FreeSpace space(bay, bench::bay_space(), {}, 0.25);
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::printf("seed %d\n", seed);
  for (int done = 0, tries = 0; done < pairs && tries < 20 * pairs; ++tries) {
    preform::Options options;
    options.ends = bench::random_ends(space, random);
    options.space = bench::bay_space();
    options.curve = bench::bay_curve();
    const preform::Result result = preform::run(bay, options);
    if (result.hoses.empty()) continue;  // mostly places within closed parts
    const double best = result.hoses.front().length;
    std::printf("pair %d, %.1f mm apart\n  %-8s %6.2f s   %zu hoses in %d passages, the best %9.2f mm\n", ++done,
                1e3 * (options.ends.finish - options.ends.start).norm(), "preform", result.seconds, result.hoses.size(),
                result.passages, 1e3 * best);
    report<og::RRTstar>("RRT*", space, options.ends, seconds, best);
    report<og::PRMstar>("PRM*", space, options.ends, seconds, best);
  }
  return 0;
}
