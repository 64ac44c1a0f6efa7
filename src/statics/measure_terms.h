// What is read off one SE(3) rod, piece by piece: each adds its value and its derivatives to a measure's.
#pragma once

#include <initializer_list>

#include "statics/measure.h"

namespace tendril {

class RodMeasureTerms {
 public:
  /// `index`: of the rod in the network; `first_node`: where its part of `out.by_state` begins.
  RodMeasureTerms(const RodDerivatives& rod, int index, int first_node, MeasureSlopes& out);

  /// To be called last: what was added by wrenches and rates becomes derivatives by state and parameters.
  void finish() { rod_.add_pull_back(by_wrench_, by_state_, by_rod_); }

  int segment_at(double at) const;
  int vertex_at(double at) const;   ///< the nearest one
  int sharpest_vertex() const;
  int tightest_segment() const;
  int most_strained_segment() const;

  /// The section at an arc length; `along` in world axes (measure.h).
  void add_position(double at, const Vec3& along);
  void add_rotation(double at, const Vec3& along);
  void add_tangent(double at, const Vec3& along);
  /// Position along a unit normal from `origin`, less the radius; the place stays with the material.
  void add_gap(double at, const Vec3& origin, const Vec3& normal);

  /// One segment.
  void add_force(int segment, const Vec3& along);
  void add_moment(int segment, const Vec3& along);
  void add_tension(int segment);
  void add_twist(int segment);
  void add_strain(int segment);
  void add_bend_radius(int vertex);

  /// The whole rod.
  void add_length();
  void add_elastic(std::initializer_list<int> components);  ///< 0-5: GA1, GA2, EA, EI1, EI2, GJ
  void add_gravity();
  void add_loads();

 private:
  /// Where an arc length lies: share `t` of the way from vertex `segment` to the next.
  struct Place {
    int segment;
    double t, h;
    bool moves_with_mesh;
  };
  Place place_of(double at) const;
  Vec3 add_point(const Place& place, const Vec3& along);
  /// Adds weight . (rotation increment of the section in its own axes).
  void add_turn(const Place& place, const Vec3& weight);
  Frame section_at(const Place& place) const;
  void add_share(const Place& place, double slope);
  struct BendWeight {
    int segment;
    double weight;
  };
  std::vector<BendWeight> bend_weights(int vertex) const;
  Vec3 curvature(int segment) const;
  Vec3 strain(int segment) const;
  double tension(int segment) const;

  const RodDerivatives& rod_;
  const RodMesh& mesh_;
  StateView state_;
  int first_;
  Vec6* by_state_;   ///< of this rod's nodes
  WrenchSlopes by_wrench_;
  RodSlopes& by_rod_;
  MeasureSlopes& out_;
};

}  // namespace tendril
