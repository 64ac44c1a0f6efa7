// The system of rods as it is installed: its problem without any hold, its connections, its routed equilibrium.
#pragma once

#include <string>
#include <vector>

#include "method/assembly/connector_body.h"
#include "method/assembly/manipulation.h"
#include "scene/scene.h"

namespace tendril::assembly {

struct InstalledSystem {
  /// Nothing is held; surroundings and gravity act. Every place that may be gripped is a vertex (a spring without stiffness), so
  /// that all states of the system are on one mesh.
  SystemProblem free;
  std::vector<std::string> rods, branches;   ///< names
  std::vector<Grip> connections;             ///< what holds it as routed
  std::vector<Frame> connected;              ///< their poses
  std::vector<Grip> extra;                   ///< further places that may be gripped: handles and supplementary grips
  SystemEquilibrium routed;
  double radius = 0;                         ///< m, of the thickest rod
  std::vector<ConnectorBody> connectors;     ///< their true shapes; in statics they are thicker, stiffer ends of their rods
  std::vector<double> thickened;             ///< m, how much of its rod each connector makes thicker
  std::shared_ptr<const Surroundings> surroundings;  ///< null: none

  Vec3 gravity() const { return free.rods.front().gravity; }
  Frame pose(const SystemEquilibrium& state, const Grip& grip) const;
  /// Longest way along the rods from a grip to any end; m.
  double arm(const Grip& grip) const;
};

/// The one system that has all rods named (empty: all of the scene). Throws UsageError, in the name of `who`, for a scene without
/// rods, unknown names and rods that do not hang together.
Scene::System system_of(const Scene& scene, const std::vector<std::string>& rods, const std::string& who);

/// The rods asked for (Options::rods, connectors, routed, solve), with `between` further places for grips on each rod beside its
/// middle. Throws UsageError where the rods do not hang together or nothing holds them, and for connectors that make no sense.
InstalledSystem installed_system(const Scene& scene, const Options& options, int between, const RunContext& context = {});

/// The system held by these grips in these poses; place() gives them others.
SystemProblem held_by(const SystemProblem& free, const std::vector<Grip>& grips, const std::vector<Frame>& poses);
void place(SystemProblem& problem, const std::vector<Grip>& grips, const std::vector<Frame>& poses);
void set_gravity(SystemProblem& problem, const Vec3& gravity);

}  // namespace tendril::assembly
