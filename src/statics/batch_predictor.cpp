#include "statics/batch_predictor.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "statics/batch_pack.h"

namespace tendril {
namespace {

constexpr double tiny = 1e-6;  // of what is usual for a number: far below where the step bends, far above rounding

Quat quaternion(const double* n) { return {n[0], n[1], n[2], n[3]}; }

void put(const Quat& q, double* to) {
  to[0] = q.w();
  for (int i = 0; i < 3; ++i) to[1 + i] = q.vec()[i];
}

/// q exp(theta) for moderate angles, without sine and cosine.
void turn(double* q, const double* theta) {
  const double u = 0.25 * (theta[0] * theta[0] + theta[1] * theta[1] + theta[2] * theta[2]);
  const double sine = 1 - u / 6 * (1 - u / 20 * (1 - u / 42 * (1 - u / 72)));
  const double cosine = 1 - u / 2 * (1 - u / 12 * (1 - u / 30 * (1 - u / 56)));
  const Quat by(cosine, 0.5 * sine * theta[0], 0.5 * sine * theta[1], 0.5 * sine * theta[2]);
  Quat turned = quaternion(q) * by;
  turned.coeffs() *= 1.5 - 0.5 * turned.squaredNorm();
  put(turned, q);
}

}  // namespace

BatchPredictor::BatchPredictor(const BatchLayout& layout, const BatchKernel& kernel, const std::vector<double>& parameters,
                               const std::vector<double>& frames, const std::vector<double>& wrenches,
                               const std::vector<char>& varies)
    : nodes_(layout.node_count()),
      rows_(6 * layout.node_count() + static_cast<int>(wrenches.size())),
      length_(layout.structure().length),
      parameters_(parameters),
      frames_(frames),
      wrenches_(wrenches) {
  std::vector<double> amounts;
  for (const BatchLayout::Number& number : layout.numbers()) {
    const int width = number.axis < 0 ? 1 : 4;  // a number or a quaternion
    if (!varies.empty() && std::none_of(&varies[number.offset], &varies[number.offset] + width, [](char v) { return v; }))
      continue;
    columns_.push_back({number.offset, number.axis});
    amounts.push_back(tiny * number.scale);
  }
  slopes_.resize(columns_.size() * rows_);
  BatchPack pack(layout, kernel);
  const BatchStructure structure = layout.structure();
  for (std::size_t first = 0; first < columns_.size(); first += kernel.lanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kernel.lanes, columns_.size() - first));
    for (int lane = 0; lane < kernel.lanes; ++lane) {
      pack.set(lane, parameters_, frames_, wrenches_, false);
      if (lane >= count) continue;
      const Column& column = columns_[first + lane];
      const double amount = amounts[first + lane];
      if (column.axis < 0) {
        pack.parameter(lane, column.offset) += amount;
        continue;
      }
      double q[4], theta[3] = {};
      for (int i = 0; i < 4; ++i) q[i] = parameters_[column.offset + i];
      theta[column.axis] = amount;
      turn(q, theta);
      for (int i = 0; i < 4; ++i) pack.parameter(lane, column.offset + i) = q[i];
    }
    kernel.iterate(structure, pack.lanes());
    for (int lane = 0; lane < count; ++lane) {
      double* out = &slopes_[(first + lane) * rows_];
      const double per_amount = 1 / amounts[first + lane];
      for (int i = 0; i < nodes_; ++i) {
        double moved[7];
        for (int j = 0; j < 7; ++j) moved[j] = pack.frame_number(lane, 7 * i + j);
        const Vec3 theta = log_rotation(quaternion(&frames_[7 * i + 3]).conjugate() * quaternion(moved + 3));
        for (int j = 0; j < 3; ++j) {
          out[6 * i + j] = per_amount * (moved[j] - frames_[7 * i + j]);
          out[6 * i + 3 + j] = per_amount * theta[j];
        }
      }
      for (std::size_t j = 0; j < wrenches_.size(); ++j)
        out[6 * nodes_ + j] = per_amount * (pack.wrench_number(lane, static_cast<int>(j)) - wrenches_[j]);
    }
  }
}

double BatchPredictor::predict(const std::vector<double>& parameters, std::vector<double>& frames,
                               std::vector<double>& wrenches, std::vector<double>& scratch) const {
  scratch.assign(rows_, 0.0);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Column& column = columns_[k];
    double amount;
    if (column.axis < 0) {
      amount = parameters[column.offset] - parameters_[column.offset];
    } else {
      const double *own = &parameters[column.offset], *was = &parameters_[column.offset];
      if (std::equal(own, own + 4, was)) continue;
      amount = log_rotation(quaternion(was).conjugate() * quaternion(own))[column.axis];
    }
    if (amount == 0) continue;
    const double* slope = &slopes_[k * rows_];
    for (int i = 0; i < rows_; ++i) scratch[i] += amount * slope[i];
  }
  frames = frames_;
  wrenches = wrenches_;
  double largest = 0;
  for (int i = 0; i < nodes_; ++i) {
    const double* x = &scratch[6 * i];
    largest = std::max({largest, (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / (length_ * length_),
                        x[3] * x[3] + x[4] * x[4] + x[5] * x[5]});
  }
  largest = std::sqrt(largest);
  if (!(largest <= too_far)) return INFINITY;
  for (int i = 0; i < nodes_; ++i) {
    const double* x = &scratch[6 * i];
    for (int j = 0; j < 3; ++j) frames[7 * i + j] += x[j];
    turn(&frames[7 * i + 3], x + 3);
  }
  for (std::size_t j = 0; j < wrenches.size(); ++j) wrenches[j] += scratch[6 * nodes_ + j];
  return largest;
}

}  // namespace tendril
