#include "method/assembly/robustness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "base/parallel.h"
#include "base/units.h"
#include "method/assembly/path_smoothing.h"

namespace tendril::assembly {

namespace {

constexpr double astray = 0.25;  // radii
constexpr int waves = 3, least_times = 48;
// Of the common time: how long grips take to get astray, and to get back.
constexpr double getting_there = 0.1;

/// A smooth way near the origin from the origin and back to it in a time of 1, never farther away than 1.
class Stray {
 public:
  explicit Stray(std::mt19937_64& random) {
    const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    double sum = 0;
    for (Wave& wave : waves_) {
      // A direction is drawn from the ball, so that none is preferred.
      do {
        for (int k = 0; k < 3; ++k) wave.direction[k] = 2 * share() - 1;
      } while (wave.direction.norm() > 1 || wave.direction.norm() < 0.1);
      wave.direction.normalize();
      wave.size = 0.2 + share();
      wave.phase = 2 * units::pi * share();
      sum += wave.size;
    }
    for (Wave& wave : waves_) wave.size /= sum;
  }

  Vec3 operator()(double t) const {
    const double edge = std::clamp(std::min(t, 1 - t) / getting_there, 0.0, 1.0);
    Vec3 away = Vec3::Zero();
    for (int i = 0; i < waves; ++i) away += waves_[i].size * std::sin(2 * units::pi * (i + 1) * t + waves_[i].phase) * waves_[i].direction;
    return edge * edge * (3 - 2 * edge) * away;
  }

 private:
  struct Wave {
    Vec3 direction;
    double size, phase;
  };
  std::array<Wave, waves> waves_;
};

/// The times of a manipulation and others in between, so that none are far apart.
std::vector<double> dense_times(const Manipulation& manipulation) {
  std::vector<double> times = manipulation.times;
  for (int i = 1; i < least_times; ++i) times.push_back(double(i) / least_times);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

Manipulation led_astray(const Manipulation& manipulation, double most, std::uint64_t seed, int number) {
  std::seed_seq both{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(number)};
  std::mt19937_64 random(both);
  Manipulation out;
  out.grips = manipulation.grips;
  out.times = dense_times(manipulation);
  for (std::size_t g = 0; g < out.grips.size(); ++g) {
    const Stray stray(random);
    std::vector<Frame>& poses = out.poses.emplace_back();
    for (const double t : out.times) {
      poses.push_back(manipulation.pose(static_cast<int>(g), t));
      poses.back().at += most * stray(t);
    }
  }
  return out;
}

Robustness robustness(const InstalledSystem& system, const Manipulation& manipulation, const Prove& prove, int replays, const RunContext& context) {
  Robustness result;
  result.replays = std::max(0, replays);
  result.failures.resize(result.replays);
  RunContext alone = context;
  alone.threads = 1;
  alone.progress = nullptr;
  const int workers = std::min(result.replays, thread_count(context.threads));
  run_workers(workers, [&](int worker) {
    for (int number = worker; number < result.replays; number += workers) {
      if (const auto stopped = context.stop()) {
        result.failures[number] = name_of(*stopped);
        continue;
      }
      const Played played = prove(kept_clear(system, led_astray(manipulation, astray * system.radius, context.seed, number)), alone);
      if (!played.proof.ok) result.failures[number] = played.proof.message.empty() ? "not proven" : played.proof.message;
    }
  });
  result.arrived = static_cast<int>(std::count(result.failures.begin(), result.failures.end(), std::string()));
  return result;
}

}  // namespace tendril::assembly
