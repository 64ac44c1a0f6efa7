#include "view/picture.h"

#include <algorithm>
#include <cmath>

#include "base/nearest_name.h"

namespace tendril {
namespace {

const std::vector<std::string> view_names{"iso", "front", "top", "side", "card"};

constexpr int smallest_side = 16;  // pixels

[[noreturn]] void refuse(const std::string& why) { throw UsageError("picture: " + why); }

std::string quoted(const char* kind, const std::string& name) { return std::string(kind) + " '" + name + "': "; }

void check_finite(const Vec3& v, const std::string& who) {
  if (!all_finite(v)) refuse(who + "a coordinate is NaN or infinite");
}

void check_page(const Picture& picture) {
  for (int size : {picture.width, picture.height})
    if (size < smallest_side || size > 16384)
      refuse("size " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
             " pixels, expected 16 ... 16384 each");
  if (static_cast<long long>(picture.width) * picture.height > 64'000'000)
    refuse("size " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
           " pixels, expected at most 64 million of them");
  if (picture.views.empty() || picture.views.size() > 6)
    refuse(std::to_string(picture.views.size()) + " views, expected 1 to 6 (views: iso, front, top, side, card)");
  for (const std::string& view : picture.views)
    if (std::find(view_names.begin(), view_names.end(), view) == view_names.end())
      refuse("unknown view " + unknown_name(view, "views", view_names));
  if (picture.fit) {
    check_finite(picture.fit->low, "fit box: ");
    check_finite(picture.fit->high, "fit box: ");
    if ((picture.fit->high.array() < picture.fit->low.array()).any()) refuse("fit box: high lies below low");
  }
}

void check_surface(const PictureSurface& surface) {
  const std::string who = quoted("surface", surface.name);
  check_finite(surface.pose.at, who);
  if (!surface.pose.rotation.coeffs().allFinite() || std::abs(surface.pose.rotation.norm() - 1) > 1e-6)
    refuse(who + "its pose is not a rotation");
  if (!(surface.share >= 0.05 && surface.share <= 0.6))
    refuse(who + "share " + std::to_string(surface.share) + ", expected 0.05 ... 0.6");
  if (!surface.values.empty() && surface.values.size() != surface.vertices.size())
    refuse(who + std::to_string(surface.values.size()) + " values for " + std::to_string(surface.vertices.size()) + " vertices");
}

void check_tube(const PictureTube& tube) {
  const std::string who = quoted("tube", tube.name);
  if (tube.points.size() < 2) refuse(who + std::to_string(tube.points.size()) + " points, expected at least 2");
  for (const Vec3& point : tube.points) check_finite(point, who);
  if (!tube.radii.empty() && tube.radii.size() != tube.points.size())
    refuse(who + std::to_string(tube.radii.size()) + " radii for " + std::to_string(tube.points.size()) + " points");
  if (!tube.values.empty() && tube.values.size() != tube.points.size())
    refuse(who + std::to_string(tube.values.size()) + " values for " + std::to_string(tube.points.size()) + " points");
  const auto good = [](double radius) { return std::isfinite(radius) && radius > 0; };
  const bool radii_good =
      tube.radii.empty() ? good(tube.radius) : std::all_of(tube.radii.begin(), tube.radii.end(), good);
  if (!radii_good) refuse(who + "a radius is not a positive number");
}

void check_scale(const ColourScale& scale) {
  for (const std::optional<double>& number : {scale.low, scale.high, scale.limit})
    if (number && !std::isfinite(*number)) refuse("colour scale '" + scale.name + "': a number is NaN or infinite");
  if (scale.low && scale.high && !(*scale.low < *scale.high))
    refuse("colour scale '" + scale.name + "': low " + std::to_string(*scale.low) + " is not below high " +
           std::to_string(*scale.high));
}

void check_marks(const Picture& picture) {
  for (const PictureHold& hold : picture.holds) {
    const std::string who = quoted("hold", hold.label);
    check_finite(hold.frame.at, who);
    if (!hold.frame.rotation.coeffs().allFinite() || hold.frame.rotation.norm() < 1e-6)
      refuse(who + "its frame is not a rotation");
    if (!std::isfinite(hold.radius) || hold.radius <= 0) refuse(who + "its radius is not a positive number");
  }
  for (const PictureArrow& arrow : picture.arrows) {
    const std::string who = quoted("arrow", arrow.label);
    check_finite(arrow.at, who);
    check_finite(arrow.direction, who);
    if (!(arrow.direction.norm() > 0)) refuse(who + "its direction is zero");
  }
  for (const PictureLabel& label : picture.labels) {
    check_finite(label.at, quoted("label", label.text));
    if (label.to) check_finite(*label.to, quoted("label", label.text));
  }
  for (const PicturePath& path : picture.paths) {
    const std::string who = quoted("path", path.name);
    for (const Vec3& point : path.points) check_finite(point, who);
    if (!(path.width >= 0.25 && path.width <= 50))
      refuse(who + "width " + std::to_string(path.width) + " pixels, expected 0.25 ... 50");
  }
}

bool shows_something(const Picture& picture) {
  if (!picture.tubes.empty()) return true;
  const bool surface = std::any_of(picture.surfaces.begin(), picture.surfaces.end(),
                                   [](const PictureSurface& s) { return !s.triangles.empty() && !s.vertices.empty(); });
  const bool path = std::any_of(picture.paths.begin(), picture.paths.end(),
                                [](const PicturePath& p) { return p.points.size() >= 2; });
  return surface || path;
}

}  // namespace

void check_picture(const Picture& picture) {
  check_page(picture);
  if (picture.columns < 0) refuse("got " + std::to_string(picture.columns) + " columns of panels, expected 0 or more");
  const int columns = picture.columns > 0 ? picture.columns : static_cast<int>(picture.panels.size());
  for (const Picture& panel : picture.panels) {
    const int rows = static_cast<int>(picture.panels.size() + columns - 1) / columns;
    if (picture.width / columns < smallest_side || picture.height / rows < smallest_side)
      refuse("too small for " + std::to_string(picture.panels.size()) + " panels");
    Picture alone = panel;
    alone.panels.clear();
    check_picture(alone);
  }
  if (!picture.panels.empty()) return;
  const bool card_alone = picture.views.size() == 1 && picture.views.front() == "card";
  if (card_alone ? picture.card.title.empty() && picture.card.rows.empty() : !shows_something(picture))
    refuse("nothing to show: no tube, no triangle, no path");
  for (const PictureSurface& surface : picture.surfaces) check_surface(surface);
  for (const PictureTube& tube : picture.tubes) check_tube(tube);
  check_scale(picture.scale);
  check_marks(picture);
}

}  // namespace tendril
