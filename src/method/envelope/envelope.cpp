#include "method/envelope/envelope.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "method/envelope/blocks.h"
#include "method/envelope/cavities.h"
#include "method/envelope/directions.h"
#include "method/envelope/field.h"
#include "method/envelope/hulls.h"
#include "method/envelope/marching_cubes.h"
#include "method/envelope/share.h"

namespace tendril {

using namespace envelope;

namespace {

using Chord = EnvelopeOutcomes::Chord;

void check(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options) {
  if (outcomes.size() == 0) throw UsageError("envelope: no outcomes; at least one expected");
  if (!(std::isfinite(options.voxel) && options.voxel > 0))
    throw UsageError("envelope: the voxel is " + number_text(options.voxel) + " m; a finite length above 0 is expected");
  double thinnest = INFINITY;
  for (const Chord& chord : outcomes.chords()) thinnest = std::min(thinnest, chord.radius);
  if (options.voxel > thinnest * (1 + 1e-9))
    throw UsageError("envelope: a voxel of " + number_text(1e3 * options.voxel) + " mm for a rod of radius " +
                     number_text(1e3 * thinnest) + " mm; expected at most the radius, better half of it");
  if (!(options.share > 0 && options.share <= 1))
    throw UsageError("envelope: the share is " + number_text(options.share) + "; expected above 0 and at most 1");
  if (options.share < 1 && outcomes.keep() != EnvelopeOutcomes::Keep::all)
    throw UsageError("envelope: a share of " + number_text(options.share) +
                     " needs the places of all outcomes, but only their hulls are kept; collect them with Keep::all");
  if (!(options.memory > 0))
    throw UsageError("envelope: " + number_text(options.memory) + " bytes of memory are allowed; expected above 0");
}

EnvelopeOutcomes without_the_most_unusual(const EnvelopeOutcomes& outcomes, double share, const RunContext& context,
                                          std::vector<int>& left_out) {
  const std::vector<int> kept = most_usual(outcome_scores(outcomes, context), share);
  for (int i = 0, next = 0; i < outcomes.size(); ++i) {
    if (next < static_cast<int>(kept.size()) && kept[next] == i) ++next;
    else left_out.push_back(i);
  }
  return outcomes.only(kept);
}

}  // namespace

struct EnvelopeBuilder::Scratch {
  const Kernel* kernel = &best_kernel();
  std::vector<Extreme> extremes;       ///< by node and direction
  std::vector<CloudHull> cloud_hulls;  ///< by worker
  std::vector<SweptHull> hulls;        ///< by chord
  BlockMap map;
  Field field;
  MarchingCubes cubes;

  double extent = 0;    ///< m: largest coordinate about the origin, radii included
  double rounding = 0;  ///< m: above the rounding of a field value

  std::optional<Status> find_extremes(const EnvelopeOutcomes& outcomes, const RunContext& context);
  std::optional<Status> build_hulls(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options,
                                    const RunContext& context, Envelope& result);
  std::optional<Status> build_surface(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options,
                                      const RunContext& context, Envelope& result);
  std::optional<Status> build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options, const RunContext& context,
                              Envelope& result);
  std::size_t bytes() const;
};

namespace {

/// Appends a step's name and seconds when it goes out of scope.
class StepClock {
 public:
  StepClock(Envelope& result, const char* name, const RunContext& context, double share)
      : result_(result), name_(name), begun_(RunContext::Clock::now()) {
    if (context.progress) context.progress(share, name);
  }
  ~StepClock() {
    result_.steps.push_back({name_, std::chrono::duration<double>(RunContext::Clock::now() - begun_).count()});
  }
  StepClock(const StepClock&) = delete;

 private:
  Envelope& result_;
  const char* name_;
  RunContext::Clock::time_point begun_;
};

}  // namespace

std::size_t EnvelopeBuilder::Scratch::bytes() const {
  std::size_t bytes = extremes.capacity() * sizeof(Extreme) + map.bytes() + field.bytes();
  for (const SweptHull& hull : hulls) bytes += hull.bytes();
  return bytes;
}

std::optional<Status> EnvelopeBuilder::Scratch::find_extremes(const EnvelopeOutcomes& outcomes, const RunContext& context) {
  const int nodes = outcomes.nodes();
  extremes.resize(static_cast<std::size_t>(nodes) * direction_pairs);
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), nodes), [&](int) {
    for (int node; (node = next++) < nodes && !context.stop();)
      kernel->extremes(outcomes.places(node), directions(), &extremes[static_cast<std::size_t>(node) * direction_pairs]);
  });
  if (const auto stop = context.stop()) return stop;
  extent = 0;
  for (int node = 0; node < nodes; ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const Extreme& e = extremes[static_cast<std::size_t>(node) * direction_pairs + axis];
      extent = std::max<double>({extent, std::abs(e.low), std::abs(e.high)});
    }
  return std::nullopt;
}

