// One stretch of a rod between two full holds on its way: how well it keeps what is demanded, on its own.
#pragma once

#include <functional>

#include "method/route/local_refinement.h"
#include "method/route/surroundings_by_use.h"

namespace tendril::routing {

/// The part of a rod between two arc lengths (m), with its share of the segments, at least `segments`.
Rod part_of(const Rod& rod, double begin, double end, int segments = 8);

class StretchTrial {
 public:
  /// `way`: the frame of the rod's section at an arc length; free of what is to be kept clear of. All must outlive this.
  StretchTrial(const SurroundingsByUse& around, const Vec3& gravity, const Rod& rod, const std::function<Frame(double)>& way,
               const RefinementOptions& options, const RunContext& context)
      : around_(around), gravity_(gravity), rod_(rod), way_(way), options_(options), context_(context) {}

  /// The smallest share by which a demand is kept, as constraints of the refinement are: 1 - demanded / bend radius, room beyond
  /// the clearance over the larger of radius and clearance, 1 - tension / allowed. -infinity: no stable equilibrium.
  double margin(const Hold& from, const Hold& to) const;

 private:
  const SurroundingsByUse& around_;
  Vec3 gravity_;
  const Rod& rod_;
  const std::function<Frame(double)>& way_;
  const RefinementOptions& options_;
  const RunContext& context_;
};

}  // namespace tendril::routing
