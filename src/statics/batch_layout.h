// How a system of rods becomes arrays for the batch solver: its nodes and segments in the order of elimination, and where
// each number of a problem goes. Built once from the nominal problem; every outcome of the same structure is then read
// straight into its lane.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "statics/batch_kernel.h"
#include "statics/problem.h"

namespace tendril {

class BatchLayout {
 public:
  /// The nominal problem must be one that batches know: see why_not().
  explicit BatchLayout(const SystemProblem& nominal);

  /// Empty, or why this problem is not one for batches.
  static std::string why_not(const SystemProblem& problem, const SolveOptions& options);

  BatchStructure structure() const;
  int parameter_count() const { return parameters_; }
  int node_count() const { return static_cast<int>(nodes_.size()); }
  int segment_count() const { return static_cast<int>(segments_.size()); }
  int held_count() const { return held_; }
  int slot_count() const { return slots_; }
  double bending_scale() const { return bending_scale_; }          ///< smallest EI / L^2, N
  double stretch_stiffness() const { return stretch_stiffness_; }  ///< h^2 EA/(12 EI), the largest

  /// An outcome's numbers, parameter_count() of them. False where its structure differs from the nominal one's or a number
  /// makes no sense.
  bool read(const SystemProblem& problem, double* parameters) const;

  /// Frames of the nodes, 7 numbers each, from the rods' vertices and the branch points.
  std::vector<double> node_frames(const std::vector<std::vector<Frame>>& vertices,
                                  const std::vector<Frame>& branches) const;

  /// What may vary, for derivatives: plain numbers, and rotations of frames by axis.
  struct Number {
    int offset;    ///< of the number, or of the quaternion
    int axis;      ///< 0-2: a rotation about that axis of the frame; -1: a plain number
    double scale;  ///< what is usual for it
  };
  std::vector<Number> numbers() const;

  // What is where.
  int rods() const { return static_cast<int>(rods_.size()); }
  int vertices(int rod) const { return static_cast<int>(rods_[rod].vertices.size()); }
  int branch_node(int branch) const { return branch; }
  struct Vertex {
    int node, joint;  ///< joint: offset of the section's frame seen from the node, -1: the section is the node
  };
  Vertex vertex(int rod, int index) const { return rods_[rod].vertices[index]; }
  int hold_vertex(int rod, int hold) const { return rods_[rod].hold_vertex[hold]; }
  const BatchNode& node(int index) const { return nodes_[index]; }
  /// Where the numbers of a rod's segment stand among the parameters: its length, six flexibilities and weight (m, 1/(GA1, GA2,
  /// EA, EI1, EI2, GJ), N/m in world axes), and its reference rates; -1: straight.
  struct SegmentPlace {
    int stiffness, rates;
  };
  std::vector<SegmentPlace> segment_places(int rod) const;
  /// Arc length of a rod's vertex in an outcome with these parameters, m.
  std::vector<double> arc_lengths(int rod, const double* parameters) const;

 private:
  /// Where an interval of equal segments begins or ends: one of the rod's places.
  struct Interval {
    int count;        ///< segments
    int stiffness;    ///< offset
    int rates;        ///< offset of the first segment's, -1: straight
  };
  struct RodPlan {
    std::vector<int> boundary_of_place;  ///< by place, see places_of()
    std::vector<Interval> intervals;
    std::vector<Vertex> vertices;
    std::vector<int> hold_vertex;
    std::vector<int> load_offset;        ///< by load: of its force
    std::vector<int> joint_branch, joint_section;  ///< the sections of branch points that are on this rod
  };

  void plan_rod(const SystemProblem& problem, int rod);
  void plan_segments(const SystemProblem& problem);
  void plan_holds(const SystemProblem& problem);
  void order(const std::vector<BatchSegment>& links);
  bool same_structure(const SystemProblem& problem) const;
  bool read_rod(const SystemProblem& problem, int rod, double* to, std::vector<double>& places) const;
  bool read_intervals(const RodProblem& problem, const RodPlan& plan, const std::vector<double>& boundaries,
                      double* to) const;
  void read_holds(const SystemProblem& problem, double* to) const;

  SystemProblem nominal_;
  std::vector<RodPlan> rods_;
  std::vector<BatchNode> nodes_;
  std::vector<BatchSegment> segments_;
  std::vector<int> roots_, root_slots_;
  std::vector<int> unit_quaternions_;  ///< offsets
  int parameters_ = 0, held_ = 0, slots_ = 0;
  double length_ = 0, stretch_stiffness_ = 0, bending_scale_ = std::numeric_limits<double>::infinity();
};

}  // namespace tendril
