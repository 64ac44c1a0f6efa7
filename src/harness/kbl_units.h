// Quantities of a KBL file: a number and a reference to the file's own table of units.
#pragma once

#include <string>

#include "harness/xml_file.h"

namespace tendril {

enum class Quantity { length, area, mass_per_length };

class KblUnits {
 public:
  explicit KblUnits(const XmlFile& file) : file_(file) {}

  /// The quantity in `owner`'s child `name` in SI units; 0 where there is no such child. Throws, at its line, for a unit that is
  /// missing or measures something else.
  double value(XmlFile::Node owner, const char* name, Quantity quantity) const;

  /// False where there is such a child and its unit measures something else.
  bool fits(XmlFile::Node owner, const char* name, Quantity quantity) const;

 private:
  /// SI units in one unit; 0: it measures something else.
  double factor(XmlFile::Node unit, Quantity quantity) const;

  const XmlFile& file_;
};

}  // namespace tendril
