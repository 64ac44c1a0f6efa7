// The contact terms of Surroundings: one for a solid, the inclusion-exclusion sum of the triangles in range for a mesh.

#include <cmath>

#include "base/units.h"
#include "geometry/closest_point.h"
#include "geometry/surroundings.h"

namespace tendril {

namespace {

// Nearer than this to a primitive (relative to the range) the direction away from it is lost in rounding.
constexpr double lost_direction = 1e-12;

// Feet nearer together than 1e-7 of the distance are in one place; this is the square.
constexpr double same_place = 1e-14;

// Collects the terms of one mesh at one point, measured in the mesh's axes and told in world axes.
struct MeshTerms {
  const Vec3& p;  ///< in the mesh's axes
  double reach;   ///< m, thickness included
  double thickness;
  const Mat3& axes;
  int obstacle;
  std::vector<DistanceTerm>& out;

  // `normal` is in world axes here, and so are the directions that Hessians are made of: cheaper than turning a matrix.
  void add(double weight, double distance, const Vec3& normal, const Mat3& hessian) const {
    out.push_back({weight, distance - thickness, normal, hessian, obstacle});
  }

  // `across`: the unit normal of the triangle's plane, which also stands for the direction away from an edge or a
  // vertex where p lies on it.
  void add_face(double weight, const TriangleFoot& foot, const Vec3& corner, const Vec3& across) const {
    add(weight, std::sqrt(foot.squared), axes * (across.dot(p - corner) < 0 ? Vec3(-across) : across), Mat3::Zero());
  }
  void add_edge(double weight, const SegmentFoot& foot, const Vec3& along, const Vec3& across) const {
    const double d = std::sqrt(foot.squared);
    if (!(d < reach)) return;
    if (!(d > lost_direction * reach)) return add(weight, d, axes * across, Mat3::Zero());
    const Vec3 normal = (p - foot.point) / d, beside = axes * normal.cross(along).normalized();
    add(weight, d, axes * normal, beside * (beside / d).transpose());
  }
  void add_vertex(double weight, const Vec3& vertex, const Vec3& across) const {
    const double d = (p - vertex).norm();
    if (!(d < reach)) return;
    if (!(d > lost_direction * reach)) return add(weight, d, axes * across, Mat3::Zero());
    const Vec3 normal = axes * ((p - vertex) / d);
    add(weight, d, normal, (Mat3::Identity() - normal * normal.transpose()) / d);
  }

  // Where the closest point of the face is that of a side, or that of a side is a corner, the distances are one: their
  // weights are added up first, and mostly cancel.
  void add_triangle(const Vec3 (&corner)[3], const FeatureWeights& weights) const {
    const TriangleFoot foot = closest_on_triangle(p, corner[0], corner[1], corner[2]);
    if (!(foot.squared < reach * reach)) return;
    const Vec3 plane = (corner[1] - corner[0]).cross(corner[2] - corner[0]).stableNormalized();
    Shares shares;
    share_face(weights.face, corner, foot, plane, shares);
    for (int k = 0; k < 3; ++k) {
      share_side(weights.edge[k], k, corner, foot, shares);
      shares.vertex[k] += weights.vertex[k];
    }
    const Vec3 across = plane.squaredNorm() > 0.5 ? plane : Vec3::UnitZ();
    if (shares.face != 0) add_face(shares.face, foot, corner[0], across);
    for (int k = 0; k < 3; ++k) {
      if (shares.side[k] != 0) add_edge(shares.side[k], foot.sides[k], corner[(k + 1) % 3] - corner[k], across);
      if (shares.vertex[k] != 0) add_vertex(shares.vertex[k], corner[k], across);
    }
  }

  // The weights of the distances to the open face, the open sides and the corners.
  struct Shares {
    double face = 0, side[3] = {0, 0, 0}, vertex[3] = {0, 0, 0};
  };

