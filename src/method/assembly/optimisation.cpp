#include "method/assembly/optimisation.h"

#include <algorithm>
#include <chrono>
#include <random>

#include "method/assembly/path_smoothing.h"

namespace tendril::assembly {

namespace {

// A shorter path is worth its play from this share on.
constexpr double least_gain = 1e-3;
// Shares of the common time over which paths are averaged, and the longest part that becomes straight.
constexpr double windows[] = {0.2, 0.4};
constexpr double longest_straight = 0.5;

Manipulation without(const Manipulation& manipulation, std::size_t grip) {
  Manipulation fewer = manipulation;
  fewer.grips.erase(fewer.grips.begin() + grip);
  fewer.poses.erase(fewer.poses.begin() + grip);
  return fewer;
}

/// All grips go straight between two times.
Manipulation straightened(const Manipulation& manipulation, double from, double to) {
  Manipulation straight = manipulation;
  for (std::size_t g = 0; g < manipulation.grips.size(); ++g) {
    const Frame a = manipulation.pose(static_cast<int>(g), from), b = manipulation.pose(static_cast<int>(g), to);
    for (std::size_t i = 0; i < manipulation.times.size(); ++i) {
      const double t = manipulation.times[i];
      if (t <= from || t >= to) continue;
      const double share = (t - from) / (to - from);
      straight.poses[g][i] = {a.at + share * (b.at - a.at), a.rotation.slerp(share, b.rotation)};
    }
  }
  return straight;
}

class Optimiser {
 public:
  Optimiser(const InstalledSystem& system, const Manipulation& manipulation, Played played, const Prove& prove, int tries, double seconds,
            const RunContext& context)
      : system_(system), prove_(prove), tries_(tries), context_(context), best_{manipulation, std::move(played), 0, 0} {
    const auto until = RunContext::Clock::now() + std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(seconds));
    if (!context_.deadline || until < *context_.deadline) context_.deadline = until;
  }

  Optimised run() {
    leave_out_grips();
    for (const double window : windows) try_shorter(smoothed(system_, best_.manipulation, window));
    std::mt19937_64 random(context_.seed);
    while (!over()) {
      const double length = longest_straight * share_of(random), from = (1 - length) * share_of(random);
      try_shorter(straightened(best_.manipulation, from, from + length));
    }
    return std::move(best_);
  }

 private:
  bool over() const { return best_.tried >= tries_ || context_.stop().has_value(); }
  static double share_of(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

  void leave_out_grips() {
    for (std::size_t g = best_.manipulation.grips.size(); g-- > 0;)
      if (!best_.manipulation.grips[g].connection) try_out(without(best_.manipulation, g));
  }

  void try_shorter(const Manipulation& manipulation) {
    const double gain = path_length(best_.manipulation) - path_length(manipulation);
    // One that gains nothing costs no play, but counts: the search ends.
    if (gain > least_gain * path_length(best_.manipulation)) try_out(manipulation);
    else ++best_.tried;
  }

  void try_out(const Manipulation& manipulation) {
    if (over()) return;
    ++best_.tried;
    Played played = prove_(manipulation, context_);
    const double enough = std::min(best_.played.proof.clearance, system_.radius) - 1e-3 * system_.radius;
    if (!played.proof.ok || played.proof.clearance < enough) return;
    ++best_.accepted;
    best_.manipulation = manipulation;
    best_.played = std::move(played);
  }

  const InstalledSystem& system_;
  const Prove& prove_;
  int tries_;
  RunContext context_;
  Optimised best_;
};

}  // namespace

double path_length(const Manipulation& manipulation) {
  double length = 0;
  for (const std::vector<Frame>& path : manipulation.poses)
    for (std::size_t i = 1; i < path.size(); ++i) length += travel(path[i - 1], path[i]);
  return length;
}

Optimised optimised(const InstalledSystem& system, const Manipulation& manipulation, Played played, const Prove& prove, int tries,
                    double seconds, const RunContext& context) {
  return Optimiser(system, manipulation, std::move(played), prove, tries, seconds, context).run();
}

}  // namespace tendril::assembly
