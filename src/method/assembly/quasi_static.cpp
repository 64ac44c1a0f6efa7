#include "method/assembly/quasi_static.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "statics/solve.h"

namespace tendril::assembly {

namespace {

// Newton's passes from which on a step was easy, or hard.
constexpr int easy = 10, hard = 25;
// A step that needs more is better halved, as long as it can be.
constexpr int most_passes = 50;
constexpr double growth = 1.5, shrinking = 0.6, taken_back = 0.4;
// A step that was taken back is not tried again at once: steps stay below, by what share, and rise again with each that is taken.
constexpr double below = 0.8, rising = 1.15;
// Passes in which nothing gets a radius farther: it is jammed.
constexpr long idle_passes = 800;
// A vertex jumps where it moves farther than both, so many radii and so many times what drives.
constexpr double jump_radii = 1.5, jump_drives = 8;
// How much nearer to a surface a point may get on its straight way than where it comes from and where it goes to, in radii.
constexpr double may_dive = 0.25;
// Of the proximal flow: how far a vertex goes in one step, in radii; stiffness and limits.
constexpr double flow_most = 0.7, flow_least = 0.35;
constexpr double flow_growth = 1.3;
constexpr int flow_steps = 400, flow_refused = 6;  // the latter in a row without getting anywhere

class Driver {
 public:
  Driver(const SystemProblem& problem, const ProblemPath& path, const std::function<double(double, double)>& moved,
         const DriveOptions& options, const SolveOptions& solve, const RunContext& context)
      : problem_(problem), path_(path), moved_(moved), options_(options), solve_(solve), context_(context) {
    solve_.follow = true;
    solve_.error = false;
  }

  Drive run(const SystemEquilibrium& from) {
    drive_.least_bend_radius = INFINITY;
    drive_.passed.push_back({0, from, false});
    step_ = options_.first_step * options_.radius;
    while (t_ < 1)
      if (!may_go_on() || !advance()) return std::move(drive_);
    drive_.end = Drive::End::arrived;
    return std::move(drive_);
  }

 private:
  bool may_go_on() {
    if (const auto stopped = context_.stop()) return end(Drive::End::stopped, name_of(*stopped));
    if (static_cast<int>(drive_.passed.size()) > options_.most_steps) return end(Drive::End::no_equilibrium, "more steps than allowed");
    return true;
  }

  const SystemEquilibrium& here() const { return drive_.passed.back().equilibrium; }

  /// Always false: the drive goes no farther.
  bool end(Drive::End why, const std::string& message) {
    drive_.end = why;
    drive_.message = message;
    return false;
  }

  /// The time at which what drives has gone `way` farther.
  double time_after(double way) const {
    if (moved_(t_, 1) <= way) return 1;
    double low = t_, high = 1;
    for (int i = 0; i < 40 && high - low > 1e-12; ++i) {
      const double middle = 0.5 * (low + high);
      (moved_(t_, middle) <= way ? low : high) = middle;
    }
    return std::max(high, std::nextafter(t_, 2.0));
  }

  SystemEquilibrium solved(const SystemProblem& problem, const SystemEquilibrium& from) {
    SystemEquilibrium found = tendril::solve(problem, solve_, context_, &from);
    ++drive_.solves;
    drive_.iterations += found.rods.front().iterations;
    return found;
  }

  /// The first surface that a point of the centre line passed through or dived into on its way, or that lies between two of them;
  /// empty: none. Points are half a radius apart: no wire slips between them.
  std::string crossing(const SystemEquilibrium& from, const SystemEquilibrium& to) const {
    for (std::size_t k = 0; k < to.rods.size(); ++k) {
      const ContactField* field = problem_.rods[k].surroundings;
      if (!field) continue;
      const double spacing = 0.5 * options_.radius;
      const auto old = from.rods[k].sampled(spacing), now = to.rods[k].sampled(spacing);
      const bool alike = old.size() == now.size();
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Vec3 a = alike ? old[i].frame.at : from.rods[k].frame_at(now[i].s).at, b = now[i].frame.at;
        const Vec3 next = i + 1 < now.size() ? now[i + 1].frame.at : b;
        const int met = met_on(*field, a, b, next, problem_.rods[k].rod.section_at(now[i].s).radius());
        if (met >= 0) return "passes through " + field->name(met) + " at " + number_text(now[i].s) + " m of rod " + std::to_string(k + 1);
      }
    }
    return {};
  }

