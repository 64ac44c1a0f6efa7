#include "method/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "method/free_space/distance_gradient.h"

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// m, between the nodes of a field: finer for thin objects, coarser where there would be too many nodes.
constexpr double field_spacing = 5e-3, finest_spacing = 1e-3;
/// A field for little geometry must not cost more than the questions that it saves.
constexpr double fewest_nodes = 2e5, nodes_per_triangle = 16, most_field_nodes = 16e6;

void check_length(double value, const char* what) {
  if (!std::isfinite(value) || value < 0)
    throw UsageError(std::string("free space: '") + what + "' is " + number_text(value) + " m; a finite length of at least 0 expected");
}

void check_weight(double value, const char* what) {
  if (!std::isfinite(value) || value < 0)
    throw UsageError(std::string("free space: the weight '") + what + "' is " + number_text(value) + "; a finite number of at least 0 expected");
}

std::string text_of(const Vec3& p) {
  return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ") m";
}

double nodes_of(const Eigen::AlignedBox3d& box, double spacing) { return ((box.sizes().array() / spacing).ceil() + 3).prod(); }

/// 5 mm halved until it is half of what is kept clear, so that the same few spacings serve all objects.
double spacing_for(const Eigen::AlignedBox3d& box, double kept_clear, double triangles) {
  const double most = std::min(most_field_nodes, fewest_nodes + nodes_per_triangle * triangles);
  double spacing = field_spacing;
  while (spacing > 0.5 * kept_clear && spacing > finest_spacing && nodes_of(box, 0.5 * spacing) <= most) spacing *= 0.5;
  while (nodes_of(box, spacing) > most) spacing *= 1.25;
  return spacing;
}

/// Signed distance to a box along the axes.
double distance_to_box(const Eigen::AlignedBox3d& box, const Vec3& p) {
  const Vec3 out = (box.min() - p).cwiseMax(p - box.max());
  const double outside = out.cwiseMax(0).norm();
  return outside > 0 ? outside : out.maxCoeff();
}

}  // namespace

FreeSpace::FreeSpace(const Scene& scene, const SpaceDemands& demands, const std::vector<Vec3>& ends, double margin, const RunContext& context)
    : demands_(demands) {
  check(ends, margin);
  take_obstacles(scene);
  const Eigen::AlignedBox3d inner = set_region(ends, margin);
  if (!scene.bodies().empty()) make_field(scene, inner, context);
  if (PlaceCost::differs(scene, demands_)) make_costs(scene, inner, context);
}

void FreeSpace::check(const std::vector<Vec3>& ends, double margin) const {
  check_length(demands_.radius, "radius");
  check_length(demands_.clearance, "clearance");
  check_length(margin, "margin");
  check_length(demands_.preference_range, "preference_range");
  if (!(demands_.preference_range > 0)) throw UsageError("free space: 'preference_range' is 0 m; a length above 0 expected");
  check_weight(demands_.clearance_weight, "clearance_weight");
  check_weight(demands_.preference, "preference");
  for (std::size_t i = 0; i < demands_.keep_out.size(); ++i) {
    const Eigen::AlignedBox3d& box = demands_.keep_out[i];
    if (!all_finite(box.min()) || !all_finite(box.max()) || !(box.sizes().array() > 0).all())
      throw UsageError("free space: keep_out " + std::to_string(i + 1) + " is the box from " + text_of(box.min()) + " to " +
                       text_of(box.max()) + "; the lower corner first, finite and with volume, expected");
  }
  const auto& in = demands_.keep_in;
  if (in && !(in->sizes().array() > 0).all())
    throw UsageError("free space: keep_in is the box from " + text_of(in->min()) + " to " + text_of(in->max()) +
                     "; the lower corner first, and volume, expected");
  for (const Vec3& end : ends) {
    if (!all_finite(end)) throw UsageError("free space: an end is at " + text_of(end) + "; a finite place expected");
    if (in && !in->contains(end))
      throw UsageError("free space: the end at " + text_of(end) + " lies outside keep_in, from " + text_of(in->min()) + " to " +
                       text_of(in->max()) + "; make that larger");
  }
}

