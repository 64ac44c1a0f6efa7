#include "statics/network_guess.h"

#include <Eigen/SVD>
#include <algorithm>

#include "base/units.h"
#include "statics/block_ldlt.h"
#include "statics/first_guess.h"

namespace tendril {
namespace {

/// A place along a rod that is held or belongs to a branch point.
struct Stop {
  double s;
  int branch;       ///< -1: a hold
  Frame frame;      ///< of the hold; of the section seen from the branch point
  bool oriented;
};

/// A stretch of rod between two neighbouring stops.
struct Span {
  Stop a, b;
  double length;
};

std::vector<std::vector<Stop>> stops_by_rod(const SystemProblem& problem) {
  std::vector<std::vector<Stop>> stops(problem.rods.size());
  for (std::size_t k = 0; k < problem.rods.size(); ++k)
    for (const Hold& hold : problem.rods[k].holds)
      if (hold.position) stops[k].push_back({hold.at, -1, hold.frame, hold.orientation});
  for (std::size_t b = 0; b < problem.branches.size(); ++b)
    for (const JoinedSection& section : problem.branches[b].sections)
      stops[section.rod].push_back({section.at, static_cast<int>(b), section.relative, true});
  for (std::vector<Stop>& list : stops)
    std::sort(list.begin(), list.end(), [](const Stop& x, const Stop& y) { return x.s < y.s; });
  return stops;
}

std::vector<Span> spans_of(const SystemProblem& problem) {
  std::vector<Span> spans;
  for (const std::vector<Stop>& stops : stops_by_rod(problem))
    for (std::size_t i = 1; i < stops.size(); ++i)
      spans.push_back({stops[i - 1], stops[i], std::max(stops[i].s - stops[i - 1].s, 1e-12)});
  return spans;
}

/// Equilibrium of the net of springs.
void place_branches(const SystemProblem& problem, const std::vector<Span>& spans, std::vector<Frame>& branches) {
  const int n = static_cast<int>(branches.size());
  BlockPattern pattern;
  pattern.nodes = n;
  std::vector<double> springs;
  for (const Span& span : spans)
    if (span.a.branch >= 0 && span.b.branch >= 0 && span.a.branch != span.b.branch) {
      pattern.edges.push_back({span.a.branch, span.b.branch});
      springs.push_back(1 / span.length);
    }
  BlockSystem net;
  net.resize(n, static_cast<int>(springs.size()));
  for (int b = 0; b < n; ++b) {
    net.diagonal[b] = 1e-9 * Mat6::Identity();  // a group of branch points that nothing holds stays where it was drawn
    net.gradient[b].setZero();
    net.gradient[b].head<3>() = -1e-9 * branches[b].at;
  }
  for (std::size_t e = 0; e < springs.size(); ++e) net.upper[e] = -springs[e] * Mat6::Identity();
  const auto pull = [&](const Stop& from, const Stop& to, double spring) {
    if (from.branch < 0 || from.branch == to.branch) return;
    net.diagonal[from.branch] += spring * Mat6::Identity();
    if (to.branch < 0) net.gradient[from.branch].head<3>() -= spring * to.frame.at;
  };
  for (const Span& span : spans) {
    pull(span.a, span.b, 1 / span.length);
    pull(span.b, span.a, 1 / span.length);
  }
  for (int b = 0; b < n; ++b)
    if (problem.branches[b].position) {
      net.diagonal[b] += 1e15 * Mat6::Identity();
      net.gradient[b].head<3>() -= 1e15 * problem.branches[b].frame.at;
    }
  BlockLdlt ldlt(pattern);
  ldlt.factor(net);
  std::vector<Vec6> place;
  ldlt.newton_step(place);
  for (int b = 0; b < n; ++b)
    branches[b].at = problem.branches[b].position ? problem.branches[b].frame.at : Vec3(place[b].head<3>());
}

/// What one span says about the orientation of the branch point at its one end.
struct Wish {
  int other;         ///< branch point at the other end, -1: a hold
  double weight;
  double sign;       ///< +1: the rod leaves the branch point towards larger s
  Frame section;     ///< seen from the branch point
  Stop far;
};

Vec3 place_of(const Stop& stop, const std::vector<Frame>& branches) {
  return stop.branch < 0 ? stop.frame.at : (branches[stop.branch] * stop.frame).at;
}

/// The rotation that suits the spans best: they leave towards their other ends, and do not twist on the way to a far end
/// whose orientation is known.
Quat turn_branch(int branch, const std::vector<Wish>& wishes, const std::vector<Frame>& branches, const std::vector<char>& known) {
  Mat3 sum = 1e-6 * branches[branch].rotation.toRotationMatrix();
  double total = 0;
  for (const Wish& wish : wishes) total += wish.weight;
  if (total > 0) sum *= total;
  for (const Wish& wish : wishes) {
    Vec3 way = wish.sign * (place_of(wish.far, branches) - (branches[branch] * wish.section).at);
    if (way.norm() < 1e-12) continue;
    way.normalize();
    sum += wish.weight * way * (wish.section.rotation * Vec3::UnitZ()).transpose();
    const bool oriented = wish.other < 0 ? wish.far.oriented : static_cast<bool>(known[wish.other]);
    if (!oriented) continue;
    const Quat there = wish.other < 0 ? wish.far.frame.rotation : (branches[wish.other] * wish.far.frame).rotation;
    const Quat here = shortest_turn(there * Vec3::UnitZ(), way) * there;  // the far section, brought along the chord
    sum += 0.3 * wish.weight * (here * wish.section.rotation.conjugate()).toRotationMatrix();
  }
  const Eigen::JacobiSVD<Mat3> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) {
    Mat3 u = svd.matrixU();
    u.col(2) *= -1;
    turn = u * svd.matrixV().transpose();
  }
  return Quat(turn);
}

/// Outwards from what is held.
void turn_branches(const SystemProblem& problem, const std::vector<Span>& spans, std::vector<Frame>& branches) {
  const int n = static_cast<int>(branches.size());
  std::vector<std::vector<Wish>> wishes(n);
  for (const Span& span : spans) {
    if (span.a.branch >= 0) wishes[span.a.branch].push_back({span.b.branch, 1 / span.length, 1, span.a.frame, span.b});
    if (span.b.branch >= 0) wishes[span.b.branch].push_back({span.a.branch, 1 / span.length, -1, span.b.frame, span.a});
  }
  std::vector<char> known(n, 0), queued(n, 0);
  std::vector<int> queue;
  const auto put = [&](int b) {
    if (!queued[b]) queue.push_back(b);
    queued[b] = 1;
  };
  for (int b = 0; b < n; ++b) {
    known[b] = problem.branches[b].orientation;
    const bool near_hold = std::any_of(wishes[b].begin(), wishes[b].end(), [](const Wish& w) { return w.other < 0; });
    if (known[b] || near_hold) put(b);
  }
  for (int b = 0, next = 0; b < n || next < static_cast<int>(queue.size());) {
    if (next == static_cast<int>(queue.size())) {
      put(b++);
      continue;
    }
    const int branch = queue[next++];
    if (!problem.branches[branch].orientation) branches[branch].rotation = turn_branch(branch, wishes[branch], branches, known);
    known[branch] = 1;
    for (const Wish& wish : wishes[branch])
      if (wish.other >= 0) put(wish.other);
  }
}

/// Turns the side to which the slack falls, and adds turns to the last section whose orientation is held.
void vary(const GuessVariant& variant, RodProblem& rod) {
  const auto earlier = [](const Hold& a, const Hold& b) { return a.at < b.at; };
  const auto [first, last] = std::minmax_element(rod.holds.begin(), rod.holds.end(), earlier);
  const Vec3 chord = last->frame.at - first->frame.at;
  if (chord.norm() > 0) {
    const Vec3 along = chord.normalized();
    const Vec3 down = rod.gravity.isZero(0) ? Vec3(first->frame.d1()) : rod.gravity;
    const Vec3 across = down - along * along.dot(down);
    rod.gravity = Eigen::AngleAxisd(variant.bulge * units::deg, along) *
                  (across.norm() > 1e-6 * down.norm() ? across : Vec3(along.unitOrthogonal()));
  }
  if (last->orientation) last->turns += variant.turns;
}

bool same_place(const Frame& a, const Frame& b, double length, bool position, bool orientation) {
  constexpr double near = 1e-3;  // rad, and share of the length
  return (!position || (a.at - b.at).norm() < near * length) && (!orientation || a.rotation.angularDistance(b.rotation) < near);
}

/// True where every rod's unstressed shape lies in the world as its holds and branch points have it: the drawing of a harness.
bool drawn_in_place(const SystemProblem& problem) {
  for (const RodProblem& rod : problem.rods) {
    if (!rod.rod.shape) return false;
    for (const Hold& hold : rod.holds)
      if (hold.turns != 0 || !same_place(rod.rod.shape(hold.at), hold.frame, rod.rod.length, hold.position, hold.orientation)) return false;
  }
  for (const BranchPoint& branch : problem.branches)
    for (const JoinedSection& section : branch.sections) {
      const Rod& rod = problem.rods[section.rod].rod;
      if (!same_place(rod.shape(section.at), branch.frame * section.relative, rod.length, true, true)) return false;
    }
  return true;
}

/// Nothing but the loads is out of balance then.
NetworkGuess as_drawn(const RodNetwork& network) {
  NetworkGuess guess;
  for (const BranchPoint& branch : network.problem().branches) guess.branches.push_back(branch.frame);
  for (int k = 0; k < network.rods(); ++k) {
    guess.rods.emplace_back();
    for (const double s : network.rod(k).mesh().s) guess.rods.back().push_back(network.problem().rods[k].rod.shape(s));
  }
  return guess;
}

}  // namespace

