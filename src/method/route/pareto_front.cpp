#include "method/route/pareto_front.h"

#include <algorithm>
#include <limits>

namespace tendril::route {

std::vector<int> pareto_front(const std::vector<Route>& routes) {
  std::vector<int> by_length;
  for (int i = 0; i < static_cast<int>(routes.size()); ++i)
    if (routes[i].ok) by_length.push_back(i);
  std::stable_sort(by_length.begin(), by_length.end(), [&](int a, int b) {
    if (routes[a].length() != routes[b].length()) return routes[a].length() < routes[b].length();
    return routes[a].clearance() > routes[b].clearance();
  });
  std::vector<int> front;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const int i : by_length) {
    if (!(routes[i].clearance() > farthest)) continue;
    farthest = routes[i].clearance();
    front.push_back(i);
  }
  return front;
}

}  // namespace tendril::route
