#include "method/route/harness_descent.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "method/pcc/bfgs.h"
#include "method/pcc/pcc_terms.h"

namespace tendril::routing {

namespace {

// Penalty weights times the bend radius. The first is higher than in descents of single curves: these ones are smooth already, and
// a junction that slips through a wall does not come back.
constexpr std::array<double, 2> weights = {50, 500};
constexpr int iterations = 400;
// What is demanded is held with this much to spare (m, and share of the radius), so that ends which stay leave room to keep it.
constexpr double margin = 1e-3, slack = 0.01;

// rad: bends that turn less are left out and, where there are too few, made anew with room around them. A straight end that is as
// short as it may be has a kink where its bend does not turn: descents would end there.
constexpr double hardly_turned = 0.02;

PccPoints without_idle_bends(const PccPoints& curve) {
  PccPoints less{{curve.points.front()}, {}};
  const std::vector<Vec3> along = edge_directions(curve.points);
  for (int i = 0; i < curve.bends(); ++i) {
    if (turn_between(along[i], along[i + 1]) < hardly_turned) continue;
    less.points.push_back(curve.points[i + 1]);
    less.radii.push_back(curve.radii[i]);
  }
  less.points.push_back(curve.points.back());
  return less;
}

/// At least two bends, so that both ends' directions can be kept whatever they are.
PccPoints with_two_bends(const PccPoints& curve, double radius) {
  PccPoints more = curve;
  const std::vector<Vec3>& p = curve.points;
  if (curve.bends() == 0) {
    const double share = std::min(1.0 / 3, radius / (p[1] - p[0]).norm());  // near the ends, where directions change
    more.points = {p[0], p[0] + share * (p[1] - p[0]), p[1] - share * (p[1] - p[0]), p[1]};
    more.radii = {radius, radius};
  } else if (curve.bends() == 1) {
    const double in = (p[1] - p[0]).norm(), out = (p[2] - p[1]).norm(), back = 0.25 * std::min({in, out, radius});
    more.points = {p[0], p[1] + back / in * (p[0] - p[1]), p[1] + back / out * (p[2] - p[1]), p[2]};
    more.radii = {curve.radii[0], curve.radii[0]};
  }
  return more;
}

struct BranchTerms {
  PccDemands demands;
  PccUnknowns unknowns;
  PccTerms terms;
  int first = 0;             ///< of its unknowns
  Eigen::VectorXd gradient;

  BranchTerms(const FreeSpace& space, const PccDemands& demanded, const Ends& ends, const std::vector<double>& radii)
      : demands(demanded), unknowns(demands, ends, radii), terms(space, demands, unknowns, margin) {
    terms.slack = slack * radii.front();
  }
};

class HarnessTerms {
 public:
  HarnessTerms(const FreeSpace& space, const HarnessOptions& options, const HarnessShape& shape) : options_(options), shape_(shape) {
    unit_ = options.min_bend_radius;
    for (std::size_t j = 0; j < shape.junctions.size(); ++j) junctions_.push_back(6 * static_cast<int>(j));  // place and trunk
    size_ = 6 * static_cast<int>(shape.junctions.size());
    for (std::size_t b = 0; b < shape.branches.size(); ++b) {
      ShapeBranch& branch = shape_.branches[b];
      branch.points = with_two_bends(without_idle_bends(branch.points), unit_);
      branches_.push_back(std::make_unique<BranchTerms>(space, demands_of(options, branch, shape.cones(static_cast<int>(b))), shape.ends(static_cast<int>(b), options.connections),
                                                        branch.points.radii));
      branches_.back()->first = size_;
      size_ += branches_.back()->unknowns.size();
    }
  }

  Eigen::VectorXd start() const {
    Eigen::VectorXd x(size_);
    for (std::size_t j = 0; j < junctions_.size(); ++j) {
      const ShapeJunction& junction = shape_.junctions[j];
      x.segment<3>(junctions_[j]) = junction.at;
      x.segment<3>(junctions_[j] + 3) = unit_ * junction.leaving[0];
    }
    for (std::size_t b = 0; b < branches_.size(); ++b)
      x.segment(branches_[b]->first, branches_[b]->unknowns.size()) = branches_[b]->unknowns.nearest(shape_.branches[b].points);
    return x;
  }

