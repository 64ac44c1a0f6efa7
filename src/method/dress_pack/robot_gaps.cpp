#include "method/dress_pack/robot_gaps.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "method/dress_pack/mesh_pair.h"

namespace tendril::dress_pack {
namespace {

constexpr double look_ahead = 0.05;  // m, beyond what is asked: saves later looks
constexpr double meeting = 1e-12;   // m
constexpr int cylinder_sides = 64;

Mesh box_mesh(const Vec3& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.push_back(0.5 * size.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Mesh cylinder_mesh(const Cylinder& cylinder) {
  Mesh mesh;
  const double radius = cylinder.radius / std::cos(units::pi / cylinder_sides), half = 0.5 * cylinder.length;
  mesh.vertices = {{0, 0, -half}, {0, 0, half}};
  for (int k = 0; k < cylinder_sides; ++k) {
    const double angle = 2 * units::pi * k / cylinder_sides, x = radius * std::cos(angle), y = radius * std::sin(angle);
    mesh.vertices.push_back({x, y, -half});
    mesh.vertices.push_back({x, y, half});
  }
  for (int k = 0; k < cylinder_sides; ++k) {
    const int a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % cylinder_sides);
    mesh.triangles.insert(mesh.triangles.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  return mesh;
}

std::shared_ptr<const TriangleSurface> surface_of(const std::variant<std::shared_ptr<const TriangleSurface>, Solid>& shape) {
  if (const auto* mesh = std::get_if<0>(&shape)) return *mesh;
  const Solid& solid = std::get<1>(shape);
  if (const auto* box = std::get_if<Box>(&solid)) return std::make_shared<const TriangleSurface>(box_mesh(box->size));
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) return std::make_shared<const TriangleSurface>(cylinder_mesh(*cylinder));
  return nullptr;
}

}  // namespace

/// A body as a ball, a half-space or a mesh, this one with its boxes where a link carries it.
struct RobotGaps::Shape {
  std::shared_ptr<const TriangleSurface> surface;  ///< null: a sphere or a half-space
  double ball = -1;                                ///< m, radius of a sphere; negative: none
  std::unique_ptr<const BoxTree> boxes;

  explicit Shape(const std::variant<std::shared_ptr<const TriangleSurface>, Solid>& given) : surface(surface_of(given)) {
    if (surface) return;
    if (const auto* sphere = std::get_if<Sphere>(&std::get<1>(given))) ball = sphere->radius;
  }
};

RobotGaps::RobotGaps(const PackBodies& bodies) : bodies_(bodies) {
  std::vector<std::shared_ptr<Shape>> shapes;
  for (int b = 0; b < bodies.size(); ++b) shapes.push_back(std::make_shared<Shape>(bodies.pack().bodies[b].body.shape));
  for (int a = 0; a < bodies.size(); ++a) {
    if (!bodies.moves(a)) continue;
    if (shapes[a]->surface) shapes[a]->boxes = std::make_unique<const BoxTree>(shapes[a]->surface->mesh());
    if (!shapes[a]->surface && shapes[a]->ball < 0) continue;  // a half-space on a link has no other side
    for (int b = 0; b < bodies.size(); ++b)
      if (bodies.fixed(b)) pairs_.push_back({a, b});
  }
  shapes_.assign(shapes.begin(), shapes.end());
}

namespace {

/// The place, of some in the world, that lies deepest inside a body.
bool deepest_of(const std::vector<Vec3>& places, const PackBodies& bodies, int body, const BodyPose& at, Vec3& place, BodyDistance& deepest) {
  deepest = {};
  for (const Vec3& p : places) {
    const BodyDistance found = bodies.distance(body, at.to_body(p), 0);
    if (!(found.distance < deepest.distance)) continue;
    deepest = found;
    place = p;
  }
  return deepest.found;
}

std::vector<Vec3> corners_of(const Mesh& mesh, const BodyPose& at) {
  std::vector<Vec3> corners;
  corners.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) corners.push_back(at.to_world(v));
  return corners;
}

/// Those within the ball about a body's box, and some beyond it.
std::vector<Vec3> corners_near(const TriangleSurface& surface, const BodyPose& at, const Eigen::AlignedBox3d& box, const BodyPose& at_box) {
  std::vector<Vec3> corners;
  const double radius = 0.5 * box.diagonal().norm() * (1 + 1e-9);
  surface.tree().visit_near(at.to_body(at_box.to_world(box.center())), radius, [&](int triangle) {
    for (const int v : surface.mesh().triangles[triangle]) corners.push_back(at.to_world(surface.mesh().vertices[v]));
  });
  return corners;
}

}  // namespace

LinkGap RobotGaps::measure(const Pair& pair, const std::vector<BodyPose>& poses, double limit, Known& known) const {
  const Shape &a = *shapes_[pair.body], &b = *shapes_[pair.other];
  const BodyPose &at_a = poses[pair.body], &at_b = poses[pair.other];
  const LinkGap nothing{limit, -1, -1};
  if (!a.surface || !b.surface) {
    // A ball is measured from its middle; a half-space from all corners.
    if (!a.surface || b.ball >= 0) {
      const bool link_is_ball = !a.surface;
      const double radius = link_is_ball ? a.ball : b.ball;
      const BodyPose &at_ball = link_is_ball ? at_a : at_b, &at_other = link_is_ball ? at_b : at_a;
      const BodyDistance found = bodies_.distance(link_is_ball ? pair.other : pair.body, at_other.to_body(at_ball.at), limit + radius);
      if (!found.found) return nothing;
      const Vec3 foot = at_other.to_world(found.point);
      const Vec3 way = found.distance != 0 ? Vec3((foot - at_ball.at) / found.distance) : Vec3::Zero();
      const Vec3 on_ball = at_ball.at + radius * way;
      return {found.distance - radius, pair.body, pair.other, link_is_ball ? on_ball : foot, link_is_ball ? foot : on_ball};
    }
    LinkGap best = nothing;
    for (const Vec3& v : a.surface->mesh().vertices) {
      const Vec3 world = at_a.to_world(v), p = at_b.to_body(world);
      if (p.z() < best.gap) best = {p.z(), pair.body, pair.other, world, at_b.to_world({p.x(), p.y(), 0})};
    }
    return best;
  }
  const RelativePose pose{at_b.axes.transpose() * at_a.axes, at_b.to_body(at_a.at)};
  const MeshPair found = closest_of_meshes(*a.boxes, *b.surface, pose, limit, known.triangles);
  known.triangles = found.triangles;
  const Vec3 some = at_b.to_body(at_a.to_world(a.surface->mesh().vertices.front()));
  const bool within = bodies_.distance(pair.other, some, 0).distance < 0;
  if (within || (found.found() && found.nearest.distance <= meeting)) {
    Vec3 corner;
    BodyDistance deepest;
    LinkGap best{0, pair.body, pair.other, at_b.to_world(found.nearest.on_a), at_b.to_world(found.nearest.on_b)};
    if (deepest_of(corners_of(a.surface->mesh(), at_a), bodies_, pair.other, at_b, corner, deepest))
      best = {deepest.distance, pair.body, pair.other, corner, at_b.to_world(deepest.point)};
    const std::vector<Vec3> corners = corners_near(*b.surface, at_b, bodies_.own_box(pair.body), at_a);
    if (deepest_of(corners, bodies_, pair.body, at_a, corner, deepest) && deepest.distance < best.gap)
      best = {deepest.distance, pair.body, pair.other, at_a.to_world(deepest.point), corner};
    return best;
  }
  if (!found.found()) return nothing;
  return {found.nearest.distance, pair.body, pair.other, at_b.to_world(found.nearest.on_a), at_b.to_world(found.nearest.on_b)};
}

/// No point of the link's body has moved farther in the other one's axes than the farthest corner of its box.
double RobotGaps::bound(std::size_t k, const std::vector<BodyPose>& poses, const Memory& memory, Eigen::Matrix<double, 3, 8>& corners) const {
  const BodyPose &at_a = poses[pairs_[k].body], &at_b = poses[pairs_[k].other];
  const Eigen::AlignedBox3d& box = bodies_.own_box(pairs_[k].body);
  for (int c = 0; c < 8; ++c)
    corners.col(c) = at_b.to_body(at_a.to_world(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c))));
  if (!(memory[k].distance > -std::numeric_limits<double>::infinity())) return memory[k].distance;
  return memory[k].distance - std::sqrt((corners - memory[k].corners).colwise().squaredNorm().maxCoeff());
}