  // A face's weight goes to where its closest point lies. Where that changes from one to the other, as straight above the
  // side between two faces of one plane, the distances are one but their second derivatives are not: then each has the
  // share of the directions from there in which it is the closer one, a half each for a face and its side; for a corner
  // of angle a the face a / 2 pi, its two sides a quarter each, the corner the rest. A rod that lies along an edge
  // within a plane then feels that plane and nothing else.
  void share_face(double weight, const Vec3 (&corner)[3], const TriangleFoot& foot, const Vec3& plane, Shares& to) const {
    const double height = plane.dot(p - corner[0]), tie = same_place * foot.squared;
    if (!foot.inside && (plane == Vec3::Zero() || foot.squared - height * height > tie)) {
      // Of two sides that end in the closest corner the one that p is straight above the end of knows more.
      int side = foot.side;
      for (int k = 0; k < 3; ++k)
        if (foot.sides[k].squared <= foot.squared * (1 + same_place) && tied_end(k, corner, foot) >= 0) side = k;
      return share_side(weight, side, corner, foot, to);
    }
    bool at[3];
    for (int k = 0; k < 3; ++k) at[k] = (foot.sides[k].point - foot.point).squaredNorm() <= tie;
    const int sides = at[0] + at[1] + at[2];
    if (sides == 0) {
      to.face += weight;
    } else if (sides == 1) {
      to.face += 0.5 * weight;
      to.side[at[0] ? 0 : at[1] ? 1 : 2] += 0.5 * weight;
    } else {
      // The corner between sides k and v; a triangle smaller than the tolerance takes any.
      const int k = at[0] && at[1] ? 0 : at[1] && at[2] ? 1 : 2, v = (k + 1) % 3;
      const Vec3 one = corner[k] - corner[v], other = corner[(v + 1) % 3] - corner[v];
      const double turn = std::atan2(one.cross(other).norm(), one.dot(other)) / (2 * units::pi);
      to.face += turn * weight;
      to.side[k] += 0.25 * weight;
      to.side[v] += 0.25 * weight;
      to.vertex[v] += (0.5 - turn) * weight;
    }
  }

  // A side's weight: to its inside, to the end where its closest point lies, or half and half straight above an end.
  void share_side(double weight, int k, const Vec3 (&corner)[3], const TriangleFoot& foot, Shares& to) const {
    if (weight == 0) return;
    const int tied = tied_end(k, corner, foot), end = tied >= 0 ? tied : foot.sides[k].end;
    const double moved = tied >= 0 ? 0.5 * weight : end >= 0 ? weight : 0;
    if (end >= 0) to.vertex[(k + end) % 3] += moved;
    to.side[k] += weight - moved;
  }

  // The end of a side that p is straight above; -1 for neither.
  int tied_end(int k, const Vec3 (&corner)[3], const TriangleFoot& foot) const {
    const Vec3 along = corner[(k + 1) % 3] - corner[k];
    const double whole = along.squaredNorm(), from_start = along.dot(p - corner[k]), to_end = whole - from_start;
    const double tie = same_place * foot.sides[k].squared * whole;
    return from_start * from_start <= tie ? 0 : to_end * to_end <= tie ? 1 : -1;
  }
};

}  // namespace

void Surroundings::add_solid_term(int index, const Vec3& p, double range, double thickness,
                                   std::vector<DistanceTerm>& out) const {
  const Entry& entry = entries_[index];
  const SolidDistance found = distance_to(std::get<Solid>(entry.obstacle.shape), entry.to_local(p));
  const double distance = found.distance - thickness;
  if (!(distance < range)) return;
  out.push_back({1, distance, entry.axes * found.normal, entry.axes * found.hessian * entry.axes.transpose(), index});
}

void Surroundings::add_mesh_terms(int index, const Vec3& p, double range, double thickness,
                                   std::vector<DistanceTerm>& out) const {
  const Entry& entry = entries_[index];
  const DistanceTree& tree = entry.surface->tree();
  const Mesh& mesh = entry.surface->mesh();
  const std::vector<FeatureWeights>& weights = entry.surface->topology().weights;
  const Vec3 local = entry.to_local(p);
  const double reach = range + thickness;
  const MeshTerms terms{local, reach, thickness, entry.axes, index, out};
  tree.visit_near(local, reach, [&](int triangle) {
    if (weights[triangle].face == 0) return;
    const auto& t = mesh.triangles[triangle];
    terms.add_triangle({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, weights[triangle]);
  });
}

}  // namespace tendril
