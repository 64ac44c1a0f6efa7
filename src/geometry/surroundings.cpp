#include "geometry/surroundings.h"

#include <cmath>
#include <limits>

#include "base/error.h"

namespace tendril {

namespace {

Eigen::AlignedBox3d placed(const Eigen::AlignedBox3d& box, const Frame& pose) {
  if (!all_finite(box.min()) || !all_finite(box.max())) return box;  // a half-space, turned or not
  const Mat3 reach = pose.rotation.toRotationMatrix().cwiseAbs();
  const Vec3 middle = pose.at + pose.rotation * box.center(), half = reach * (0.5 * box.sizes());
  return {middle - half, middle + half};
}

void check(const Frame& pose) {
  if (!all_finite(pose.at) || !(std::abs(pose.rotation.norm() - 1) < 1e-6))
    throw UsageError("obstacle: the pose is not a frame; a finite place and a unit rotation expected");
}

}  // namespace

int Surroundings::add(Obstacle obstacle) {
  const auto* mesh = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.shape);
  if (mesh && !*mesh) throw UsageError("obstacle: no mesh was given");
  if (!mesh) check(std::get<Solid>(obstacle.shape), "obstacle");
  if (!std::isfinite(obstacle.clearance) || obstacle.clearance < 0)
    throw UsageError("obstacle: the clearance is " + std::to_string(obstacle.clearance) + " m; at least 0 expected");
  check(obstacle.pose);
  const TriangleSurface* surface = mesh ? mesh->get() : nullptr;
  largest_clearance_ = std::max(largest_clearance_, obstacle.clearance);
  entries_.push_back({std::move(obstacle), {}, Mat3::Identity(), surface});
  entries_.back().place();
  return size() - 1;
}

void Surroundings::move(int index, const Frame& pose) {
  check(pose);
  entries_[index].obstacle.pose = pose;
  entries_[index].place();
}

void Surroundings::Entry::place() {
  obstacle.pose.rotation.normalize();
  box = placed(surface ? surface->box() : tendril::box_of(std::get<Solid>(obstacle.shape)), obstacle.pose);
  axes = obstacle.pose.rotation.toRotationMatrix();
}

ClosestPoint Surroundings::closest_on(int index, const Vec3& p, double limit, double most) const {
  const Entry& entry = entries_[index];
  const double thickness = entry.thickness(most);
  const ClosestPoint nothing{limit, p, -1};
  // Inside its box a solid may be nearer than any limit; a mesh is not nearer than its box.
  const double reach = limit + thickness;
  if (!all_finite(p)) return nothing;
  const double to_box = entry.box.squaredExteriorDistance(p);
  if (to_box > 0 && !(reach > 0 && to_box < reach * reach)) return nothing;
  if (!entry.surface) {
    const SolidDistance found = distance_to(std::get<Solid>(entry.obstacle.shape), entry.to_local(p));
    if (!(found.distance < reach)) return nothing;
    return {found.distance - thickness, entry.to_world(found.point), index};
  }
  const DistanceTree::Nearest found = entry.surface->tree().closest(entry.to_local(p), reach);
  if (found.triangle < 0) return nothing;
  return {found.distance - thickness, entry.to_world(found.point), index};
}

ClosestPoint Surroundings::closest(const Vec3& p, double limit) const { return closest_kept(p, limit, 0); }

ClosestPoint Surroundings::closest_kept(const Vec3& p, double limit, double most) const {
  ClosestPoint best{limit, p, -1};
  for (int i = 0; i < size(); ++i) {
    const ClosestPoint found = closest_on(i, p, best.distance, most);
    if (found.obstacle >= 0) best = found;
  }
  return best;
}

bool Surroundings::within_kept(const Vec3& p, double limit, double most) const {
  if (!all_finite(p)) return false;
  for (const Entry& entry : entries_) {
    const double reach = limit + entry.thickness(most), to_box = entry.box.squaredExteriorDistance(p);
    if (to_box > 0 && !(reach > 0 && to_box < reach * reach)) continue;
    const Vec3 local = entry.to_local(p);
    if (entry.surface ? entry.surface->tree().within(local, reach)
                      : distance_to(std::get<Solid>(entry.obstacle.shape), local).distance < reach)
      return true;
  }
  return false;
}

void Surroundings::terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const { terms_kept(p, range, 0, out); }

void Surroundings::terms_kept(const Vec3& p, double range, double most, std::vector<DistanceTerm>& out) const {
  if (!all_finite(p)) return;
  for (int i = 0; i < size(); ++i) {
    const double thickness = entries_[i].thickness(most), reach = range + thickness;
    const double to_box = entries_[i].box.squaredExteriorDistance(p);
    if (to_box > 0 && !(reach > 0 && to_box < reach * reach)) continue;
    if (entries_[i].surface) add_mesh_terms(i, p, range, thickness, out);
    else add_solid_term(i, p, range, thickness, out);
  }
}

std::optional<RayHit> Surroundings::ray(const Vec3& a, const Vec3& b) const {
  std::optional<RayHit> first;
  if (!all_finite(a) || !all_finite(b)) return first;
  const Eigen::AlignedBox3d way(a.cwiseMin(b), a.cwiseMax(b));
  for (int i = 0; i < size(); ++i) {
    const Entry& entry = entries_[i];
    // A half-space's box is infinite and meets everything.
    if (!entry.box.intersects(way)) continue;
    const Vec3 from = entry.to_local(a), to = entry.to_local(b);
    if (entry.surface) {
      const auto hit = entry.surface->tree().ray(from, to);
      if (hit && (!first || hit->share < first->share))
        first = RayHit{hit->share, a + hit->share * (b - a), entry.axes * hit->normal, i};
    } else {
      const auto hit = entry_into(std::get<Solid>(entry.obstacle.shape), from, to);
      if (hit && (!first || hit->share < first->share))
        first = RayHit{hit->share, a + hit->share * (b - a), entry.axes * hit->normal, i};
    }
  }
  return first;
}

std::string Surroundings::name(int obstacle) const {
  const std::string& own = entries_[obstacle].obstacle.name;
  return own.empty() ? ContactField::name(obstacle) : "obstacle '" + own + "'";
}

std::shared_ptr<const ContactField> Surroundings::without(const std::vector<int>& obstacles) const {
  auto rest = std::make_shared<Surroundings>(*this);
  for (const int k : obstacles) {
    if (k < 0 || k >= size())
      throw UsageError("surroundings: there is no obstacle of the number " + std::to_string(k) + " to leave out, there are " +
                       std::to_string(size()));
    // Nothing comes near a box that is infinitely far away.
    const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::infinity());
    rest->entries_[k].box = {nowhere, nowhere};
  }
  return rest;
}

Eigen::AlignedBox3d Surroundings::box() const {
  Eigen::AlignedBox3d box;
  for (const Entry& entry : entries_)
    if (all_finite(entry.box.min())) box.extend(entry.box);
  return box;
}

std::optional<Crossing> first_crossing(const ContactField& surroundings, const std::vector<Vec3>& points) {
  if (points.empty()) return std::nullopt;
  const ClosestPoint start = surroundings.closest(points[0], 1e-9);
  if (start.obstacle >= 0 && start.distance < 0) {
    const Vec3 out = start.point - points[0];
    return Crossing{0, {0, points[0], out.norm() > 0 ? Vec3(out.normalized()) : Vec3::UnitZ(), start.obstacle}};
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (auto hit = surroundings.ray(points[i], points[i + 1])) return Crossing{static_cast<int>(i), *hit};
  return std::nullopt;
}

}  // namespace tendril
