#include "method/variation/branch_check.h"

#include <algorithm>

namespace tendril::variation {
namespace {

constexpr double share_of_move = 0.25;
constexpr double share_of_length = 0.02;  // what a step of a motion may move a vertex by (statics/motion.h)

}  // namespace

BranchCheck::BranchCheck(Positions nominal, std::vector<double> nominal_values, std::vector<Positions> by_unit,
                         std::vector<double> lengths)
    : nominal_(std::move(nominal)), nominal_values_(std::move(nominal_values)), by_unit_(std::move(by_unit)),
      lengths_(std::move(lengths)) {}

bool BranchCheck::suspicious(std::span<const double> values, const Positions& at, const Positions* half_way) const {
  const int vertices = static_cast<int>(nominal_.size());
  double largest_move = 0, largest_miss = 0;  // of the rod's length
  for (int i = 0; i < vertices; ++i) {
    Vec3 move = Vec3::Zero();
    for (std::size_t c = 0; c < by_unit_.size(); ++c)
      if (!by_unit_[c].empty()) move += (values[c] - nominal_values_[c]) * by_unit_[c][i];
    Vec3 miss = at[i] - nominal_[i] - move;
    if (half_way) miss -= 4 * ((*half_way)[i] - nominal_[i] - 0.5 * move);
    largest_move = std::max(largest_move, move.norm() / lengths_[i]);
    largest_miss = std::max(largest_miss, miss.norm() / lengths_[i]);
  }
  return !(largest_miss <= share_of_length + share_of_move * largest_move);
}

}  // namespace tendril::variation