void hold_at_branches(const RodNetwork& network, const NetworkGuess& guess, int rod, RodProblem& problem, RodMesh& mesh) {
  const std::vector<BranchPoint>& branches = network.problem().branches;
  std::size_t seen = 0;
  for (std::size_t b = 0; b < branches.size(); ++b)
    for (const JoinedSection& section : branches[b].sections) {
      if (section.rod != rod) continue;
      problem.holds.push_back({section.at, guess.branches[b] * section.relative});
      mesh.hold_vertex.push_back(mesh.joint_vertex[seen++]);
    }
}

NetworkGuess network_guess(const RodNetwork& network, const GuessVariant& variant) {
  const SystemProblem& problem = network.problem();
  if (variant.rod < 0 && !problem.branches.empty() && drawn_in_place(problem)) return as_drawn(network);
  NetworkGuess guess;
  for (const BranchPoint& branch : problem.branches) guess.branches.push_back(branch.frame);
  if (!problem.branches.empty()) {
    const std::vector<Span> spans = spans_of(problem);
    place_branches(problem, spans, guess.branches);
    turn_branches(problem, spans, guess.branches);
  }
  for (int k = 0; k < network.rods(); ++k) {
    if (problem.branches.empty() && variant.rod != k) {
      guess.rods.push_back(first_guess(problem.rods[k], network.rod(k).mesh()));
      continue;
    }
    RodProblem held = problem.rods[k];
    RodMesh mesh = network.rod(k).mesh();
    hold_at_branches(network, guess, k, held, mesh);
    if (variant.rod == k) vary(variant, held);
    guess.rods.push_back(first_guess(held, mesh));
  }
  return guess;
}

}  // namespace tendril
