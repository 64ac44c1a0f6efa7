// Where the solution of a network begins: branch points between what holds them, then each rod's own first guess.
#pragma once

#include "statics/rod_network.h"

namespace tendril {

/// Frames at the vertices of every rod and at the branch points.
struct NetworkGuess {
  std::vector<std::vector<Frame>> rods;
  std::vector<Frame> branches;
};

/// How the guess of one rod differs from the usual one.
struct GuessVariant {
  int rod = -1;        ///< -1: none differs
  double bulge = 0;    ///< degrees by which the slack's bulge is turned about the chord
  double turns = 0;    ///< full turns about the tangent on the way to its last held section
};

/// Branch points are placed as a net of springs, each as soft as its rod is long, and turned so that the rods leave towards
/// their other ends; linear in their number. A single rod is guessed as first_guess.h says.
NetworkGuess network_guess(const RodNetwork& network, const GuessVariant& variant = {});

/// Adds holds where sections of rod `rod` belong to the branch points of a guess, and their vertices.
void hold_at_branches(const RodNetwork& network, const NetworkGuess& guess, int rod, RodProblem& problem, RodMesh& mesh);

}  // namespace tendril
