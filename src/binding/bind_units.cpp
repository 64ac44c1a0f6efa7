#include "base/units.h"
#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {

void bind_units(lua_State* L) {
  Module(L, "units", "Factors to SI: 60*units.mm is 0.06 (m)")
      .constant("m", units::m, "m", "metre")
      .constant("cm", units::cm, "m", "centimetre")
      .constant("mm", units::mm, "m", "millimetre")
      .constant("rad", units::rad, "rad", "radian")
      .constant("deg", units::deg, "rad", "degree")
      .constant("N", units::N, "N", "newton")
      .constant("kN", units::kN, "N", "kilonewton")
      .constant("Pa", units::Pa, "Pa", "pascal")
      .constant("kPa", units::kPa, "Pa", "kilopascal")
      .constant("MPa", units::MPa, "Pa", "megapascal")
      .constant("GPa", units::GPa, "Pa", "gigapascal")
      .constant("kg", units::kg, "kg", "kilogram")
      .constant("g", units::g, "kg", "gram");
}

}  // namespace tendril::lua
