#include "robot/spherical_wrist.h"

#include <cmath>

#include "base/number_text.h"
#include "base/units.h"

namespace tendril {

namespace {

constexpr double parallel_tolerance = 1e-7;  // rad; descriptions round a right angle to as little as eight digits
constexpr double meeting_tolerance = 1e-6;   // m in an arm of 1 m; solutions are polished afterwards
constexpr double singular_tolerance = 1e-8;

Mat3 turn(const ScrewAxis& axis, double angle) { return Eigen::AngleAxisd(angle, axis.along).toRotationMatrix(); }

Vec3 normal_part(const Vec3& v, const Vec3& axis) { return v - axis * axis.dot(v); }

double wrapped(double angle) { return std::remainder(angle, 2 * units::pi); }

// The angle about the unit vector k that turns the direction of `from` into that of `to`, both seen along k.
double angle_about(const Vec3& k, const Vec3& from, const Vec3& to) {
  return std::atan2(k.dot(from.cross(to)), normal_part(from, k).dot(to));
}

// All angles with h . (turn about k of p) = d. `reach`: how large h . turn p gets beyond its middle (the amplitude), and
// `wanted` where between -1 and 1 of that the answer lies.
struct Projected {
  std::array<double, 2> angles;
  double amplitude, wanted;
};
Projected angles_projected(const Vec3& h, const Vec3& k, const Vec3& p, double d) {
  const double sine = h.dot(k.cross(p)), cosine = h.dot(p) - h.dot(k) * k.dot(p);
  Projected out;
  out.amplitude = std::hypot(sine, cosine);
  out.wanted = (d - h.dot(k) * k.dot(p)) / out.amplitude;
  const double middle = std::atan2(sine, cosine), half = std::acos(std::clamp(out.wanted, -1.0, 1.0));
  out.angles = {wrapped(middle + half), wrapped(middle - half)};
  return out;
}

// Two roots that are one in effect.
bool meet(const Projected& p) { return std::abs(wrapped(p.angles[0] - p.angles[1])) < 1e-6; }

// The point nearest to three lines; nothing when it is farther than `tolerance` from one of them or two are parallel.
std::optional<Vec3> common_point(const ScrewAxis& a, const ScrewAxis& b, const ScrewAxis& c, double tolerance) {
  Mat3 sum = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const ScrewAxis* axis : {&a, &b, &c}) {
    const Mat3 normal = Mat3::Identity() - axis->along * axis->along.transpose();
    sum += normal;
    right += normal * axis->at;
  }
  if (a.along.cross(b.along).norm() < 1e-3 || b.along.cross(c.along).norm() < 1e-3) return std::nullopt;
  const Vec3 point = sum.inverse() * right;
  for (const ScrewAxis* axis : {&a, &b, &c})
    if (!(normal_part(point - axis->at, axis->along).norm() < tolerance)) return std::nullopt;
  return point;
}

}  // namespace

struct SphericalWristArm::Search {
  const Angles& near;
  const std::array<std::string, 6>& names;
  Branches found;

  void note(const std::string& text) {
    if (found.singular.find(text) != text.npos) return;
    found.singular += (found.singular.empty() ? "" : "; ") + text;
  }
  void note_free(int joint) { note("'" + names[joint] + "' is free and stays at " + number_text(near[joint])); }
};

std::optional<SphericalWristArm> SphericalWristArm::from_axes(const std::array<ScrewAxis, 6>& axes, const Frame& tip,
                                                              std::string& why_not) {
  SphericalWristArm arm;
  arm.axes_ = axes;
  arm.tip_inverse_ = tip.inverse();
  const Vec3& across = axes[1].along;
  arm.size_ = 0;
  for (int k = 1; k < 6; ++k) arm.size_ += normal_part(axes[k].at - axes[k - 1].at, axes[k - 1].along).norm();
  if (across.cross(axes[2].along).norm() > parallel_tolerance) {
    why_not = "axes 2 and 3 are not parallel";
    return std::nullopt;
  }
  const auto wrist = common_point(axes[3], axes[4], axes[5], meeting_tolerance * std::max(arm.size_, 1e-3));
  if (!wrist) {
    why_not = "the last three axes do not meet in a point";
    return std::nullopt;
  }
  arm.wrist_ = *wrist;
  arm.upper_ = normal_part(axes[2].at - axes[1].at, across);
  arm.fore_ = normal_part(*wrist - axes[2].at, across);
  if (axes[0].along.cross(across).norm() < 1e-3)
    why_not = "axes 1 and 2 are parallel";
  else if (arm.upper_.norm() < 1e-6 * arm.size_)
    why_not = "axes 2 and 3 are one";
  else if (arm.fore_.norm() < 1e-6 * arm.size_)
    why_not = "the wrist lies on axis 3";
  if (!why_not.empty()) return std::nullopt;
  return arm;
}

