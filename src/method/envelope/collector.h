// From a scene's rods to the outcomes of an envelope: block by block, as they come.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "method/envelope/outcomes.h"
#include "scene/scene_equilibrium.h"

namespace tendril {

class EnvelopeCollector {
 public:
  /// For the rods of `nominal`, with its meshes and sections. `voxel` (m): chords stay within a twentieth of it of the centre
  /// line, so that what is added for the bulge is small beside the grid's own margin.
  EnvelopeCollector(const SceneEquilibrium& nominal, double voxel, EnvelopeOutcomes::Keep keep);

  /// By rod: frames of its vertices, seven numbers each. Throws UsageError as EnvelopeOutcomes::add_frames does.
  Status add(std::span<const std::span<const double>> frames, const RunContext& context);
  /// An equilibrium of the same rods on the same meshes.
  Status add(const SceneEquilibrium& outcome, const RunContext& context);
  /// Adds what is left. Everything is in outcomes() then, unless stopped.
  Status finish(const RunContext& context);

  const EnvelopeOutcomes& outcomes() const { return outcomes_; }

 private:
  EnvelopeOutcomes outcomes_;
  std::vector<std::vector<double>> waiting_;  ///< by rod: frames of the outcomes of a block, one after the other
  int count_ = 0;
};

/// The space that rods sweep from state to state, straight between neighbouring ones: each of these ways has pieces of its own, so
/// that what lies between two ways is not filled. At least one state; all of the same rods on the same meshes.
EnvelopeOutcomes swept_space(std::span<const std::shared_ptr<SceneEquilibrium>> states, double voxel, const RunContext& context, Status& status);

}  // namespace tendril
