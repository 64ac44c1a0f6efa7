#include "method/route/clipped_design.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "method/route/clip_choice.h"
#include "method/route/clip_places.h"
#include "method/route/route_guess.h"
#include "method/route/stretch_trial.h"

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_length = 1.0 / 40;  // of the object: no need of more places

/// Start, candidates and the design's own clips by rising arc length, finish.
struct Places {
  std::vector<Hold> holds;
  std::vector<bool> given;   ///< the design's own: none may be left out
  int candidates = 0;

  /// The design's own clips between two of the holds.
  bool given_between(int from, int to) const {
    return std::find(given.begin() + from + 1, given.begin() + to, true) != given.begin() + to;
  }
};

Places places_for(const SurroundingsByUse& around, const Design& design, const Way& way, const RefinementOptions& options) {
  const double length = design.rod.length, radius = design.rod.largest_radius(), apart = room_at_holds(length, radius);
  const ClipSites sites{around.all.get(), &around.obstacles, options.clip_reach};
  std::vector<std::pair<Hold, bool>> all;
  for (const Hold& clip : design.clips) all.push_back({clip, true});
  for (const Hold& place : clip_places(way, length, radius, std::max(3 * radius, share_of_length * length), apart, sites)) {
    const bool taken = std::any_of(design.clips.begin(), design.clips.end(),
                                   [&](const Hold& clip) { return std::abs(clip.at - place.at) < apart; });
    if (!taken) all.push_back({place, false});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first.at < b.first.at; });
  Places places;
  places.candidates = static_cast<int>(all.size() - design.clips.size());
  places.holds.push_back({0, design.from});
  places.given.push_back(true);
  for (const auto& [hold, own] : all) {
    places.holds.push_back(hold);
    places.given.push_back(own);
  }
  places.holds.push_back({length, design.to});
  places.given.push_back(true);
  return places;
}

/// The longest way without a place to fasten to, where it is longer than places are apart.
std::string bare_stretch(const Places& places, double usual) {
  double longest = 1.5 * usual;
  std::string text;
  for (std::size_t k = 1; k < places.holds.size(); ++k) {
    const double begin = places.holds[k - 1].at, end = places.holds[k].at;
    if (end - begin <= longest) continue;
    longest = end - begin;
    text = "nothing to fasten a clip to is in reach from " + number_text(std::round(1e3 * begin) / 1e3) + " to " +
           number_text(std::round(1e3 * end) / 1e3) + " m";
  }
  return text;
}

std::string lack_of(const ClipChoice& choice, int given, int most, const Places& places, double usual) {
  if (choice.needed >= 0 && choice.needed <= most + given) return "";
  if (choice.needed >= 0)
    return std::to_string(choice.needed - given) + (choice.needed - given == 1 ? " clip" : " clips") + " would do, at most " +
           std::to_string(most) + " may be added";
  const std::string bare = bare_stretch(places, usual);
  return bare.empty() ? "clips at any of " + std::to_string(places.candidates) + " places along the route do not help" : bare;
}

}  // namespace

std::optional<ClippedDesign> clipped_along_way(const SurroundingsByUse& around, const Vec3& gravity, const Design& design,
                                               const RefinementOptions& options, const RunContext& context) {
  const std::optional<Way> way = way_of(design);
  if (!way) return std::nullopt;
  const Places places = places_for(around, design, *way, options);
  if (places.candidates == 0) return std::nullopt;
  const StretchTrial trial(around, gravity, design.rod, *way, options, context);
  const int inner = static_cast<int>(places.holds.size()) - 2, given = static_cast<int>(design.clips.size());
  const ClipChoice choice = fewest_clips(inner, options.most_clips + given, [&](int from, int to) {
    return places.given_between(from, to) ? -infinity : trial.margin(places.holds[from], places.holds[to]);
  });
  ClippedDesign out{choice.margin > -infinity, design, {}, choice.needed, {}};
  if (out.found) out.design.clips.clear();
  for (const int place : choice.places) {
    out.design.clips.push_back(places.holds[place]);
    if (!places.given[place]) out.added.push_back(places.holds[place]);
  }
  out.lack = lack_of(choice, given, options.most_clips, places, room_at_holds(design.rod.length, design.rod.largest_radius()));
  return out;
}

}  // namespace tendril::routing
