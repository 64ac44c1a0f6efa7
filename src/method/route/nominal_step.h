// Step 1 of routing for one choice of weights: a nominal route and the design that follows it.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "method/free_space/roadmap.h"
#include "method/route/options.h"
#include "scene/scene.h"

namespace tendril::route {

/// The grid of places for one choice of weights, with the space that it is about.
struct Ground {
  std::shared_ptr<const FreeSpace> space;
  routing::Roadmap roadmap;
};

/// Everything that routes of one scene share. All that is referred to must outlive this. Safe from several threads.
struct Search {
  const Scene& scene;
  const Options& options;
  const RunContext& context;
  routing::Ends ends;
  routing::StateLattice lattice;

  Search(const Scene& scene, const Options& options, const RunContext& context);

  std::shared_ptr<const FreeSpace> space(const Weights& weights, double more_clearance = 0) const;
  /// Up to a quarter of the grid's step more clearance: that of what is demanded and no more, made once. What is free for routes
  /// with a little in reserve is free there, and costs to the goal are no more.
  std::shared_ptr<const Ground> ground(const Weights& weights, double more_clearance = 0) const;

 private:
  mutable std::mutex making_;
  mutable std::map<double, std::shared_ptr<const Ground>> grounds_;  ///< by clearance for length
};

/// What a nominal route keeps beyond what is demanded, for gravity to take.
struct Reserve {
  double bend_radius = 1;  ///< factor
  double clearance = 0;    ///< m
  /// Of the lattice, at most; 0: as many as it takes. Where what is kept in reserve closes a passage a search would go on for long.
  long most_states = 0;
};

/// Nothing where there is no nominal route: `why` says what keeps the ends apart. `count`: its states and curves grow.
std::optional<Route> nominal(const Search& search, const Weights& weights, const Reserve& reserve, MethodStep& count,
                             std::string& why);

}  // namespace tendril::route