  /// Junctions by the unknowns, and the branches' ends with them.
  void place(const Eigen::VectorXd& x) {
    for (std::size_t j = 0; j < junctions_.size(); ++j) {
      ShapeJunction& junction = shape_.junctions[j];
      junction.at = x.segment<3>(junctions_[j]);
      junction.leaving[0] = x.segment<3>(junctions_[j] + 3).normalized();
      junction.leaving[1] = -junction.leaving[0];
    }
    for (std::size_t b = 0; b < branches_.size(); ++b) branches_[b]->unknowns.move(shape_.ends(static_cast<int>(b), options_.connections));
  }
  void weigh(double weight) {
    for (auto& branch : branches_) branch->terms.weight = weight / unit_;
  }
  void plan(const Eigen::VectorXd& x) {
    place(x);
    for (auto& branch : branches_) branch->terms.plan(own(x, *branch), 8e-3);
  }
  bool planned(const Eigen::VectorXd& x) {
    place(x);
    return std::all_of(branches_.begin(), branches_.end(), [&](auto& branch) { return branch->terms.planned(own(x, *branch)); });
  }

  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    for (const int first : junctions_)
      if (!(x.segment<3>(first + 3).norm() > 1e-6 * unit_)) return std::numeric_limits<double>::infinity();
    place(x);
    gradient.setZero(size_);
    double sum = 0;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      BranchTerms& branch = *branches_[b];
      const double factor = shape_.branches[b].factor;
      const Eigen::VectorXd xb = own(x, branch);
      sum += factor * branch.terms(xb, branch.gradient);
      gradient.segment(branch.first, branch.gradient.size()) = factor * branch.gradient;
      const Ends by = branch.terms.by_ends(xb);
      add_end(shape_.branches[b].from, static_cast<int>(b), factor * by.start, factor * by.start_along, x, gradient);
      add_end(shape_.branches[b].to, static_cast<int>(b), factor * by.finish, -factor * by.finish_along, x, gradient);
    }
    return sum;
  }

  HarnessShape shape(const Eigen::VectorXd& x) {
    place(x);
    HarnessShape result = shape_;
    PccShape curve;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      branches_[b]->unknowns.evaluate(own(x, *branches_[b]), curve);
      result.branches[b].points.points = curve.points;
    }
    result.take_directions();
    return result;
  }
  double unit() const { return unit_; }

 private:
  Eigen::VectorXd own(const Eigen::VectorXd& x, const BranchTerms& branch) const { return x.segment(branch.first, branch.unknowns.size()); }
  void add_end(const HarnessEnd& end, int branch, const Vec3& by_place, const Vec3& by_leaving, const Eigen::VectorXd& x,
               Eigen::VectorXd& gradient) const {
    if (!end.junction) return;
    const ShapeJunction& junction = shape_.junctions[end.number];
    const std::size_t k = std::find(junction.branches.begin(), junction.branches.end(), branch) - junction.branches.begin();
    gradient.segment<3>(junctions_[end.number]) += by_place;
    if (k > 1) return;
    const int at = junctions_[end.number] + 3;
    const Vec3 along = junction.leaving[k], by = by_leaving - along.dot(by_leaving) * along;
    gradient.segment<3>(at) += (k == 1 ? -1 : 1) / x.segment<3>(at).norm() * by;
  }

  const HarnessOptions& options_;
  HarnessShape shape_;
  double unit_ = 1;
  int size_ = 0;
  std::vector<int> junctions_;                          ///< first unknown of each
  std::vector<std::unique_ptr<BranchTerms>> branches_;
};

}  // namespace

HarnessShape descend_together(const FreeSpace& space, const HarnessOptions& options, const HarnessShape& shape, const RunContext& context) {
  HarnessTerms terms(space, options, shape);
  Eigen::VectorXd x = terms.start();
  BfgsOptions bfgs;
  bfgs.iterations = iterations;
  bfgs.largest_step = 0.2 * terms.unit();
  for (const double weight : weights) {
    terms.weigh(weight);
    const bool last = weight == weights.back();
    bfgs.gradient = last ? 1e-4 : 1e-2;
    bfgs.decrease = last ? 1e-8 : 1e-5;
    for (int round = 0; round < 3 && !context.stop(); ++round) {
      if (round > 0 && terms.planned(x)) break;
      terms.plan(x);
      minimize([&](const Eigen::VectorXd& at, Eigen::VectorXd& by) { return terms(at, by); }, x, bfgs, context);
    }
  }
  return terms.shape(x);
}

}  // namespace tendril::routing
