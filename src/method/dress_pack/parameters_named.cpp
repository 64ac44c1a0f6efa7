// The numbers of a pack that have names.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/number_text.h"
#include "method/dress_pack/parameters.h"
#include "statics/parameter.h"

namespace tendril::dress_pack {
namespace {

const char* const components[] = {"x", "y", "z"};

/// Grows a number of the rods' problems in place.
void grow(PackProblem& pack, const Parameter& parameter, double by) {
  SystemProblem system{std::move(pack.rods), {}};
  change(system, parameter, by);
  pack.rods = std::move(system.rods);
}

PackParameter length_of(const PackProblem& pack, int rod) {
  PackParameter out;
  out.name = pack.rod_name(rod) + ".length";
  out.start = pack.rods[rod].rod.length;
  out.apply = [rod](double value, PackProblem& to) {
    Parameter length;
    length.rod = rod;
    grow(to, length, value - to.rods[rod].rod.length);
  };
  return out;
}

PackParameter place_of(const PackProblem& pack, int attachment, int component) {
  PackParameter out;
  out.name = pack.attachment_name(attachment) + "." + components[component];
  out.start = pack.attachments[attachment].in_link.at[component];
  out.apply = [attachment, component](double value, PackProblem& to) { to.attachments[attachment].in_link.at[component] = value; };
  out.moves_attachments = true;
  return out;
}

PackParameter turn_of(const PackProblem& pack, int attachment, int component) {
  PackParameter out;
  out.name = pack.attachment_name(attachment) + ".r" + components[component];
  out.apply = [attachment, component](double value, PackProblem& to) {
    Quat& rotation = to.attachments[attachment].in_link.rotation;
    rotation = (rotation * exp_rotation(value * Vec3::Unit(component))).normalized();
  };
  out.moves_attachments = true;
  return out;
}

bool inside(const RodProblem& rod, const Hold& hold) {
  return hold.at > 1e-9 * rod.rod.length && hold.at < (1 - 1e-9) * rod.rod.length && !hold.slide;
}

PackParameter arc_of(const PackProblem& pack, int rod, int hold) {
  PackParameter out;
  const double at = pack.rods[rod].holds[hold].at;
  out.name = pack.rod_name(rod) + "." + number_text(at) + ".at";
  out.start = at;
  out.apply = [rod, hold, at](double value, PackProblem& to) {
    // The segments on both sides stay as many as they are.
    to.rods[rod].holds[hold].cut_at = at;
    to.rods[rod].holds[hold].at = value;
  };
  return out;
}

std::vector<PackParameter> all_of(const PackProblem& pack) {
  std::vector<PackParameter> out;
  for (std::size_t k = 0; k < pack.rods.size(); ++k) {
    out.push_back(length_of(pack, static_cast<int>(k)));
    for (std::size_t h = 0; h < pack.rods[k].holds.size(); ++h)
      if (inside(pack.rods[k], pack.rods[k].holds[h])) out.push_back(arc_of(pack, static_cast<int>(k), static_cast<int>(h)));
  }
  for (std::size_t k = 0; k < pack.attachments.size(); ++k) {
    for (int c = 0; c < 3; ++c) out.push_back(place_of(pack, static_cast<int>(k), c));
    for (int c = 0; c < 3; ++c) out.push_back(turn_of(pack, static_cast<int>(k), c));
  }
  return out;
}

/// Holds keep their order, and a rod reaches beyond its last place.
void check_reach(const PackProblem& pack, const PackParameter& parameter) {
  for (const double value : {parameter.lower, parameter.upper}) {
    PackProblem changed = pack;
    parameter.apply(value, changed);
    for (std::size_t k = 0; k < pack.rods.size(); ++k) {
      const auto order = [](const RodProblem& rod) {
        std::vector<std::pair<double, std::size_t>> places;
        for (std::size_t h = 0; h < rod.holds.size(); ++h) places.push_back({rod.holds[h].at, h});
        std::sort(places.begin(), places.end());
        std::vector<std::size_t> order;
        for (const auto& [at, h] : places) order.push_back(h);
        return order;
      };
      bool beyond = order(changed.rods[k]) != order(pack.rods[k]);
      for (const Hold& hold : changed.rods[k].holds) beyond |= hold.at < 0 || hold.at > changed.rods[k].rod.length * (1 + 1e-12);
      if (beyond)
        throw UsageError("dress pack: at " + number_text(value) + " '" + parameter.name + "' carries a hold of " + pack.rod_name(static_cast<int>(k)) +
                         " over another one or over an end; expected narrower bounds");
    }
  }
}

}  // namespace

std::vector<std::string> parameter_names(const PackProblem& pack) {
  std::vector<std::string> out;
  for (const PackParameter& one : all_of(pack)) out.push_back(one.name);
  return out;
}

PackParameter pack_parameter(const PackProblem& pack, const std::string& name, double lower, double upper) {
  pack.check();
  for (PackParameter& one : all_of(pack)) {
    if (one.name != name) continue;
    one.lower = lower;
    one.upper = upper;
    if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper) || !(one.start >= lower && one.start <= upper))
      throw UsageError("dress pack: the bounds of '" + name + "' are " + number_text(lower) + " and " + number_text(upper) +
                       ", expected two numbers in rising order with " + number_text(one.start) + " between them");
    const bool arc = name.ends_with(".at") || name.ends_with(".length");
    if (arc && !(lower > 0)) throw UsageError("dress pack: the bounds of '" + name + "' begin at " + number_text(lower) + " m, expected more than 0");
    if (arc) check_reach(pack, one);
    return one;
  }
  throw UsageError("dress pack: there is no parameter " + unknown_name(name, "parameters", parameter_names(pack)));
}

}  // namespace tendril::dress_pack
