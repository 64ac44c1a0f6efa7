// The true shape of a connector against the surroundings, while it moves with its rod's end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/assembly/options.h"
#include "statics/equilibrium.h"

namespace tendril::assembly {

/// A rigid body on a rod's end section. It is drawn in by a slack first, so that what rubs along a surface does not hit it.
class ConnectorBody {
 public:
  struct Hit {
    double share;   ///< of the way from the first pose to the second
    Vec3 at;        ///< m, on the connector
    int obstacle;
  };

  /// Throws UsageError for a body without size or shape. `rod`: its number among the system's; `slack`: m.
  ConnectorBody(const Connector& connector, int rod, double slack);

  const std::string& name() const { return name_; }
  int rod() const { return rod_; }
  bool at_start() const { return at_start_; }
  double reach() const { return reach_; }  ///< m, from the section's centre to the farthest point
  double wide() const { return wide_; }    ///< m, from the rod's axis to the farthest point
  bool is_plugged_in() const { return !plugged_.empty(); }
  double behind() const { return behind_; }  ///< m of rod that it covers

  Frame pose(const SystemEquilibrium& state) const;

  /// How far it must be withdrawn straight along its rod to be clear of what it is plugged into, its own length at most; m.
  double socket_depth(const Surroundings& surroundings, const Frame& routed) const;

  /// It may overlap what it overlaps here, where it is plugged in, as long as it is near this pose.
  void plugged_in(const Surroundings& surroundings, const Frame& routed);

  /// Conservative advancement: a way is free where the gap at its middle is larger than half of how far any point goes, else both
  /// halves are asked. To half of the slack exact; places move straight, orientations turn evenly.
  std::optional<Hit> sweep(const Surroundings& surroundings, const Frame& from, const Frame& to) const;

 private:
  using Triangle = std::array<Vec3, 3>;
  struct Place {
    const Surroundings& surroundings;
    Frame section;
    double margin;
    bool unplugged;  ///< far from where it is plugged in
  };
  std::optional<Hit> sweep(const Surroundings& surroundings, const Frame& from, const Frame& to, double begin, double end) const;
  std::optional<Hit> near(const Place& place) const;
  std::optional<Hit> near(const Place& place, const Triangle& triangle) const;
  ClosestPoint closest(const Place& place, const Vec3& p, double limit) const;

  std::string name_;
  int rod_;
  bool at_start_;
  double slack_, reach_ = 0, wide_ = 0, behind_ = 0, length_ = 0;
  std::vector<Triangle> triangles_;  ///< in the section's axes, m
  std::vector<int> plugged_;         ///< obstacles
  Vec3 routed_ = Vec3::Zero();
};

/// What the connectors hit between two states of their system; empty: nothing.
std::string connector_hit(const std::vector<ConnectorBody>& bodies, const Surroundings* surroundings, const SystemEquilibrium& from,
                          const SystemEquilibrium& to);

}  // namespace tendril::assembly
