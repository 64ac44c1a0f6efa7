// The rods of a dress pack at one time step in mixed form: the functional of direct_segment.h, loads included, with its first and
// second derivatives by plain numbers.
//
// The numbers of a step: six for each node, its position in world axes (m) and the rotation vector e (rad) that has turned it from a
// reference, R = R0 exp([e]); then six for each segment, its wrench (N, N m). Rotations may come as far as one full turn.
#pragma once

#include <vector>

#include "method/dress_pack/direct_segment.h"
#include "method/dress_pack/pack_cost.h"

namespace tendril::dress_pack {

/// Beyond it (rad) rotation vectors are not used: at a full turn they lose their meaning.
inline constexpr double largest_rotation_vector = 6;

/// Of R0 exp([e]): what de is in increments of the section's own axes; and its transposed inverse.
Mat3 rotation_rate(const Vec3& e);
Mat3 inverse_rotation_rate(const Vec3& e);

/// A function of a step's numbers: gradient, and second derivative by blocks.
struct StepTerms {
  double value = 0;
  Eigen::VectorXd gradient;
  std::vector<Mat6> node;     ///< by node
  std::vector<Mat6> link;     ///< by segment: rows its first node, columns its second
  std::vector<Mat6> near, far;  ///< by segment: rows its first, second node, columns its wrench
  std::vector<Mat6> wrench;   ///< by segment
};

class MixedRods {
 public:
  explicit MixedRods(const PackStatics& statics, const PackDemands& demands);

  int nodes() const { return nodes_; }
  int segments() const { return static_cast<int>(segments_.size()); }
  int size() const { return 6 * (nodes_ + segments()); }
  int wrench_at(int segment) const { return 6 * (nodes_ + segment); }

  /// The numbers of a state: no rotation from it, and its true wrenches.
  Eigen::VectorXd numbers_of(const RodState& state) const;

  enum class Part { functional, shape };
  /// Of the functional, or of what PackCost adds for twist and curvature. `second` false: without second derivatives. False where
  /// a rotation vector is too long.
  bool terms(const RodState& reference, const Eigen::Ref<const Eigen::VectorXd>& numbers, Part part, bool second, StepTerms& out);

  /// visit(i, j, value) for every number of the second derivative's pattern, once for (i, j) and (j, i). `value` is 0 without terms.
  template <class Visit>
  void each_pair(const StepTerms* terms, Visit visit) const;

 private:
  struct Segment {
    int node, rod;
    MixedSegment mixed;
    double length, share, rest_twist;  ///< m, of its rod's length, rad/m
  };
  struct Turned {
    Quat q;
    Vec3 e;
    Mat3 rate;
  };
  void add_segments(const Eigen::Ref<const Eigen::VectorXd>& numbers, Part part, bool second, StepTerms& out);
  void add_shape(const Segment& segment, const SegmentMotion& motion, bool second, MixedTerms& out) const;
  void add_loads(bool second, StepTerms& out);
  void to_rotation_vectors(bool second, StepTerms& out) const;

  const RodNetwork& network_;
  PackDemands demands_;
  int nodes_;
  std::vector<Segment> segments_;
  RodState state_;
  std::vector<Turned> turned_;
  std::vector<Vec6> load_gradient_;
  std::vector<Mat6> load_diagonal_;
};

template <class Visit>
void MixedRods::each_pair(const StepTerms* terms, Visit visit) const {
  const auto block = [&](const std::vector<Mat6> StepTerms::*list, int k, int row, int column) {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < (row == column ? j + 1 : 6); ++i) visit(row + i, column + j, terms ? (terms->*list)[k](i, j) : 0.0);
  };
  for (int i = 0; i < nodes_; ++i) block(&StepTerms::node, i, 6 * i, 6 * i);
  for (int k = 0; k < segments(); ++k) {
    const int a = 6 * segments_[k].node, w = wrench_at(k);
    block(&StepTerms::link, k, a, a + 6);
    block(&StepTerms::near, k, a, w);
    block(&StepTerms::far, k, a + 6, w);
    block(&StepTerms::wrench, k, w, w);
  }
}

}  // namespace tendril::dress_pack
