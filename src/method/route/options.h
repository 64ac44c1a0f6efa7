// What method.route is asked, and what it answers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "method/route/local_refinement.h"
#include "method/route/nominal_routing.h"
#include "method/step.h"

namespace tendril::route {

using routing::FreeSpace;
using routing::PccPoints;

/// What a metre of the object costs: length + clearance * f(gap) + what preferences add (FreeSpace::cost).
struct Weights {
  double length = 1, clearance = 0;
};

struct Options {
  Frame from, to;
  Section section;
  bool preformed = false;            ///< true: the reference shape is the nominal route; false: it is straight
  routing::SpaceDemands space;       ///< its weights are overwritten by each of `weights`
  routing::PccDemands curve;
  std::vector<Weights> weights{Weights{}};   ///< one alternative each
  double grid = 20e-3;               ///< m
  int segments = 0;                  ///< of the rod; 0: four to an arc of the smallest bend radius, at least 40
  bool refine = true;
  routing::RefinementOptions refinement;     ///< of which weights, bend radius and clearance are overwritten
  int restarts = 3;                  ///< where refinement fails: with bend radius and clearance in reserve, then more weight on clearance
  int max_clips = 0;                 ///< that may be added where one restart does not help; each restart again with clips
};

/// One design, nominal and in equilibrium.
struct Route {
  Weights weights;                   ///< it was routed with; revised where a restart was needed
  int restarts = 0;
  PccPoints nominal;
  double nominal_length = 0;         ///< m
  double lattice_length = 0;         ///< m, before smoothing
  long lattice_states = 0;           ///< that its search touched
  routing::CurveClearance nominal_clearance;  ///< of the nominal route, outside its free ends
  routing::Design design;            ///< refined
  routing::RefinementResult refined; ///< without an equilibrium where refinement was not asked for
  double objective = 0;              ///< m, of the nominal route, or in equilibrium where there is one
  bool ok = false;                   ///< keeps all that is demanded

  /// In equilibrium where there is one, else nominal: m; the clearance is infinite where nothing is near.
  double length() const { return design.rod.length; }
  double clearance() const;
};

struct Result {
  bool ok = false;                   ///< at least one route keeps all
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  std::vector<MethodStep> steps;
  std::vector<Route> routes;         ///< those that keep all first, each part in the order of the weights; without repetitions
  Options options;
  std::shared_ptr<const FreeSpace> space;    ///< of the first weights
};

}  // namespace tendril::route