  /// The obstacle that a point meets from a to b, or that stands between b and the next one; -1: none.
  int met_on(const ContactField& field, const Vec3& a, const Vec3& b, const Vec3& next, double radius) const {
    const double way = (b - a).norm();
    if (field.closest(0.5 * (a + b), 0.5 * way + std::max((next - b).norm(), radius)).obstacle < 0) return -1;
    if (const auto hit = field.ray(a, b)) return hit->obstacle;
    if (const auto hit = field.ray(b, next)) return hit->obstacle;
    // Rods may be fastened within an obstacle: what counts is how much deeper it gets on the way.
    const double least = std::min({field.closest(a, radius).distance, field.closest(b, radius).distance, radius}) - may_dive * options_.radius;
    if (way < 2 * may_dive * options_.radius) return -1;
    for (const double share : {0.25, 0.5, 0.75}) {
      const ClosestPoint there = field.closest(a + share * (b - a), radius);
      if (there.obstacle >= 0 && there.distance < least) return there.obstacle;
    }
    return -1;
  }

  /// Where it presses most.
  std::string jammed() const {
    double deepest = 0;
    int obstacle = -1;
    for (std::size_t k = 0; k < here().rods.size(); ++k)
      for (const ContactForce& contact : here().rods[k].contacts)
        if (contact.force.norm() > deepest) {
          deepest = contact.force.norm();
          obstacle = contact.obstacle;
        }
    const ContactField* field = problem_.rods.front().surroundings;
    return obstacle < 0 || !field ? std::string("is jammed") : "is jammed at " + field->name(obstacle);
  }
  bool is_jammed() const {
    return drive_.iterations > options_.most_iterations || (options_.flow && drive_.iterations - passes_then_ > idle_passes);
  }

  /// One step, or the end.
  bool advance() {
    const double least = options_.least_step * options_.radius;
    for (;;) {
      if (is_jammed()) return end(Drive::End::no_equilibrium, jammed());
      const double there = time_after(step_), way = moved_(t_, there);
      path_(there, problem_);
      // Where nothing drives a shorter step is no easier.
      solve_.max_iterations = step_ > least * (1 + 1e-9) && !options_.stays ? std::min(all_passes_, most_passes) : all_passes_;
      SystemEquilibrium found = solved(problem_, here());
      if (context_.stop()) return end(Drive::End::stopped, name_of(*context_.stop()));
      const int passes = found.rods.front().iterations;
      const double move = found.ok() ? farthest_move(here(), found) : 0;
      const bool jumps = move > std::max(jump_radii * options_.radius, options_.stays ? 0 : jump_drives * way);
      const std::string crossed = found.ok() && !jumps ? crossing(here(), found) : std::string();
      const std::string judged = found.ok() && !jumps && crossed.empty() && options_.judge ? options_.judge(here(), found) : std::string();
      if (found.ok() && !jumps && crossed.empty() && judged.empty()) {
        if (!take(there, std::move(found), false)) return false;
        t_ = there;
        ceiling_ *= rising;
        if (passes <= easy && !(options_.stays && move > 0.5 * jump_radii * options_.radius)) step_ = std::min({growth * step_, ceiling_, options_.most_step * options_.radius});
        else if (passes > hard) step_ = std::max(shrinking * step_, least);
        return true;
      }
      if (step_ > least * (1 + 1e-9)) {
        ceiling_ = std::max(least, below * step_);
        step_ = std::max(least, taken_back * step_);
        continue;
      }
      if (!judged.empty()) return end(Drive::End::collision, judged);
      if (options_.flow) return flow(there);
      if (jumps) return end(Drive::End::snap, "snaps through");
      if (!crossed.empty()) return end(Drive::End::crossing, crossed);
      const Equilibrium& first = found.rods.front();
      return end(Drive::End::no_equilibrium, std::string("no equilibrium: ") + name_of(first.status) + " " + first.message);
    }
  }

  /// Takes up a state and judges it.
  bool take(double t, SystemEquilibrium state, bool flowed) {
    drive_.passed.push_back({t, std::move(state), flowed});
    if (farthest_move(drive_.passed[resting_since_].equilibrium, here()) > options_.radius) {
      resting_since_ = drive_.passed.size() - 1;
      passes_then_ = drive_.iterations;
    }
    for (std::size_t k = 0; k < here().rods.size(); ++k) {
      const Equilibrium& rod = here().rods[k];
      const double strain = rod.largest_strain(), bend = rod.smallest_bend_radius();
      drive_.worst_strain = std::max(drive_.worst_strain, strain);
      drive_.least_bend_radius = std::min(drive_.least_bend_radius, bend);
      if (options_.most_strain > 0 && strain > options_.most_strain)
        return end(Drive::End::strain, "a strain of " + number_text(100 * strain) + " % in rod " + std::to_string(k + 1));
      if (bend < options_.min_bend_radius)
        return end(Drive::End::bend_radius, "a bend radius of " + number_text(bend / units::mm) + " mm in rod " + std::to_string(k + 1));
    }
    if (options_.jam)
      if (const std::string jam = options_.jam(here()); !jam.empty()) return end(Drive::End::jammed, jam);
    return true;
  }

