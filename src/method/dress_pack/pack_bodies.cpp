#include "method/dress_pack/pack_bodies.h"

#include <algorithm>

namespace tendril::dress_pack {
namespace {

constexpr double fitting_radii = 4;

std::vector<int> rigid_groups(const Robot& robot) {
  std::vector<int> group(robot.links().size(), 0);
  for (std::size_t k = 1; k < group.size(); ++k) {
    const Joint& joint = robot.joints()[k - 1];
    group[k] = joint.kind == JointKind::fixed ? group[joint.parent] : static_cast<int>(k);
  }
  return group;
}

}  // namespace

PackBodies::PackBodies(const PackProblem& pack, Sides sides) : pack_(pack), rigid_(rigid_groups(*pack.robot)) {
  for (const PackBody& body : pack.bodies) {
    surroundings_.add(body.body);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleSurface>>(&body.body.shape);
    boxes_.push_back(mesh ? (*mesh)->box() : tendril::box_of(std::get<Solid>(body.body.shape)));
    const bool told = mesh && sides == Sides::of_meshes_too && (*mesh)->topology().watertight();
    inside_.push_back(told ? std::make_shared<const InsideTest>((*mesh)->mesh()) : nullptr);
  }
  for (int k = 0; k < static_cast<int>(pack.rods.size()); ++k)
    for (int h = 0; h < static_cast<int>(pack.rods[k].holds.size()); ++h) {
      const Hold& hold = pack.rods[k].holds[h];
      if (!hold.position) continue;
      const auto carried = std::find_if(pack.attachments.begin(), pack.attachments.end(), [&](const Attachment& a) { return a.rod == k && a.hold == h; });
      const double radius = pack.rods[k].rod.section_at(hold.at).radius();
      skips_.push_back({hold.at, radius, k, any});
      skips_.push_back({hold.at, fitting_radii * radius, k, carried == pack.attachments.end() ? -1 : rigid_[carried->link]});
    }
}

void PackBodies::poses(const JointVector& q, std::vector<BodyPose>& out) const {
  const std::vector<Frame> links = pack_.robot->link_frames({q.data(), static_cast<std::size_t>(q.size())});
  out.resize(size());
  for (int b = 0; b < size(); ++b) {
    const PackBody& body = pack_.bodies[b];
    Frame there = body.link < 0 ? body.body.pose : pack_.base * (links[body.link] * body.body.pose);
    there.rotation.normalize();
    out[b] = {there.rotation.toRotationMatrix(), there.at};
  }
}

BodyDistance PackBodies::distance(int body, const Vec3& in_body, double limit) const {
  const auto& shape = pack_.bodies[body].body.shape;
  const BodyDistance nothing{limit, in_body, false};
  const double to_box = boxes_[body].squaredExteriorDistance(in_body);
  if (to_box > 0 && !(limit > 0 && to_box < limit * limit)) return nothing;
  if (const auto* solid = std::get_if<Solid>(&shape)) {
    const SolidDistance found = distance_to(*solid, in_body);
    return found.distance < limit ? BodyDistance{found.distance, found.point, true} : nothing;
  }
  const DistanceTree::Nearest found = std::get<0>(shape)->tree().closest(in_body, limit);
  if (to_box == 0 && inside_[body] && inside_[body]->inside(in_body)) {
    // However deep: the surface is somewhere.
    const DistanceTree::Nearest out = found.triangle < 0 ? std::get<0>(shape)->tree().closest(in_body) : found;
    return {-out.distance, out.point, true};
  }
  return found.triangle < 0 ? nothing : BodyDistance{found.distance, found.point, true};
}

bool PackBodies::passes(int body, const Vec3& from, const Vec3& to) const {
  const Eigen::AlignedBox3d way(from.cwiseMin(to), from.cwiseMax(to));
  if (!boxes_[body].intersects(way)) return false;
  const auto& shape = pack_.bodies[body].body.shape;
  if (const auto* solid = std::get_if<Solid>(&shape)) return entry_into(*solid, from, to).has_value();
  return std::get<0>(shape)->tree().ray(from, to).has_value();
}

bool PackBodies::compared(int rod, double s, int body, Compared what) const {
  const int link = pack_.bodies[body].link, group = link < 0 ? -1 : rigid_[link];
  for (const Skip& skip : skips_) {
    if (skip.rod != rod || std::abs(s - skip.at) > skip.reach * (1 + 1e-9)) continue;
    if (skip.group == any ? what == Compared::contact : skip.group == group) return false;
  }
  return true;
}

void PackBodies::move(const JointVector& q) {
  const std::vector<Frame> links = pack_.robot->link_frames({q.data(), static_cast<std::size_t>(q.size())});
  for (int b = 0; b < size(); ++b) {
    const PackBody& body = pack_.bodies[b];
    if (body.link < 0) continue;
    Frame there = pack_.base * (links[body.link] * body.body.pose);
    there.rotation.normalize();
    surroundings_.move(b, there);
  }
}

void PackBodies::surround(SystemProblem& system) const {
  for (std::size_t k = 0; k < system.rods.size(); ++k) {
    RodProblem& rod = system.rods[k];
    rod.surroundings = size() > 0 ? &surroundings_ : nullptr;
    rod.fastenings.clear();
    for (const Attachment& a : pack_.attachments)
      for (int b = 0; a.rod == static_cast<int>(k) && b < size(); ++b)
        if (!fixed(b) && rigid_[pack_.bodies[b].link] == rigid_[a.link])
          rod.fastenings.push_back({a.hold, b, fitting_radii * rod.rod.section_at(rod.holds[a.hold].at).radius()});
  }
}

}  // namespace tendril::dress_pack
