// The few linear-algebra types that every folder shares. Eigen only.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tendril {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// The matrix [v] with [v] w = v x w.
inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// True when every entry is a finite number.
template <class Derived>
bool all_finite(const Eigen::MatrixBase<Derived>& m) {
  return m.array().isFinite().all();
}

}  // namespace tendril
