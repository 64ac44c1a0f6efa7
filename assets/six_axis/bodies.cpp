// The links' castings, motors and covers.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/loft.h"
#include "six_axis/arm.h"

namespace tendril::six_axis {

namespace {

using engine_bay::box;
using engine_bay::cylinder;
using engine_bay::facing;
using engine_bay::placed;
using engine_bay::turned;

// A drum about y from y = `from` to y = `to`.
Mesh drum(double radius, double x, double z, double from, double to, double fillet, const Detail& detail) {
  return placed(cylinder(radius, to - from, fillet, detail), facing({x, from, z}, Vec3::UnitY()));
}

// A motor of two diameters with a cap, standing on `at`.
Mesh motor(const Vec3& at, const Vec3& along, double radius, double length, const Detail& detail) {
  const double neck = 0.75 * radius, cap = 0.12 * length;
  return placed(turned({{0, 0},
                        {radius, 0},
                        {radius, 0.55 * length},
                        {neck, 0.6 * length},
                        {neck, length - cap},
                        {0.85 * radius, length - cap},
                        {0.85 * radius, length},
                        {0, length}},
                       detail),
                facing(at, along));
}

std::vector<Vec3> ring(const Vec3& middle, const Vec3& along, double radius, int count) {
  const Frame frame = facing(middle, along);
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * units::pi * (k + 0.5) / count;
    places.push_back(frame.at + radius * (std::cos(angle) * frame.d1() + std::sin(angle) * frame.d2()));
  }
  return places;
}

Mesh base(const Detail& d) {
  Mesh mesh = box({-380, -330, 0}, {330, 330, 55}, 14, d);
  mesh.append(turned({{0, 40}, {315, 40}, {300, 120}, {262, 180}, {262, 300}, {285, 325}, {285, 348}, {0, 348}}, d));
  mesh.append(box({-470, -130, 60}, {-220, 130, 250}, 18, d));
  mesh.append(engine_bay::bolts({{-330, -280, 55}, {-330, 280, 55}, {280, -280, 55}, {280, 280, 55}}, Vec3::UnitZ(), 30, d));
  return mesh;
}

Mesh link_1(const Detail& d) {
  Mesh mesh = turned({{0, 2}, {295, 2}, {295, 70}, {255, 120}, {0, 120}}, d);
  mesh.append(box({-270, -165, 80}, {300, 165, 300}, 40, d));
  mesh.append(engine_bay::tapered_box({170, -160, 100}, {510, 160, 420}, 45, 20, d));
  mesh.append(drum(190, 350, 430, -165, 165, 22, d));
  mesh.append(motor({350, -165, 430}, -Vec3::UnitY(), 105, 270, d));
  mesh.append(motor({-140, 0, 300}, Vec3::UnitZ(), 100, 330, d));
  mesh.append(engine_bay::bolts(ring({350, -165, 430}, -Vec3::UnitY(), 155, 8), -Vec3::UnitY(), 16, d));
  return mesh;
}

Mesh link_2(const Detail& d) {
  const double middle = 232, half = 57;
  Mesh mesh = drum(185, 0, 0, middle - half, middle + half, 20, d);
  mesh.append(drum(155, 0, 1020, middle - half, middle + half, 20, d));
  // Narrow in the middle, as wide as the drums at the ends.
  const engine_bay::Scale waist = [](double s, double total) {
    return 0.86 + 0.14 * std::pow(2 * s / total - 1, 2) - 0.08 * s / total;
  };
  mesh.append(engine_bay::sweep(engine_bay::divided({{0, middle, 0}, {0, middle, 1020}}, d.with_edge(70)),
                                engine_bay::rounded_rectangle(96, 330, 30, d), engine_bay::Ends::capped, d, Vec3::UnitX(),
                                waist));
  mesh.append(engine_bay::bolts(ring({0, middle + half, 0}, Vec3::UnitY(), 140, 8), Vec3::UnitY(), 16, d));
  mesh.append(engine_bay::bolts(ring({0, middle + half, 1020}, Vec3::UnitY(), 115, 8), Vec3::UnitY(), 16, d));
  return mesh;
}

Mesh link_3(const Detail& d) {
  Mesh mesh = drum(165, 0, 0, -160, 168, 20, d);
  mesh.append(box({-330, -150, 40}, {150, 150, 375}, 45, d));
  mesh.append(
      placed(turned({{0, 0}, {150, 0}, {150, 60}, {128, 160}, {128, 178}, {0, 178}}, d), facing({120, 0, 215}, Vec3::UnitX())));
  for (const Vec3& at : {Vec3(-325, 0, 295), Vec3(-325, 85, 160), Vec3(-325, -85, 160)})
    mesh.append(motor(at, -Vec3::UnitX(), 62, 215, d));
  mesh.append(motor({0, -160, 0}, -Vec3::UnitY(), 95, 235, d));
  return mesh;
}

Mesh link_4(const Detail& d) {
  Mesh mesh = placed(turned({{0, 0}, {124, 0}, {124, 40}, {108, 70}, {92, 600}, {105, 640}, {105, 690}, {0, 690}}, d),
                     facing(Vec3::Zero(), Vec3::UnitX()));
  for (double side : {-1.0, 1.0}) {
    const double inner = side > 0 ? 72 : -118, outer = side > 0 ? 118 : -72;
    mesh.append(box({610, inner, -80}, {830, outer, 80}, 16, d));
    mesh.append(drum(88, 820, 0, inner, outer, 12, d));
    mesh.append(engine_bay::bolts(ring({820, side * 118, 0}, side * Vec3::UnitY(), 66, 6), side * Vec3::UnitY(), 12, d));
  }
  return mesh;
}

Mesh link_5(const Detail& d) {
  Mesh mesh = drum(84, 0, 0, -68, 68, 10, d);
  mesh.append(
      placed(turned({{0, 0}, {66, 0}, {66, 84}, {74, 92}, {74, 108}, {0, 108}}, d, 4), facing(Vec3::Zero(), Vec3::UnitX())));
  mesh.append(engine_bay::bolts(ring({92, 0, 0}, -Vec3::UnitX(), 70, 4), -Vec3::UnitX(), 8, d));
  return mesh;
}

Mesh link_6(const Detail& d) {
  Mesh mesh =
      placed(turned({{0, 2}, {80, 2}, {80, 45}, {62, 52}, {62, flange}, {0, flange}}, d, 3), facing(Vec3::Zero(), Vec3::UnitX()));
  mesh.append(engine_bay::bolts(ring({46, 0, 0}, Vec3::UnitX(), 71, 8), Vec3::UnitX(), 8, d));
  return mesh;
}

}  // namespace

std::vector<Body> bodies(const Detail& d) {
  return {{"base", base(d)},
          {"link_1", link_1(d)},
          {"link_2", link_2(d)},
          {"link_3", link_3(d)},
          {"link_4", link_4(d)},
          {"link_5", link_5(d)},
          {"link_6", link_6(d.with_edge(30))}};
}

}  // namespace tendril::six_axis
