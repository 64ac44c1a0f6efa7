#include "scene/placed_branch.h"

#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "scene/placed_rod.h"

namespace tendril {
namespace {

constexpr double same_place = 1e-9;  // of the length

bool held_fully(const Hold* hold) { return hold && hold->position && hold->orientation; }

bool begins(const BranchPlace& place) { return place.at <= same_place * place.rod->rod().length; }

/// Carries on the first section's direction, or meets it head-on.
Frame continued(const BranchPlace& first, const BranchPlace& other) {
  if (begins(first) != begins(other)) return {};
  return {Vec3::Zero(), Quat(Eigen::AngleAxisd(units::pi, Vec3::UnitX()))};
}

void check_places(const std::string& name, const std::vector<BranchPlace>& places) {
  if (name.empty()) throw UsageError("scene:branch: the name is empty, expected a word");
  if (places.empty()) throw UsageError("scene:branch: '" + name + "' joins no rod, expected a list of {rod, place}");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BranchPlace& place = places[i];
    const double length = place.rod->rod().length;
    if (!std::isfinite(place.at) || place.at < 0 || place.at > length)
      throw UsageError("scene:branch: the place on '" + place.rod->name() + "' is " + number_text(place.at) +
                       " m, expected 0 to " + number_text(length) + " m (its length)");
    for (std::size_t j = 0; j < i; ++j)
      if (places[j].rod == place.rod && std::abs(places[j].at - place.at) <= same_place * length)
        throw UsageError("scene:branch: '" + name + "' joins '" + place.rod->name() + "' at " +
                         place.rod->describe(place.at) + " twice");
  }
}

}  // namespace

bool PlacedBranch::joins(const std::string& rod, double at, double tolerance) const {
  for (const JoinedPlace& place : places)
    if (place.rod == rod && std::abs(place.at - at) <= tolerance) return true;
  return false;
}

PlacedBranch make_branch(std::string name, const std::vector<BranchPlace>& places, const std::optional<Frame>& held) {
  check_places(name, places);
  PlacedBranch branch;
  branch.name = std::move(name);
  const BranchPlace& first = places.front();
  const Hold* drawn = first.rod->hold_at(first.at);
  const Frame first_relative = first.relative.value_or(Frame{});
  if (held_fully(drawn)) branch.frame = drawn->frame * first_relative.inverse();
  for (const BranchPlace& place : places) {
    const Hold* hold = place.rod->hold_at(place.at);
    Frame relative = first_relative * continued(first, place);
    if (&place == &first) relative = first_relative;
    if (held_fully(hold) && held_fully(drawn)) relative = branch.frame.inverse() * hold->frame;
    if (place.relative) relative = *place.relative;
    branch.places.push_back({place.rod->name(), place.at, relative});
  }
  for (const BranchPlace& place : places)
    if (place.rod->hold_at(place.at)) place.rod->release(place.at);
  if (held) branch.frame = *held;
  branch.position = branch.orientation = held.has_value();
  return branch;
}

}  // namespace tendril
