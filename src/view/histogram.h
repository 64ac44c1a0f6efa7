// Bins for a histogram.
#pragma once

#include <cstddef>
#include <vector>

namespace tendril {

struct Histogram {
  std::vector<double> edges;        ///< counts.size() + 1, ascending
  std::vector<std::size_t> counts;  ///< values in [edge, next edge), the last bin closed
};

/// Bins over the range of the finite `values` (at least one). `bins` > 0: that many. 0: by Freedman and Diaconis
/// (1981), width 2 IQR / n^(1/3), where the quartiles agree by Sturges, and always 1 ... 200. Equal values share one
/// bin about them.
Histogram histogram_of(std::vector<double> values, int bins = 0);

}  // namespace tendril