void FreeSpace::take_obstacles(const Scene& scene) {
  for (const PlacedObstacle& placed : scene.bodies()) {
    Obstacle body = placed.body;
    body.name = placed.name;
    names_.push_back(placed.name);
    body.clearance = std::max(placed.clearance, demands_.clearance);
    surroundings_.add(std::move(body));
  }
  for (std::size_t i = 0; i < demands_.keep_out.size(); ++i) {
    names_.push_back("keep_out " + std::to_string(i + 1));
    const Eigen::AlignedBox3d& zone = demands_.keep_out[i];
    surroundings_.add({Solid(Box{zone.sizes()}), {zone.center(), Quat::Identity()}, 0, names_.back()});
  }
  names_.push_back("keep_in");
}

/// Returns the region without its margin.
Eigen::AlignedBox3d FreeSpace::set_region(const std::vector<Vec3>& ends, double margin) {
  region_ = surroundings_.box();
  for (const Vec3& end : ends) region_.extend(end);
  if (region_.isEmpty()) throw UsageError("free space: there is neither an end nor an obstacle; at least one expected");
  Eigen::AlignedBox3d inner = region_;
  region_.min().array() -= margin;
  region_.max().array() += margin;
  if (demands_.keep_in) region_ = region_.intersection(*demands_.keep_in);
  if (region_.isEmpty()) throw UsageError("free space: keep_in lies away from all obstacles; an end within it expected");
  inner = inner.intersection(region_);
  return inner.isEmpty() ? region_ : inner;
}

/// The field is that of what obstacles ask beyond the clearance demanded, so that an object that asks another clearance gets the
/// same one; one that leaves out some of the margin will do, where no box of an obstacle is near. Trees are built beside it.
void FreeSpace::make_field(const Scene& scene, const Eigen::AlignedBox3d& inner, const RunContext& context) {
  const auto began = RunContext::Clock::now();
  Surroundings beyond;
  std::vector<const TriangleSurface*> surfaces;
  double triangles = 0;
  for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
    Obstacle body = surroundings_.obstacle(static_cast<int>(i));
    if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&body.shape)) surfaces.push_back(surface->get());
    triangles += static_cast<double>(scene.bodies()[i].triangles());
    body.clearance -= demands_.clearance;
    beyond.add(std::move(body));
  }
  std::erase_if(surfaces, [](const TriangleSurface* surface) { return surface->has_tree(); });
  const double kept_clear = demands_.radius + demands_.clearance;
  Eigen::AlignedBox3d box = region_;
  box.min().array() -= kept_clear;
  box.max().array() += kept_clear;
  const double spacing = spacing_for(box, kept_clear, triangles);
  const auto make = [&] { field_ = scene.fields()->field(beyond, inner, box, spacing, context); };
  if (surfaces.empty()) {
    make();
  } else {
    scene.fields();  // made by the first call: before there are threads
    run_workers(thread_count(context.threads) > 1 ? static_cast<int>(surfaces.size()) + 1 : 1, [&](int worker) {
      if (worker == 0) make();
      for (std::size_t i = 0; i < surfaces.size(); ++i)
        if ((static_cast<int>(i) == worker - 1 || thread_count(context.threads) == 1) && !context.stop()) surfaces[i]->tree();
    });
  }
  if (!field_->ok()) field_.reset();
  field_seconds_ = std::chrono::duration<double>(RunContext::Clock::now() - began).count();
}

void FreeSpace::make_costs(const Scene& scene, const Eigen::AlignedBox3d& inner, const RunContext& context) {
  cost_ = std::make_shared<const PlaceCost>(scene, demands_, inner, region_, field_ ? field_->spacing() : field_spacing, context);
  cost_grid_ = std::make_shared<const CostGrid>(cost_, region_);
  fine_cost_grid_ = std::make_shared<const CostGrid>(cost_, region_, 0.4);
}

