#include "method/preform/global_search.h"

#include <algorithm>
#include <limits>

#include "method/free_space/bottleneck.h"
#include "method/preform/end_lead.h"
#include "method/preform/path_search.h"

namespace tendril::preform {
namespace {

/// Of the first path: ends that are near each other must not keep all that lies between them.
constexpr double largest_kept_share = 0.35;

/// About an end nothing is excluded: around the connection, and behind the straight that leaves it.
struct KeptEnd {
  Vec3 end, tip;
  static constexpr double tie = 1e-9;  ///< m: nodes may lie at exactly that distance
  double around_end, around_tip;       ///< m
  KeptEnd(const Vec3& end, const EndLead& lead, double radius)
      : end(end), tip(lead.tip), around_end(radius), around_tip(std::max(radius - lead.length, 0.5 * radius)) {}
  bool holds(const Vec3& p) const { return (p - end).norm() <= around_end + tie || (p - tip).norm() <= around_tip + tie; }
};

double length_of(const std::vector<Vec3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// The straights that leave the ends.
struct Leads {
  EndLead start, finish;
  Leads(const FreeSpace& space, const Options& options)
      : start(end_lead(space, options.curve, options.ends.start, options.ends.start_along, options.curve.start_cone, "start")),
        finish(end_lead(space, options.curve, options.ends.finish, -options.ends.finish_along, options.curve.finish_cone, "finish")) {}
  const std::string& obstruction() const { return !start.obstruction.empty() ? start.obstruction : finish.obstruction; }
};

GlobalPaths search_between(const FreeSpace& space, const routing::Roadmap& roadmap, const Leads& leads, const Options& options,
                           const RunContext& context) {
  GlobalPaths found;
  const Ends& ends = options.ends;
  const EndLead &start = leads.start, &finish = leads.finish;
  found.nodes = roadmap.nodes();
  found.free_nodes = roadmap.free_nodes();
  if (context.stop()) return found;
  PathSearch search(space, roadmap, start.tip, finish.tip);
  double kept = options.exclusion_ends, most = std::numeric_limits<double>::infinity();
  while (static_cast<int>(found.paths.size()) < options.max_paths && !context.stop()) {
    const PathSearch::Path path = search.shortest(most, context);
    if (path.places.empty()) break;
    std::vector<Vec3> whole{ends.start};
    if (start.length > 0) whole.push_back(start.tip);
    whole.insert(whole.end(), path.places.begin() + 1, path.places.end() - 1);
    if (finish.length > 0) whole.push_back(finish.tip);
    whole.push_back(ends.finish);
    if (found.paths.empty()) {
      kept = std::min(kept, largest_kept_share * length_of(path.places));
      most = options.max_detour * path.cost;
    }
    found.paths.push_back(std::move(whole));
    const KeptEnd first(ends.start, start, kept), last(ends.finish, finish, kept);
    // A path that loses none of its own nodes would be found again.
    if (search.exclude_around(path, options.exclusion, [&](const Vec3& p) { return first.holds(p) || last.holds(p); }) == 0) break;
  }
  if (found.paths.empty() && !context.stop()) {
    const routing::Bottleneck narrow = routing::bottleneck_between(space, start.tip, finish.tip, options.grid, context);
    if (narrow.kind != routing::Bottleneck::Kind::stopped) found.obstruction = text_of(narrow, space, options.grid);
  }
  return found;
}

GlobalPaths obstructed(const Leads& leads) {
  GlobalPaths found;
  found.obstruction = leads.obstruction();
  return found;
}

}  // namespace

GlobalPaths global_search(const FreeSpace& space, const Options& options, const RunContext& context) {
  const Leads leads(space, options);
  if (!leads.obstruction().empty()) return obstructed(leads);
  return search_between(space, routing::Roadmap(space, options.grid, context), leads, options, context);
}

GlobalPaths global_search(const FreeSpace& space, const routing::Roadmap& roadmap, const Options& options, const RunContext& context) {
  const Leads leads(space, options);
  if (!leads.obstruction().empty()) return obstructed(leads);
  return search_between(space, roadmap, leads, options, context);
}

}  // namespace tendril::preform
