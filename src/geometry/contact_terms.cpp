// The contact terms of Surroundings: one for a solid, the inclusion-exclusion sum of the triangles in range for a mesh.

#include <algorithm>
#include <cmath>

#include "geometry/closest_point.h"
#include "geometry/surroundings.h"

namespace tendril {

namespace {

// Nearer than this to a primitive (relative to the range) the direction away from it is lost in rounding.
constexpr double lost_direction = 1e-12;

// Collects the terms of one mesh at one point and turns them into world axes.
struct MeshTerms {
  const Vec3& p;  ///< in the mesh's axes
  double reach;   ///< m, offset included
  double offset;
  const Mat3& axes;
  int obstacle;
  std::vector<DistanceTerm>& out;

  void add(double weight, double distance, const Vec3& normal, const Mat3& hessian) const {
    const Mat3 turned = axes * hessian * axes.transpose();
    out.push_back({weight, distance - offset, axes * normal, turned, obstacle});
  }

  // `across`: the unit normal of the triangle's plane, which also stands for the direction away from an edge or a
  // vertex where p lies on it.
  void add_face(double weight, const TriangleFoot& foot, const Vec3& corner, const Vec3& across) const {
    add(weight, std::sqrt(foot.squared), across.dot(p - corner) < 0 ? Vec3(-across) : across, Mat3::Zero());
  }
  void add_edge(double weight, const SegmentFoot& foot, const Vec3& along, const Vec3& across) const {
    const double d = std::sqrt(foot.squared);
    if (!(d < reach)) return;
    if (!(d > lost_direction * reach)) return add(weight, d, across, Mat3::Zero());
    const Vec3 normal = (p - foot.point) / d, beside = normal.cross(along).normalized();
    add(weight, d, normal, beside * beside.transpose() / d);
  }
  void add_vertex(double weight, const Vec3& vertex, const Vec3& across) const {
    const double d = (p - vertex).norm();
    if (!(d < reach)) return;
    if (!(d > lost_direction * reach)) return add(weight, d, across, Mat3::Zero());
    const Vec3 normal = (p - vertex) / d;
    add(weight, d, normal, (Mat3::Identity() - normal * normal.transpose()) / d);
  }

  // A foot on a side, or outside it by no more than rounding, counts as within the face: else a point above the side
  // between two faces of one plane would find both of them ending there and feel a ridge that is not there.
  bool within_face(const TriangleFoot& foot, const Vec3 (&corner)[3]) const {
    if (foot.inside) return true;
    const Vec3 one = corner[1] - corner[0], other = corner[2] - corner[0], normal = one.cross(other);
    const double nn = normal.squaredNorm(), longest = std::max(one.squaredNorm(), other.squaredNorm());
    if (!(nn > 1e-24 * longest * longest)) return false;
    const double height = normal.dot(p - corner[0]);
    return foot.squared * nn - height * height <= 1e-14 * foot.squared * nn;
  }

  // Where the closest point of the face is that of a side, or that of a side is a corner, the distances are one: their
  // weights are added up first, and mostly cancel.
  void add_triangle(const Vec3 (&corner)[3], const FeatureWeights& weights) const {
    const TriangleFoot foot = closest_on_triangle(p, corner[0], corner[1], corner[2]);
    if (!(foot.squared < reach * reach)) return;
    double side[3] = {weights.edge[0], weights.edge[1], weights.edge[2]};
    double vertex[3] = {weights.vertex[0], weights.vertex[1], weights.vertex[2]};
    const bool inside = within_face(foot, corner);
    if (!inside) side[foot.side] += weights.face;
    for (int k = 0; k < 3; ++k)
      if (foot.sides[k].end >= 0) {
        vertex[(k + foot.sides[k].end) % 3] += side[k];
        side[k] = 0;
      }
    const bool any = inside || side[0] != 0 || side[1] != 0 || side[2] != 0 || vertex[0] != 0 || vertex[1] != 0 ||
                     vertex[2] != 0;
    if (!any) return;
    const Vec3 plane = (corner[1] - corner[0]).cross(corner[2] - corner[0]).stableNormalized();
    const Vec3 across = plane.squaredNorm() > 0.5 ? plane : Vec3::UnitZ();
    if (inside) add_face(weights.face, foot, corner[0], across);
    for (int k = 0; k < 3; ++k) {
      if (side[k] != 0) add_edge(side[k], foot.sides[k], corner[(k + 1) % 3] - corner[k], across);
      if (vertex[k] != 0) add_vertex(vertex[k], corner[k], across);
    }
  }
};

}  // namespace

void Surroundings::add_solid_term(int index, const Vec3& p, double range, std::vector<DistanceTerm>& out) const {
  const Entry& entry = entries_[index];
  const SolidDistance found = distance_to(std::get<Solid>(entry.obstacle.shape), entry.to_local(p));
  const double distance = found.distance - entry.obstacle.offset;
  if (!(distance < range)) return;
  out.push_back({1, distance, entry.axes * found.normal, entry.axes * found.hessian * entry.axes.transpose(), index});
}

void Surroundings::add_mesh_terms(int index, const Vec3& p, double range, std::vector<DistanceTerm>& out) const {
  const Entry& entry = entries_[index];
  const DistanceTree& tree = entry.surface->tree();
  const Mesh& mesh = entry.surface->mesh();
  const std::vector<FeatureWeights>& weights = entry.surface->topology().weights;
  const Vec3 local = entry.to_local(p);
  const double reach = range + entry.obstacle.offset;
  const MeshTerms terms{local, reach, entry.obstacle.offset, entry.axes, index, out};
  tree.visit_near(local, reach, [&](int triangle) {
    if (weights[triangle].face == 0) return;
    const auto& t = mesh.triangles[triangle];
    terms.add_triangle({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, weights[triangle]);
  });
}

}  // namespace tendril
