// From the unknowns of a curve of straights and arcs to its geometry, and from derivatives by the geometry back to the unknowns.
//
// Unknowns: the distance along either end's direction to its vertex, two angles for each end that may turn within a cone, and
// the inner vertices. With a single vertex only one end has these unknowns; the direction at the other one follows. So it does
// at ends that may have any direction (cones of pi): the vertices next to them are inner ones.
#pragma once

#include <vector>

#include "method/pcc/pcc_demands.h"

namespace tendril::routing {

/// Straights and arcs for one value of the unknowns. With m vertices: m + 2 points, m + 1 edges.
/// Vertex i (1 ... m) has the arc i - 1; edge i runs from point i to point i + 1.
struct PccShape {
  std::vector<Vec3> points;     ///< m
  std::vector<Vec3> along;      ///< of the edges, unit
  std::vector<double> edges;    ///< m; those at the ends may be negative
  std::vector<double> turns;    ///< rad
  std::vector<double> tangents; ///< m, from a vertex to where its arc begins and ends
  std::vector<double> tangent_slopes;  ///< of the tangents by the turns, m
  std::vector<double> straights;       ///< m, what the arcs leave of the edges; negative where they overlap
  double length = 0;            ///< m
};

/// Derivatives of one number by what PccShape holds, each as if it were independent of the others. (Tangents and straights
/// count through turns and edges.)
struct PccAdjoint {
  std::vector<Vec3> points, along;
  std::vector<double> edges, turns;
  void reset(int bends);
  void add_straight(const PccShape& shape, int edge, double by);     ///< of PccShape::straights
  void add_length(const PccShape& shape, const std::vector<double>& radii, double by);  ///< of PccShape::length
};

/// Where a single vertex is nearest to being on both ends' directions, m.
Vec3 crossing(const Ends& ends);

class PccUnknowns {
 public:
  /// Throws UsageError for no bend at all, radii that are not finite and positive, and ends that are not finite or have no
  /// direction.
  PccUnknowns(const PccDemands& demands, const Ends& ends, const std::vector<double>& radii);

  int size() const { return size_; }
  int bends() const { return static_cast<int>(radii_.size()); }
  const std::vector<double>& radii() const { return radii_; }
  /// The tangent grows linearly with the turn from here (rad) on, once differentiable, so that it stays finite.
  double linear_from = 2.75;

  /// The unknowns nearest to a curve with as many vertices.
  Eigen::VectorXd nearest(const PccPoints& curve) const;
  void evaluate(const Eigen::VectorXd& x, PccShape& shape) const;
  /// The gradient by the unknowns; uses up the adjoint.
  void pull_back(const Eigen::VectorXd& x, const PccShape& shape, PccAdjoint& adjoint, Eigen::VectorXd& gradient) const;

  /// Other ends; the unknowns mean the same as before, seen from there. Throws UsageError as the constructor does.
  void move(const Ends& ends);
  /// Derivatives by the ends' places (1/m) and by their directions as if those were any vectors, after pull_back(). Of ends whose
  /// directions are fixed or may be any, and curves with as many bends as fixed directions.
  Ends pull_to_ends(const Eigen::VectorXd& x, const PccAdjoint& adjoint) const;

  /// How far the directions at start and finish have turned away (rad), and its derivatives added to a gradient or adjoint.
  double start_turn(const PccShape& shape) const { return turn_between(start_.along, shape.along.front()); }
  double finish_turn(const PccShape& shape) const { return turn_between(finish_.along, shape.along.back()); }
  void add_start_turn(const PccShape& shape, double by, PccAdjoint& adjoint) const;
  void add_finish_turn(const PccShape& shape, double by, PccAdjoint& adjoint) const;

 private:
  /// An end with the unknowns that belong to it.
  struct End {
    Vec3 at, along;         ///< along: into the curve at the start, out of it at the finish
    Vec3 side, up;          ///< unit, normal to `along`
    bool tied = true;       ///< its vertex lies on its direction
    int distance = -1;      ///< index of the unknown distance
    int angles = -1;        ///< index of the first of two unknown angles; -1: the direction is fixed
    double sign = 1;        ///< of the way from the end to its vertex
  };
  Vec3 direction(const End& end, const Eigen::VectorXd& x) const;
  void pull_end(const End& end, const Eigen::VectorXd& x, double edge, const Vec3& along, const Vec3& vertex,
                Eigen::VectorXd& gradient) const;
  void place_end(const End& end, const Vec3& vertex, Eigen::VectorXd& x) const;

  End start_, finish_;
  std::vector<double> radii_;
  double angle_unit_ = 1;   ///< m per rad: makes the angles comparable with the other unknowns
  int inner_ = 0;           ///< index of the first inner vertex's coordinates
  int first_ = 2, inner_count_ = 0;  ///< inner vertices: those that lie on no end's direction
  int size_ = 0;
};

}  // namespace tendril::routing
