// The time of a method's step and what it counts, over all its runs.
#pragma once

#include "base/run_context.h"
#include "method/step.h"

namespace tendril::assembly {

class Stage {
 public:
  Stage(MethodStep& step, const char* what) : step_(step) {
    if (step_.counts.empty()) step_.counts.push_back({what, 0});
    ++step_.counts.front().second;
  }
  ~Stage() { step_.seconds += seconds(); }
  double seconds() const { return std::chrono::duration<double>(RunContext::Clock::now() - start_).count(); }

 private:
  MethodStep& step_;
  const RunContext::Clock::time_point start_ = RunContext::Clock::now();
};

}  // namespace tendril::assembly
