#include "method/assembly/pull.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

// While connections let go time stands for no way; so many radii make the steps.
constexpr double release_way = 40;
// Of obstacles, in radii; of equilibria on the way, in lengths.
constexpr double give = 0.1, loose = 1e-7;
// Springs of connections, in EI/L^3: powers of ten at the beginning, and by how many they fall.
constexpr double stiffest = 6, falls_by = 9;
// Newton's passes after which what is carried out as it is has jammed.
constexpr long most_carried = 3000;

/// Where a connection's springs act: on a rod.
struct Sprung {
  int rod;
  double at;
  Frame pose;
};

std::vector<Sprung> sprung_connections(const InstalledSystem& system, const std::vector<Frame>& poses) {
  std::vector<Sprung> sprung;
  for (std::size_t c = 0; c < system.connections.size(); ++c) {
    const Grip& grip = system.connections[c];
    if (grip.branch < 0) {
      sprung.push_back({grip.rod, grip.at, poses[c]});
      continue;
    }
    const JoinedSection& section = system.free.branches[grip.branch].sections.front();
    sprung.push_back({section.rod, section.at, poses[c] * section.relative});
  }
  return sprung;
}

/// A connector on its way out of its socket: straight along its rod.
struct Withdrawal {
  std::size_t connection;
  Vec3 way;     ///< m
  double away;  ///< m, from the handle
};

/// In their order: the farthest from the handle first.
std::vector<Withdrawal> withdrawals(const InstalledSystem& system, const Grip& handle) {
  const Vec3 held = system.pose(system.routed, handle).at;
  std::vector<Withdrawal> all;
  for (const ConnectorBody& body : system.connectors) {
    if (!body.is_plugged_in()) continue;
    for (std::size_t c = 0; c < system.connections.size(); ++c) {
      const Grip& grip = system.connections[c];
      if (grip.branch >= 0 || grip.rod != body.rod() || (grip.at <= 0) != body.at_start()) continue;
      const Frame& pose = system.connected[c];
      const double far = body.socket_depth(*system.surroundings, pose) + system.radius;
      all.push_back({c, (body.at_start() ? 1 : -1) * far * pose.d3(), (pose.at - held).norm()});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Withdrawal& a, const Withdrawal& b) { return a.away > b.away; });
  return all;
}

/// Poses of the connections after a share of all withdrawals.
std::vector<Frame> withdrawn(const InstalledSystem& system, const std::vector<Withdrawal>& all, double t) {
  std::vector<Frame> poses = system.connected;
  for (std::size_t i = 0; i < all.size(); ++i)
    poses[all[i].connection].at += std::clamp(t * static_cast<double>(all.size()) - static_cast<double>(i), 0.0, 1.0) * all[i].way;
  return poses;
}

/// Springs at connections of 10^power EI/L^3; nothing from t = 1 on.
void add_springs(SystemProblem& problem, const std::vector<Sprung>& sprung, double t) {
  if (t >= 1) return;
  for (const Sprung& s : sprung) {
    const Rod& rod = problem.rods[s.rod].rod;
    const Section& section = rod.section_at(s.at);
    const double stiffness = std::min(section.EI1, section.EI2) / std::pow(rod.length, 3) * std::pow(10, stiffest - falls_by * t);
    problem.rods[s.rod].springs.push_back({s.at, s.pose, stiffness, 0.05 * stiffness * rod.length * rod.length});
  }
}

/// Places at even shares of a polyline's length.
class Along {
 public:
  explicit Along(const std::vector<Vec3>& points) : points_(points), begin_(1, 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i) begin_.push_back(begin_.back() + (points[i] - points[i - 1]).norm());
  }
  double length() const { return begin_.back(); }
  Vec3 at(double share) const {
    const double s = std::clamp(share, 0.0, 1.0) * length();
    const auto after = std::upper_bound(begin_.begin(), begin_.end(), s);
    if (after == begin_.end()) return points_.back();
    const std::size_t i = after - begin_.begin();
    return points_[i - 1] + (s - begin_[i - 1]) / (begin_[i] - begin_[i - 1]) * (points_[i] - points_[i - 1]);
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<double> begin_;
};

/// Obstacles give way a little: only where the grips go counts, which the play forward proves with hard surfaces.
SolveOptions softly(SolveOptions solve) {
  solve.soft_contact = give;
  solve.tolerance = std::max(solve.tolerance, loose);
  return solve;
}

/// The connections are held, the rest gives way.
Drive unplug(const InstalledSystem& system, const std::vector<Withdrawal>& all, const DriveOptions& options, const SolveOptions& solve,
             const RunContext& context) {
  const SystemProblem held = held_by(system.free, system.connections, system.connected);
  const ProblemPath path = [&](double t, SystemProblem& problem) { place(problem, system.connections, withdrawn(system, all, t)); };
  double longest = 0;
  for (const Withdrawal& one : all) longest = std::max(longest, one.way.norm());
  const auto moved = [&](double from, double to) { return (to - from) * longest * static_cast<double>(all.size()); };
  return drive(held, path, moved, system.routed, options, solve, context);
}

/// Straight up, by as much as the system is long.
std::vector<Vec3> lifted(const InstalledSystem& system, const Grip& handle) {
  const Vec3 from = system.pose(system.routed, handle).at, down = system.gravity();
  const Vec3 up = down.norm() > 0 ? Vec3(-down.normalized()) : Vec3(Vec3::UnitZ());
  return {from, from + (system.arm(handle) + 2 * system.radius) * up};
}

