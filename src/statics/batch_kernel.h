// What the batch solver's inner loop works on: one system of rods whose parameters differ from lane to lane. Plain arrays,
// so that it can be compiled for several instruction sets without touching what the rest of the program is made of.
#pragma once

namespace tendril {

/// One segment between two nodes, in the order of elimination: `child` has no other neighbour left once this segment is in.
struct BatchSegment {
  int child = 0, parent = 0;
  bool reversed = false;               ///< the rod runs from parent to child
  int stiffness = 0;                   ///< offset of its stiffness block in the parameters
  int rates = -1;                      ///< offset of its reference rates; -1: straight
  int start_joint = -1, end_joint = -1;  ///< offset of the section's frame seen from the node; -1: the section is the node
  int start_force = -1, end_force = -1;  ///< offset of a dead force on the section; -1: none
  bool start_slope = false, end_slope = false;  ///< the fourth-order weight term of that end is needed
  int child_slot = 0, parent_slot = 0;          ///< where what is left for the node is gathered
  bool child_fresh = true, parent_fresh = true; ///< nothing has been gathered yet
};

struct BatchNode {
  int held = 0;     ///< 1: position, 2: orientation, 3: both
  int target = -1;  ///< offset of the frame that it is held at
  int held_index = -1;
};

/// Sizes of the blocks in the parameters, in doubles a lane.
struct BatchBlocks {
  static constexpr int stiffness = 10;  ///< h; 1/(GA1, GA2, EA); 1/(EI1, EI2, GJ); weight per length (world axes)
  static constexpr int rates = 9;       ///< reference rates v, phi; slope of phi
  static constexpr int frame = 7;       ///< position; quaternion w, x, y, z
  static constexpr int force = 3;
  static constexpr int wrench = 6;
};

/// The same for all outcomes.
struct BatchStructure {
  const BatchSegment* segments;
  int segment_count;
  const BatchNode* nodes;
  int node_count;
  const int* roots;       ///< the nodes without a parent
  const int* root_slots;
  int root_count;
  double length;          ///< m: moves over this are compared with rotations
  double largest_step;    ///< rad, and share of the length: longer steps are cut to this
};

/// One pack of outcomes: arrays of `lanes` doubles each, 64-byte aligned.
struct BatchLanes {
  double* parameters;
  double* deferred;   ///< 1: the fourth-order correction comes from the predicted wrench; 0: from the actual one
  double* shift;      ///< N: times a segment's length added to the diagonal of its ends' rotations, 0.01 / length^2 of it to positions
  double* frames;     ///< by node: position, quaternion; moved by the step
  double* wrenches;   ///< by segment: predicted n, m at mid-segment; replaced by what the step leads to
  double* reactions;  ///< by held node: gradient (force in world axes, moment in section axes) that the step leads to
  double* size;       ///< of the whole step: the largest of rotation (rad) and move over `length`
  double* positive;   ///< 1: every pivot was positive; 0: not, and the lane has stayed where it was
  double* scratch;    ///< scratch_size() numbers a lane
};

/// One Newton iteration of all lanes. What a lane gets does not depend on the others.
struct BatchKernel {
  const char* name;
  int lanes;
  void (*iterate)(const BatchStructure&, const BatchLanes&);
  int (*scratch_size)(const BatchStructure&, int held_count, int slots);  ///< doubles a lane
};

enum class InstructionSet { common, avx2, avx512 };

/// Null where this processor, or this program, does not have it. `common`: always there.
const BatchKernel* batch_kernel(InstructionSet set);

/// The fastest that this processor has. TENDRIL_BATCH=common|avx2|avx512 asks for a certain one.
const BatchKernel& best_batch_kernel();

}  // namespace tendril
