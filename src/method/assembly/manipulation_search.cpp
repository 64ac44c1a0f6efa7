#include "method/assembly/manipulation_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "method/assembly/connector_ends.h"
#include "method/assembly/key_frames.h"
#include "method/assembly/optimisation.h"
#include "method/assembly/path_smoothing.h"
#include "method/assembly/robustness.h"
#include "method/assembly/stage.h"
#include "method/assembly/straight_way.h"
#include "method/assembly/supplementation.h"

namespace tendril::assembly {

namespace {

using routing::FreeSpace;

constexpr int most_supplementary = 4;      // grips, one after the other, before other traces are tried
constexpr std::size_t most_by_handle = 8;  // attempts, before another one has its turn
constexpr int optimisation_plays = 30;
constexpr double same_side = 0.7;          // cosine of the angle between ways out, seen from where a connector got stuck
constexpr double smoothing_window = 0.1;   // of the common time

std::shared_ptr<const FreeSpace> free_space(const Scene& scene, const InstalledSystem& system, double arm, const Options& options, const RunContext& context) {
  routing::SpaceDemands demands;
  demands.radius = system.radius;
  std::vector<Vec3> ends;
  for (const Grip& grip : system.extra) ends.push_back(system.pose(system.routed, grip).at);
  if (options.exit) ends.push_back(*options.exit);
  return std::make_shared<const FreeSpace>(scene.without_rods(), demands, ends, 1.2 * arm + 4 * system.radius, context);
}

/// Everything that is traced: connections, the handle first among the others.
std::vector<Grip> grips_of(const InstalledSystem& system, const Grip& handle) {
  std::vector<Grip> grips = system.connections;
  grips.push_back(handle);
  for (const Grip& grip : system.extra)
    if (grip.name != handle.name && grip.branch < 0) grips.push_back(grip);
  return grips;
}

/// Where contact presses hardest; without contact, the middle of the rod that is bent most.
Vec3 place_of(const SystemEquilibrium& state) {
  double most = 0, tightest = INFINITY;
  Vec3 pressed = Vec3::Zero(), bent = Vec3::Zero();
  for (const Equilibrium& rod : state.rods) {
    for (const ContactForce& contact : rod.contacts)
      if (contact.force.norm() > most) {
        most = contact.force.norm();
        pressed = contact.point;
      }
    if (rod.smallest_bend_radius() < tightest) {
      tightest = rod.smallest_bend_radius();
      bent = rod.points[rod.points.size() / 2];
    }
  }
  return most > 0 ? pressed : bent;
}

std::string percent(double share) { return number_text(std::round(1e3 * share) / 10) + " %"; }

/// How far a drive came, from 0 to 1.
double share_of(const Drive& drive) { return drive.passed.empty() ? 0 : drive.passed.back().t; }

}  // namespace

ManipulationSearch::ManipulationSearch(const Scene& scene, const InstalledSystem& system, const Options& options, const RunContext& context, Result& result)
    : scene_(scene), system_(system), options_(options), context_(context), result_(result) {
  {
    const Stage stage(result.steps[handle_path_planning], "searches");
    for (const Grip& grip : system.extra) arms_.push_back(system.arm(grip));
    space_ = free_space(scene, system, *std::max_element(arms_.begin(), arms_.end()), options, context);
  }
  drive_.radius = system.radius;
  drive_.most_strain = options.max_strain;
  drive_.min_bend_radius = options.min_bend_radius;
  if (system.connectors.empty()) return;
  drive_.judge = [this](const SystemEquilibrium& from, const SystemEquilibrium& to) {
    return connector_hit(system_.connectors, system_.surroundings.get(), from, to);
  };
  drive_.jam = [this](const SystemEquilibrium& state) { return wedged(system_, state); };
}

bool ManipulationSearch::may_go_on() const {
  const std::size_t made = result_.attempts.size();
  return !context_.stop() && static_cast<int>(made) < options_.attempts && made - by_earlier_handles_ < most_by_handle;
}

/// Numbers of extra grips, by how short their longest arm is.
std::vector<int> ManipulationSearch::handles() const {
  std::vector<int> handles;
  for (std::size_t k = 0; k < system_.extra.size(); ++k) {
    const Grip& grip = system_.extra[k];
    if (options_.grip.empty() || grip.name == options_.grip || (grip.rod >= 0 && system_.rods[grip.rod] == options_.grip)) handles.push_back(static_cast<int>(k));
  }
  if (handles.empty()) throw UsageError("assembly: 'grip' names neither a rod nor a free branch point: '" + options_.grip + "'");
  std::stable_sort(handles.begin(), handles.end(), [&](int a, int b) { return arms_[a] < arms_[b]; });
  return handles;
}

bool ManipulationSearch::run() {
  for (const int handle : handles()) {
    by_earlier_handles_ = result_.attempts.size();
    if (!may_go_on()) return false;
    if (by_handle(system_.extra[handle], arms_[handle])) return true;
  }
  return false;
}

bool ManipulationSearch::by_handle(const Grip& handle, double arm) {
  const Frame from = system_.pose(system_.routed, handle);
  const HandlePathOptions wanted{system_.radius, arm + 2 * system_.radius, 0, options_.exit};
  std::vector<HandlePath> straight = straight_ways(*space_, from, wanted);
  std::optional<HandlePaths> paths;
  const auto next = [&]() -> std::optional<HandlePath> {
    const Stage stage(result_.steps[handle_path_planning], "searches");
    // Connectors leave holes along their rods; without them that is the last resort.
    if (system_.connectors.empty() || straight.empty()) {
      if (!paths) paths.emplace(*space_, from.at, wanted, context_);
      if (const std::optional<HandlePath> path = paths->next()) return path;
    }
    if (straight.empty()) return std::nullopt;
    const HandlePath path = std::move(straight.front());
    straight.erase(straight.begin());
    return path;
  };
  std::optional<HandlePath> path = next();
  if (!path && result_.message.empty()) {
    result_.message = "no way out for '" + handle.name + "': " + paths->why();
    result_.stopped_at = paths->widest().narrow;
  }
  for (; path; path = next())
    for (const bool gravity : {false, true}) {
      if (!may_go_on()) return false;
      if (wedges(*path)) break;
      if (along(handle, *path, gravity)) return true;
      if (jammed_ && !system_.connectors.empty()) break;  // gravity opens no hole
    }
  return false;
}

/// Leads out by a side of a hole by which a connector was wedged in it before.
bool ManipulationSearch::wedges(const HandlePath& path) const {
  return std::any_of(wedged_.begin(), wedged_.end(), [&](const Wedged& before) {
    const Vec3 then = before.out - before.at, now = path.points.back() - before.at;
    return now.dot(then) > same_side * now.norm() * then.norm();
  });
}

/// One handle along one path: pulled, traced, smoothed, played. True: proven.
bool ManipulationSearch::along(const Grip& handle, const HandlePath& path, bool gravity) {
  Attempt kind{handle.name, gravity, true, 0, {}, 0};
  Pulled pulled;
  {
    const Stage stage(result_.steps[constraint_relaxation], "pulls");
    pulled = pull(system_, handle, path.points, gravity, drive_, options_.solve, context_);
    kind.seconds = stage.seconds();
  }
  jammed_ = pulled.released.ok() && (pulled.pulled.end == Drive::End::jammed || pulled.pulled.end == Drive::End::no_equilibrium);
  if (pulled.pulled.end == Drive::End::jammed) wedged_.push_back({place_of(pulled.pulled.passed.back().equilibrium), path.points.back()});
  if (!pulled.ok) {
    kind.outcome = pulled.message;
    note(kind, handle, pulled, path);
    return false;
  }
  HandlePath taken = path;
  taken.points = pulled.path;
  Manipulation raw, smooth;
  {
    const Stage stage(result_.steps[path_smoothing], "manipulations");
    raw = kept_clear(system_, traces(system_, pulled, grips_of(system_, handle)).reversed());
    smooth = smoothed(system_, raw, smoothing_window);
  }
  if (supplemented(smooth, kind, pulled, taken)) return true;
  kind.smoothed = false;
  kind.seconds = 0;
  return supplemented(raw, kind, pulled, taken);
}

/// Played with ever more grips until it arrives. True: proven.
bool ManipulationSearch::supplemented(const Manipulation& all, const Attempt& kind, const Pulled& pulled, const HandlePath& path) {
  const SystemEquilibrium& start = pulled.pulled.passed.back().equilibrium;
  std::vector<std::string> names;
  for (const Grip& grip : system_.connections) names.push_back(grip.name);
  names.push_back(kind.handle);
  std::string before;  // what stopped the play with one grip less
  for (int more = 0; more <= most_supplementary && may_go_on(); ++more) {
    Attempt attempt = kind;
    if (more > 0) attempt.seconds = 0;
    const Manipulation forward = with_grips(all, names);
    std::optional<Stage> stage(std::in_place, result_.steps[grip_point_supplementation], "plays");
    Played play = played(forward, start, context_);
    attempt.grips = static_cast<int>(forward.grips.size());
    attempt.seconds += stage->seconds();
    attempt.outcome = play.proof.ok ? "proven" : play.proof.message;
    stage.reset();
    note(attempt, forward, play, path);
    if (play.proof.ok) {
      keep_best(forward, std::move(play), start, path);
      return true;
    }
    // One more grip that changes nothing at all was at the wrong place, or it is no matter of grips.
    if (std::exchange(before, attempt.outcome) == attempt.outcome) return false;
    const std::string next = supplementary_grip(system_, all, forward, play);
    if (next.empty()) return false;
    names.push_back(next);
  }
  return false;
}

Played ManipulationSearch::played(const Manipulation& forward, const SystemEquilibrium& start, const RunContext& context) const {
  return play(system_, forward, start, options_.deviation * system_.radius, drive_, options_.solve, context);
}

/// The proven manipulation made better, and replayed by unsteady hands, as far as asked for.
void ManipulationSearch::keep_best(const Manipulation& forward, Played play, const SystemEquilibrium& start, const HandlePath& path) {
  const Prove prove = [&](const Manipulation& manipulation, const RunContext& context) { return played(manipulation, start, context); };
  Optimised best{forward, std::move(play), 0, 0};
  if (options_.optimise) {
    MethodStep& step = result_.steps[optimisation];
    const Stage stage(step, "runs");
    best = optimised(system_, forward, std::move(best.played), prove, optimisation_plays, options_.optimise_seconds, context_);
    step.counts = {{"tried", best.tried}, {"accepted", best.accepted}};
  }
  keep(best.manipulation, best.played, path);
  if (options_.replays > 0) result_.robustness = robustness(system_, best.manipulation, prove, options_.replays, context_);
}

void ManipulationSearch::keep(const Manipulation& forward, const Played& play, const HandlePath& path) {
  result_.manipulation = forward;
  result_.proof = play.proof;
  result_.handle_path = path.points;
  result_.stopped_at.reset();
  result_.hands = forward.hands(0);
  result_.play = key_frames(scene_, system_, forward.grips, play.moved.passed, system_.gravity(), options_.solve);
  if (!play.let_go.passed.empty())
    result_.play.back() = key_frames(scene_, system_, system_.connections, {play.let_go.passed.back()}, system_.gravity(), options_.solve).front();
  result_.play.back().t = 1;
}

bool ManipulationSearch::is_furthest(double progress, const Drive& stopped) {
  if (progress <= furthest_) return false;
  furthest_ = progress;
  result_.stopped_at.reset();
  if (!stopped.passed.empty()) result_.stopped_at = place_of(stopped.passed.back().equilibrium);
  return true;
}

void ManipulationSearch::note(const Attempt& attempt, const Grip& handle, const Pulled& pulled, const HandlePath& path) {
  result_.attempts.push_back(attempt);
  const bool unplugged = !pulled.released.passed.empty();
  const Drive& stopped = pulled.released.ok() ? pulled.pulled : unplugged ? pulled.released : pulled.unplugged;
  if (!is_furthest((pulled.released.ok() ? 1 : 0) + share_of(stopped), stopped)) return;
  const char* part = pulled.released.ok() ? " of the way: " : unplugged ? " of the connections' release: " : " of the way out of its sockets: ";
  result_.message = "pulled out by '" + attempt.handle + "', " + percent(share_of(stopped)) + part + pulled.message;
  result_.handle_path = path.points;
  result_.play = key_frames(scene_, system_, {handle}, stopped.passed, attempt.gravity ? system_.gravity() : Vec3::Zero(), options_.solve);
}

void ManipulationSearch::note(const Attempt& attempt, const Manipulation& forward, const Played& play, const HandlePath& path) {
  result_.attempts.push_back(attempt);
  const Drive& stopped = !play.hung.ok() ? play.hung : !play.moved.ok() ? play.moved : play.let_go;
  if (attempt.outcome == "proven" || !is_furthest(2 + (play.moved.passed.empty() ? 0 : 1 + share_of(play.moved)) + share_of(play.let_go), stopped)) return;
  result_.message = "installed by " + std::to_string(attempt.grips) + " grips: " + play.proof.message;
  result_.proof = play.proof;
  result_.handle_path = path.points;
  result_.play = key_frames(scene_, system_, forward.grips, stopped.passed, system_.gravity(), options_.solve);
}

}  // namespace tendril::assembly