/// All connections go along with the handle, as they are held when unplugged: hands carry the system out in its routed shape.
Drive carry(const InstalledSystem& system, const Grip& handle, const SystemEquilibrium& from, const std::vector<Frame>& poses, const Along& along,
            DriveOptions options, const SolveOptions& solve, const RunContext& context) {
  options.flow = false;
  options.most_iterations = most_carried;
  std::vector<Grip> grips = system.connections;
  grips.push_back(handle);
  std::vector<Frame> held = poses;
  held.push_back(system.pose(from, handle));
  const ProblemPath path = [&](double t, SystemProblem& problem) {
    std::vector<Frame> carried = held;
    for (Frame& pose : carried) pose.at += along.at(t) - along.at(0);
    place(problem, grips, carried);
  };
  const auto moved = [&](double from, double to) { return (to - from) * along.length(); };
  return drive(held_by(system.free, grips, held), path, moved, from, options, solve, context);
}

Drive release(const InstalledSystem& system, const Grip& handle, const SystemEquilibrium& from, const std::vector<Frame>& poses, bool gravity,
              DriveOptions options, const SolveOptions& solve, const RunContext& context) {
  options.stays = true;
  const std::vector<Sprung> sprung = sprung_connections(system, poses);
  const Frame held = system.pose(from, handle);
  const SystemProblem bare = held_by(system.free, {handle}, {held});
  const ProblemPath path = [&](double t, SystemProblem& problem) {
    problem = bare;
    add_springs(problem, sprung, t);
    if (!gravity) set_gravity(problem, (1 - t) * system.gravity());
  };
  const auto moved = [&](double from, double to) { return (to - from) * release_way * system.radius; };
  return drive(bare, path, moved, from, options, solve, context);
}

}  // namespace

Pulled pull(const InstalledSystem& system, const Grip& handle, const std::vector<Vec3>& path, bool gravity, const DriveOptions& options,
            const SolveOptions& hard, const RunContext& context) {
  const SolveOptions solve = softly(hard);
  Pulled out;
  const std::vector<Withdrawal> first = withdrawals(system, handle);
  if (!first.empty()) {
    out.unplugged = unplug(system, first, options, solve, context);
    out.message = out.unplugged.message;
    if (!out.unplugged.ok()) return out;
  }
  const Along along(path);
  const SystemEquilibrium& unplugged = first.empty() ? system.routed : out.unplugged.passed.back().equilibrium;
  out.path = path;
  if (!gravity && (!first.empty() || !system.free.branches.empty()))
    for (const std::vector<Vec3>& way : {path, lifted(system, handle)}) {
      out.pulled = carry(system, handle, unplugged, withdrawn(system, first, 1), Along(way), options, solve, context);
      out.ok = out.pulled.ok();
      if (!out.ok) continue;
      out.path = way;
      return out;
    }
  out.released = release(system, handle, unplugged, withdrawn(system, first, 1), gravity, options, solve, context);
  out.message = out.released.message;
  if (!out.released.ok()) return out;
  const SystemEquilibrium& free = out.released.passed.back().equilibrium;
  const Frame held = system.pose(free, handle);
  SystemProblem problem = held_by(system.free, {handle}, {held});
  if (!gravity) set_gravity(problem, Vec3::Zero());
  const Vec3 aside = held.at - along.at(0);  // unplugged it may have left the path's beginning
  const ProblemPath moves = [&](double t, SystemProblem& moving) {
    place(moving, {handle}, {Frame{along.at(t) + (1 - t) * aside, held.rotation}});
  };
  const auto moved = [&](double from, double to) { return (to - from) * along.length(); };
  out.pulled = drive(problem, moves, moved, free, options, solve, context);
  out.message = out.pulled.message;
  out.ok = out.pulled.ok();
  return out;
}

Manipulation traces(const InstalledSystem& system, const Pulled& pulled, const std::vector<Grip>& grips) {
  Manipulation trace;
  trace.grips = grips;
  trace.poses.resize(grips.size());
  const auto add = [&](const SystemEquilibrium& state) {
    double farthest = 0;
    for (std::size_t g = 0; g < grips.size(); ++g) {
      const Frame pose = system.pose(state, grips[g]);
      if (!trace.poses[g].empty()) farthest = std::max(farthest, travel(trace.poses[g].back(), pose));
      trace.poses[g].push_back(pose);
    }
    trace.times.push_back(trace.times.empty() ? 0 : trace.times.back() + std::max(farthest, 1e-9));
  };
  // Each drive begins where the one before ended.
  for (const Drive* drive : {&pulled.unplugged, &pulled.released, &pulled.pulled})
    for (std::size_t i = trace.times.empty() ? 0 : 1; i < drive->passed.size(); ++i) add(drive->passed[i].equilibrium);
  // The first state is the routed one: connections are where they belong to the last digit.
  for (std::size_t g = 0; g < grips.size(); ++g)
    for (std::size_t c = 0; c < system.connections.size(); ++c)
      if (grips[g].name == system.connections[c].name) trace.poses[g].front() = system.connected[c];
  for (double& t : trace.times) t /= trace.times.back();
  return trace;
}

}  // namespace tendril::assembly
