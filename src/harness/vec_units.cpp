#include "harness/vec_units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/number_text.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

constexpr double highest_power = 9, largest = 1e6;

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

std::string named(const VecUnit& unit) {
  if (unit.kilograms != 0) return "grams per metre, as a CompositeUnit of the two";
  return std::string("metres") + (unit.metres == 2 ? " with the exponent 2" : "") + ", by SiUnitName and SiPrefix";
}

}  // namespace

/// Metres or grams to a power.
std::optional<VecUnit> VecUnits::si_unit(Node unit) const {
  const std::string name = lower(XmlFile::text(unit, "SiUnitName")), prefix = lower(XmlFile::text(unit, "SiPrefix"));
  const std::string_view stated = XmlFile::text(unit, "Exponent");
  const double power = stated.empty() ? 1 : file_.number(unit, stated);
  const auto known = std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& p) { return prefix == p.name; });
  if (known == prefixes.end() || power != std::round(power) || std::abs(power) > highest_power) return {};
  VecUnit made;
  if (name == "metre" || name == "meter")
    made.metres = power, made.factor = std::pow(known->factor, power);
  else if (name == "gram")
    made.kilograms = power, made.factor = std::pow(1e-3 * known->factor, power);
  else
    return {};
  return made;
}

/// Of one unit or the product of several; a product of products is none that files have.
std::optional<VecUnit> VecUnits::unit(Node unit) const {
  const auto factors = XmlFile::words(XmlFile::text(unit, "Factors"));
  if (factors.empty()) return si_unit(unit);
  VecUnit product;
  for (const std::string_view id : factors) {
    const std::optional<VecUnit> one = si_unit(file_.referenced(unit, id, "Unit"));
    if (!one || factors.size() > 4) return {};
    product.factor *= one->factor;
    product.metres += one->metres;
    product.kilograms += one->kilograms;
  }
  return product;
}

double VecUnits::factor(Node from, std::string_view id, const VecUnit& wanted) const {
  const Node node = file_.referenced(from, id, "Unit");
  const std::optional<VecUnit> found = unit(node);
  if (!found || !found->measures(wanted))
    file_.fail(node, "<Unit>: expected " + named(wanted) + ", where line " + std::to_string(file_.line(from)) + " uses it");
  return found->factor;
}

bool VecUnits::fits(Node value, const VecUnit& wanted) const {
  const Node node = file_.by_id(XmlFile::text(value, "UnitComponent"));
  if (!node || XmlFile::local_name(node) != "Unit") return false;
  const std::optional<VecUnit> found = unit(node);
  return found && found->measures(wanted);
}

double VecUnits::value(Node value, const VecUnit& wanted) const {
  if (!value) return 0;
  const double number = file_.number(value, XmlFile::text(value, "ValueComponent")) * factor(value, XmlFile::text(value, "UnitComponent"), wanted);
  if (number < 0 || number > largest)
    file_.fail(value, "<" + std::string(value.name()) + ">: got " + number_text(number) + " (SI), expected 0 to 1e6");
  return number;
}

}  // namespace tendril