void RobotGaps::near(const JointVector& q, double limit, Memory& memory, std::vector<LinkGap>& out) const {
  out.clear();
  memory.resize(pairs_.size());
  std::vector<BodyPose> poses;
  bodies_.poses(q, poses);
  Eigen::Matrix<double, 3, 8> corners;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (bound(k, poses, memory, corners) >= limit) continue;
    const LinkGap found = measure(pairs_[k], poses, limit + look_ahead, memory[k]);
    memory[k].corners = corners;
    memory[k].distance = found.gap;
    if (found.gap < limit && found.body >= 0) out.push_back(found);
  }
}

LinkGap RobotGaps::smallest(const JointVector& q, double limit, Memory& memory) const {
  memory.resize(pairs_.size());
  std::vector<BodyPose> poses;
  bodies_.poses(q, poses);
  LinkGap best{limit, -1, -1};
  Eigen::Matrix<double, 3, 8> corners;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (bound(k, poses, memory, corners) >= best.gap) continue;
    const LinkGap found = measure(pairs_[k], poses, best.gap + look_ahead, memory[k]);
    memory[k].corners = corners;
    memory[k].distance = found.gap;
    if (found.gap < best.gap && found.body >= 0) best = found;
  }
  return best;
}

}  // namespace tendril::dress_pack
