#include <cstdio>

#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

using Factor = std::variant<double, Vec3>;

Vec3 product(const Factor& left, const Factor& right) {
  if (left.index() + right.index() != 1)
    throw UsageError("vec *: one operand must be a number; for two vectors there are v:dot(w) and v:cross(w)");
  return left.index() == 0 ? Vec3(std::get<0>(left) * std::get<1>(right)) : Vec3(std::get<1>(left) * std::get<0>(right));
}

Vec3 quotient(const Vec3& left, double right) {
  if (right == 0) throw UsageError("vec /: division by zero");
  return left / right;
}

Vec3 unit(const Vec3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) throw UsageError("vec:unit: the zero vector has no direction");
  return (v / largest).normalized();  // scaled first: neither overflow nor underflow
}

/// Components that are only rounding noise beside the largest are shown as 0.
std::string text(const Vec3& v) {
  const double noise = 1e-14 * v.cwiseAbs().maxCoeff();
  const auto shown = [noise](double x) { return std::abs(x) <= noise ? 0.0 : x; };
  char line[128];
  std::snprintf(line, sizeof line, "vec(%.10g, %.10g, %.10g)", shown(v.x()), shown(v.y()), shown(v.z()));
  return line;
}

}  // namespace

void bind_vec(lua_State* L) {
  Class<Vec3>(L, "A vector or point, immutable. Wherever a vec is expected a plain {x, y, z} will do")
      .property("x", "", "First component", [](const Vec3& v) { return v.x(); })
      .property("y", "", "Second component", [](const Vec3& v) { return v.y(); })
      .property("z", "", "Third component", [](const Vec3& v) { return v.z(); })
      .method("length", {.does = "Euclidean length.", .example = "print(vec(3, 4, 0):length())  --> 5.0"},
              [](const Vec3& v) { return v.stableNorm(); })
      .method("dot", {.takes = {"other"}, .does = "Scalar product.", .example = "print(vec(1, 2, 3):dot{1, 0, 0})  --> 1.0"},
              [](const Vec3& v, const Vec3& other) { return v.dot(other); })
      .method("cross", {.takes = {"other"}, .does = "Vector product.",
                        .example = "print(vec(1, 0, 0):cross{0, 1, 0})  --> vec(0, 0, 1)"},
              [](const Vec3& v, const Vec3& other) { return Vec3(v.cross(other)); })
      .method("unit", {.does = "The vector of length 1 in the same direction; an error for the zero vector.",
                       .example = "print(vec(0, 0, 5):unit())  --> vec(0, 0, 1)"}, unit)
      .operation("__add", [](const Vec3& left, const Vec3& right) { return Vec3(left + right); })
      .operation("__sub", [](const Vec3& left, const Vec3& right) { return Vec3(left - right); })
      .operation("__mul", product)
      .operation("__div", quotient)
      .operation("__unm", [](const Vec3& v) { return Vec3(-v); })
      .operation("__eq", [](lua_State* state) {
        const Vec3 *left = object<Vec3>(state, 1), *right = object<Vec3>(state, 2);
        return left && right && *left == *right;
      })
      .tostring(text);

  Module(L, "", "").function("vec", {.takes = {"x", "y", "z"}, .does = "A vector from its components.",
                                     .example = "print(vec(1, 2, 3) + {0, 0, 1})  --> vec(1, 2, 4)"},
                             [](double x, double y, double z) { return Vec3(x, y, z); });
}

}  // namespace tendril::lua