  /// Springs that draw every vertex to where it is, one stiffness for all rods.
  SystemProblem drawn_back(const SystemProblem& problem, const SystemEquilibrium& state, double share) const {
    SystemProblem drawn = problem;
    for (std::size_t k = 0; k < drawn.rods.size(); ++k) {
      const Equilibrium& rod = state.rods[k];
      const Section& section = drawn.rods[k].rod.section_at(0);
      const double length = rod.s.back(), each = std::min(section.EI1, section.EI2) * length / std::pow(length, 4);
      for (std::size_t i = 0; i < rod.s.size(); ++i)
        drawn.rods[k].springs.push_back({rod.s[i], {rod.points[i], rod.rotations[i]}, share * each / static_cast<double>(rod.s.size() - 1), 0});
    }
    return drawn;
  }

  /// From the present state down to an equilibrium at t, which is elsewhere, in steps of less than a radius.
  bool flow(double t) {
    path_(t, problem_);
    ++drive_.snaps;
    solve_.max_iterations = std::min(all_passes_, most_passes);
    double share = 10, let_go = INFINITY;  // springs now, and when what drives was last tried without
    double moved_before = INFINITY;
    int refused = 0;
    for (int i = 0; i < flow_steps; ++i) {
      if (is_jammed() || refused > flow_refused) return end(Drive::End::no_equilibrium, jammed());
      if (context_.stop()) return end(Drive::End::stopped, name_of(*context_.stop()));
      SystemEquilibrium found = solved(drawn_back(problem_, here(), share), here());
      const double move = found.ok() ? farthest_move(here(), found) : INFINITY;
      if (!found.ok() || move > flow_most * options_.radius || !crossing(here(), found).empty()) {
        share *= found.ok() && move < 4 * flow_most * options_.radius ? 2 : 4;
        refused += !found.ok();
        if (share > 1e12) return end(Drive::End::no_equilibrium, "finds no way down from where it snaps through");
        continue;
      }
      if (options_.judge)
        if (const std::string judged = options_.judge(here(), found); !judged.empty()) return end(Drive::End::collision, judged);
      if (!take(t, std::move(found), true)) return false;
      // What moves ever faster is on its way: softer springs would let it jump.
      if (move < flow_least * options_.radius && move < flow_growth * moved_before) share /= 2;
      if (move > flow_least * options_.radius) refused = 0;
      moved_before = move;
      if ((move > 0.1 * options_.radius && share > 1e-6) || share > 0.25 * let_go) continue;
      let_go = share;
      SystemEquilibrium free = solved(problem_, here());
      if (free.ok() && farthest_move(here(), free) <= jump_radii * options_.radius && crossing(here(), free).empty()) {
        if (!take(t, std::move(free), false)) return false;
        t_ = t;
        step_ = options_.first_step * options_.radius;
        ceiling_ = INFINITY;
        return true;
      }
    }
    return end(Drive::End::no_equilibrium, "does not come to rest after it snaps through");
  }

  SystemProblem problem_;
  const ProblemPath& path_;
  const std::function<double(double, double)>& moved_;
  const DriveOptions& options_;
  SolveOptions solve_;
  const int all_passes_ = solve_.max_iterations;
  const RunContext& context_;
  Drive drive_;
  double t_ = 0, step_ = 0;
  double ceiling_ = INFINITY;  // m, of steps, after one was taken back
  // Of what passed: the state and the passes when something last got a radius farther.
  std::size_t resting_since_ = 0;
  long passes_then_ = 0;
};

}  // namespace

double farthest_move(const SystemEquilibrium& a, const SystemEquilibrium& b) {
  double farthest = 0;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].points.size(); ++i)
      farthest = std::max(farthest, (a.rods[k].points[i] - b.rods[k].points[i]).norm());
  return farthest;
}

Drive drive(const SystemProblem& problem, const ProblemPath& path, const std::function<double(double from, double to)>& moved,
            const SystemEquilibrium& from, const DriveOptions& options, const SolveOptions& solve, const RunContext& context) {
  return Driver(problem, path, moved, options, solve, context).run(from);
}

}  // namespace tendril::assembly
