// Tolerance envelopes: a watertight mesh around where rods are in many outcomes.
//
// Each straight piece of a rod sweeps, over all outcomes, less than the convex hull of its places; the envelope is the
// union of these hulls, rounded by the rod's radius, as a surface on a grid of voxels. It contains the surface of every
// outcome: the chain of capsules about the centre line's chords at the rod's radius, with what the curved centre line
// can bulge from them. Steps, a file each:
//   supports        extent of every node's places in 128 directions
//   hulls           convex hull of each piece's places; planes moved out by radius and margin   [hulls, cloud_hull]
//   blocks          which hulls pass through which block of 7^3 cells
//   field           the lowest of the hulls' fields at the nodes
//   cavities        filled: only the outer boundary is kept
//   marching_cubes  the surface, after Lorensen and Cline, SIGGRAPH 1987, with cases that neighbours agree on
// The margin: a point x of a ball of radius r around a centre point has field values of at most |v - c| - r - margin at
// the nodes v around it, and their mean weighted by any convex combination that yields x is at most
// sqrt(r^2 + 3/4 h^2) - r - margin. With the margin equal to that root less r, linear interpolation loses no point of any
// outcome. For cells cut by marching cubes this is not a proof; tests sample millions of points.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/mesh.h"
#include "method/envelope/outcomes.h"

namespace tendril {

struct EnvelopeOptions {
  double voxel = 2e-3;  ///< m: grid step; at most the radius of the thinnest rod
  double share = 1;     ///< above 0 to 1: of the outcomes that are contained entirely
  double memory = 2e9;  ///< bytes that blocks and mesh may take: more is refused
};

struct Envelope {
  Status status = Status::solved;  ///< solved, cancelled or timeout; without a mesh unless solved
  /// Closed, manifold, normals outward; parts that do not touch each other are parts of one mesh.
  Mesh mesh;
  double volume = 0;      ///< m^3
  double voxel = 0;       ///< m
  double margin = 0;      ///< m: largest of what was added to the radii so that the grid loses nothing
  double sagitta = 0;     ///< m: largest bulge of a centre line from its chords, added too
  int outcomes = 0;       ///< contained
  std::vector<int> left_out;  ///< outcomes that are not, counted from 0 in the order of adding; for a share below 1
  int hulls = 0, planes = 0, blocks = 0, cavities = 0;
  std::size_t scratch_bytes = 0;  ///< of the builder, beside the outcomes and the mesh
  struct Step {
    std::string name;
    double seconds;
  };
  std::vector<Step> steps;
  double seconds = 0;
};

/// Builds envelopes; keeps its memory, so that the second one of a size costs no page faults.
class EnvelopeBuilder {
 public:
  EnvelopeBuilder();
  ~EnvelopeBuilder();
  EnvelopeBuilder(EnvelopeBuilder&&) noexcept;
  EnvelopeBuilder& operator=(EnvelopeBuilder&&) noexcept;

  /// The same bits for any number of threads and any instruction set with fused multiply-add. Throws UsageError without
  /// outcomes, for a voxel that is not positive or larger than the thinnest rod's radius, a share outside 0 ... 1, a
  /// share below 1 of outcomes that were not all kept, and a size beyond the memory allowed.
  Envelope build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options = {}, const RunContext& context = {});
  /// The same into an envelope whose memory is used again.
  void build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options, const RunContext& context, Envelope& result);

  /// A kernel other than the fastest one: for tests.
  void use(const envelope::Kernel& kernel);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace tendril
