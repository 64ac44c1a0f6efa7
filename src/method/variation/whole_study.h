// A whole variation study: all outcomes, divided among processes where there are several, kept in a file where one is wanted.
#pragma once

#include <memory>
#include <string>

#include "method/variation/study.h"

namespace tendril::variation {

struct Result {
  bool ok = false;          ///< every outcome has its measures
  Status status = Status::stalled;  ///< solved: none is left unsolved, though some may have failed or jumped
  std::string message;      ///< "1000 outcomes, 3 failed (12, 77, 512), 1 jumped (901)"
  double seconds = 0;
  std::shared_ptr<const Study> study;
  Outcomes outcomes;
};

/// Throws UsageError as Study does, and as Store does for a file `store` (empty: none), whose outcomes are not computed again.
/// `on_outcome` is called for the outcomes that this process computes. Of several processes (base/processes.h) each computes a
/// share of the outcomes, and all of them return the same result; the first one keeps the file.
Result run(const Scene& scene, const Options& options, const OnOutcome& on_outcome = {}, const RunContext& context = {},
           const std::string& store = {});

/// "1000 outcomes, 3 failed (12, 77, 512), 1 jumped (901)", counted from 1.
std::string summary(const Outcomes& outcomes);

}  // namespace tendril::variation
