// Where rods are in many outcomes: what an envelope is built from.
//
// Outcomes come one by one or by blocks, in any number. A node of a rod keeps the places of at most a few thousand
// outcomes; when it is full, they are reduced to the corners of their convex hull (within a thousandth of the thinnest
// rod's radius, which the envelope's margin then includes). Memory: 12 bytes a node and place kept. Only an envelope of a
// share of the outcomes needs all places, 12 bytes a node and outcome.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/run_context.h"
#include "method/envelope/cloud_hull.h"
#include "method/envelope/kernel.h"
#include "statics/batch.h"

namespace tendril {

/// One rod as envelopes see it.
struct EnvelopeRod {
  std::vector<double> radii;  ///< m, one a segment: a rod of n segments has n + 1 vertices
  int pieces = 1;             ///< chords in place of a segment's arc, for outcomes given by frames; see arc_pieces
};

/// How many chords a segment of these frames needs so that each stays within `sagitta` (m) of the centre line, at most
/// 64. `frames`: seven numbers a vertex, position (m) and unit quaternion w, x, y, z.
int arc_pieces(std::span<const double> frames, double sagitta);

class EnvelopeOutcomes {
 public:
  enum class Keep {
    hull,  ///< what the envelope of all outcomes needs
    all    ///< every place: needed for a share of the outcomes
  };
  /// Throws UsageError for no rods, a rod without segments, a radius that is not finite and positive, pieces outside
  /// 1 ... 64. `room`: places that a node keeps before they are reduced, at least 64.
  explicit EnvelopeOutcomes(std::vector<EnvelopeRod> rods, Keep keep = Keep::hull, int room = 2048);

  /// The numbers of one rod in one outcome; called from several threads at once, at least once for every outcome and rod.
  using Numbers = std::function<std::span<const double>(int outcome, int rod)>;

  /// Adds outcomes 0 ... outcomes - 1 given by the frames of their vertices: seven numbers a vertex, position (m) and unit
  /// quaternion w, x, y, z. Between vertices the centre line is the arc of an SE(3) element: it is cut into the rod's
  /// `pieces`, and how far it can bulge from a chord is added to the radius there. Throws UsageError naming outcome, rod
  /// and vertex for numbers that are not finite or beyond Mesh::largest_coordinate; then none of the block is added.
  /// Not all are added when stopped: those that are stay.
  Status add_frames(int outcomes, const Numbers& frames, const RunContext& context = {});
  /// The same by three numbers a vertex (m), for rods that are chains of straight segments.
  Status add_points(int outcomes, const Numbers& points, const RunContext& context = {});
  /// All outcomes of a batch that are solved. Returns how many those are in `added`.
  Status add(const BatchResults& batch, int* added = nullptr, const RunContext& context = {});

  int size() const { return size_; }  ///< outcomes added
  Keep keep() const { return keep_; }
  /// Some of the outcomes, by their numbers in increasing order; all must have been kept.
  EnvelopeOutcomes only(std::span<const int> kept) const;
  void clear();  ///< forgets the outcomes and keeps the memory

  std::size_t bytes() const { return 3 * stride() * count_.size() * sizeof(float); }  ///< of the places

  // What building reads.

  /// The straight piece between two neighbouring nodes.
  struct Chord {
    int node;        ///< its first; the other one is the next
    double radius;   ///< m
    double sagitta;  ///< m: how far the centre line can lie from the chord, the largest of all outcomes
  };
  int nodes() const { return static_cast<int>(count_.size()); }
  const std::vector<EnvelopeRod>& rods() const { return rods_; }
  std::vector<Chord> chords() const;
  const Vec3& origin() const { return origin_; }  ///< of the places, m in world axes
  /// The places of a node, filled up to a multiple of 16 by its first.
  envelope::PointArrays places(int node) const;
  int place_count(int node) const { return count_[node]; }
  double reduction() const { return reduced_ ? reduction_tolerance() : 0; }  ///< m: how far places may lie outside those kept

 private:
  enum class Kind { points = 3, frames = 7 };
  Status append(int outcomes, const Numbers& numbers, Kind kind, const RunContext& context);
  void append_block(int first, int count, const Numbers& numbers, Kind kind, const RunContext& context);
  void append_rod(int outcome, int column, int rod, std::span<const double> numbers, Kind kind, double* sagitta);
  void set_origin(const Numbers& numbers, Kind kind);
  int make_room(int wanted, const RunContext& context);
  void grow(int capacity);
  void reduce(const RunContext& context);
  double reduction_tolerance() const { return 1e-3 * thinnest_; }
  std::size_t stride() const { return capacity_ + 16; }  // not a power of two: columns then share no cache sets
  float* row(int node, int axis) { return places_.get() + (3 * static_cast<std::size_t>(node) + axis) * stride(); }
  const float* row(int node, int axis) const { return const_cast<EnvelopeOutcomes*>(this)->row(node, axis); }

  std::vector<EnvelopeRod> rods_;
  Keep keep_;
  int room_;
  double thinnest_ = 0;
  std::vector<int> first_node_, first_segment_;  ///< by rod
  std::vector<double> sagitta_;                  ///< by segment, m
  int size_ = 0, capacity_ = 0;
  bool reduced_ = false;
  Vec3 origin_ = Vec3::Zero();
  std::unique_ptr<float[]> places_;  ///< by node and axis, `stride` each; not touched before it is used
  std::vector<int> count_, settled_; ///< by node: places kept, and of these the corners that stay
};

}  // namespace tendril