void FreeSpace::limit_by_walls(const Vec3& p, Gap& gap) const {
  if (!demands_.keep_in) return;
  for (int k = 0; k < 3; ++k)
    for (const int side : {-1, 1}) {
      const double wall = side < 0 ? demands_.keep_in->min()[k] : demands_.keep_in->max()[k];
      const double value = side * (wall - p[k]) - demands_.radius;
      if (!(value < gap.value)) continue;
      gap = {value, -side * Vec3::Unit(k), p, static_cast<int>(names_.size()) - 1};
      gap.on[k] = wall;
    }
}

Gap FreeSpace::gap(const Vec3& p, double limit) const {
  Gap gap{limit, Vec3::Zero(), p, -1};
  if (!all_finite(p)) return gap;
  const ClosestPoint found = surroundings_.closest_kept(p, limit + demands_.radius, infinity);
  if (found.obstacle >= 0) {
    const double distance = found.distance + surroundings_.obstacle(found.obstacle).clearance;
    gap = {found.distance - demands_.radius, distance_gradient(surroundings_, p, found, distance), found.point, found.obstacle};
  }
  limit_by_walls(p, gap);
  return gap;
}

double FreeSpace::gap_to_zones_and_walls(const Vec3& p) const {
  double least = infinity;
  for (const Eigen::AlignedBox3d& zone : demands_.keep_out) least = std::min(least, distance_to_box(zone, p));
  if (demands_.keep_in) least = std::min(least, std::min((p - demands_.keep_in->min()).minCoeff(), (demands_.keep_in->max() - p).minCoeff()));
  return least - demands_.radius;
}

DistanceField::Bounds FreeSpace::bounds(const Vec3& p) const {
  if (!all_finite(p)) return {-infinity, infinity};
  const bool has_field = surroundings_.size() > static_cast<int>(demands_.keep_out.size());
  DistanceField::Bounds known{infinity, infinity};
  if (has_field) known = field_ ? field_->at(p) : DistanceField::Bounds{-infinity, infinity};
  const double kept_clear = demands_.radius + demands_.clearance, exact = gap_to_zones_and_walls(p);
  return {std::min(known.low - kept_clear, exact), std::min(known.high - kept_clear, exact)};
}

bool FreeSpace::is_free(const Vec3& p, double least) const {
  if (!all_finite(p)) return false;
  const DistanceField::Bounds known = bounds(p);
  if (known.low >= least - tie) return true;
  if (known.high < least - tie || gap_to_zones_and_walls(p) < least - tie) return false;
  return !surroundings_.within_kept(p, least + demands_.radius - tie, infinity);
}

bool FreeSpace::is_free(const Vec3& a, const Vec3& b, double least) const {
  return is_free(a, least) && is_free(b, least) && is_free_between(a, b, least);
}

/// Both ends are free. Balls of the radius that is kept clear around both touch no obstacle: nothing comes nearer to the straight
/// than where they meet, which for a short one is a height of less than the tolerance below the radius.
bool FreeSpace::is_free_between(const Vec3& a, const Vec3& b, double least) const {
  const double half = 0.5 * (b - a).norm(), kept_clear = demands_.radius + least;
  if (half <= straight_tolerance || half * half <= straight_tolerance * (2 * kept_clear - straight_tolerance)) return true;
  const Vec3 middle = 0.5 * (a + b);
  const DistanceField::Bounds known = bounds(middle);
  if (known.low >= least + half) return true;
  if (known.high < least - tie) return false;
  // The field takes off half the way at least where it has to be asked again; the trees are asked for the rest.
  double reach = known.low - least;
  if (reach < 0.5 * half) {
    reach = gap(middle, least + half).value - least;
    if (reach >= half) return true;
    if (reach < -tie) return false;
  }
  const Vec3 on = std::max(reach, 0.0) / (2 * half) * (b - a);
  return is_free_between(a, middle - on, least) && is_free_between(middle + on, b, least);
}

double FreeSpace::cost(const Vec3& p, Vec3* gradient) const {
  if (gradient) gradient->setZero();
  return cost_ ? cost_->exact(p, gradient) : 1;
}

double FreeSpace::cost_interpolated(const Vec3& p, Vec3* gradient, bool fine) const {
  if (gradient) gradient->setZero();
  return cost_ ? (fine ? fine_cost_grid_ : cost_grid_)->at(p, gradient) : 1;
}

}  // namespace tendril::routing