std::optional<Status> EnvelopeBuilder::Scratch::build_hulls(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options,
                                                            const RunContext& context, Envelope& result) {
  const std::vector<Chord> chords = outcomes.chords();
  const int count = static_cast<int>(chords.size());
  double thickest = 0;
  for (const Chord& chord : chords) thickest = std::max(thickest, chord.radius + chord.sagitta);
  extent += thickest + 8 * options.voxel;
  rounding = 1e-6 * extent;
  if (rounding > 0.125 * options.voxel)
    throw UsageError("envelope: the outcomes lie within " + number_text(extent) + " m of each other, which a voxel of " +
                     number_text(1e3 * options.voxel) + " mm cannot resolve in single precision; expected a voxel of at least " +
                     number_text(8e3 * rounding) + " mm");
  const double h = options.voxel;
  const auto margin = [&](const Chord& chord) {
    const double r = chord.radius + chord.sagitta;
    return std::sqrt(r * r + 0.75 * h * h) - r + Field::nearest_to_end * h + rounding + outcomes.reduction();
  };
  if (static_cast<int>(hulls.size()) < count) hulls.resize(count);
  const int workers = std::min(thread_count(context.threads), count);
  cloud_hulls.resize(std::max<std::size_t>(cloud_hulls.size(), workers));
  std::atomic<int> next = 0;
  run_workers(workers, [&](int worker) {
    CloudHull& cloud_hull = cloud_hulls[worker];
    for (int i; (i = next++) < count && !context.stop();) {
      Cloud clouds[2];
      for (int end = 0; end < 2; ++end) {
        const int node = chords[i].node + end;
        clouds[end] = {outcomes.places(node), outcomes.place_count(node),
                       &extremes[static_cast<std::size_t>(node) * direction_pairs]};
      }
      cloud_hull.build(*kernel, clouds, h / 32);
      hulls[i].build(cloud_hull, clouds, *kernel, chords[i].radius + chords[i].sagitta + margin(chords[i]));
    }
  });
  if (const auto stop = context.stop()) return stop;
  result.hulls = count;
  result.planes = 0;
  for (int i = 0; i < count; ++i) {
    result.planes += hulls[i].plane_count();
    result.margin = std::max(result.margin, margin(chords[i]));
    result.sagitta = std::max(result.sagitta, chords[i].sagitta);
  }
  return std::nullopt;
}

std::optional<Status> EnvelopeBuilder::Scratch::build_surface(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options,
                                                              const RunContext& context, Envelope& result) {
  const float slack = static_cast<float>(rounding);
  {
    const StepClock clock(result, "blocks", context, 0.4);
    map.plan(hulls, result.hulls, options.voxel, options.memory);
    if (const auto stop = map.fill(hulls, result.hulls, slack, options.memory, *kernel, context)) return stop;
    result.blocks = map.blocks();
  }
  {
    const StepClock clock(result, "field", context, 0.6);
    if (const auto stop = field.evaluate(map, hulls, slack, *kernel, context)) return stop;
  }
  {
    const StepClock clock(result, "cavities", context, 0.8);
    result.cavities = fill_cavities(map, field);
  }
  const StepClock clock(result, "marching_cubes", context, 0.85);
  cubes.count(field, context);
  if (const auto stop = context.stop()) return stop;
  const double bytes = sizeof(Vec3) * static_cast<double>(cubes.vertices()) + 12.0 * static_cast<double>(cubes.triangles());
  if (bytes > options.memory || cubes.triangles() >= (1u << 30))
    throw UsageError("envelope: a voxel of " + number_text(1e3 * options.voxel) + " mm gives " +
                     number_text(1e-6 * static_cast<double>(cubes.triangles())) + " million triangles, " +
                     number_text(bytes / 1e9) + " GB; " + number_text(options.memory / 1e9) +
                     " GB are allowed; take a larger voxel, or allow more memory");
  if (const auto stop = cubes.write(map, field, outcomes.origin(), result.mesh, context)) return stop;
  result.volume = volume_of(result.mesh, context);
  return context.stop();
}

std::optional<Status> EnvelopeBuilder::Scratch::build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options,
                                                      const RunContext& context, Envelope& result) {
  {
    const StepClock clock(result, "supports", context, 0);
    if (const auto stop = find_extremes(outcomes, context)) return stop;
  }
  {
    const StepClock clock(result, "hulls", context, 0.1);
    if (const auto stop = build_hulls(outcomes, options, context, result)) return stop;
  }
  return build_surface(outcomes, options, context, result);
}

EnvelopeBuilder::EnvelopeBuilder() : scratch_(std::make_unique<Scratch>()) {}
EnvelopeBuilder::~EnvelopeBuilder() = default;
EnvelopeBuilder::EnvelopeBuilder(EnvelopeBuilder&&) noexcept = default;
EnvelopeBuilder& EnvelopeBuilder::operator=(EnvelopeBuilder&&) noexcept = default;

void EnvelopeBuilder::use(const Kernel& kernel) { scratch_->kernel = &kernel; }

Envelope EnvelopeBuilder::build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options, const RunContext& context) {
  Envelope result;
  build(outcomes, options, context, result);
  return result;
}

void EnvelopeBuilder::build(const EnvelopeOutcomes& outcomes, const EnvelopeOptions& options, const RunContext& context,
                            Envelope& result) {
  check(outcomes, options);
  const auto begun = RunContext::Clock::now();
  Mesh mesh = std::move(result.mesh);
  result = Envelope{};
  result.mesh = std::move(mesh);
  result.mesh.name = "envelope";
  result.voxel = options.voxel;
  std::optional<Status> stop;
  if (options.share < 1) {
    std::optional<EnvelopeOutcomes> part;
    {
      const StepClock clock(result, "share", context, 0);
      part = without_the_most_unusual(outcomes, options.share, context, result.left_out);
    }
    stop = context.stop();
    if (!stop) stop = scratch_->build(*part, options, context, result);
  } else {
    stop = scratch_->build(outcomes, options, context, result);
  }
  result.outcomes = outcomes.size() - static_cast<int>(result.left_out.size());
  if (stop) {
    result.status = *stop;
    result.mesh.vertices.clear();
    result.mesh.triangles.clear();
    result.volume = 0;
  }
  result.scratch_bytes = scratch_->bytes();
  result.seconds = std::chrono::duration<double>(RunContext::Clock::now() - begun).count();
}

}  // namespace tendril
