// The steps that a method reports: their names are those of the thesis.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace tendril {

/// One line of a result's steps.
struct MethodStep {
  std::string name;
  double seconds = 0;
  std::vector<std::pair<std::string, long>> counts;
};

/// Times steps one after the other into a result's list.
class StepClock {
 public:
  explicit StepClock(std::vector<MethodStep>& steps) : steps_(steps) {}

  /// The step that began when the last one ended is over.
  void end(std::string name, std::vector<std::pair<std::string, long>> counts) {
    const Clock::time_point now = Clock::now();
    steps_.push_back({std::move(name), std::chrono::duration<double>(now - last_).count(), std::move(counts)});
    last_ = now;
  }
  double seconds() const { return std::chrono::duration<double>(last_ - start_).count(); }  ///< of all steps that are over

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<MethodStep>& steps_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace tendril
