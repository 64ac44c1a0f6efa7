#include "method/assembly/connector_body.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"

namespace tendril::assembly {

namespace {

Vec3 moved(const Frame& frame, const Vec3& p) { return frame.at + frame.rotation * p; }

}  // namespace

ConnectorBody::ConnectorBody(const Connector& connector, int rod, double slack)
    : name_(connector.name), rod_(rod), at_start_(connector.at_start), slack_(slack) {
  if (std::holds_alternative<Solid>(connector.body.shape) && std::holds_alternative<HalfSpace>(std::get<Solid>(connector.body.shape)))
    throw UsageError("assembly: connector '" + name_ + "' is a half-space, expected a box, a cylinder, a sphere or a mesh");
  PlacedObstacle placed;
  placed.name = name_;
  placed.body = connector.body;
  placed.check();
  Mesh mesh = drawn_mesh(placed, {})->moved(connector.body.pose.at, connector.body.pose.rotation);
  const Eigen::AlignedBox3d box = mesh.box();
  const Vec3 middle = box.center();
  Vec3 scale;
  for (int k = 0; k < 3; ++k) scale[k] = 1 - 2 * std::min(slack, 0.25 * box.sizes()[k]) / std::max(box.sizes()[k], 1e-300);
  for (Vec3& p : mesh.vertices) {
    p = middle + scale.cwiseProduct(p - middle);
    reach_ = std::max(reach_, p.norm());
    wide_ = std::max(wide_, p.head<2>().norm());
  }
  length_ = box.sizes().z();
  behind_ = std::max(0.0, at_start_ ? box.max().z() : -box.min().z());
  for (const auto& t : mesh.triangles) triangles_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

Frame ConnectorBody::pose(const SystemEquilibrium& state) const {
  const Equilibrium& rod = state.rods[rod_];
  return at_start_ ? Frame{rod.points.front(), rod.rotations.front()} : Frame{rod.points.back(), rod.rotations.back()};
}

void ConnectorBody::plugged_in(const Surroundings& surroundings, const Frame& routed) {
  routed_ = routed.at;
  plugged_.clear();
  // Each hit names one obstacle more.
  while (const std::optional<Hit> hit = near({surroundings, routed, 0.5 * slack_, false})) plugged_.push_back(hit->obstacle);
}

double ConnectorBody::socket_depth(const Surroundings& surroundings, const Frame& routed) const {
  const Vec3 out = (at_start_ ? 1 : -1) * routed.d3();
  for (double depth = 0; depth < length_; depth += slack_)
    if (!near({surroundings, {routed.at + depth * out, routed.rotation}, 0.5 * slack_, true})) return depth;
  return length_;
}

ClosestPoint ConnectorBody::closest(const Place& place, const Vec3& p, double limit) const {
  if (place.unplugged || plugged_.empty()) return place.surroundings.closest(p, limit);
  ClosestPoint nearest{limit, p, -1};
  for (int k = 0; k < place.surroundings.size(); ++k) {
    if (std::find(plugged_.begin(), plugged_.end(), k) != plugged_.end()) continue;
    ClosestPoint one = place.surroundings.closest_on(k, p, nearest.distance);
    if (one.distance < nearest.distance) {
      one.obstacle = k;
      nearest = one;
    }
  }
  return nearest;
}

std::optional<ConnectorBody::Hit> ConnectorBody::near(const Place& place, const Triangle& t) const {
  const Vec3 middle = (t[0] + t[1] + t[2]) / 3, p = moved(place.section, middle);
  const double size = std::sqrt(std::max({(t[0] - middle).squaredNorm(), (t[1] - middle).squaredNorm(), (t[2] - middle).squaredNorm()}));
  const ClosestPoint found = closest(place, p, size + place.margin);
  if (found.obstacle < 0 || found.distance >= size + place.margin) return std::nullopt;
  if (found.distance <= place.margin || size < 0.25 * slack_) return Hit{0, p, found.obstacle};
  const Vec3 ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]), ca = 0.5 * (t[2] + t[0]);
  for (const Triangle& part : {Triangle{ab, bc, ca}, Triangle{t[0], ab, ca}, Triangle{ab, t[1], bc}, Triangle{ca, bc, t[2]}})
    if (const auto hit = near(place, part)) return hit;
  return std::nullopt;
}

std::optional<ConnectorBody::Hit> ConnectorBody::near(const Place& place) const {
  if (closest(place, place.section.at, reach_ + place.margin).obstacle < 0) return std::nullopt;
  for (const Triangle& triangle : triangles_)
    if (const auto hit = near(place, triangle)) return hit;
  return std::nullopt;
}

std::optional<ConnectorBody::Hit> ConnectorBody::sweep(const Surroundings& surroundings, const Frame& from, const Frame& to, double begin,
                                                       double end) const {
  const auto at = [&](double share) { return Frame{from.at + share * (to.at - from.at), from.rotation.slerp(share, to.rotation)}; };
  const double way = (end - begin) * ((to.at - from.at).norm() + reach_ * from.rotation.angularDistance(to.rotation));
  const double middle = 0.5 * (begin + end);
  const Frame section = at(middle);
  auto hit = near({surroundings, section, 0.5 * way, (section.at - routed_).norm() > 2 * reach_});
  if (!hit) return std::nullopt;
  if (way <= 0.5 * slack_) {
    hit->share = middle;
    return hit;
  }
  if (const auto first = sweep(surroundings, from, to, begin, middle)) return first;
  return sweep(surroundings, from, to, middle, end);
}

std::optional<ConnectorBody::Hit> ConnectorBody::sweep(const Surroundings& surroundings, const Frame& from, const Frame& to) const {
  return sweep(surroundings, from, to, 0, 1);
}

std::string connector_hit(const std::vector<ConnectorBody>& bodies, const Surroundings* surroundings, const SystemEquilibrium& from,
                          const SystemEquilibrium& to) {
  if (!surroundings) return {};
  for (const ConnectorBody& body : bodies) {
    const auto hit = body.sweep(*surroundings, body.pose(from), body.pose(to));
    if (!hit) continue;
    const auto mm = [](double metres) { return number_text(metres / units::mm); };
    return "connector '" + body.name() + "' hits " + surroundings->name(hit->obstacle) + " at (" + mm(hit->at.x()) + ", " + mm(hit->at.y()) +
           ", " + mm(hit->at.z()) + ") mm";
  }
  return {};
}

}  // namespace tendril::assembly
