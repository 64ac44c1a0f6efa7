// Quantities of a VEC file: a number and a reference to one of the file's own units.
#pragma once

#include "harness/xml_file.h"

namespace tendril {

class VecUnits {
 public:
  explicit VecUnits(const XmlFile& file) : file_(file) {}

  /// Of a NumericalValue `value`, which measures m to the power of `dimension` (1: a length, 2: an area), in SI units. Throws, at its
  /// line, for a unit that is missing, measures something else, or is no SI unit.
  double value(XmlFile::Node value, int dimension) const;

  /// m to the power of `dimension` in the unit that `from` refers to by `id`.
  double factor(XmlFile::Node from, std::string_view id, int dimension) const;

 private:
  const XmlFile& file_;
};

}  // namespace tendril
