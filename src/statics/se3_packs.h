// A rod's segments as the SE(3) element works on them: four in the lanes of a pack.
#pragma once

#include <algorithm>
#include <vector>

#include "rod/se3_element.h"
#include "statics/rod_system.h"

namespace tendril {

inline void put(V3<Pack>& to, const Vec3& v, int i) {
  lane(to.x, i) = v.x();
  lane(to.y, i) = v.y();
  lane(to.z, i) = v.z();
}

inline Vec3 get(const V3<Pack>& v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }

inline V3<double> in_lanes(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Q4<double> in_lanes(const Quat& q) { return {q.w(), {q.x(), q.y(), q.z()}}; }
inline Vec3 from_lanes(const V3<double>& v) { return {v.x, v.y, v.z}; }

/// Segments by packs of four. Lanes behind the last segment repeat it, so that they stay harmless; nothing of them is read.
std::vector<Se3Segment<Pack>> se3_segments(const RodMesh& mesh, bool fourth_order);

/// Reference rates of a segment: the logarithm of its reference frame over its length, in (v, phi).
struct ReferenceRates {
  Vec3 v, phi;
};
ReferenceRates reference_rates(const Frame& reference, double length);

/// d(reference curvature)/ds over a segment (1/m^2), from the turns of its halves; zero where that is rounding.
Vec3 reference_slope(const MeshSegment& segment);

/// The ends' frames of the four segments of a pack.
inline Se3Ends<Pack> se3_ends(StateView state, int segments, int pack) {
  Se3Ends<Pack> e;
  for (int l = 0; l < 4; ++l) {
    const int a = std::min(4 * pack + l, segments - 1), b = a + 1;
    const Quat &qa = state.q[a], &qb = state.q[b];
    put(e.ra, state.r[a], l);
    put(e.rb, state.r[b], l);
    lane(e.qa.w, l) = qa.w();
    lane(e.qb.w, l) = qb.w();
    put(e.qa.v, qa.vec(), l);
    put(e.qb.v, qb.vec(), l);
  }
  return e;
}

}  // namespace tendril
