#include "harness/vec_units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace tendril {
namespace {

using Node = XmlFile::Node;

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr std::array prefixes = {Prefix{"", 1},        Prefix{"kilo", 1e3},   Prefix{"deci", 1e-1}, Prefix{"centi", 1e-2},
                                 Prefix{"milli", 1e-3}, Prefix{"micro", 1e-6}, Prefix{"nano", 1e-9}};

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

}  // namespace

double VecUnits::factor(Node from, std::string_view id, int dimension) const {
  const Node unit = file_.referenced(from, id, "Unit");
  const std::string name = lower(XmlFile::text(unit, "SiUnitName")), prefix = lower(XmlFile::text(unit, "SiPrefix"));
  const std::string_view power = XmlFile::text(unit, "Exponent");
  const double exponent = power.empty() ? 1 : file_.number(unit, power);
  const auto known = std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& p) { return prefix == p.name; });
  if ((name != "metre" && name != "meter") || exponent != dimension || known == prefixes.end())
    file_.fail(unit, "<Unit>: expected metres" + std::string(dimension == 2 ? " with the exponent 2" : "") +
                         ", by SiUnitName and SiPrefix, where line " + std::to_string(file_.line(from)) + " uses it");
  return std::pow(known->factor, dimension);
}

double VecUnits::value(Node value, int dimension) const {
  if (!value) return 0;
  return file_.number(value, XmlFile::text(value, "ValueComponent")) * factor(value, XmlFile::text(value, "UnitComponent"), dimension);
}

}  // namespace tendril
