// Objects that compute as numbers: eq:clearance{from = "hose"} / units.mm.
#pragma once

#include <cmath>
#include <variant>

#include "binding/lua_class.h"

namespace tendril::lua {

/// Gives a class with `value()` the operators of a number, between two of it and between it and a number. Lua compares a
/// number and an object for equality itself (never equal): compare `.value` there.
template <class T>
void compute_as_number(Class<T>& bound) {
  using Operand = std::variant<double, T>;
  const auto number = [](const Operand& operand) {
    const double* plain = std::get_if<double>(&operand);
    return plain ? *plain : std::get<T>(operand).value();
  };
  bound.operation("__add", [number](const Operand& a, const Operand& b) { return number(a) + number(b); })
      .operation("__sub", [number](const Operand& a, const Operand& b) { return number(a) - number(b); })
      .operation("__mul", [number](const Operand& a, const Operand& b) { return number(a) * number(b); })
      .operation("__div", [number](const Operand& a, const Operand& b) { return number(a) / number(b); })
      .operation("__pow", [number](const Operand& a, const Operand& b) { return std::pow(number(a), number(b)); })
      .operation("__unm", [number](const Operand& a, const Operand&) { return -number(a); })
      .operation("__lt", [number](const Operand& a, const Operand& b) { return number(a) < number(b); })
      .operation("__le", [number](const Operand& a, const Operand& b) { return number(a) <= number(b); });
}

}  // namespace tendril::lua
