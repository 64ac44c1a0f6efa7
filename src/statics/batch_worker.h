// One thread's share of a batch: lanes that take the next outcome as soon as they are done with one.
#pragma once

#include <atomic>
#include <mutex>

#include "statics/batch.h"
#include "statics/batch_pack.h"

namespace tendril {

class BatchWorker {
 public:
  /// What all workers of one batch share.
  struct Work {
    const Batch::Fill& fill;
    BatchResults& results;
    std::atomic<int>& next;  ///< the first outcome that nobody has taken
    std::mutex& guard;       ///< of the messages
    const RunContext& context;
  };

  explicit BatchWorker(const Batch& batch);
  BatchWorker(const Batch& batch, const Work& work) : BatchWorker(batch) { work_ = &work; }

  /// Solves outcomes until none is left.
  void run();

  /// Newton's iteration of the nominal problem itself from frames close to its equilibrium: the exact frames, and the
  /// wrenches there.
  void refine(std::vector<double>& frames, std::vector<double>& wrenches);

 private:
  /// How the outcome in one lane stands.
  struct Lane {
    int outcome = -1;
    int iterations = 0, limit = 0;
    int not_shrinking = 0;
    double previous_size = 0, smallest_size = 0, last_shift = 0;
    bool again = false;  ///< the second attempt
  };
  bool take_outcome(int lane);
  void rest(int lane);
  void begin_again(int lane);
  void raise_shift(int lane);
  void relax_shift(int lane);
  void judge(int lane);
  bool rough(double size) const;
  bool settled(Lane& lane, double size) const;
  void keep(int lane);
  void write_frames(const double* frames, const double* parameters, int stride, int lane, double* out) const;
  void solve_scalar(int outcome, int iterations);

  const Batch& batch_;
  const BatchLayout& layout_;
  const Work* work_ = nullptr;
  const int lanes_;
  SystemProblem problem_;
  std::vector<double> numbers_, first_frames_, first_wrenches_, scratch_;
  std::vector<Lane> state_;
  const std::vector<double> no_wrenches_;
  BatchPack pack_;
  bool stopped_ = false;
};

}  // namespace tendril
