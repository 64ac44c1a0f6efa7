#include "method/preform/pcc_optimization.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "method/pcc/curve_distance.h"
#include "method/preform/in_parallel.h"

namespace tendril::preform {

namespace {

using routing::DescentOptions;
using routing::DescentResult;
using routing::Violation;

// m or rad: what counts as kept.
constexpr double tolerance = 1e-5;
// A curve that misses a clearance by more than this share of the radius will not be repaired by closer samples.
constexpr double repairable = 0.2;

/// Samples so far apart that a corner reaches between two of them by no more than the margin: with the least distance d of the
/// centre line from surfaces, spacing^2 / 8 d.
DescentOptions sampled(const FreeSpace& space, const Options& options, double share) {
  const double radius = options.curve.radii.front(), reach = space.demands().radius + space.demands().clearance;
  DescentOptions descent;
  descent.sample = share * std::clamp(0.4 * reach, 0.02 * radius, 0.4 * radius);
  // Where there is no clearance to speak of, edges of surfaces are sharp: nothing but the samples' distance helps.
  descent.margin = std::min(descent.sample * descent.sample / (8 * std::max(reach, 1e-3 * radius)), descent.sample);
  return descent;
}

Optimized judged(const FreeSpace& space, const Options& options, const DescentResult& result, int path) {
  return {result.curve, result.length, result.objective, path,
          violations(space, options.curve, options.ends, result.curve, tolerance)};
}

/// Whether closer samples may help: only surroundings are missed, and by little.
bool is_near(const Options& options, const std::vector<Violation>& violations) {
  return !violations.empty() && std::all_of(violations.begin(), violations.end(), [&](const Violation& v) {
    const bool space = v.kind == Violation::Kind::clearance || v.kind == Violation::Kind::keep_in || v.kind == Violation::Kind::keep_out;
    return space && v.by < repairable * options.curve.radii.front();
  });
}

Optimized optimized(const FreeSpace& space, const Options& options, const Candidate& candidate, const RunContext& context) {
  const DescentOptions coarse = sampled(space, options, 1);
  Optimized best = judged(space, options, descend(space, options.curve, options.ends, candidate.points, coarse, context), candidate.path);
  if (!is_near(options, best.violations)) return best;
  DescentOptions fine = sampled(space, options, 0.6);
  fine.margin = 3 * coarse.margin;
  const DescentResult again = descend(space, options.curve, options.ends, best.points, fine, context);
  Optimized repaired = judged(space, options, again, candidate.path);
  return repaired.violations.empty() || repaired.violations.front().by < best.violations.front().by ? repaired : best;
}

bool is_better(const Optimized& a, const Optimized& b) {
  if (a.violations.empty() != b.violations.empty()) return a.violations.empty();
  return a.objective < b.objective * (1 - 1e-9);
}

/// Samples, in those of a first descent: of optima that are compared with each other, and of those that are handed out.
constexpr double compared = 1, final = 0.25;

/// The constrained optimum next to a curve that need not be feasible; margins that the certificate finds too small are raised.
Optimized held(const FreeSpace& space, const Options& options, const PccPoints& curve, int path, double samples, const RunContext& context) {
  DescentOptions descent = sampled(space, options, samples);
  descent.polish = true;
  Optimized held;
  for (int attempt = 0; attempt < 3; ++attempt, descent.margin *= 4) {
    held = judged(space, options, descend(space, options.curve, options.ends, curve, descent, context), path);
    if (!is_near(options, held.violations) || context.stop()) break;
  }
  return held;
}

/// From a feasible curve: as it was where it gets no better.
Optimized polished(const FreeSpace& space, const Options& options, const Optimized& curve, double samples, const RunContext& context) {
  const Optimized found = held(space, options, curve.points, curve.path, samples, context);
  return found.violations.empty() && found.objective <= curve.objective ? found : curve;
}

/// The optimum for other vertices or tools: the nearest one where it keeps everything, else wherever a descent from the softer
/// penalties leads, unless that ends far above `worth` (m).
Optimized optimum(const FreeSpace& space, const Options& options, const Candidate& candidate, double worth, const RunContext& context) {
  constexpr double far_above = 0.02;
  const Optimized nearest = held(space, options, candidate.points, candidate.path, compared, context);
  if (nearest.violations.empty()) return nearest;
  const Optimized found = optimized(space, options, candidate, context);
  if (!found.violations.empty() || found.objective > worth * (1 + far_above)) return found;
  return polished(space, options, found, compared, context);
}

/// Other tools, bend by bend, until none makes it better.
Optimized with_best_tools(const FreeSpace& space, const Options& options, Optimized best, const RunContext& context) {
  bool improved = options.curve.radii.size() > 1;
  for (int round = 0; improved && round < 3; ++round) {
    improved = false;
    for (int bend = 0; bend < best.points.bends(); ++bend)
      for (const double radius : options.curve.radii) {
        if (context.stop()) return best;
        if (bend >= best.points.bends() || radius == best.points.radii[bend]) continue;
        Candidate changed{best.points, best.path};
        changed.points.radii[bend] = radius;
        const Optimized tried = optimum(space, options, changed, best.objective, context);
        if (!is_better(tried, best)) continue;
        best = tried;
        improved = true;
      }
  }
  return best;
}

double turn_at(const PccPoints& curve, int bend) {
  const Vec3 in = (curve.points[bend + 1] - curve.points[bend]).normalized();
  const Vec3 out = (curve.points[bend + 2] - curve.points[bend + 1]).normalized();
  return 2 * std::atan2((out - in).norm(), (out + in).norm());
}

/// Without bends that hardly turn, as long as that costs next to nothing: each of them is a step of the bending machine.
Optimized with_fewer_bends(const FreeSpace& space, const Options& options, const Optimized& given, const RunContext& context) {
  constexpr double hardly = 15 * units::deg;
  const double most = given.objective * (1 + options.fewer_bends);
  Optimized best = given;
  while (best.points.bends() > 0 && !context.stop()) {
    int least = 0;
    for (int bend = 1; bend < best.points.bends(); ++bend)
      if (turn_at(best.points, bend) < turn_at(best.points, least)) least = bend;
    if (turn_at(best.points, least) > hardly) break;
    Candidate fewer{best.points, best.path};
    fewer.points.points.erase(fewer.points.points.begin() + least + 1);
    fewer.points.radii.erase(fewer.points.radii.begin() + least);
    const Optimized tried = optimum(space, options, fewer, most, context);
    // With so much freedom the descent may end in another passage, which is another hose.
    if (!tried.violations.empty() || tried.objective > most || routing::curve_distance(tried.points, given.points) > options.same) break;
    best = tried;
  }
  return best;
}

}  // namespace

std::vector<Optimized> pcc_optimization(const FreeSpace& space, const Options& options, const std::vector<Candidate>& candidates,
                                        const RunContext& context) {
  std::vector<Optimized> all(candidates.size());
  std::vector<char> done(candidates.size(), 0);
  in_parallel(candidates.size(), context, "hoses", [&](std::size_t i) {
    all[i] = optimized(space, options, candidates[i], context);
    done[i] = 1;
  });
  // Stopped early: what was not reached is left out.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (done[i]) std::swap(all[kept++], all[i]);
  all.resize(kept);
  return all;
}

void polish(const FreeSpace& space, const Options& options, std::vector<Optimized>& curves, const RunContext& context) {
  in_parallel(curves.size(), context, "polishing", [&](std::size_t i) {
    if (!curves[i].violations.empty()) return;
    const Optimized settled = polished(space, options, curves[i], compared, context);
    const Optimized chosen = with_best_tools(space, options, with_fewer_bends(space, options, settled, context), context);
    curves[i] = polished(space, options, chosen, final, context);
  });
}

}  // namespace tendril::preform
