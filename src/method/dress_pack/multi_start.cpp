#include "method/dress_pack/multi_start.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <random>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"

namespace tendril::dress_pack {
namespace {

/// -1 ... 1, the same on every machine.
double even(std::mt19937_64& random) { return 2 * static_cast<double>(random() >> 11) / 9007199254740992.0 - 1; }

void check(const MultiStartOptions& options, const Robot& robot) {
  check(options.search, robot);
  if (options.starts < 1) throw UsageError("dress pack: " + std::to_string(options.starts) + " starts, expected at least 1");
  if (!(options.spread >= 0) || !std::isfinite(options.spread))
    throw UsageError("dress pack: starts that stray by " + number_text(options.spread) + " rad, expected at least 0");
}

/// What can be used of a search: its path was followed.
bool usable(const ReducedResult& result) { return result.path.points() > 0 && !result.after.steps.empty() && result.status != Status::infeasible; }

class Starts {
 public:
  Starts(const PackProblem& pack, const MultiStartOptions& options, const std::vector<JointPath>& paths, const RunContext& context)
      : pack_(pack), options_(options), paths_(paths), context_(context), found_(paths.size()) {}

  std::vector<ReducedResult> run() {
    const int count = static_cast<int>(paths_.size());
    run_workers(std::min(thread_count(context_.threads), count), [&](int) {
      for (int k = next_++; k < count; k = next_++) one(k);
    });
    return std::move(found_);
  }

 private:
  void one(int k) {
    RunContext own = context_;
    own.progress = nullptr;
    ReducedOptions search = options_.search;
    search.via = 0;
    found_[k] = optimise(pack_, paths_[k], search, own);
    const std::lock_guard<std::mutex> lock(report_);
    ++done_;
    if (context_.progress) context_.progress(done_ / static_cast<double>(paths_.size()), "starts");
  }

  const PackProblem& pack_;
  const MultiStartOptions& options_;
  const std::vector<JointPath>& paths_;
  const RunContext& context_;
  std::vector<ReducedResult> found_;
  std::atomic<int> next_{0};
  std::mutex report_;
  int done_ = 0;
};

StartReport report_of(const ReducedResult& found, const JointPath& start) {
  const double none = std::numeric_limits<double>::infinity();
  const bool use = usable(found);
  return {found.status, found.message, use ? found.objective_before : none, use ? found.objective : none, found.iterations, start};
}

}  // namespace

JointPath strayed(const JointPath& path, const Robot& robot, double spread, double seconds, std::uint64_t seed, int number) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(number)};
  std::mt19937_64 random(sequence);
  const int n = path.points(), joints = path.size();
  std::vector<JointVector> by(n, JointVector::Zero(joints));
  for (int i = 0; i < joints; ++i) {
    const double common = even(random);
    for (int k = 1; k + 1 < n; ++k) by[k][i] = spread * (2.0 / 3 * common * std::sin(units::pi * k / (n - 1)) + 1.0 / 3 * even(random));
  }
  // As far as the joints reach; then less of it all until the speeds are kept too.
  for (double share = 1; share > 1e-3; share *= 0.5) {
    std::vector<JointVector> via = path.via();
    for (int k = 1; k + 1 < n; ++k)
      for (int i = 0; i < joints; ++i) via[k][i] = std::clamp(via[k][i] + share * by[k][i], robot.lower()[i], robot.upper()[i]);
    JointPath out(std::move(via));
    if (beyond_robot(out, robot, seconds).empty()) return out;
  }
  return path;
}

MultiStartResult optimise_from_starts(const PackProblem& pack, const JointPath& given, const MultiStartOptions& options,
                                      const RunContext& context) {
  pack.check();
  check(options, *pack.robot);
  const auto begin = std::chrono::steady_clock::now();
  const JointPath path = options.search.via > 0 ? given.resampled(options.search.via) : given;
  std::vector<JointPath> paths{path};
  const bool strays = beyond_robot(path, *pack.robot, options.search.seconds).empty() && path.points() > 2;
  for (int k = 1; strays && k < options.starts; ++k)
    paths.push_back(strayed(path, *pack.robot, options.spread, options.search.seconds, context.seed, k));
  const std::vector<ReducedResult> found = Starts(pack, options, paths, context).run();
  MultiStartResult out;
  for (std::size_t k = 0; k < found.size(); ++k) {
    out.starts.push_back(report_of(found[k], paths[k]));
    if (out.starts[k].objective < out.starts[out.best].objective) out.best = static_cast<int>(k);
  }
  static_cast<ReducedResult&>(out) = found[out.best];
  if (out.best > 0 && !found[0].before.steps.empty()) {
    out.before = found[0].before;
    out.objective_before = out.starts[0].objective_before;
  }
  if (const auto why = context.stop()) {
    out.status = *why;
    out.message = *why == Status::timeout ? "out of time; this is the best path so far" : "interrupted; this is the best path so far";
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace tendril::dress_pack
