// The scene's classes as scripts see them: names, and handles where a script holds a part of something larger.
#pragma once

#include <memory>
#include <string>

#include "binding/lua_value.h"
#include "geometry/curve.h"
#include "scene/accuracy.h"
#include "scene/explain.h"
#include "scene/sampled_motion.h"
#include "scene/scene.h"
#include "scene/scene_gradient.h"
#include "scene/scene_motion.h"
#include "view/chart.h"

namespace tendril::lua {

/// A rod of a scene, by name: it stays valid while the scene grows and shrinks, and says so when the rod is gone.
struct PlacedRodHandle {
  std::shared_ptr<Scene> scene;
  std::string name;
  PlacedRod& rod() const { return scene->rod(name); }
};

/// A branch point of a scene, by name.
struct PlacedBranchHandle {
  std::shared_ptr<Scene> scene;
  std::string name;
  PlacedBranch& branch() const { return scene->branch(name); }
};

/// A robot of a scene, by name.
struct PlacedRobotHandle {
  std::shared_ptr<Scene> scene;
  std::string name;
  const PlacedRobot& robot() const { return scene->robot(name); }
};

/// One rod of an equilibrium.
struct SolvedRodHandle {
  std::shared_ptr<SceneEquilibrium> equilibrium;
  std::size_t index = 0;
  const SolvedRod& rod() const { return equilibrium->rods[index]; }
};

/// A number that knows more: a clearance knows where it is, an error estimate how far to trust it. Computes as a number.
struct ClearanceValue {
  Clearance clearance;
  std::string obstacle;    ///< its name; empty: there is none
  double required = 0;     ///< m, of that obstacle
  bool too_close = false;
  double value() const { return clearance.value; }
};

struct ErrorValue {
  ErrorEstimate estimate;
  double value() const { return estimate.value; }
};

/// A force of the surroundings on a rod.
struct ContactHandle {
  ContactForce force;
  std::string rod, obstacle;
};

/// A box, sphere, cylinder or half-space in its own axes.
struct SolidValue {
  Solid solid;
};

/// A picture to be: what it shows, by what colours.
struct View;

template <> inline constexpr const char* class_name<Material> = "material";
template <> inline constexpr const char* class_name<Section> = "section";
template <> inline constexpr const char* class_name<Rod> = "rod";
template <> inline constexpr const char* class_name<Curve> = "curve";
template <> inline constexpr const char* class_name<Scene> = "scene";
template <> inline constexpr const char* class_name<SolidValue> = "solid";
template <> inline constexpr const char* class_name<PlacedRodHandle> = "placed_rod";
template <> inline constexpr const char* class_name<PlacedBranchHandle> = "placed_branch";
template <> inline constexpr const char* class_name<PlacedRobotHandle> = "placed_robot";
template <> inline constexpr const char* class_name<SceneEquilibrium> = "equilibrium";
template <> inline constexpr const char* class_name<SceneMotion> = "motion";
template <> inline constexpr const char* class_name<SampledMotion> = "sampled_motion";
template <> inline constexpr const char* class_name<SceneSnap> = "snap_through";
template <> inline constexpr const char* class_name<SolvedBranch> = "solved_branch";
template <> inline constexpr const char* class_name<Reaction> = "support";
template <> inline constexpr const char* class_name<SolvedRodHandle> = "solved_rod";
template <> inline constexpr const char* class_name<Energy> = "energy";
template <> inline constexpr const char* class_name<ClearanceValue> = "clearance";
template <> inline constexpr const char* class_name<ErrorValue> = "error_estimate";
template <> inline constexpr const char* class_name<ContactHandle> = "contact";
template <> inline constexpr const char* class_name<SceneGradient> = "gradient";
template <> inline constexpr const char* class_name<Explanation> = "explanation";
template <> inline constexpr const char* class_name<ExplainedItem> = "explained_item";
template <> inline constexpr const char* class_name<View> = "view";
template <> inline constexpr const char* class_name<Chart> = "chart";
template <> inline constexpr const char* class_name<ChartSheet> = "sheet";
template <> inline constexpr const char* class_name<Accuracy> = "accuracy";
template <> inline constexpr const char* class_name<AccuracyRow> = "accuracy_row";

}  // namespace tendril::lua
