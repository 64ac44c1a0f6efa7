// The memory of one pack of outcomes: arrays with the lanes side by side.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "statics/batch_layout.h"

namespace tendril {

class BatchPack {
 public:
  BatchPack(const BatchLayout& layout, const BatchKernel& kernel)
      : count_(kernel.lanes),
        parameters_(array(layout.parameter_count())),
        deferred_(array(1)),
        shift_(array(1)),
        frames_(array(7 * layout.node_count())),
        wrenches_(array(BatchBlocks::wrench * layout.segment_count())),
        reactions_(array(6 * layout.held_count())),
        size_(array(1)),
        positive_(array(1)),
        scratch_(array(kernel.scratch_size(layout.structure(), layout.held_count(), layout.slot_count()))) {}

  BatchLanes lanes() const {
    return {parameters_.get(), deferred_.get(),  shift_.get(), frames_.get(), wrenches_.get(),
            reactions_.get(),  size_.get(),      positive_.get(), scratch_.get()};
  }

  void set(int lane, const std::vector<double>& parameters, const std::vector<double>& frames,
           const std::vector<double>& wrenches, bool deferred) {
    spread(parameters, parameters_, lane);
    begin(lane, frames, wrenches, deferred);
  }
  /// The same numbers from another state.
  void begin(int lane, const std::vector<double>& frames, const std::vector<double>& wrenches, bool deferred) {
    spread(frames, frames_, lane);
    spread(wrenches, wrenches_, lane);
    defer(lane, deferred);
    shift(lane, 0);
  }
  void shift(int lane, double shift) { shift_[lane] = shift; }
  double shift(int lane) const { return shift_[lane]; }
  void defer(int lane, bool deferred) { deferred_[lane] = deferred ? 1 : 0; }
  bool deferred(int lane) const { return deferred_[lane] != 0; }

  double& parameter(int lane, int i) { return parameters_[i * count_ + lane]; }
  double frame_number(int lane, int i) const { return frames_[i * count_ + lane]; }
  double wrench_number(int lane, int i) const { return wrenches_[i * count_ + lane]; }
  double reaction_number(int lane, int i) const { return reactions_[i * count_ + lane]; }
  double size(int lane) const { return size_[lane]; }
  bool positive(int lane) const { return positive_[lane] > 0; }
  const double* frames() const { return frames_.get(); }
  const double* parameters() const { return parameters_.get(); }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  using Array = std::unique_ptr<double[], Free>;

  Array array(std::size_t numbers_a_lane) const {
    const std::size_t bytes = (std::max<std::size_t>(1, numbers_a_lane) * count_ * sizeof(double) + 63) / 64 * 64;
    Array array(static_cast<double*>(std::aligned_alloc(64, bytes)));
    if (!array) throw std::bad_alloc();
    std::fill_n(array.get(), bytes / sizeof(double), 0.0);
    return array;
  }
  void spread(const std::vector<double>& numbers, const Array& to, int lane) {
    for (std::size_t i = 0; i < numbers.size(); ++i) to[i * count_ + lane] = numbers[i];
  }

  int count_;
  Array parameters_, deferred_, shift_, frames_, wrenches_, reactions_, size_, positive_, scratch_;
};

}  // namespace tendril
