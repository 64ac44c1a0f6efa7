#include "method/envelope/outcomes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "geometry/mesh.h"
#include "method/envelope/arc_points.h"
#include "method/envelope/directions.h"

namespace tendril {
namespace {

constexpr int most_pieces = 64;

void check(const std::vector<EnvelopeRod>& rods, int room) {
  if (rods.empty()) throw UsageError("envelope: no rods; at least one expected");
  if (room < 64) throw UsageError("envelope: room for " + std::to_string(room) + " places a node, expected at least 64");
  for (std::size_t r = 0; r < rods.size(); ++r) {
    const std::string who = "envelope: rod " + std::to_string(r + 1);
    if (rods[r].radii.empty()) throw UsageError(who + " has no segments; one radius for each is expected");
    for (std::size_t i = 0; i < rods[r].radii.size(); ++i)
      if (!(std::isfinite(rods[r].radii[i]) && rods[r].radii[i] > 0))
        throw UsageError(who + ": the radius of segment " + std::to_string(i + 1) + " is " + number_text(rods[r].radii[i]) +
                         "; a finite number of metres above 0 is expected");
    if (rods[r].pieces < 1 || rods[r].pieces > most_pieces)
      throw UsageError(who + " has " + std::to_string(rods[r].pieces) + " pieces a segment, expected 1 to " +
                       std::to_string(most_pieces));
  }
}

}  // namespace

int arc_pieces(std::span<const double> frames, double sagitta) {
  double largest = 0;
  for (std::size_t v = 7; v + 7 <= frames.size(); v += 7)
    largest = std::max(largest, envelope::ElementArc(&frames[v - 7], &frames[v]).sagitta(1));
  if (!(largest > sagitta)) return 1;
  const double pieces = std::ceil(std::sqrt(largest / std::max(sagitta, 1e-300)));
  return static_cast<int>(std::min<double>(most_pieces, pieces));
}

EnvelopeOutcomes::EnvelopeOutcomes(std::vector<EnvelopeRod> rods, Keep keep, int room)
    : rods_(std::move(rods)), keep_(keep), room_(room) {
  check(rods_, room_);
  thinnest_ = rods_[0].radii[0];
  int nodes = 0, segments = 0;
  for (const EnvelopeRod& rod : rods_) {
    first_node_.push_back(nodes);
    first_segment_.push_back(segments);
    nodes += static_cast<int>(rod.radii.size()) * rod.pieces + 1;
    segments += static_cast<int>(rod.radii.size());
    for (const double radius : rod.radii) thinnest_ = std::min(thinnest_, radius);
  }
  count_.assign(nodes, 0);
  settled_.assign(nodes, 0);
  sagitta_.assign(segments, 0);
}

void EnvelopeOutcomes::clear() {
  std::fill(count_.begin(), count_.end(), 0);
  std::fill(settled_.begin(), settled_.end(), 0);
  std::fill(sagitta_.begin(), sagitta_.end(), 0);
  size_ = 0;
  reduced_ = false;
}

std::vector<EnvelopeOutcomes::Chord> EnvelopeOutcomes::chords() const {
  std::vector<Chord> chords;
  for (std::size_t r = 0; r < rods_.size(); ++r)
    for (std::size_t i = 0; i < rods_[r].radii.size(); ++i)
      for (int p = 0; p < rods_[r].pieces; ++p)
        chords.push_back({first_node_[r] + static_cast<int>(i) * rods_[r].pieces + p, rods_[r].radii[i],
                          sagitta_[first_segment_[r] + i]});
  return chords;
}

envelope::PointArrays EnvelopeOutcomes::places(int node) const {
  return {row(node, 0), row(node, 1), row(node, 2), (count_[node] + 15) / 16 * 16};
}

EnvelopeOutcomes EnvelopeOutcomes::only(std::span<const int> kept) const {
  EnvelopeOutcomes part(rods_, keep_, room_);
  part.sagitta_ = sagitta_;
  part.origin_ = origin_;
  part.size_ = static_cast<int>(kept.size());
  part.grow(part.size_);
  std::fill(part.count_.begin(), part.count_.end(), part.size_);
  for (int node = 0; node < nodes(); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      float* const to = part.row(node, axis);
      const float* const from = row(node, axis);
      for (int i = 0; i < part.size_; ++i) to[i] = from[kept[i]];
      for (int i = part.size_; i % 16; ++i) to[i] = to[0];
    }
  return part;
}

// ---------------------------------------------------------------- adding

Status EnvelopeOutcomes::add_frames(int outcomes, const Numbers& frames, const RunContext& context) {
  return append(outcomes, frames, Kind::frames, context);
}

Status EnvelopeOutcomes::add_points(int outcomes, const Numbers& points, const RunContext& context) {
  return append(outcomes, points, Kind::points, context);
}

Status EnvelopeOutcomes::add(const BatchResults& batch, int* added, const RunContext& context) {
  std::vector<int> solved;
  for (int k = 0; k < batch.size(); ++k)
    if (batch[k].ok()) solved.push_back(k);
  if (batch.size() > 0 && batch.rods() != static_cast<int>(rods_.size()))
    throw UsageError("envelope: outcomes of " + std::to_string(batch.rods()) + " rods, expected " +
                     std::to_string(rods_.size()));
  const int before = size_;
  const Status status = add_frames(
      static_cast<int>(solved.size()), [&](int outcome, int rod) { return batch.frames(solved[outcome], rod); }, context);
  if (added) *added = size_ - before;
  return status;
}

Status EnvelopeOutcomes::append(int outcomes, const Numbers& numbers, Kind kind, const RunContext& context) {
  if (outcomes < 0) throw UsageError("envelope: " + std::to_string(outcomes) + " outcomes to add, expected 0 or more");
  if (size_ == 0 && outcomes > 0) set_origin(numbers, kind);
  for (int done = 0; done < outcomes;) {
    if (const auto stop = context.stop()) return *stop;
    const int count = make_room(outcomes - done, context);
    append_block(done, count, numbers, kind, context);
    done += count;
  }
  return Status::solved;
}

// Single precision is about the middle of the first outcome.
void EnvelopeOutcomes::set_origin(const Numbers& numbers, Kind kind) {
  const std::size_t step = static_cast<std::size_t>(kind);
  Eigen::AlignedBox3d box;
  for (std::size_t r = 0; r < rods_.size(); ++r) {
    const std::span<const double> rod = numbers(0, static_cast<int>(r));
    for (std::size_t v = 0; v + step <= rod.size(); v += step) box.extend(Vec3(rod[v], rod[v + 1], rod[v + 2]));
  }
  origin_ = box.isEmpty() || !all_finite(box.center()) ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

void EnvelopeOutcomes::append_block(int first, int count, const Numbers& numbers, Kind kind, const RunContext& context) {
  constexpr int chunk = 32;
  const int chunks = (count + chunk - 1) / chunk;
  const int workers = std::max(1, std::min(thread_count(context.threads), chunks / 2));
  std::vector<std::vector<double>> sagitta(workers, std::vector<double>(sagitta_.size(), 0.0));
  std::atomic<int> next = 0;
  run_workers(workers, [&](int worker) {
    for (int c; (c = next++) < chunks;)
      for (int k = c * chunk; k < std::min(count, (c + 1) * chunk); ++k)
        for (int r = 0; r < static_cast<int>(rods_.size()); ++r)
          append_rod(first + k, k, r, numbers(first + k, r), kind, sagitta[worker].data());
  });
  for (const std::vector<double>& found : sagitta)
    for (std::size_t i = 0; i < found.size(); ++i) sagitta_[i] = std::max(sagitta_[i], found[i]);
  for (int node = 0; node < nodes(); ++node) {
    count_[node] += count;
    for (int axis = 0; axis < 3; ++axis) {
      float* const at = row(node, axis);
      for (int i = count_[node]; i % 16; ++i) at[i] = at[0];
    }
  }
  size_ += count;
}

void EnvelopeOutcomes::append_rod(int outcome, int column, int rod, std::span<const double> numbers, Kind kind,
                                  double* sagitta) {
  const std::size_t step = static_cast<std::size_t>(kind), segments = rods_[rod].radii.size();
  const auto who = [&] { return "envelope: outcome " + std::to_string(outcome + 1) + ", rod " + std::to_string(rod + 1); };
  if (numbers.size() != step * (segments + 1))
    throw UsageError(who() + ": got " + std::to_string(numbers.size()) + " numbers, expected " + std::to_string(step) +
                     " for each of " + std::to_string(segments + 1) + " vertices");
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!(std::abs(numbers[i]) <= Mesh::largest_coordinate))
      throw UsageError(who() + ", vertex " + std::to_string(i / step + 1) + ": the number " + number_text(numbers[i]) +
                       "; finite numbers within " + number_text(Mesh::largest_coordinate) + " are expected");
  int node = first_node_[rod];
  const auto put = [&](const Vec3& place) {
    const Vec3 local = place - origin_;
    for (int axis = 0; axis < 3; ++axis) row(node, axis)[count_[node] + column] = static_cast<float>(local[axis]);
    ++node;
  };
  const int pieces = rods_[rod].pieces;
  put({numbers[0], numbers[1], numbers[2]});
  for (std::size_t i = 0; i < segments; ++i) {
    const double *a = &numbers[step * i], *b = a + step;
    const Vec3 start(a[0], a[1], a[2]), finish(b[0], b[1], b[2]);
    if (kind == Kind::frames) {
      const envelope::ElementArc arc(a, b);
      double& bulge = sagitta[first_segment_[rod] + i];
      bulge = std::max(bulge, arc.sagitta(pieces));
      for (int p = 1; p < pieces; ++p) put(arc.at(static_cast<double>(p) / pieces));
    } else {
      for (int p = 1; p < pieces; ++p) put(start + (finish - start) * (static_cast<double>(p) / pieces));
    }
    put(finish);
  }
}

// ---------------------------------------------------------------- memory

// How many of `wanted` outcomes can be added at once: at least one.
int EnvelopeOutcomes::make_room(int wanted, const RunContext& context) {
  const auto used = [&] { return *std::max_element(count_.begin(), count_.end()); };
  const int most = keep_ == Keep::all ? wanted : std::min(wanted, room_ - used());
  if (used() + most > capacity_ && (keep_ == Keep::all || capacity_ < room_)) {
    const int doubled = std::max(64, 2 * capacity_), needed = used() + std::max(1, most);
    grow(keep_ == Keep::all ? std::max(needed, std::min(doubled, needed + 65536)) : std::min(room_, std::max(needed, doubled)));
  }
  if (used() == capacity_) {
    reduce(context);
    if (used() > capacity_ / 2) {
      room_ = 2 * capacity_;
      grow(room_);
    }
  }
  return std::min(wanted, capacity_ - used());
}

void EnvelopeOutcomes::grow(int capacity) {
  const std::size_t old_stride = stride();
  const std::unique_ptr<float[]> old = std::move(places_);
  capacity_ = (capacity + 15) / 16 * 16;
  places_.reset(new float[3 * stride() * count_.size()]);
  prefer_huge_pages(places_.get(), bytes());
  for (int node = 0; old && node < nodes(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      std::memcpy(row(node, axis), old.get() + (3 * static_cast<std::size_t>(node) + axis) * old_stride,
                  sizeof(float) * ((count_[node] + 15) / 16 * 16));
}

// Each node keeps the corners of its places' hull. Corners of an earlier hull stay unless they lie within the new one, so
// that what is left out lies within one tolerance of what is kept, however often this happens.
void EnvelopeOutcomes::reduce(const RunContext& context) {
  using namespace envelope;
  const Kernel& kernel = best_kernel();
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), nodes()), [&](int) {
    CloudHull hull;
    std::vector<Extreme> extremes(direction_pairs);
    std::vector<int> kept;
    for (int node; (node = next++) < nodes();) {
      kernel.extremes(places(node), directions(), extremes.data());
      const Cloud cloud{places(node), count_[node], extremes.data(), settled_[node]};
      hull.build(kernel, {&cloud, 1}, reduction_tolerance());
      kept.clear();
      if (!hull.thin()) {
        hull.corners_of(0, reduction_tolerance(), kept);
      } else if (hull.deviation() <= reduction_tolerance()) {
        // The two ends suffice, beside what was kept before.
        for (int i = 0; i < settled_[node]; ++i) kept.push_back(i);
        for (const Extreme& e : extremes)
          for (const int i : {e.low_index, e.high_index})
            if (i >= settled_[node]) kept.push_back(i);
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
      } else {
        continue;
      }
      for (std::size_t i = 0; i < kept.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) row(node, axis)[i] = row(node, axis)[kept[i]];
      count_[node] = settled_[node] = static_cast<int>(kept.size());
      for (int axis = 0; axis < 3; ++axis)
        for (int i = count_[node]; i % 16; ++i) row(node, axis)[i] = row(node, axis)[0];
    }
  });
  reduced_ = true;
}

}  // namespace tendril
