// Outcomes that an envelope was not made from.
#include <catch2/catch.hpp>

#include "unit/method/containment_cases.h"

using namespace tendril;
using namespace tendril::test;

namespace {

Envelope envelope_of(const Places& places) {
  EnvelopeOutcomes outcomes(places.rods);
  outcomes.add_frames(places.outcomes(), places);
  EnvelopeOptions options;
  options.voxel = 4e-3;
  return EnvelopeBuilder().build(outcomes, options);
}

/// Frames along x, moved by `by`, for a rod of 0.4 m.
std::vector<double> straight_frames(const Vec3& by) {
  std::vector<double> frames;
  const Quat q = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1}).rotation;
  for (int v = 0; v <= tee_segments; ++v) {
    const Vec3 p = by + Vec3(0.4 * v / tee_segments, 0, 0);
    frames.insert(frames.end(), {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
  }
  return frames;
}

}  // namespace

TEST_CASE("containment: a rod moved out of its own envelope reaches out as far", "[envelope]") {
  Places places;
  places.rods = {{std::vector<double>(tee_segments, tee_radius), 5}};
  places.numbers = {straight_frames({0, 0, 0})};
  const Envelope envelope = envelope_of(places);
  const ReachTest test(envelope.mesh);
  const auto reach = [&](const Vec3& by) { return test.reach(straight_frames(by), tee_radius, 10); };
  CHECK(reach({0, 0, 0}) < 0);
  CHECK(reach({0, 0, 0}) > -1.01 * envelope.margin);  // the mesh lies between the capsule and the capsule grown by the margin
  for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(0, -0.6, 0.8), Vec3(1, 0, 0), Vec3(-0.8, 0, 0.6)})
    for (const double way : {0.003, 0.01, 0.05}) {
      CAPTURE(direction.transpose(), way);
      CHECK(reach(way * direction) <= way);
      CHECK(reach(way * direction) > way - 1.01 * envelope.margin);
    }
}

TEST_CASE("containment: an envelope holds the outcomes it is made from, and most of the fresh ones", "[envelope]") {
  // Measured over eight seeds: 15 to 29 in a hundred outside, by 19 to 42 mm at most. None outside would mean an envelope that
  // is far too large.
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    int lost = 0, lost_fresh = 0;
    const Places used = solved_tee(300, seed, lost), fresh = solved_tee(500, 1000 + seed, lost_fresh);
    CHECK(lost + lost_fresh == 0);
    const Envelope envelope = envelope_of(used);
    const ReachTest test(envelope.mesh);
    double own = -INFINITY, farthest = -INFINITY;
    for (int k = 0; k < used.outcomes(); ++k) own = std::max(own, test.reach(used, k, 6));
    int outside = 0;
    for (int k = 0; k < fresh.outcomes(); ++k) {
      const double reach = test.reach(fresh, k, 6);
      outside += reach > 0;
      farthest = std::max(farthest, reach);
    }
    CHECK(own < 0);
    CHECK(own > -5e-3);
    CHECK(outside > 25);
    CHECK(outside < 200);
    CHECK(farthest < 0.06);
  }
}
