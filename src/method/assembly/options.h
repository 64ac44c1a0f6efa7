// What method.assembly is asked, and what it answers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "method/assembly/manipulation.h"
#include "method/step.h"
#include "scene/scene.h"

namespace tendril::assembly {

/// A rigid body at a rod's end or a branch point: it collides too.
struct Connector {
  std::string name;
  std::string rod;            ///< its rod's name
  bool at_start = false;      ///< else at its finish
  /// In the axes of the section it is fixed to.
  Obstacle body;
};

struct Options {
  std::vector<std::string> rods;       ///< names; empty: all rods of the scene, which must hang together
  std::vector<Connector> connectors;
  std::optional<Vec3> exit;            ///< m, where the handle must get to; nothing: anywhere with room
  std::string grip;                    ///< rod or branch point to take as the handle; empty: chosen
  double grip_at = -1;                 ///< m, arc length; negative: the middle
  double max_strain = 0.3;             ///< of the outermost fibre, all the way
  double min_bend_radius = 0;          ///< m, all the way; 0: any
  double deviation = 0.05;             ///< of the thickest radius: how near the last state must be to the routed one
  int attempts = 20;                   ///< handles, paths, gravity modes, grips: tried in order of promise
  bool optimise = true;                ///< the found manipulation: shorter, smoother, with more clearance, fewer grips
  double optimise_seconds = 5;         ///< s
  int replays = 0;                     ///< of the proven manipulation, by hands that stray by a quarter of the thickest radius
  /// Of the scene: which of its equilibria is the routed one, and where the search for it starts; null: found anew.
  std::shared_ptr<const SceneEquilibrium> routed;
  SolveOptions solve;
};

/// How a try to install it went.
struct Proof {
  bool ok = false;
  std::string message;                 ///< what went wrong, where
  double deviation = 0;                ///< m, farthest vertex from the routed configuration in the end
  int steps = 0;
  double strain = 0, strain_at_time = 0;
  double bend_radius = 0, bend_radius_at_time = 0;  ///< m
  double clearance = 0, clearance_at_time = 0;      ///< m; negative: contact with so much overlap
  std::string strain_of, bend_radius_of, clearance_to;
};

/// One state of the forward play.
struct KeyFrame {
  double t = 0;
  std::shared_ptr<const SceneEquilibrium> equilibrium;
};

/// Replays of a proven manipulation by hands that do not follow their paths exactly. Where some do not arrive it is fragile.
struct Robustness {
  int replays = 0, arrived = 0;
  std::vector<std::string> failures;   ///< of each replay, in order; empty: it arrived
};

/// One try: a handle pulled along one way out and, where it came out, what was traced played forward.
struct Attempt {
  std::string handle;
  bool gravity = false;      ///< it acted while the system was pulled out
  bool smoothed = false;     ///< the traces were
  int grips = 0;             ///< that moved it in; 0: it did not come out
  std::string outcome;       ///< "proven", or what stopped it
  double seconds = 0;
};

struct Result {
  bool ok = false;
  /// solved: installed and proven by playing it forward. infeasible: no attempt was proven; `message` says how far the best one
  /// came and what stopped it. stalled: the routed configuration itself has no equilibrium. cancelled, timeout.
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  std::vector<MethodStep> steps;
  Manipulation manipulation;           ///< forward: from outside to the routed configuration
  double duration = 1;                 ///< s, of the common time
  Proof proof;
  Robustness robustness;
  /// Of the proof; where none was found, of the attempt that came furthest, as far as it came.
  std::vector<KeyFrame> play;
  std::optional<Vec3> stopped_at;      ///< m: where that one was stopped
  std::vector<Vec3> handle_path;       ///< m, outwards
  std::vector<Attempt> attempts;
  int hands = 0;                       ///< grips at the same time, at most
};

}  // namespace tendril::assembly
