// Rods on a rigid, smooth floor, with exact answers.
#pragma once

#include <memory>

#include "geometry/surroundings.h"
#include "statics/solve.h"

namespace tendril::validation {

/// A problem with its surroundings, which must outlive the solve.
struct FloorProblem {
  std::unique_ptr<Surroundings> floor;
  RodProblem rod;
};

/// A heavy hose of 1.2 m, clamped level 0.1 m above the floor (of its centre line), its far end free on it. By the rod's
/// conserved quantity the clamp's moment is sqrt(2 EI w h) at any deflection.
FloorProblem hose_on_floor(int segments);
struct HoseOnFloor {
  static constexpr double clamp_force = 0.708445429800733;   ///< N, upwards
  static constexpr double clamp_moment = 0.0835450424978976; ///< N m
  static constexpr double lift_off = 0.48612776278317155;    ///< m, arc length from which on it lies
  static constexpr double lift_off_x = 0.4717572080924621;   ///< m
  /// Centre line where it is free, at a quarter, half and three quarters of the lift-off arc length: x, z.
  static constexpr double free_part[3][2] = {{0.118030931427816, 0.0738014631355221},
                                             {0.231996109997553, 0.0316308382621317},
                                             {0.35041643940194, 0.0052082708932345}};
};
struct FloorErrors {
  double force = 0, moment = 0;  ///< of the clamp, relative
  double line = 0;               ///< of the free part and of the lying part's height, relative to the length
  double deepest = 0;            ///< penetration over the radius
};
FloorErrors hose_on_floor_errors(const Equilibrium& e);

/// A weightless cantilever of 1 m under a tip force of `times` the one with which its tip touches a floor `depth` below.
/// Only the tip touches: the shape stays what it was at the touch, the floor carries what is beyond.
struct TipOnFloor {
  double depth, touch_force, tip_x, tip_angle;  ///< over L; over EI/L^2; over L; rad, downwards
};
inline constexpr TipOnFloor tips_on_floor[] = {{0.1, 0.3031220388040343, 0.9939792953795942, 0.15030682493892877},
                                               {0.3, 0.9930978060477731, 0.9442302816669402, 0.45861708123616196},
                                               {0.6, 2.9614472292149223, 0.7488287630271846, 0.9796594837201407}};
FloorProblem tip_on_floor(const TipOnFloor& tip, double times, int segments);
struct TipErrors {
  double place = 0, angle = 0;  ///< of the tip: over L; rad
  double floor_force = 0;       ///< relative
};
TipErrors tip_on_floor_errors(const TipOnFloor& tip, double times, const Equilibrium& e);

}  // namespace tendril::validation
