// The discrete energy of one rod as Newton's method sees it: nodes with a position and a rotation each, which unknowns are
// held, and the energy, gradient and second derivative. One implementation per element.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "statics/block_system.h"
#include "statics/equilibrium.h"
#include "statics/rod_mesh.h"

namespace tendril {

/// Position (m) and rotation of every node.
struct RodState {
  std::vector<Vec3> r;
  std::vector<Quat> q;

  /// r <- r + share dr, R <- R exp(share theta).
  void apply(const std::vector<Vec6>& step, double share);
};

/// The nodes of one rod within the state of a network, counted from the rod's first one.
struct StateView {
  const Vec3* r;
  const Quat* q;

  StateView(const RodState& state, int first = 0)  // NOLINT: a whole state is a view of its only rod
      : r(state.r.data() + first), q(state.q.data() + first) {}
};

/// Which wrench the geometric terms of the second derivative use: none, the predicted one, or the actual one. `rough` is
/// the predicted one far from the solution: the element then leaves out its fourth-order correction, whose softer shear
/// would let a wrong wrench make the matrix indefinite.
///
/// `deferred`: as rough, but with that correction taken from the predicted wrench: what is solved is then right to fourth
/// order while the actual wrench is still false.
enum class Stress { zero, rough, deferred, predicted, actual };

/// Held unknowns of a node, one bit each in the order of block_system.h.
using HeldMask = std::uint8_t;
inline constexpr HeldMask held_position = 0b000111, held_rotation = 0b111000, held_all = 0b111111;

class RodSystem {
 public:
  RodSystem(const RodProblem& problem, RodMesh mesh);
  virtual ~RodSystem() = default;

  const RodMesh& mesh() const { return mesh_; }
  const RodProblem& problem() const { return problem_; }
  int nodes() const { return nodes_; }
  double length() const { return problem_.rod.length; }
  /// Shift, in bending_scale(), that lifts a neutral direction above rounding: 1e-3, more for a very stiff stretch.
  double neutral_shift() const { return neutral_shift_; }
  double bending_scale() const { return bending_scale_; }  ///< smallest EI / L^2, N
  const std::vector<HeldMask>& held() const { return held_; }
  /// Where the held nodes belong.
  struct Target {
    int node;
    HeldMask mask;
    Frame frame;
  };
  const std::vector<Target>& targets() const { return targets_; }
  const std::vector<double>& node_length() const { return node_length_; }  ///< m of rod that a node stands for
  bool has_moments() const { return !moments_.empty(); }

  /// Nodes from vertex frames (the first guess or another solution); and back.
  virtual RodState state_from(const std::vector<Frame>& vertices) const = 0;
  virtual std::vector<Frame> frames_of(StateView state) const = 0;

  /// The nodes that carry position and rotation of the section at a vertex. Throws UsageError where the element has no such
  /// nodes: the staggered one has rotations between the vertices, and at the ends.
  struct SectionNodes {
    int position, rotation;
  };
  virtual SectionNodes section_at(int vertex) const = 0;

  /// Takes up the problem's springs; called once, when the rod is complete. Throws UsageError as section_at() does.
  void place_springs();

  /// Overwrites its part of the system. Held unknowns are not yet taken out. Returns the energy.
  double assemble(StateView state, Stress stress, BlockView system);

  /// Energy and gradient alone.
  double gradient(StateView state, Vec6* gradient);

  /// After assemble(): the wrench that the whole linearised step leads to becomes the predicted one. It balances the
  /// loads in world axes, so it is turned back by what the sections really turn, `share` of the step's rotations.
  virtual void predict(const Vec6* step, double share) = 0;

  /// Dead moments times `share`, for loading in steps.
  void scale_moments(double share);

  /// After assemble() with a predicted wrench: how far the actual force is from it, n h^2/(12 EI), the largest over
  /// segments. Large while bent segments look stretched; the fourth-order correction is quadratic in it.
  virtual double false_stress() const { return 0; }

  /// Takes another solution's internal forces (world axes) and moments (section axes at mid-segment), one a segment, for
  /// the predicted wrench. Elements that need no such help ignore it.
  virtual void expect(StateView, const std::vector<Vec3>& /*forces*/, const std::vector<Vec3>& /*moments*/) {}

  /// Stretch against bending over one segment: h^2 EA/(12 EI), the largest. What a false stretch strain is multiplied by.
  double stretch_stiffness() const { return stretch_stiffness_; }

  /// Stiffness EA and GA no larger than this (N); infinity: the true ones.
  virtual void cap_stretch_stiffness(double limit) = 0;

  /// Fills energies, forces, strains, curvatures and moments of a solution.
  virtual void describe(StateView state, Equilibrium& out) = 0;

  /// Adds what hold k exerts on the rod (world axes), from the gradient of all terms.
  virtual void add_reaction(int hold, StateView state, const Vec6* gradient, Reaction& out) const = 0;

  /// Adds what is not of the elements: -w.r and -F.r summed over nodes, the end terms of the fourth-order gravity rule, springs;
  /// null `diagonal`: the gradient alone. Returns the energy.
  double add_loads(StateView state, Vec6* gradient, Mat6* diagonal) const;

  /// Antisymmetric part of the second derivative: node and R^T m of every dead moment.
  struct MomentTerm {
    int node;
    Vec3 body_moment;
  };
  std::vector<MomentTerm> moment_terms(StateView state) const;

 protected:
  virtual double assemble_elements(StateView state, Stress stress, BlockView system) = 0;
  virtual double element_gradient(StateView state, Vec6* gradient) = 0;

  double add_springs(StateView state, Vec6* gradient, Mat6* diagonal) const;
  double spring_energy(StateView state) const;

  void describe_loads(StateView state, Energy& energy) const;

  RodProblem problem_;
  RodMesh mesh_;
  int nodes_ = 0;
  double bending_scale_ = 0;
  double neutral_shift_ = 0;
  double stretch_stiffness_ = 0;
  std::vector<HeldMask> held_;
  std::vector<Target> targets_;
  std::vector<double> node_length_;
  std::vector<Vec3> weight_;        ///< per node, N; empty without gravity
  std::vector<Vec3> weight_slope_;  ///< per node, N m: energy weight_slope . R e3; empty: no such term
  struct Force {
    int node;
    Vec3 force;
  };
  struct Moment {
    int node;
    Vec3 moment;
  };
  std::vector<Force> forces_;
  std::vector<Moment> moments_;
  struct Spring {
    SectionNodes nodes;
    Frame frame;
    double position, rotation;
  };
  std::vector<Spring> springs_;
  double moment_share_ = 1;
};

/// The system of the problem's rod with the element and clamp rule of the options.
std::unique_ptr<RodSystem> make_rod_system(const RodProblem& problem, const SolveOptions& options, RodMesh mesh);

}  // namespace tendril
