#include "method/variation/rod_reader.h"

#include <algorithm>

#include "statics/se3_packs.h"

namespace tendril::variation {
namespace {

Vec3 vector_at(const double* n) { return {n[0], n[1], n[2]}; }

/// Segments 4 * pack ... of a rod, the last one repeated in lanes behind it.
Se3Segment<Pack> segments_of(const std::vector<BatchLayout::SegmentPlace>& places, const std::vector<double>& numbers, int pack) {
  Se3Segment<Pack> s;
  for (int l = 0; l < 4; ++l) {
    const BatchLayout::SegmentPlace place = places[std::min<std::size_t>(4 * pack + l, places.size() - 1)];
    const double* own = &numbers[place.stiffness];
    lane(s.h, l) = own[0];
    lane(s.q, l) = own[0] * own[0] / 12;
    put(s.flexibility_v, vector_at(own + 1), l);
    put(s.flexibility_phi, vector_at(own + 4), l);
    const double* rates = place.rates < 0 ? nullptr : &numbers[place.rates];
    put(s.rate_v, rates ? vector_at(rates) : Vec3::UnitZ(), l);
    put(s.rate_phi, rates ? vector_at(rates + 3) : Vec3(Vec3::Zero()), l);
    const Vec3 slope = rates ? vector_at(rates + 6) : Vec3(Vec3::Zero());
    put(s.slope_phi, slope, l);
    s.varies = s.varies || !slope.isZero(0);
  }
  return s;
}

}  // namespace

RodReader::RodReader(const Batch& batch)
    : batch_(batch), numbers_(batch.layout().parameter_count()), rods_(batch.layout().rods()),
      has_shape_(rods_.size(), 0), has_stress_(rods_.size(), 0) {
  for (int k = 0; k < batch.layout().rods(); ++k) places_.push_back(batch.layout().segment_places(k));
}

void RodReader::stand_at(const BatchResults& results, int outcome, const SystemProblem& problem) {
  results_ = &results;
  outcome_ = outcome;
  problem_ = &problem;
  numbers_read_ = false;
  std::fill(has_shape_.begin(), has_shape_.end(), 0);
  std::fill(has_stress_.begin(), has_stress_.end(), 0);
}

const Equilibrium& RodReader::rod(int rod, bool stress) {
  Equilibrium& out = rods_[rod];
  if (!numbers_read_) {
    batch_.layout().read(*problem_, numbers_.data());
    numbers_read_ = true;
  }
  if (!has_shape_[rod]) read_shape(rod, out);
  has_shape_[rod] = 1;
  if (stress && !has_stress_[rod]) read_stress(rod, out);
  has_stress_[rod] = has_stress_[rod] || stress;
  return out;
}

void RodReader::read_shape(int rod, Equilibrium& out) {
  const std::span<const double> frames = results_->frames(outcome_, rod);
  const int vertices = results_->vertices(rod);
  out.s.resize(vertices);
  out.points.resize(vertices);
  out.rotations.resize(vertices);
  double s = 0;
  for (int i = 0; i < vertices; ++i) {
    const double* n = &frames[7 * i];
    out.points[i] = vector_at(n);
    out.rotations[i] = Quat(n[3], n[4], n[5], n[6]);
    out.s[i] = s;
    if (i + 1 < vertices) s += numbers_[places_[rod][i].stiffness];
  }
  out.s.back() = problem_->rods[rod].rod.length;
  const std::vector<Hold>& holds = problem_->rods[rod].holds;
  out.reactions.resize(holds.size());
  for (std::size_t k = 0; k < holds.size(); ++k) {
    const BatchResults::Support support = results_->reaction(outcome_, rod, static_cast<int>(k));
    out.reactions[k] = {holds[k].at, support.force, support.moment};
  }
}

void RodReader::read_stress(int rod, Equilibrium& out) {
  const std::vector<BatchLayout::SegmentPlace>& places = places_[rod];
  const int segments = static_cast<int>(places.size());
  for (auto* all : {&out.forces, &out.strains, &out.curvatures, &out.curvature_changes, &out.moments}) all->resize(segments);
  out.radii.resize(segments);
  for (int p = 0; 4 * p < segments; ++p) {
    const Se3Segment<Pack> s = segments_of(places, numbers_, p);
    Se3Ends<Pack> ends;
    for (int l = 0; l < 4; ++l) {
      const int a = std::min(4 * p + l, segments - 1);
      const Quat &qa = out.rotations[a], &qb = out.rotations[a + 1];
      put(ends.ra, out.points[a], l);
      put(ends.rb, out.points[a + 1], l);
      lane(ends.qa.w, l) = qa.w();
      lane(ends.qb.w, l) = qb.w();
      put(ends.qa.v, qa.vec(), l);
      put(ends.qb.v, qb.vec(), l);
    }
    const SegmentGradient<Pack> g = se3_gradient(s, ends);
    const Wrench<Pack> strained = strained_by(s, g.wrench);
    const V3<Pack> strain = times(s.flexibility_v, strained.n), bend = times(s.flexibility_phi, strained.m);
    const V3<Pack> curvature = bend + s.rate_phi;
    for (int l = 0; l < std::min(4, segments - 4 * p); ++l) {
      const int i = 4 * p + l;
      out.forces[i] = get(g.force, l);
      out.moments[i] = get(strained.m, l);
      out.strains[i] = get(strain, l);
      out.curvature_changes[i] = get(bend, l);
      out.curvatures[i] = get(curvature, l);
      out.radii[i] = problem_->rods[rod].rod.section_at(0.5 * (out.s[i] + out.s[i + 1])).radius();
    }
  }
}

}  // namespace tendril::variation
