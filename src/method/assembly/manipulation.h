// A manipulation of a system of rods: what is gripped, and where each grip is over a common time (thesis 3.4).
#pragma once

#include <string>
#include <vector>

#include "base/frame.h"

namespace tendril::assembly {

/// Where a hand or a jig holds the system: a section of a rod, or a branch point.
struct Grip {
  std::string name;   ///< "hose.start", "handle", "junction 1"
  int rod = -1;       ///< of the system's rods; or
  int branch = -1;    ///< of its branch points
  double at = 0;      ///< arc length, m; of no meaning for a branch point
  bool connection = false;  ///< it is held in the routed configuration; the others let go at the end
};

/// How far a grip goes between two poses: distance plus 0.05 m a radian.
double travel(const Frame& a, const Frame& b);

/// Poses of all grips at rising times from 0 to 1; between them places move straight and orientations turn evenly.
struct Manipulation {
  std::vector<Grip> grips;
  std::vector<double> times;
  std::vector<std::vector<Frame>> poses;  ///< by grip, then by time

  Frame pose(int grip, double t) const;
  /// The way of whichever grip travels farthest at each time, summed between two times; m.
  double moved(double from, double to) const;
  Manipulation reversed() const;
  /// The time from which a grip is at rest until the end; 1 where it moves to the last.
  double rests_from(int grip) const;
  /// Hands that it takes at a time: a connection that is at rest until the end is plugged in and needs none, all others do, the
  /// last of them until t = 1.
  int hands(double t) const;
};

/// Manipulation::moved() for many pairs of times.
class Travelled {
 public:
  explicit Travelled(const Manipulation& manipulation);
  double operator()(double from, double to) const { return until(to) - until(from); }

 private:
  double until(double t) const;
  std::vector<double> times_, ways_;  // up to each time
};

}  // namespace tendril::assembly
