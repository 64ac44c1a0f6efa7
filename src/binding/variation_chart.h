// Charts and columns of a variation study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/variation/whole_study.h"
#include "view/chart.h"

namespace tendril {

/// All values of a variable's component or a measure, an outcome each, in order; NaN where there is none. Throws UsageError with the
/// nearest name.
std::vector<double> column_of(const variation::Result& result, const std::string& name);

/// How often which values of a measure occur; a line at `limit`, and at the nominal value.
Chart histogram_of(const variation::Result& result, int measure, const std::string& title, std::optional<double> limit);

/// A measure over a variable's component or another measure.
Chart scatter_of(const variation::Result& result, int measure, const std::string& over);

}  // namespace tendril