// Joint 1: seen along axes 2 and 3, the wrist must lie as far out as it does in the zero position.
std::vector<double> SphericalWristArm::shoulder(const Vec3& wrist, Search& search) const {
  const Vec3& across = axes_[1].along;
  const Vec3 from_axis = wrist - axes_[0].at;
  const Projected back = angles_projected(across, axes_[0].along, from_axis, across.dot(wrist_ - axes_[0].at));
  if (back.amplitude < singular_tolerance * size_) {
    const double offset = across.dot(wrist_ - axes_[0].at) - across.dot(axes_[0].along) * axes_[0].along.dot(from_axis);
    if (std::abs(offset) < singular_tolerance * size_) {
      search.note_free(0);
      return {search.near[0]};
    }
  }
  if (!(std::abs(back.wanted) <= 1 + 1e-10)) {
    const double distance = normal_part(from_axis, axes_[0].along).norm();
    search.found.out_of_reach = "the wrist centre would be " + number_text(distance) + " m from the axis of '" + search.names[0] +
                                "', at least " + number_text(std::abs(back.wanted) * distance) + " m is needed";
    return {};
  }
  if (meet(back)) {
    search.note("two branches meet at '" + search.names[0] + "'");
    return {-back.angles[0]};
  }
  return {-back.angles[0], -back.angles[1]};
}

void SphericalWristArm::elbow(const Vec3& wrist, Angles angles, const Mat3& rotation, Search& search) const {
  const Mat3 first = turn(axes_[0], angles[0]);
  const Vec3 across = axes_[1].along;
  const Vec3 to_wrist = normal_part(first.transpose() * (wrist - axes_[0].at) + axes_[0].at - axes_[1].at, across);
  const double distance = to_wrist.norm();
  const Projected bend =
      angles_projected(upper_, axes_[2].along, fore_, (distance * distance - upper_.squaredNorm() - fore_.squaredNorm()) / 2);
  if (!(std::abs(bend.wanted) <= 1 + 1e-10)) {
    search.found.out_of_reach = "the wrist centre would be " + number_text(distance) + " m from the axis of '" + search.names[1] +
                                "', the arm reaches " + number_text(std::abs(upper_.norm() - fore_.norm())) + " ... " +
                                number_text(upper_.norm() + fore_.norm()) + " m";
    return;
  }
  const int count = meet(bend) ? 1 : 2;
  if (count == 1) search.note("two branches meet at '" + search.names[2] + "', the arm is stretched or folded");
  for (int k = 0; k < count; ++k) {
    angles[2] = bend.angles[k];
    const Vec3 from = turn(axes_[2], angles[2]) * fore_ + upper_;
    if (distance < singular_tolerance * size_) {
      angles[1] = search.near[1];
      search.note_free(1);
    } else {
      angles[1] = angle_about(across, from, to_wrist);
    }
    hand(angles, (first * turn(axes_[1], angles[1]) * turn(axes_[2], angles[2])).transpose() * rotation, search);
  }
}

void SphericalWristArm::hand(Angles angles, const Mat3& rotation, Search& search) const {
  const Vec3 &roll = axes_[3].along, &bend = axes_[4].along, &last = axes_[5].along;
  const Vec3 wanted = rotation * last;
  const Projected tilt = angles_projected(roll, bend, last, roll.dot(wanted));
  if (!(std::abs(tilt.wanted) <= 1 + 1e-10)) {
    search.found.out_of_reach = "the wrist cannot turn the last axis that far to that of '" + search.names[3] + "'";
    return;
  }
  const int count = meet(tilt) ? 1 : 2;
  for (int k = 0; k < count; ++k) {
    angles[4] = tilt.angles[k];
    const Vec3 tilted = turn(axes_[4], angles[4]) * last;
    if (normal_part(tilted, roll).norm() < 1e-6) {
      angles[3] = search.near[3];
      search.note("the wrist is stretched: '" + search.names[3] + "' is free and stays at " + number_text(search.near[3]));
    } else {
      if (count == 1) search.note("two branches meet at '" + search.names[4] + "'");
      angles[3] = angle_about(roll, tilted, wanted);
    }
    const Vec3 side = last.unitOrthogonal();
    const Mat3 before = turn(axes_[3], angles[3]) * turn(axes_[4], angles[4]);
    angles[5] = angle_about(last, side, before.transpose() * rotation * side);
    search.found.angles.push_back(angles);
  }
}

SphericalWristArm::Branches SphericalWristArm::solve(const Frame& target, const Angles& near,
                                                     const std::array<std::string, 6>& names) const {
  const Frame moved = target * tip_inverse_;  // of the whole arm, from the zero position
  const Vec3 wrist = moved.at + moved.rotation * wrist_;
  const Mat3 rotation = moved.rotation.toRotationMatrix();
  Search search{near, names, {}};
  for (double angle : shoulder(wrist, search)) elbow(wrist, {wrapped(angle)}, rotation, search);
  if (!search.found.angles.empty()) search.found.out_of_reach.clear();
  return std::move(search.found);
}

}  // namespace tendril
