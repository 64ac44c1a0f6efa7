// What a variation study is asked: which numbers of a design vary and how, what is measured, how outcomes are drawn.
//
// Variables have the names of scene_gradient.h. A number ("hose.length", "hose.section.EI", "hose.hold.1.place",
// "hose.from.at.x") or a group of alike ones ("hose.from.at", "gravity") varies within `tolerance`; a frame ("hose.from",
// "hose.to", "hose.hold.1", a held branch point "tee", a section joined to it "tee.2") within ball or box, cone and twist; the
// direction of "gravity" within a cone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/frame.h"
#include "scene/scene_gradient.h"
#include "statics/problem.h"

namespace tendril::variation {

/// How a variable is distributed about its nominal value.
enum class Spread {
  normal,      ///< the tolerance is three standard deviations, unless `sigma` is given
  uniform,     ///< over the tolerance: interval, ball, box, cap of directions
  triangular,  ///< the nominal value is the likeliest one
  function,    ///< Variable::inverse
};

/// One design variable. SI units and radians; `relative`: tolerance, sigma and inverse are shares of the nominal value.
struct Variable {
  std::string name;
  std::optional<double> tolerance;  ///< of numbers, to both sides
  bool relative = false;
  std::optional<double> ball;       ///< m, radius: where a frame may be
  std::optional<Vec3> box;          ///< m, half sides along the world axes
  std::optional<double> cone;       ///< rad, half angle about the section normal, or about gravity
  std::optional<double> twist;      ///< rad, about the section normal
  /// Nothing: normal for numbers, box and twist, uniform for ball and cone. A normal ball or cone has a third of it as the
  /// standard deviation of each of its components, so that a few outcomes in a hundred lie outside.
  std::optional<Spread> spread;
  std::optional<double> sigma;      ///< standard deviation, of each component
  /// The inverse distribution: how far the variable is from its nominal value where a share (0 ... 1) of all outcomes lies
  /// below. Called in the order of outcomes on the thread that runs the study; while it is set up too, for the variance.
  std::function<double(double share)> inverse;

  /// Instead of a distribution: the number itself, or the frame (world axes; of a section joined to a branch point: in that
  /// one's axes), in every outcome: a measured series or a motion. As many as there are outcomes.
  std::vector<double> numbers;
  std::vector<Frame> frames;
};

/// Variables that depend on each other, by a Gaussian copula: each keeps its own distribution.
struct Group {
  std::vector<std::string> variables;  ///< names as in `vary`, all with as many components
  Eigen::MatrixXd correlation;         ///< of the underlying normal numbers; 1x1: that between any two of them
};

/// What is read off every outcome. Set one of the three, or the name alone.
struct MeasureRequest {
  std::string name;                      ///< in the result; alone: a measure of scene_gradient.h
  std::optional<SceneMeasure> built_in;  ///< one without a name there: a position or a tension at an arc length
  std::string rod, to;                   ///< the clearance from a rod to one obstacle
  bool contact_length = false;           ///< of `rod`, instead of its clearance: the length that obstacles press on
  std::function<double(const SceneEquilibrium&)> function;  ///< called in the order of outcomes on the thread that runs the study
  std::string unit;                      ///< of the function's values
};

/// The rod whose length in contact a measure's name asks for ("hose.contact_length"); empty for other names.
std::string rod_of_contact_length(const std::string& measure);

/// How outcomes fill the space of the variables.
enum class Sampling {
  random,  ///< independent
  sobol,   ///< Sobol' points, Owen-scrambled by the seed
  latin,   ///< Latin hypercubes
};

/// "random", "sobol", "latin".
const char* name_of(Sampling sampling);

struct Options {
  std::vector<Variable> vary;
  std::vector<Group> groups;
  std::vector<MeasureRequest> measures;  ///< empty: bend radius, tension, length and clearance of every rod
  bool measured = true;   ///< false: no measures at all, where only the shapes are wanted
  int outcomes = 1000;
  Sampling sampling = Sampling::random;
  int replicates = 8;     ///< Sobol' points and Latin hypercubes: independent sets of them, from which the error is estimated
  bool uniform = false;   ///< every variable uniform over its tolerance, whatever its spread: for envelopes
  /// Total effects: for so many outcomes, every variable (or correlated group) is drawn anew while the others stay. Costs as many
  /// more solutions for each of them, and once more.
  int effects = 0;
  SolveOptions solve;
};

}  // namespace tendril::variation
