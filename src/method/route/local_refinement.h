// Local refinement (thesis 3.1): the adjustable parameters of a design, so that the object in static equilibrium keeps what is
// demanded at the least cost.
//
//   minimise   integral over the rod of  length + clearance f(g) + preference (sum over avoid of f(g_o) + sum over near of 1 - f(g_o)),
//              f(gap) = max(0, 1 - gap / range)^2,  g: to the nearest obstacle that is not to be kept near
//   subject to static equilibrium under gravity in contact, bend radius, clearance, and where asked for tension and strain
//
// gradient: sequential quadratic programming in a trust region, on exact sensitivities of the equilibria; what is demanded enters as
// constraints. gradient_free: the paper's way, a derivative-free method of NLopt on cost plus penalties, equilibria as a black box.
//
// Obstacles that no clearance is demanded of may be touched: they carry the object by contact. Those to keep clear of exert no force
// while designs are compared, as a design that keeps its clearance does not touch them; which side of an open mesh the object is on
// is told by where it ran first. The last equilibrium is found in contact with everything and judged by exact distances; where it
// then misses something, the search goes on in contact with everything.
// Not done: other rods of the scene take no part; a design is a local optimum, near the one that was given.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/curve.h"
#include "scene/scene.h"

namespace tendril::routing {

/// An object between two connections.
struct Design {
  Rod rod;                      ///< straight or preformed; what is adjusted is its length
  Frame from, to;               ///< full holds of start and finish
  double turns = 0;             ///< extra full turns of the finish: see Hold
  std::vector<Hold> clips;      ///< inside the rod, by rising arc length
  /// Roughly where it runs, from start to finish: the first guess, which decides the passage. Nothing: a preformed shape from
  /// `from` where that ends near `to`, else the first guess of statics.
  std::optional<Curve> route;
};

/// What may be adjusted.
struct Adjust {
  /// Reference length. A preformed rod gets longer or shorter at its finish, where its shape must be a straight.
  bool length = true;
  bool from_turn = false, to_turn = false;   ///< connections about their tangents
  bool from_tilt = false, to_tilt = false;   ///< connections about both axes normal to their tangents
  bool clips = false;                        ///< arc lengths of the clips that do not slide
};

enum class RefinementSolver { gradient, gradient_free };

struct RefinementOptions {
  std::string name = "route";               ///< of the rod in the equilibrium, in messages
  Adjust adjust;
  RefinementSolver solver = RefinementSolver::gradient;

  double length_weight = 1;                 ///< 1/m
  double clearance_weight = 0, preference_weight = 0;  ///< 1/m
  double range = 0.1;                       ///< m, of the costs

  double min_bend_radius = 0;               ///< m; 0: any
  double clearance = 0;                     ///< m, for every obstacle; an obstacle's own larger one stands
  double max_tension = std::numeric_limits<double>::infinity();  ///< N
  double max_strain = std::numeric_limits<double>::infinity();
  /// Arc length (m) from both ends, and to both sides of a clip, within which no clearance is demanded.
  double free_ends = 0, free_clips = 0;

  /// m. Nothing: a rod is never shorter than the straight ways between its holds; not longer than twice the design.
  std::optional<double> min_length, max_length;
  double max_turn = 3.0;                    ///< rad, either way
  double max_tilt = 0.25;                   ///< rad, either way, about each axis
  double max_shift = 0.1;                   ///< m, of a clip's arc length, either way

  double tolerance = 1e-6;                  ///< of the cost, relative, at which it is enough
  int max_evaluations = 0;                  ///< equilibria; 0: 100 with gradients, 400 without
  SolveOptions solve;                       ///< of the equilibria; `clearance` is judge, `error` for the last one only

  /// Where no adjustment helps: so many clips may be added, on obstacles that rods may be fastened to (PlacedObstacle::clip)
  /// within `clip_reach` (m, from the rod's surface): as few as hold the design along its route, their arc lengths adjusted (with
  /// those of its own clips only if Adjust says so); without a route one after the other, where it misses most.
  int most_clips = 0;
  double clip_reach = 0.05;
};

/// Something that the final equilibrium does not keep.
struct Unmet {
  enum class What { bend_radius, clearance, tension, strain, stability, equilibrium };
  What what = What::bend_radius;
  double value = 0, demanded = 0;           ///< m, N or none
  double s = 0;                             ///< m, arc length
  Vec3 at = Vec3::Zero();                   ///< m, on the centre line
  std::string obstacle;                     ///< of a clearance
  std::string text;                         ///< "3.2 mm to 'engine' at 0.41 m, 8 required"
};

/// One parameter before and after.
struct Adjusted {
  std::string name, unit;                   ///< "length", "from.turn", "to.tilt.1", "clip.2"; m or rad
  double before = 0, after = 0;
};

/// One equilibrium that was looked at.
struct RefinementRecord {
  double seconds = 0;                       ///< since the beginning
  double objective = 0;                     ///< cost, without penalties
  double violation = 0;                     ///< the largest share by which a demand is missed; 0: all are kept
};

struct RefinementResult {
  bool ok = false;
  /// solved: all demands are kept, no adjustment is better nearby. infeasible: see `unmet`. stalled: the first equilibrium failed.
  /// cancelled, timeout: the best so far.
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  int evaluations = 0;                      ///< equilibria
  Design design;
  std::vector<Adjusted> adjusted;
  std::vector<Hold> added_clips;
  std::shared_ptr<const SceneEquilibrium> equilibrium;  ///< of this one rod; null: there was none
  double objective = 0;
  double settled_length = 0;                ///< m
  double min_bend_radius = 0, min_bend_radius_at = 0;   ///< m; infinite for a straight rod
  Clearance clearance;                      ///< outside the free stretches; exact; infinite without obstacles
  std::string clearance_to;
  std::vector<Unmet> unmet;                 ///< worst first
  std::vector<RefinementRecord> history;
};

/// Throws UsageError for designs and options that make no sense, and for a method of NLopt that cannot be loaded.
RefinementResult refine(const Scene& scene, const Design& design, const RefinementOptions& options = {},
                        const RunContext& context = {});

/// The same, but with at most options.most_clips clips along the design's way from the beginning: as few as hold it there.
RefinementResult refine_clipped(const Scene& scene, const Design& design, const RefinementOptions& options = {},
                                const RunContext& context = {});

/// A place for one more clip: as near as possible to where the rod misses its clearance most (where it misses none: sags most), on
/// its route or else the straight between its neighbouring holds, or as near to that as something to fasten to is within
/// options.clip_reach of its surface; clear of all obstacles by what they demand. Nothing: no place.
std::optional<Hold> propose_clip(const SceneEquilibrium& equilibrium, const Design& design, const RefinementOptions& options);

}  // namespace tendril::routing
