// How far the rods of a dress pack are from its bodies, and whether a motion can have brought one through the other.
//
// A distance that was found once holds good, less what the point has moved in the body's axes since: most pairs of a piece of rod
// and a body cost one comparison. Points lie on the rods' centre lines, at nodes and between, at most a radius apart.
#pragma once

#include <limits>
#include <span>

#include "method/dress_pack/pack_bodies.h"
#include "statics/contact_points.h"
#include "statics/equilibrium.h"
#include "statics/rod_network.h"

namespace tendril::dress_pack {

/// Where the points and the bodies are at one configuration.
struct PackPlaces {
  std::vector<Vec3> points;
  std::vector<Vec3> middles;     ///< of segments,
  std::vector<double> halves;    ///< whose points are no farther from there than this, m
  std::vector<BodyPose> bodies;
};

class PackGaps {
 public:
  /// The bodies must outlive this.
  PackGaps(const PackBodies& bodies, const RodNetwork& network, Compared what);
  /// For a solution whose segments have other lengths than the problem's, as where rods slide through holds.
  PackGaps(const PackBodies& bodies, const SystemEquilibrium& equilibrium, Compared what);

  int points() const { return static_cast<int>(points_.size()); }
  const ContactPoint& point(int p) const { return points_[p]; }
  int rod_of(int p) const { return rod_of_[p]; }
  int first_node(int rod) const { return rods_[rod].first_node; }
  int first_node_at(int p) const { return rods_[rod_of_[p]].first_node + points_[p].segment; }  ///< and the next one

  void place(const RodState& state, const JointVector& q, PackPlaces& out) const;

  /// What is known of distances; one for everything that moves little from call to call.
  struct Known {
    Vec3 at = Vec3::Zero();       ///< in the body's axes,
    double distance = -std::numeric_limits<double>::infinity();  ///< is no nearer to the body than this, m
  };
  struct Memory {
    std::vector<Known> segments, points;  ///< by segment or point, and body
  };

  struct Nearest {
    double gap = std::numeric_limits<double>::infinity();  ///< m, between the surfaces; negative: overlap
    int body = -1, point = -1;
    double s = 0;                                          ///< m
  };
  /// The smallest gap of a rod below `limit` (m), also looked for between the points.
  Nearest smallest(int rod, const RodState& state, const PackPlaces& places, double limit, Memory& memory) const;

  /// Between a point and its neighbours: where the parabola through their gaps from a body is lowest, if that is lower.
  struct Lowest {
    ContactPoint point;
    Vec3 at = Vec3::Zero();      ///< m
    BodyDistance found;          ///< in the body's axes
    double gap = 0;              ///< m
  };
  Lowest lowest_at(int point, int body, const RodState& state, const PackPlaces& places) const;

  /// Calls visit(point, body, BodyDistance) for all points with a gap below `limit`.
  template <class Visit>
  void visit_near(const PackPlaces& places, double limit, Memory& memory, Visit visit) const;

  /// A motion straight from one configuration to another, in the bodies' axes. `touch`: gaps below so many radii count as touching.
  struct Watch {
    bool clear = true;
    double move = 0;   ///< radii, the farthest that a point that touches or has passed a surface has moved
  };
  Watch watch(const PackPlaces& before, const PackPlaces& after, double touch, Memory& memory) const;

  /// The largest motion of a point relative to a body, over what it may be: half a radius, and half the gap at the beginning.
  double haste(const PackPlaces& before, const PackPlaces& after, Memory& memory) const;

 private:
  struct Rod {
    int first_node, first_segment, first_point;
    std::vector<double> s, radii;
  };
  struct Segment {
    int rod, first_point, last_point;  ///< last: one past
    double radius;                     ///< m, the largest of its points
  };
  void add_rod(std::vector<double> s, std::vector<double> radii);
  void finish(Compared what);
  int bodies() const { return bodies_.size(); }
  double segment_bound(int g, int b, const Vec3& in_body, double needed, Memory& memory) const;
  double point_bound(int p, int b, const Vec3& in_body, double needed, Memory& memory, BodyDistance* found) const;
  bool segment_stays_clear(int g, int b, const PackPlaces& before, const PackPlaces& after, double margin, Memory& memory) const;

  const PackBodies& bodies_;
  std::vector<Rod> rods_;
  std::vector<Segment> segments_;
  std::vector<ContactPoint> points_;
  std::vector<int> rod_of_;
  std::vector<char> compared_, segment_compared_;  ///< by point or segment, and body
};

template <class Visit>
void PackGaps::visit_near(const PackPlaces& places, double limit, Memory& memory, Visit visit) const {
  memory.segments.resize(segments_.size() * bodies());
  memory.points.resize(points_.size() * bodies());
  for (int b = 0; b < bodies(); ++b)
    for (int g = 0; g < static_cast<int>(segments_.size()); ++g) {
      if (!segment_compared_[g * bodies() + b]) continue;
      const Segment& segment = segments_[g];
      const double needed = limit + segment.radius + places.halves[g];
      if (segment_bound(g, b, places.bodies[b].to_body(places.middles[g]), needed, memory) >= needed) continue;
      for (int p = segment.first_point; p < segment.last_point; ++p) {
        if (!compared_[p * bodies() + b]) continue;
        BodyDistance found{0, {}, false};
        const double reach = limit + points_[p].radius;
        if (point_bound(p, b, places.bodies[b].to_body(places.points[p]), reach, memory, &found) < reach) visit(p, b, found);
      }
    }
}

}  // namespace tendril::dress_pack
