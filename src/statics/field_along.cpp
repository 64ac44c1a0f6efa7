#include "statics/field_along.h"

#include <algorithm>

namespace tendril {

FieldAlong::FieldAlong(const ContactField& all, const std::vector<SparedStretch>& spared) : all_(&all) {
  std::vector<double> borders;
  for (const SparedStretch& one : spared) borders.insert(borders.end(), {one.from, one.to});
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double middle = 0.5 * (borders[i] + borders[i + 1]);
    std::vector<int> obstacles;
    for (const SparedStretch& one : spared)
      if (one.from < middle && middle < one.to) obstacles.push_back(one.obstacle);
    if (!obstacles.empty()) parts_.push_back({borders[i], borders[i + 1], all.without(obstacles)});
  }
}

const ContactField& FieldAlong::at(double s) const {
  for (const Part& part : parts_)
    if (s >= part.from && s <= part.to) return *part.field;
  return *all_;
}

const ContactField& FieldAlong::between(double a, double b) const {
  const ContactField& first = at(a);
  return &first == all_ ? at(b) : first;
}

}  // namespace tendril
