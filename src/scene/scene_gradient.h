// Sensitivities of a solved scene, by names: "hose.min_bend_radius" by "hose.length", "hose.to.at.z", "gravity.z".
//
// Parameters. gravity.x; of a rod: hose.length, hose.section.EI (EA GA GA1 GA2 EI1 EI2 GJ mass outer inner young, or the factors
// stiffness and density; hose.section.2.EI: of its second part), hose.from.at.x and hose.from.turn.x (to, or hold.1 for the
// first hold inside the rod; hose.hold.1.place: its arc length), hose.load.1.force.x (moment, place); of a branch point:
// tee.at.x and tee.turn.x where it is held, tee.2.at.x, tee.2.turn.x and tee.2.place for the second section joined to it.
// A name that others begin with means all of them: hose.to, gravity.
//
// Measures. Of a rod: hose.min_bend_radius, max_tension, max_strain, length, clearance, energy.bend (twist stretch shear gravity
// load total), hose.from.force.x and hose.from.moment.x; of a branch point: tee.place.x, tee.force.x, tee.moment.x.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "scene/scene_equilibrium.h"
#include "scene/system_sensitivity.h"
#include "statics/sensitivity.h"

namespace tendril {

/// A parameter by its name in a scene.
struct SceneParameter {
  std::string name;
  int system = 0;        ///< of the equilibrium; -1: all of them (gravity)
  Parameter parameter;
};

/// A measure by its name in a scene.
struct SceneMeasure {
  std::string name;
  int system = 0;
  Measure measure;
};

/// One measure's derivatives.
struct SceneGradient {
  std::string measure, unit;
  double value = 0;
  bool ok = false;          ///< the derivatives exist
  std::string message;
  struct Entry {
    std::string parameter, unit;  ///< of the parameter
    double derivative = 0;
  };
  std::vector<Entry> entries;     ///< in the order asked for

  /// Unit of a derivative: "N/m", "m/(N m^2)", "1".
  static std::string unit_of(const std::string& measure, const std::string& parameter);
};

/// Every parameter of a solved scene.
std::vector<SceneParameter> parameters_of(const SceneEquilibrium& equilibrium);
/// Every measure with a name. Others can be made by hand.
std::vector<SceneMeasure> measures_of(const SceneEquilibrium& equilibrium);

/// What engineers look at first: bend radius, tension, length and, near obstacles, clearance of every rod.
std::vector<std::string> usual_measures(const SceneEquilibrium& equilibrium);

/// The parameters of these names, groups resolved. Throws UsageError with the nearest name.
std::vector<SceneParameter> named_parameters(const SceneEquilibrium& equilibrium, const std::vector<std::string>& names);
/// The measure of this name. Throws UsageError with the nearest.
SceneMeasure named_measure(const SceneEquilibrium& equilibrium, const std::string& name);
/// The gap between a rod and the obstacle `to` (-1: any) where it is smallest. Throws UsageError when there is none near.
SceneMeasure clearance_measure(const SceneEquilibrium& equilibrium, const std::string& rod, int to = -1);
/// System and number there of a rod. Throws UsageError with the nearest name.
std::pair<int, int> place_of_rod(const SceneEquilibrium& equilibrium, const std::string& name);

/// A solved scene whose rods can be asked how they depend on what.
class SceneSensitivity {
 public:
  /// The equilibrium must outlive this. Nothing is computed before the first question.
  explicit SceneSensitivity(const SceneEquilibrium& equilibrium);

  /// Exact derivatives by one adjoint solution (with sliding clips by four more equilibria a clip, see system_sensitivity.h).
  /// Throws UsageError for rods of staggered elements; an equilibrium that is not solved, or a singular one, gives a result
  /// that is not ok.
  SceneGradient gradient(const SceneMeasure& measure, const std::vector<SceneParameter>& parameters, const RunContext& context = {});

  /// Derivatives of any function of an equilibrium by central differences of scenes solved anew, two for each parameter:
  /// right to about six digits.
  SceneGradient gradient(const std::function<double(const SceneEquilibrium&)>& measure,
                         const std::vector<SceneParameter>& parameters, const RunContext& context = {}) const;

  /// How far a unit of the parameter moves the vertices of every rod, by rod of the equilibrium: m per unit, world axes; zero
  /// for rods that it does not reach, NaN where there are no derivatives. Clips that slide stay at their arc lengths. Throws as
  /// gradient() does.
  std::vector<std::vector<Vec3>> motion(const SceneParameter& parameter, const RunContext& context = {});

 private:
  SystemSensitivity& system(int k, const RunContext& context);
  SceneEquilibrium solved_after(const SceneParameter& parameter, double by, const RunContext& context) const;

  const SceneEquilibrium& equilibrium_;
  std::vector<std::unique_ptr<SystemSensitivity>> systems_;
};

}  // namespace tendril
