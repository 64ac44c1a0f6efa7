// How an accuracy study prints and what its chart shows.
#pragma once

#include <string>
#include <vector>

#include "scene/accuracy.h"
#include "view/chart.h"

namespace tendril {

/// A table: segments, error, order, time, iterations, and the estimate when there is one.
std::string accuracy_table(const Accuracy& accuracy);

/// Error (m) against run time (ms), both logarithmic; one line a study. Throws UsageError when no study has a point.
Chart accuracy_chart(const std::vector<Accuracy>& studies, const std::string& title);

}  // namespace tendril
