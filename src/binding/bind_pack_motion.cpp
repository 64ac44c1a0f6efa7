// Motions of dress packs: what the rods bear over time, states, joints.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/pack_motion.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

using dress_pack::JointVector;
using dress_pack::PackMotion;
using dress_pack::PackStep;

/// The state of the rods at the time step nearest to t.
std::shared_ptr<SceneEquilibrium> frame_at(const PackMotionHandle& h, double t) {
  const std::vector<PackStep>& steps = h.motion->steps;
  if (steps.empty()) throw UsageError("pack_motion:frame: there is no state: " + h.motion->message);
  if (!(t >= 0 && t <= 1)) throw UsageError("pack_motion:frame: got t = " + number_text(t) + ", expected 0 to 1");
  const auto near = std::min_element(steps.begin(), steps.end(), [t](const PackStep& a, const PackStep& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
  return dress_pack::scene_states(*h.scene, *h.pack, {*near}).front();
}

namespace {

using Numbers = std::vector<double>;

Numbers joints_at(const PackMotionHandle& h, double t) {
  if (!(t >= 0 && t <= 1)) throw UsageError("pack_motion:joints: got t = " + number_text(t) + ", expected 0 to 1");
  const JointVector q = h.path.at(t);
  return {q.data(), q.data() + q.size()};
}

std::shared_ptr<SceneMotion> scene_motion_of(const PackMotionHandle& h, const Options& o) {
  const PackMotion& motion = *h.motion;
  auto out = std::make_shared<SceneMotion>();
  out->status = motion.status;
  out->message = motion.message;
  out->seconds = motion.seconds;
  out->solves = motion.iterations;
  const int wanted = std::min<int>(o.get<int>("states"), static_cast<int>(motion.steps.size()));
  std::vector<PackStep> shown;
  for (int k = 0; k < wanted; ++k) shown.push_back(motion.steps[wanted == 1 ? 0 : k * (motion.steps.size() - 1) / (wanted - 1)]);
  for (const PackStep& step : shown) out->times.push_back(step.t);
  out->equilibria = dress_pack::scene_states(*h.scene, *h.pack, shown);
  for (const dress_pack::PackSnap& snap : motion.snaps)
    out->snaps.push_back({h.pack->problem.rod_name(snap.rod), {snap.t, snap.rod, 0, snap.move, snap.energy_drop}});
  return out;
}

template <class Read>
Numbers over_time(const PackMotionHandle& h, Read read) {
  Numbers out;
  for (const PackStep& step : h.motion->steps) out.push_back(read(step));
  return out;
}

double force_of(const PackStep& step) {
  double most = 0;
  for (const auto& end : step.ends) most = std::max(most, end.force.norm());
  return most;
}

const std::string example =
    std::string(pack_scene_example) +
    "local r = method.dress_pack(s, {path = {{0, 0, 0, 0, 0, 0}, {0.5, 0.1, -0.3, 0.3, 0.2, 0.2}, {1, 0, 0, 0.7, 0, 0}}, via = 4, checked_steps = 20})\n";

}  // namespace

void bind_pack_motion(lua_State* L) {
  Class<dress_pack::PackSnap>(L, "A rod of a dress pack that left its equilibrium and came to rest in another one")
      .property("t", "", "Just after this share of the path", [](const dress_pack::PackSnap& s) { return s.t; })
      .property("move", "m", "The farthest that a place on it moved", [](const dress_pack::PackSnap& s) { return s.move; })
      .property("energy_drop", "J", "Energy set free", [](const dress_pack::PackSnap& s) { return s.energy_drop; })
      .tostring([](const dress_pack::PackSnap& s) { return "snap-through at t = " + plain_number(s.t) + ": " + quantity(s.move, "m"); });
  Class<PackMotionHandle>(L, "A dress pack that follows its robot along a path, from equilibrium to equilibrium")
      .property("ok", "", "It came to the end of the path", [](const PackMotionHandle& h) { return h.motion->ok(); })
      .property("message", "", "What there is to say about it", [](const PackMotionHandle& h) { return h.motion->message; })
      .property("seconds", "s", "Run time", [](const PackMotionHandle& h) { return h.motion->seconds; })
      .property("max_tension", "N", "The largest force between a hold and its rod", [](const PackMotionHandle& h) { return h.motion->largest_end_force(); })
      .property("max_twist", "rad/m", "The largest change against the unstressed rods", [](const PackMotionHandle& h) { return h.motion->largest_twist(); })
      .property("min_bend_radius", "m", "The smallest", [](const PackMotionHandle& h) { return h.motion->smallest_bend_radius(); })
      .property("clearance", "m", "The smallest of the rods from obstacles and links; infinite: nothing is near", [](const PackMotionHandle& h) { return h.motion->smallest_clearance(); })
      .property("length", "rad or m", "Of the path, the joints together", [](const PackMotionHandle& h) { return h.path.length(); })
      .property("times", "", "Shares of the path", [](const PackMotionHandle& h) { return over_time(h, [](const PackStep& s) { return s.t; }); })
      .property("tensions", "N", "The largest force of a hold at those times", [](const PackMotionHandle& h) { return over_time(h, force_of); })
      .property("residual", "N", "The largest that was left unbalanced", [](const PackMotionHandle& h) {
        double most = 0;
        for (const PackStep& step : h.motion->steps) most = std::max(most, step.residual);
        return most;
      })
      .property("snaps", "", "Snap-throughs, in time order", [](const PackMotionHandle& h) { return h.motion->snaps; })
      .method("frame", {.takes = {"t"}, .does = "The equilibrium, with the robot where it is, at the time step nearest to t = 0 ... 1.",
                        .example = example + "print(r.after:frame(0.5).ok)  --> true"},
              frame_at)
      .method("joints", {.takes = {"t"}, .does = "The robot's joint values at t = 0 ... 1.", .example = example + "print(#r.after:joints(0))  --> 6"},
              joints_at)
      .method("motion", {.options = {option<int>("states", "", "Evenly spaced, first and last among them").at_least(1).at_most(1e5).preset(40)},
                         .does = "Its states as a motion: for envelopes, gaps and pictures.", .example = example + "print(#r.after:motion{states = 5}.equilibria)  --> 5"},
              scene_motion_of)
      .tostring([](const PackMotionHandle& h) {
        const PackMotion& m = *h.motion;
        return Card(h.title)
            .row("status", m.ok() ? "solved" : name_of(m.status), m.message)
            .row("largest force", m.largest_end_force(), "N").row("largest twist", m.largest_twist() / units::deg, "deg/m")
            .row("min bend radius", m.smallest_bend_radius(), "m").row("min clearance", m.smallest_clearance(), "m").text();
      });
}

}  // namespace tendril::lua
