// What method.preform is asked, and what it answers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_check.h"
#include "method/pcc/pcc_demands.h"
#include "method/step.h"

namespace tendril::preform {

using routing::Ends;
using routing::FreeSpace;
using routing::PccPoints;

struct Options {
  Ends ends;
  routing::SpaceDemands space;
  routing::PccDemands curve;
  int max_bends = 6;
  double grid = 20e-3;            ///< m, step of the roadmap
  double exclusion = 60e-3;       ///< m, around each path that was found
  double exclusion_ends = 120e-3; ///< m, around the ends, where nothing is excluded
  int max_paths = 30;
  /// Paths that cost more than so many times the cheapest one are left; at least 1. Far more than a hose may be longer: paths go
  /// around what was excluded before, and hoses pull themselves tight from there.
  double max_detour = 6;
  double same = 25e-3;            ///< m: curves nearer than this all along are the same
  double fewer_bends = 5e-3;      ///< share of the objective that may be given up for leaving out bends that hardly turn
};

/// One design.
struct Hose {
  PccPoints points;
  double length = 0, objective = 0;  ///< m
  routing::CurveGap clearance;       ///< its value: m, between the surfaces (the clearance demanded is not taken off)
  std::string clearance_to;          ///< obstacle's name; empty: nothing within reach
  int passage = 0;                   ///< hoses with the same number are known to be deformable into each other
  std::string label;                 ///< what sets it apart: "4 bends, other side of 'battery'"
};

struct Result {
  bool ok = false;
  Status status = Status::stalled;   ///< solved, infeasible, cancelled, timeout
  std::string message;
  double seconds = 0;
  std::vector<MethodStep> steps;
  std::vector<Hose> hoses;           ///< the best first
  int passages = 0;
  /// The nearest misses where nothing is feasible: which demand, where, by how much.
  std::vector<std::string> near_misses;
  Options options;
  std::shared_ptr<const FreeSpace> space;  ///< that the search asked; null where it never came so far
};

}  // namespace tendril::preform
