#include "harness/kbl_units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/number_text.h"

namespace tendril {
namespace {

struct Known {
  std::string_view name;
  Quantity quantity;
  double in_si;
};

/// Units that files name in words of their own.
constexpr std::array named = {
    Known{"millimetre", Quantity::length, 1e-3},
    Known{"millimeter", Quantity::length, 1e-3},
    Known{"mm", Quantity::length, 1e-3},
    Known{"metre", Quantity::length, 1},
    Known{"meter", Quantity::length, 1},
    Known{"m", Quantity::length, 1},
    Known{"squaremillimetre", Quantity::area, 1e-6},
    Known{"squaremillimeter", Quantity::area, 1e-6},
    Known{"mm2", Quantity::area, 1e-6},
    Known{"grampermetre", Quantity::mass_per_length, 1e-3},
    Known{"grampermeter", Quantity::mass_per_length, 1e-3},
    Known{"g/m", Quantity::mass_per_length, 1e-3},
    Known{"kilogrampermetre", Quantity::mass_per_length, 1},
    Known{"kilogrampermeter", Quantity::mass_per_length, 1},
    Known{"kg/m", Quantity::mass_per_length, 1},
    Known{"kilogramperkilometre", Quantity::mass_per_length, 1e-3},
    Known{"kg/km", Quantity::mass_per_length, 1e-3},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr double largest = 1e6;

constexpr std::array prefixes = {Prefix{"", 1},       Prefix{"milli", 1e-3}, Prefix{"centi", 1e-2}, Prefix{"deci", 1e-1},
                                 Prefix{"micro", 1e-6}, Prefix{"kilo", 1e3}};

const char* name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::length: return "a length";
    case Quantity::area: return "an area";
    case Quantity::mass_per_length: return "a mass per length";
  }
  return "";
}

/// Lower case, without blanks and underscores.
std::string plain(std::string_view text) {
  std::string found;
  for (const unsigned char c : text)
    if (!std::isspace(c) && c != '_') found += static_cast<char>(std::tolower(c));
  return found;
}

}  // namespace

double KblUnits::value(XmlFile::Node owner, const char* name, Quantity quantity) const {
  const XmlFile::Node value = owner.child(name);
  if (!value) return 0;
  const XmlFile::Node unit = file_.referenced(value, XmlFile::text(value, "Unit_component"), "Unit");
  const double in_si = factor(unit, quantity);
  if (in_si == 0)
    file_.fail(value, "<" + std::string(name) + ">: its unit '" + unit.attribute("id").value() + "' is not that of " + name_of(quantity));
  const double number = file_.number(value, XmlFile::text(value, "Value_component")) * in_si;
  if (number < 0 || number > largest) file_.fail(value, "<" + std::string(name) + ">: got " + number_text(number) + " (SI), expected 0 to 1e6");
  return number;
}

bool KblUnits::fits(XmlFile::Node owner, const char* name, Quantity quantity) const {
  const XmlFile::Node value = owner.child(name);
  return !value || factor(file_.referenced(value, XmlFile::text(value, "Unit_component"), "Unit"), quantity) != 0;
}

double KblUnits::factor(XmlFile::Node unit, Quantity quantity) const {
  const std::string si = plain(XmlFile::text(unit, "Si_unit_name")), prefix = plain(XmlFile::text(unit, "Si_prefix"));
  const std::string dimension = plain(XmlFile::text(unit, "Si_dimension")), own = plain(XmlFile::text(unit, "Unit_name"));
  if (si == "metre" || si == "meter") {
    const auto scale = std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& p) { return p.name == prefix; });
    if (scale == prefixes.end()) file_.fail(unit, "unknown Si_prefix '" + prefix + "'");
    if (quantity == Quantity::length && dimension.empty()) return scale->factor;
    if (quantity == Quantity::area && dimension == "square") return scale->factor * scale->factor;
  }
  const auto known = std::find_if(named.begin(), named.end(), [&](const Known& k) { return k.name == own; });
  return known != named.end() && known->quantity == quantity ? known->in_si : 0;
}

}  // namespace tendril
