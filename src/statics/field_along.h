// What a rod meets along itself: its surroundings, without what it is fastened to near where it is.
#pragma once

#include <memory>
#include <vector>

#include "statics/contact_field.h"

namespace tendril {

/// A stretch of a rod, in arc lengths (m), that an obstacle does not act on.
struct SparedStretch {
  int obstacle = 0;
  double from = 0, to = 0;
};

/// Cheap to copy. `all` must outlive it.
class FieldAlong {
 public:
  FieldAlong(const ContactField& all) : all_(&all) {}  // NOLINT: a field is the same all along
  FieldAlong(const ContactField& all, const std::vector<SparedStretch>& spared);

  const ContactField& all() const { return *all_; }

  /// Obstacles have the numbers of all().
  const ContactField& at(double s) const;
  /// For what lies between two places: that of the one that meets less.
  const ContactField& between(double a, double b) const;

 private:
  struct Part {
    double from, to;
    std::shared_ptr<const ContactField> field;
  };
  const ContactField* all_;
  std::vector<Part> parts_;  ///< in order; between them all() holds
};

}  // namespace tendril
