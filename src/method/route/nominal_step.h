// Step 1 of routing for one choice of weights: a nominal route and the design that follows it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "method/route/options.h"
#include "scene/scene.h"

namespace tendril::route {

/// Everything that routes of one scene share. All that is referred to must outlive this.
struct Search {
  const Scene& scene;
  const Options& options;
  const RunContext& context;
  routing::Ends ends;
  routing::StateLattice lattice;

  Search(const Scene& scene, const Options& options, const RunContext& context);

  std::shared_ptr<const FreeSpace> space(const Weights& weights, double more_clearance = 0) const;
};

/// What a nominal route keeps beyond what is demanded, for gravity to take.
struct Reserve {
  double bend_radius = 1;  ///< factor
  double clearance = 0;    ///< m
};

/// Nothing where there is no nominal route: `why` says what keeps the ends apart. `count`: its states and curves grow.
std::optional<Route> nominal(const Search& search, const Weights& weights, const Reserve& reserve, MethodStep& count,
                             std::string& why);

}  // namespace tendril::route
