// What scripts see of variation studies and stability analyses.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "method/stability/stability.h"
#include "method/variation/whole_study.h"

namespace tendril::lua {

/// A study with its outcomes; the parts below share it.
struct VariationHandle {
  std::shared_ptr<const variation::Result> result;
};

/// One measure of a study: a sample with its statistics.
struct MeasuredHandle {
  std::shared_ptr<const variation::Result> result;
  int measure = 0;
  std::shared_ptr<const variation::Sample> sample;
};

/// The table of outcomes of a study, and one row of it.
struct OutcomesHandle {
  std::shared_ptr<const variation::Result> result;
};
struct OutcomeHandle {
  std::shared_ptr<const variation::Result> result;
  int outcome = 0;  ///< counted from 0
};

/// A stability analysis and the equilibrium that it is about.
struct StabilityHandle {
  std::shared_ptr<SceneEquilibrium> equilibrium;
  stability::Result result;
};

/// An estimate that computes as a number and knows its interval.
struct EstimateValue {
  variation::Estimate estimate;
  std::string unit;
  double value() const { return estimate.value; }
};

template <> inline constexpr const char* class_name<VariationHandle> = "variation";
template <> inline constexpr const char* class_name<MeasuredHandle> = "measured";
template <> inline constexpr const char* class_name<OutcomesHandle> = "outcomes";
template <> inline constexpr const char* class_name<OutcomeHandle> = "outcome";
template <> inline constexpr const char* class_name<EstimateValue> = "estimate";
template <> inline constexpr const char* class_name<variation::Contributor> = "contributor";
template <> inline constexpr const char* class_name<StabilityHandle> = "stability";

}  // namespace tendril::lua
