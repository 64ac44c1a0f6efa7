// Which variable is to blame: shares of a measure's variance.
#pragma once

#include <string>
#include <vector>

#include "method/variation/statistics.h"

namespace tendril::variation {

/// What one variable, or one correlated group, contributes to a measure's variance. Shares are of the whole variance; NaN where
/// they are not known.
struct Contributor {
  std::string name;         ///< "hose.length"; of a group: its variables with " + " between
  std::vector<int> columns; ///< components, by their numbers in Outcomes::variables()
  /// First order by the exact gradient at the nominal design: g' C g of its own components over that of all.
  double linear = std::numeric_limits<double>::quiet_NaN();
  /// By linear regression over the outcomes: the share of the variance that its components explain.
  double regression = std::numeric_limits<double>::quiet_NaN();
  /// Sobol' indices (Jansen's estimators; Comput. Phys. Commun. 117, 1999): what it explains by itself, and with all its
  /// interactions.
  Estimate first, total;
};

/// The contributors to one measure, largest first (by total effect, else by regression, else by the linear share).
struct Contributions {
  std::vector<Contributor> all;
  double linear_deviation = std::numeric_limits<double>::quiet_NaN();  ///< sqrt(g' C g): what the tolerances make to first order
  double explained = std::numeric_limits<double>::quiet_NaN();  ///< share of the variance that the regression explains (R^2)
  std::string message;  ///< why the gradient is not known; else empty
};

}  // namespace tendril::variation
