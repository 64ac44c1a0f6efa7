// curve: shapes in space, for preformed rods and for routes.
#include "binding/card.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using OneOrMany = std::variant<double, std::vector<double>>;

Schema points_alone() {
  return Schema{}.with_list(Value<Vec3>::kind(), "points", "Two or more points, m");
}

Schema pcc_options() {
  return {
      option<std::vector<Vec3>>("points", "m", "Ends and corners").required(),
      option<OneOrMany>("radius", "m", "Bend radius, or one for each inner point").required(),
  };
}

Schema spline_options() {
  return Schema{option<Vec3>("start", "", "Direction at the first point; default: no curvature there"),
                option<Vec3>("finish", "", "Direction at the last point; default: no curvature there")}
      .with_list(Value<Vec3>::kind(), "points", "Two or more points to pass through, m");
}

Schema helix_options() {
  return {
      option<double>("radius", "m", "From the axis to the centre line").required().above(0),
      option<double>("pitch", "m", "Rise of one turn").required(),
      option<double>("turns", "", "How many").required().above(0),
      option<bool>("left_handed", "", "Turns clockwise as it rises").preset(false),
  };
}

Curve make_helix(const Options& o) {
  return Curve::helix(o.get<double>("radius"), o.get<double>("pitch"), o.get<double>("turns"), o.get<bool>("left_handed"));
}

Curve make_pcc(const Options& o) {
  const std::vector<Vec3> points = o.get<std::vector<Vec3>>("points");
  const OneOrMany radius = o.get<OneOrMany>("radius");
  if (const double* one = std::get_if<double>(&radius)) return Curve::pcc(points, *one);
  return Curve::pcc(points, std::get<std::vector<double>>(radius));
}

Curve make_spline(const Options& o) {
  return Curve::spline(o.list<Vec3>(), {o.maybe<Vec3>("start"), o.maybe<Vec3>("finish")});
}

}  // namespace

void bind_curve(lua_State* L) {
  Class<Curve>(L, "A curve in space by arc length; it never changes")
      .property("kind", "", "\"polyline\", \"pcc\", \"spline\" or \"helix\"", [](const Curve& c) { return c.kind(); })
      .property("length", "m", "Arc length", [](const Curve& c) { return c.length(); })
      .property("points", "m", "Those it was made from; a helix: its ends", [](const Curve& c) { return c.points(); })
      .method("at", {.takes = {"s"}, .does = "Place and orientation at an arc length in m; along is the tangent.",
                     .example = "print(curve.polyline{{0, 0, 0}, {1, 0, 0}}:at(0.25).at)  --> vec(0.25, 0, 0)"},
              [](const Curve& c, double s) { return c.at(s); })
      .method("min_bend_radius", {.does = "The smallest bend radius in m, and where; 0 at a polyline's corner, math.huge when straight.",
                         .example = "local radius, s = curve.pcc{points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, radius = 0.1}:min_bend_radius()\nprint(radius)  --> 0.1"},
              [](lua_State* state, const Curve& c) {
                lua_pushnumber(state, c.min_bend_radius());
                lua_pushnumber(state, c.min_bend_radius_at());
                return Pushed{2};
              })
      .tostring([](const Curve& c) {
        return Card(std::string("curve (") + c.kind() + ")").row("length", c.length(), "m")
            .row("points", std::to_string(c.points().size())).row("min bend radius", c.min_bend_radius(), "m").text();
      });

  Module(L, "curve", "Shapes in space")
      .function("polyline", {.options = points_alone(), .does = "Straight from point to point.",
                             .example = "print(curve.polyline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}.length)  --> 2.0"},
                [](const Options& o) { return Curve::polyline(o.list<Vec3>()); })
      .function("pcc", {.options = pcc_options(), .does = "Straights with each corner rounded by an arc: piecewise constant curvature.",
                        .example = "print(curve.pcc{points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, radius = 0.1}:min_bend_radius())"},
                make_pcc)
      .function("helix", {.options = helix_options(),
                          .does = "The circular helix about the z axis from {radius, 0, 0} on; d1 points to the axis.",
                          .example = "local c = curve.helix{radius = 0.02, pitch = 0.01, turns = 5}\n"
                                     "print(c:at(0).at)  --> vec(0.02, 0, 0)"},
                make_helix)
      .function("spline", {.options = spline_options(), .does = "The cubic spline through points, with continuous curvature.",
                           .example = "print(curve.spline{{0, 0, 0}, {0.5, 0.2, 0}, {1, 0, 0}, start = {1, 0, 0}})"},
                make_spline);
}

}  // namespace tendril::lua
