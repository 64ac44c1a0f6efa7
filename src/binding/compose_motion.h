// Pictures of a motion: a strip of key frames, the space that rods sweep, and the frames of an animation. Knows no Lua and draws
// nothing.
#pragma once

#include "binding/compose_picture.h"
#include "scene/scene_motion.h"

namespace tendril {

/// One state of a motion.
struct MotionFrame {
  double t = 0;
  std::shared_ptr<const SceneEquilibrium> equilibrium;
};

/// So many states, evenly spaced, the first and the last among them; all where there are fewer. Throws UsageError for a motion
/// without states and fewer than one.
std::vector<MotionFrame> key_frames(const SceneMotion& motion, int count);

/// One picture a state, all through the same cameras and by the same colours. `wish.fit` holds for all states together; default: the
/// rods and the robots that carry them. Throws UsageError for no frames.
std::vector<Picture> compose_frames(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish);

/// The states side by side, each in one view (the first of `wish.views` that is not the card), with its time.
Picture compose_strip(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish);

/// The last state with `wish.envelope` as a veil around what the rods sweep; the robot at the first, pale, and the rods at the states
/// between, from pale to full colour.
Picture compose_sweep(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish);

}  // namespace tendril
