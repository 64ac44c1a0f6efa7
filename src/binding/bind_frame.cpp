#include <cstdio>

#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

using Turn = std::tuple<Vec3, double>;

Schema frame_options() {
  return {
      option<Vec3>("at", "m", "Place").required(),
      option<Vec3>("along", "", "Direction of d3, the rod's tangent there; any length").required(),
      option<Vec3>("up", "", "Direction that d1 leans to, made normal to `along`; without it z, or x for a vertical `along`"),
  };
}

Schema moved_options() {
  return {
      option<Vec3>("by", "m", "Displacement in world axes"),
      option<Turn>("turn", "rad", "{axis, angle}: turn about the world axis `axis` through the frame's own place"),
  };
}

Frame frame_of(const Options& o) {
  const std::optional<Vec3> up = o.maybe<Vec3>("up");
  if (up && up->isZero(0)) throw UsageError("frame: 'up' must not be the zero vector");
  return Frame::looking(o.get<Vec3>("at"), o.get<Vec3>("along"), up.value_or(Vec3::Zero()));
}

Frame moved(const Frame& frame, const Options& o) {
  const Vec3 by = o.maybe<Vec3>("by").value_or(Vec3::Zero());
  const auto [axis, angle] = o.maybe<Turn>("turn").value_or(Turn(Vec3::UnitZ(), 0));
  return frame.moved(by, axis, angle);
}

std::string text(const Frame& f) {
  const Vec3 along = f.d3(), up = f.d1();
  const auto tidy = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };  // -0 and rounding of the quaternion
  char line[256];
  std::snprintf(line, sizeof line, "frame{at = {%.6g, %.6g, %.6g}, along = {%.6g, %.6g, %.6g}, up = {%.6g, %.6g, %.6g}}",
                f.at.x(), f.at.y(), f.at.z(), tidy(along.x()), tidy(along.y()), tidy(along.z()), tidy(up.x()),
                tidy(up.y()), tidy(up.z()));
  return line;
}

}  // namespace

void bind_frame(lua_State* L) {
  Class<Frame>(L, "A place and orientation of a rod's section: d3 is the rod's tangent, d1 and d2 its own axes")
      .property("at", "m", "Place", [](const Frame& f) { return f.at; })
      .property("along", "", "Direction of d3, a unit vector", [](const Frame& f) { return f.d3(); })
      .property("up", "", "Direction of d1, a unit vector", [](const Frame& f) { return f.d1(); })
      .method("moved", {.options = moved_options(), .does = "A new frame, displaced and turned.",
                        .example = "local f = frame{at = {0, 0, 0}, along = {1, 0, 0}}\n"
                                   "print(f:moved{by = {0, 0, 1}, turn = {{0, 0, 1}, 90*units.deg}}.along)  --> vec(0, 1, 0)"},
              moved)
      .tostring(text);

  Module(L, "", "").function("frame", {.options = frame_options(), .does = "A place and orientation of a section.",
                                       .example = "print(frame{at = {0, 0, 1}, along = {1, 0, 0}}.up)  --> vec(0, 0, 1)"},
                             frame_of);
}

}  // namespace tendril::lua
