#include "statics/se3_packs.h"

namespace tendril {

ReferenceRates reference_rates(const Frame& reference, double length) {
  JacobianCoefficients<double> k;
  const V3<double> phi = rotation_log<double>(in_lanes(reference.rotation), k);
  const V3<double> v = inverse_left_jacobian(phi, k.c) * in_lanes(reference.at);
  return {from_lanes(v) / length, from_lanes(phi) / length};
}

Vec3 reference_slope(const MeshSegment& segment) {
  if (segment.to_middle.vec().isZero(0) && segment.reference.rotation.vec().isZero(0)) return Vec3::Zero();
  const Vec3 first = log_rotation(segment.to_middle);
  const Vec3 second = log_rotation(segment.to_middle.conjugate() * segment.reference.rotation);
  const Vec3 change = second - first;
  return change.norm() > 1e-11 ? Vec3(4 / (segment.length * segment.length) * change) : Vec3(Vec3::Zero());
}

std::vector<Se3Segment<Pack>> se3_segments(const RodMesh& mesh, bool fourth_order) {
  const int segments = mesh.vertices() - 1;
  std::vector<Se3Segment<Pack>> packs((segments + 3) / 4);
  for (int i = 0; i < 4 * static_cast<int>(packs.size()); ++i) {
    const MeshSegment& from = mesh.segments[std::min(i, segments - 1)];
    Se3Segment<Pack>& to = packs[i / 4];
    const int l = i % 4;
    const double h = from.length;
    const Section& section = from.section;
    const ReferenceRates rates = reference_rates(from.reference, h);
    lane(to.h, l) = h;
    lane(to.q, l) = fourth_order ? h * h / 12 : 0;
    put(to.flexibility_v, Vec3(1 / section.GA1, 1 / section.GA2, 1 / section.EA), l);
    put(to.flexibility_phi, Vec3(1 / section.EI1, 1 / section.EI2, 1 / section.GJ), l);
    put(to.rate_v, rates.v, l);
    put(to.rate_phi, rates.phi, l);
    const Vec3 slope = reference_slope(from);
    put(to.slope_phi, slope, l);
    to.varies = to.varies || !slope.isZero(0);
  }
  return packs;
}

}  // namespace tendril
