#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace tendril {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
  std::vector<std::vector<int>> cost(n + 1, std::vector<int>(m + 1));
  for (int i = 0; i <= n; ++i) cost[i][0] = i;
  for (int j = 0; j <= m; ++j) cost[0][j] = j;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= m; ++j) {
      const int replaced = cost[i - 1][j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[n][m];
}

std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 64;  // beyond this it is no slip of the fingers, and the table would be large
  if (wanted.empty() || wanted.size() > longest) return {};
  std::string best;
  int least = std::max<int>(1, static_cast<int>(wanted.size()) / 3) + 1;
  for (const std::string& name : names) {
    if (name.size() > longest) continue;
    const int distance = edit_distance(wanted, name);
    if (distance < least) {
      least = distance;
      best = name;
    }
  }
  return best;
}

std::string unknown_name(std::string_view wanted, const char* kind, const std::vector<std::string>& names) {
  std::string text = "'" + std::string(wanted) + "'";
  if (names.empty()) return text + " (there are no " + kind + ")";
  const std::string near = nearest_name(wanted, names);
  if (!near.empty()) text += "; did you mean '" + near + "'?";
  text += " (" + std::string(kind) + ":";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i ? ", " : " ") + names[i];
  return text + ")";
}

}  // namespace tendril
