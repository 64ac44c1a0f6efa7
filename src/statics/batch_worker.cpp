#include "statics/batch_worker.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "statics/batch_scalar.h"

namespace tendril {
namespace {

constexpr int most_iterations = 20;  // of one attempt
constexpr int refining_iterations = 4;
constexpr double refining_step = 1e-2;
constexpr double rough_step = 0.2;     // after larger steps the actual wrench is too rough for the fourth-order terms,
constexpr double rough_stretch = 0.5;  // and so it is where the step's second-order stretch makes this much of it
constexpr double quadratic_regime = 1e-2;
constexpr double settled_step = 1e-5;
constexpr int settled_rounds = 5;

Frame frame_at(const double* from, int offset, int stride, int lane) {
  auto number = [&](int i) { return from[(offset + i) * stride + lane]; };
  return {{number(0), number(1), number(2)}, Quat(number(3), number(4), number(5), number(6))};
}

double* write(const Frame& frame, double* out) {
  const Quat& q = frame.rotation;
  for (const double number : {frame.at.x(), frame.at.y(), frame.at.z(), q.w(), q.x(), q.y(), q.z()}) *out++ = number;
  return out;
}

}  // namespace

BatchWorker::BatchWorker(const Batch& batch)
    : batch_(batch),
      layout_(batch.layout_),
      lanes_(batch.kernel_->lanes),
      problem_(batch.nominal_),
      numbers_(layout_.parameter_count()),
      state_(lanes_),
      no_wrenches_(batch.wrenches_.size(), 0.0),
      pack_(layout_, *batch.kernel_) {}

/// An idle lane iterates at the nominal equilibrium, where nothing can go wrong.
void BatchWorker::rest(int lane) {
  state_[lane].outcome = -1;
  pack_.set(lane, batch_.parameters_, batch_.frames_, batch_.wrenches_, false);
}

/// Puts the next outcome that fits into the lane; false when there is none left.
bool BatchWorker::take_outcome(int lane) {
  while (!stopped_) {
    if (const auto stop = work_->context.stop()) {
      stopped_ = true;
      break;
    }
    const int outcome = work_->next.fetch_add(1, std::memory_order_relaxed);
    if (outcome >= work_->results.size()) break;
    work_->fill(outcome, problem_);
    if (!layout_.read(problem_, numbers_.data())) {
      solve_scalar(outcome, 0);
      continue;
    }
    const double size = batch_.predictor_.predict(numbers_, first_frames_, first_wrenches_, scratch_);
    pack_.set(lane, numbers_, first_frames_, first_wrenches_, rough(size));
    state_[lane] = {outcome, 0, most_iterations, 0, INFINITY, settled_step, 0, false};
    return true;
  }
  rest(lane);
  return false;
}

void BatchWorker::refine(std::vector<double>& frames, std::vector<double>& wrenches) {
  const BatchStructure structure = layout_.structure();
  for (int lane = 0; lane < lanes_; ++lane) rest(lane);
  for (int i = 0; i < refining_iterations; ++i) {
    batch_.kernel_->iterate(structure, pack_.lanes());
    if (!(pack_.positive(0) && pack_.size(0) <= refining_step))
      throw UsageError("batch: the frames given are not a stable equilibrium of the nominal problem");
  }
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = pack_.frame_number(0, static_cast<int>(i));
  for (std::size_t i = 0; i < wrenches.size(); ++i) wrenches[i] = pack_.wrench_number(0, static_cast<int>(i));
}

void BatchWorker::run() {
  int busy = 0;
  for (int lane = 0; lane < lanes_; ++lane) busy += take_outcome(lane);
  const BatchStructure structure = layout_.structure();
  const BatchLanes lanes = pack_.lanes();
  while (busy > 0) {
    if (const auto stop = work_->context.stop()) break;
    batch_.kernel_->iterate(structure, lanes);
    busy = 0;
    for (int lane = 0; lane < lanes_; ++lane) {
      if (state_[lane].outcome >= 0) judge(lane);
      busy += state_[lane].outcome >= 0;
    }
  }
}

/// After a step of this size the actual wrenches are too false for the fourth-order terms.
bool BatchWorker::rough(double size) const {
  return size > rough_step || 0.5 * size * size * layout_.stretch_stiffness() > rough_stretch;
}

/// After a full step of this size: is what is left below the tolerance? As in Newton's own test.
bool BatchWorker::settled(Lane& lane, double size) const {
  double left = size;
  if (size < quadratic_regime && lane.previous_size < 10 * quadratic_regime)
    left = 10 * size * size * size / (lane.previous_size * lane.previous_size) + 0.3 * size * lane.previous_size;
  lane.not_shrinking = size < settled_step && size > 0.5 * lane.smallest_size ? lane.not_shrinking + 1 : 0;
  lane.smallest_size = std::min(lane.smallest_size, size);
  return std::min(size, left) < batch_.options_.tolerance || lane.not_shrinking == settled_rounds;
}

/// A second attempt as from a first guess: nominal shape, no stress in the geometric terms, hence a positive matrix.
void BatchWorker::begin_again(int index) {
  Lane& lane = state_[index];
  pack_.begin(index, batch_.frames_, no_wrenches_, true);
  lane.limit = lane.iterations + most_iterations;
  lane.not_shrinking = 0;
  lane.previous_size = INFINITY;
  lane.smallest_size = settled_step;
  lane.last_shift = 0;
  lane.again = true;
}

/// A pivot was not positive and the lane has not moved: more shift, by the scalar Newton's rule.
void BatchWorker::raise_shift(int index) {
  const double shift = pack_.shift(index), least = 0.5 * layout_.bending_scale();
  pack_.shift(index, shift == 0 ? std::max(least, 0.25 * state_[index].last_shift) : 10 * shift);
}

/// After a full step.
void BatchWorker::relax_shift(int index) {
  const double shift = pack_.shift(index);
  state_[index].last_shift = shift;
  pack_.shift(index, 0.25 * shift < 0.5 * layout_.bending_scale() ? 0 : 0.25 * shift);
}

void BatchWorker::judge(int index) {
  Lane& lane = state_[index];
  ++lane.iterations;
  const double size = pack_.size(index);
  const bool positive = pack_.positive(index), full = size <= layout_.structure().largest_step;
  if (positive && full && pack_.shift(index) == 0 && !pack_.deferred(index) && settled(lane, size)) {
    keep(index);
    take_outcome(index);
    return;
  }
  if (!std::isfinite(size) || lane.iterations >= lane.limit) {
    if (!lane.again) {
      begin_again(index);
      return;
    }
    const Lane failed = lane;
    rest(index);
    solve_scalar(failed.outcome, failed.iterations);
    take_outcome(index);
    return;
  }
  if (!positive) {
    raise_shift(index);
    return;
  }
  if (full) relax_shift(index);
  pack_.defer(index, rough(size));
  lane.previous_size = size;
}

/// Writes the frames of all vertices and branch points from arrays with `stride` numbers a value.
void BatchWorker::write_frames(const double* frames, const double* parameters, int stride, int lane, double* out) const {
  for (int k = 0; k < layout_.rods(); ++k)
    for (int v = 0; v < layout_.vertices(k); ++v) {
      const BatchLayout::Vertex vertex = layout_.vertex(k, v);
      const Frame node = frame_at(frames, 7 * vertex.node, stride, lane);
      out = write(vertex.joint < 0 ? node : node * frame_at(parameters, vertex.joint, stride, lane), out);
    }
  for (int b = 0; b < work_->results.branches(); ++b)
    out = write(frame_at(frames, 7 * layout_.branch_node(b), stride, lane), out);
}

void BatchWorker::keep(int index) {
  const Lane& lane = state_[index];
  work_->results.outcomes_[lane.outcome] = {Status::solved, lane.iterations, pack_.size(index), false};
  write_frames(pack_.frames(), pack_.parameters(), lanes_, index, work_->results.frames_of(lane.outcome));
  double* out = work_->results.reactions_of(lane.outcome);
  auto support = [&](int node, bool position, bool orientation) {
    const int held = layout_.node(node).held_index;
    auto number = [&](int i) { return pack_.reaction_number(index, 6 * held + i); };
    const Vec3 moment = frame_at(pack_.frames(), 7 * node, lanes_, index).rotation *
                        (orientation ? Vec3(number(3), number(4), number(5)) : Vec3::Zero());
    for (int i = 0; i < 3; ++i) *out++ = position ? number(i) : 0;
    for (int i = 0; i < 3; ++i) *out++ = moment[i];
  };
  for (int k = 0; k < layout_.rods(); ++k)
    for (int h = 0; h < work_->results.holds(k); ++h) {
      const Hold& hold = batch_.nominal_.rods[k].holds[h];
      support(layout_.vertex(k, layout_.hold_vertex(k, h)).node, hold.position, hold.orientation);
    }
  for (int b = 0; b < work_->results.branches(); ++b) {
    const BranchPoint& branch = batch_.nominal_.branches[b];
    support(layout_.branch_node(b), branch.position, branch.orientation);
  }
}

/// The fallback: the outcome's own numbers again, and the scalar solver from the nominal equilibrium.
void BatchWorker::solve_scalar(int outcome, int iterations) {
  work_->fill(outcome, problem_);
  const ScalarAnswer answer = tendril::solve_scalar(problem_, batch_.options_, work_->context, &batch_.equilibrium_,
                                                    &batch_.shares_);
  BatchResults& results = work_->results;
  results.outcomes_[outcome] = {answer.status, iterations + answer.iterations, answer.last_step, true};
  if (!answer.message.empty()) {
    const std::lock_guard lock(work_->guard);
    results.messages_[outcome] = answer.message;
  }
  double* out = results.frames_of(outcome);
  if (answer.at.vertices.empty() || answer.at.branches.size() != static_cast<std::size_t>(results.branches())) {
    write_frames(batch_.frames_.data(), batch_.parameters_.data(), 1, 0, out);
  } else {
    for (const std::vector<Frame>& rod : answer.at.vertices)
      for (const Frame& frame : rod) out = write(frame, out);
    for (const Frame& frame : answer.at.branches) out = write(frame, out);
  }
  // Holds that the outcome does not have exert nothing.
  out = results.reactions_of(outcome);
  auto supports = [&out](const std::vector<BatchResults::Support>& own, int count) {
    for (int i = 0; i < count; ++i) {
      const bool there = i < static_cast<int>(own.size());
      for (int j = 0; j < 3; ++j) *out++ = there ? own[i].force[j] : 0;
      for (int j = 0; j < 3; ++j) *out++ = there ? own[i].moment[j] : 0;
    }
  };
  for (int k = 0; k < results.rods(); ++k)
    supports(answer.holds.empty() ? std::vector<BatchResults::Support>() : answer.holds[k], results.holds(k));
  supports(answer.branches, results.branches());
}

}  // namespace tendril
