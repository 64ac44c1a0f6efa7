// How the forward play of an installation depends on its step: the same manipulation played with ever smaller most steps, against the
// play of the smallest. Distances in mm, of the farthest vertex, midway and at the end.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "method/assembly/path_smoothing.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"
#include "statics/solve.h"
#include "unit/method/assembly_scenes.h"

namespace {

using namespace tendril;
using namespace tendril::assembly;

double farthest(const SystemEquilibrium& a, const SystemEquilibrium& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].points.size(); ++i) most = std::max(most, (a.rods[k].points[i] - b.rods[k].points[i]).norm());
  return most;
}

/// The state at t, from the passed one before it by one solve of its own.
SystemEquilibrium state_at(const InstalledSystem& system, const Manipulation& m, const Drive& moved, double t) {
  const auto after = std::find_if(moved.passed.begin(), moved.passed.end(), [t](const Passed& p) { return p.t >= t; });
  const Passed& near = after == moved.passed.end() ? moved.passed.back() : *after;
  std::vector<Frame> poses;
  for (std::size_t g = 0; g < m.grips.size(); ++g) poses.push_back(m.pose(static_cast<int>(g), t));
  SolveOptions solve;
  solve.follow = true;
  return tendril::solve(held_by(system.free, m.grips, poses), solve, {}, &near.equilibrium);
}

void table(const char* name, const assembly_scenes::Case& c) {
  const Result found = run(c.scene, [&] {
    Options options = c.options;
    options.optimise = false;
    return options;
  }());
  std::printf("%s: %s\n", name, found.message.c_str());
  if (!found.ok) return;
  const InstalledSystem system = installed_system(c.scene, c.options, 2);
  std::vector<Frame> poses;
  for (std::size_t g = 0; g < found.manipulation.grips.size(); ++g) poses.push_back(found.manipulation.pose(static_cast<int>(g), 0));
  SystemProblem weightless = held_by(system.free, found.manipulation.grips, poses);
  set_gravity(weightless, Vec3::Zero());
  const SystemEquilibrium start = tendril::solve(weightless, {}, {});
  const double steps[] = {4, 2, 1, 0.5, 0.25};
  std::vector<Played> plays;
  std::vector<double> seconds;
  for (const double step : steps) {
    DriveOptions options;
    options.radius = system.radius;
    options.most_step = step;
    options.first_step = std::min(1.0, step);
    const auto begin = std::chrono::steady_clock::now();
    plays.push_back(play(system, found.manipulation, start, 0.05 * system.radius, options, {}));
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  const Drive& finest = plays.back().moved;
  std::printf("%10s %6s %8s %10s %12s %12s\n", "step [R]", "ok", "steps", "time [ms]", "midway [mm]", "end [mm]");
  for (std::size_t i = 0; i < plays.size(); ++i) {
    const Drive& moved = plays[i].moved;
    const double middle = farthest(state_at(system, found.manipulation, moved, 0.5), state_at(system, found.manipulation, finest, 0.5));
    std::printf("%10.2f %6s %8zu %10.1f %12.3g %12.3g\n", steps[i], plays[i].proof.ok ? "yes" : "no", moved.passed.size() - 1, 1e3 * seconds[i],
                1e3 * middle, 1e3 * farthest(moved.passed.back().equilibrium, finest.passed.back().equilibrium));
  }
}

}  // namespace

int main() {
  table("two posts", assembly_scenes::two_posts(1000));
  table("ring", assembly_scenes::ring(1000));
  table("L channel", assembly_scenes::l_channel(1000));
}
