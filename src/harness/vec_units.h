// Quantities of a VEC file: a number and a reference to one of the file's own units.
#pragma once

#include <optional>

#include "harness/xml_file.h"

namespace tendril {

/// Metres and kilograms to these powers, and what one of the unit is in them.
struct VecUnit {
  double factor = 1;
  double metres = 0, kilograms = 0;
  bool measures(const VecUnit& other) const { return metres == other.metres && kilograms == other.kilograms; }
};
constexpr VecUnit vec_length{1, 1, 0}, vec_area{1, 2, 0}, vec_mass_per_length{1, -1, 1};

class VecUnits {
 public:
  explicit VecUnits(const XmlFile& file) : file_(file) {}

  /// Of a NumericalValue `value`, in SI units; 0 where there is none. Throws, at its line, for a unit that is missing, measures
  /// something else than `wanted`, or is made of others than metres and grams.
  double value(XmlFile::Node value, const VecUnit& wanted) const;

  /// Whether the unit of `value` measures what is `wanted`.
  bool fits(XmlFile::Node value, const VecUnit& wanted) const;

  /// The factor to SI units of the unit that `from` refers to by `id`. Throws as value() does.
  double factor(XmlFile::Node from, std::string_view id, const VecUnit& wanted) const;

 private:
  std::optional<VecUnit> si_unit(XmlFile::Node unit) const;
  std::optional<VecUnit> unit(XmlFile::Node unit) const;

  const XmlFile& file_;
};

}  // namespace tendril
