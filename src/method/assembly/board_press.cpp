#include "method/assembly/board_press.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "statics/solve.h"

namespace tendril::assembly {

namespace {

// Stiffnesses are in EI / L^3 of the longest rod, for each vertex.
constexpr double keeps_spin = 1e-3;          // N m: against turning about itself, in EI / L
constexpr int most_cycles = 16;
constexpr double settled = 1e-8;             // moves, as a share of the longest rod
constexpr double strays = 0.02;              // the same of the plane: then the springs were too soft
constexpr double peg_stiffness = 1e3;

double longest(const SystemProblem& problem) {
  double length = 0;
  for (const RodProblem& rod : problem.rods) length = std::max(length, rod.rod.length);
  return length;
}

/// EI / L: N m.
double bending(const SystemProblem& problem) {
  double largest = 0;
  for (const RodProblem& rod : problem.rods) {
    const Section& section = rod.rod.section_at(0);
    largest = std::max(largest, std::max(section.EI1, section.EI2));
  }
  return largest / longest(problem);
}

bool is_joined(const SystemProblem& problem, int rod, double at) {
  for (const BranchPoint& branch : problem.branches)
    for (const JoinedSection& section : branch.sections)
      if (section.rod == rod && std::abs(section.at - at) <= 1e-9 * problem.rods[rod].rod.length) return true;
  return false;
}

/// The vertex of the first rod that is nearest to its middle and free.
int middle_vertex(const SystemProblem& problem, const Equilibrium& rod) {
  const double middle = 0.5 * rod.s.back();
  int best = 0;
  double nearest = INFINITY;
  for (int i = 0; i < static_cast<int>(rod.s.size()); ++i)
    if (std::abs(rod.s[i] - middle) < nearest && !is_joined(problem, 0, rod.s[i])) {
      nearest = std::abs(rod.s[i] - middle);
      best = i;
    }
  return best;
}

SolveOptions following() {
  SolveOptions options;
  options.follow = true;
  return options;
}

/// Best-fit plane as z = 0; which way is up, and what the shape leaves open, follow from the first section's axes.
Frame onto_plane(const SystemEquilibrium& state) {
  Vec3 middle = Vec3::Zero();
  double count = 0;
  for (const Equilibrium& rod : state.rods)
    for (const Vec3& p : rod.points) middle += p, ++count;
  middle /= count;
  Mat3 spread = Mat3::Zero();
  for (const Equilibrium& rod : state.rods)
    for (const Vec3& p : rod.points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  const Frame first{state.rods.front().points.front(), state.rods.front().rotations.front()};
  const Vec3 x = axes.eigenvectors().col(2);
  Vec3 normal = axes.eigenvectors().col(0);
  if (axes.eigenvalues()[1] < 1e-12 * axes.eigenvalues()[2]) {  // a straight line
    const Vec3 open = std::abs(x.dot(first.d1())) < 0.9 ? first.d1() : first.d2();
    normal = (open - open.dot(x) * x).normalized();
  } else {
    for (const Vec3& axis : {first.d1(), first.d2(), first.d3()})
      if (std::abs(normal.dot(axis)) > 0.3) {
        if (normal.dot(axis) < 0) normal = -normal;
        break;
      }
  }
  Mat3 rows;
  rows.row(0) = x;
  rows.row(1) = normal.cross(x);
  rows.row(2) = normal;
  const Quat turn(rows);
  return {-(turn * middle), turn};
}

/// The iteration of this file's head.
class Press {
 public:
  Press(const SystemProblem& free, const SystemEquilibrium& relaxed, const std::vector<Peg>& pegs, const RunContext& context)
      : free_(free), pegs_(pegs), context_(context), size_(longest(free)), moment_(bending(free)), unit_(moment_ / (size_ * size_)),
        held_(middle_vertex(free, relaxed.rods.front())) {
    out_.state = relaxed;
    for (const Equilibrium& rod : relaxed.rods) push_.emplace_back(rod.points.size(), 0.0);
    hold_at_ = pegs.empty() ? relaxed.rods.front().points[held_] : between_pegs(relaxed.rods.front().s[held_]);
    hold_at_.z() = 0;
  }

  Pressed run() {
    // Down to the board, and to the pegs.
    for (int power = 0; power <= 4; ++power)
      if (!step(std::pow(10, power), pegs_.empty() ? 0 : std::min(peg_stiffness, std::pow(10, power)))) return std::move(out_);
    double soft = 1;
    for (int cycle = 0; cycle < most_cycles; ++cycle) {
      const SystemEquilibrium before = out_.state;
      const std::vector<std::vector<double>> push = push_;
      const bool solved = step(soft, peg_stiffness);
      if (context_.stop()) return std::move(out_);
      if (!solved || off() > strays * size_) {
        out_.state = before;
        push_ = push;
        soft *= 10;
        if (soft > 1e6) return std::move(out_);
        continue;
      }
      const bool rests = moved_ <= settled * size_ && off() <= settled * size_;
      if (!rests && (!step(1e3 * soft, peg_stiffness) || !step(1e5, peg_stiffness))) return std::move(out_);
      if (rests) break;
    }
    for (int polish = 0; polish < 8 && off() > settled * size_; ++polish)
      if (!step(1e6, peg_stiffness)) return std::move(out_);
    out_.off = off();
    out_.ok = true;
    return std::move(out_);
  }

 private:
  double off() const {
    double farthest = 0;
    for (const Equilibrium& rod : out_.state.rods)
      for (const Vec3& p : rod.points) farthest = std::max(farthest, std::abs(p.z()));
    return farthest;
  }

  const Peg* peg_at(int rod, double at) const {
    for (const Peg& peg : pegs_)
      if (peg.rod == rod && std::abs(peg.at - at) <= 1e-9 * size_) return &peg;
    return nullptr;
  }

  /// Where a place of the first rod is when that is straight between its pegs.
  Vec3 between_pegs(double at) const {
    const Peg *before = nullptr, *after = nullptr;
    for (const Peg& peg : pegs_) {
      if (peg.rod != 0) continue;
      if (peg.at <= at && (!before || peg.at > before->at)) before = &peg;
      if (peg.at >= at && (!after || peg.at < after->at)) after = &peg;
    }
    if (!before || !after) return (before ? before : after)->to;
    return before->to + (at - before->at) / std::max(after->at - before->at, 1e-300) * (after->to - before->to);
  }

  /// One solve with springs of so many units; pegs have their own.
  bool step(double share, double peg_share) {
    SystemProblem problem = free_;
    std::vector<std::vector<double>> stiffness(problem.rods.size());
    for (std::size_t k = 0; k < problem.rods.size(); ++k) {
      const Equilibrium& rod = out_.state.rods[k];
      problem.rods[k].springs.clear();
      for (std::size_t i = 0; i < rod.s.size(); ++i) {
        const Peg* peg = peg_at(static_cast<int>(k), rod.s[i]);
        const double each = unit_ * (peg ? std::max(share, peg_share) : share);
        Frame to{rod.points[i], rod.rotations[i]};
        if (peg) to.at = peg->to;
        to.at.z() = -push_[k][i] / each;
        stiffness[k].push_back(each);
        const bool held = k == 0 && static_cast<int>(i) == held_;
        problem.rods[k].springs.push_back({rod.s[i], to, held ? 0 : each, held ? keeps_spin * moment_ : 0});
      }
    }
    const Equilibrium& first = out_.state.rods.front();
    Hold hold;
    hold.at = first.s[held_];
    hold.frame = {hold_at_, first.rotations[held_]};
    hold.orientation = false;
    problem.rods.front().holds = {hold};
    SystemEquilibrium found = solve(problem, following(), context_, &out_.state);
    ++out_.solves;
    if (!found.ok()) {
      out_.message = found.rods.front().message;
      return false;
    }
    moved_ = 0;
    for (std::size_t k = 0; k < found.rods.size(); ++k)
      for (std::size_t i = 0; i < found.rods[k].points.size(); ++i) {
        moved_ = std::max(moved_, (found.rods[k].points[i] - out_.state.rods[k].points[i]).norm());
        push_[k][i] += stiffness[k][i] * found.rods[k].points[i].z();
      }
    out_.state = std::move(found);
    return true;
  }

  const SystemProblem& free_;
  const std::vector<Peg>& pegs_;
  const RunContext& context_;
  double size_, moment_, unit_;
  int held_;
  Vec3 hold_at_;
  std::vector<std::vector<double>> push_;  ///< N, that the board exerts downwards, by rod and vertex
  double moved_ = 0;
  Pressed out_;
};

}  // namespace

void keep_vertices(SystemProblem& free, const SystemEquilibrium& state) {
  for (std::size_t k = 0; k < free.rods.size(); ++k)
    for (const double s : state.rods[k].s) free.rods[k].springs.push_back({s, Frame{}, 0, 0});
}

Relaxed relaxed_on_board(const SystemProblem& free, const SystemEquilibrium& routed, const RunContext& context) {
  Relaxed out;
  out.state = routed;
  const double unit = bending(free) / std::pow(longest(free), 2);
  const int held = middle_vertex(free, routed.rods.front());
  const Equilibrium& first = routed.rods.front();
  for (int power = 3; power >= -3; --power) {
    SystemProblem problem = free;
    problem.rods.front().holds = {{first.s[held], {first.points[held], first.rotations[held]}}};
    if (power > -3)
      for (std::size_t k = 0; k < free.rods.size(); ++k)
        for (std::size_t i = 0; i < routed.rods[k].s.size(); ++i)
          problem.rods[k].springs[i] = {routed.rods[k].s[i], {routed.rods[k].points[i], routed.rods[k].rotations[i]}, unit * std::pow(10, power), 0};
    SystemEquilibrium found = solve(problem, following(), context, &out.state);
    ++out.solves;
    out.message = found.rods.front().message;
    if (!found.ok() && (power == -3 || context.stop())) return out;
    if (found.ok()) out.state = std::move(found);
  }
  move_rigidly(out.state, onto_plane(out.state));
  out.ok = true;
  return out;
}

std::vector<Peg> pegs_of(const SystemProblem& free, const BoardGraph& graph, const std::vector<Vec3>& layout) {
  std::vector<Peg> pegs;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const BoardNode& node = graph.nodes[n];
    if (node.branch < 0) pegs.push_back({node.rod, node.at, layout[n]});
    else pegs.push_back({free.branches[node.branch].sections.front().rod, free.branches[node.branch].sections.front().at, layout[n]});
  }
  return pegs;
}

Pressed pressed_flat(const SystemProblem& free, const SystemEquilibrium& relaxed, const std::vector<Peg>& pegs, const RunContext& context) {
  return Press(free, relaxed, pegs, context).run();
}

void move_rigidly(SystemEquilibrium& state, const Frame& motion) {
  const auto turn = [&](Reaction& reaction) {
    reaction.force = motion.rotation * reaction.force;
    reaction.moment = motion.rotation * reaction.moment;
  };
  for (Equilibrium& rod : state.rods) {
    for (Vec3& p : rod.points) p = motion.at + motion.rotation * p;
    for (Quat& q : rod.rotations) q = motion.rotation * q;
    for (Vec3& f : rod.forces) f = motion.rotation * f;
    for (Reaction& reaction : rod.reactions) turn(reaction);
  }
  for (Frame& branch : state.branches) branch = motion * branch;
  for (Reaction& support : state.branch_supports) turn(support);
}

}  // namespace tendril::assembly
