// Radiator with fans, expansion tank and the stubs that coolant hoses are pushed over.
#include "base/error.h"
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"
#include "engine_bay/sheet.h"

namespace tendril::engine_bay {
namespace {

constexpr double core_left = 352, core_right = 1048, core_bottom = 132, core_top = 558;
constexpr int tube_rows = 36;

double row(int k) { return core_bottom + (core_top - core_bottom) * (k + 0.5) / tube_rows; }

// Flat tubes with rounded edges.
Mesh radiator_tubes(const Detail& detail) {
  const Detail along = detail.with_edge(detail.texture ? 24 : 1e9);
  const Section section = rounded_rectangle(24, 2.4, 1, along);
  Mesh mesh;
  for (int k = 0; k < tube_rows; ++k)
    mesh.append(sweep(divided({{core_left - 8, 110, row(k)}, {core_right + 8, 110, row(k)}}, along), section, Ends::capped, along,
                      Vec3::UnitZ()));
  mesh.append(box({core_left - 6, 96, core_bottom - 6}, {core_right + 6, 124, core_bottom}, 1, along));
  mesh.append(box({core_left - 6, 96, core_top}, {core_right + 6, 124, core_top + 6}, 1, along));
  return mesh;
}

// One folded strip between every two tubes; flat strips where texture is left out.
Mesh radiator_fins(const Detail& detail) {
  const double gap = row(1) - row(0), height = (gap - 2.8) / 2, wave = 9.67;
  const double length = core_right - core_left;
  const double step = detail.texture ? wave / 22 : length;
  Mesh mesh;
  for (int k = 0; k + 1 < tube_rows; ++k) {
    const double middle = (row(k) + row(k + 1)) / 2;
    Mesh strip = sheet(length, 20, {}, detail.with_edge(1e9));
    if (detail.texture) {
      strip = {};
      const int n = static_cast<int>(length / step);
      for (int i = 0; i <= n; ++i)
        for (const double v : {0.0, 20.0}) strip.points.emplace_back(i * step, v, 0);
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
        strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        strip.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
      }
    }
    mesh.append(mapped(strip, [=](const Vec3& p) {
      const double z = detail.texture ? height * std::sin(2 * units::pi * p.x() / wave) : 0;
      return Vec3(core_left + p.x(), 100 + p.y(), middle + z);
    }));
  }
  return mesh;
}

Mesh radiator_tank(double low_x, double high_x, const Detail& detail) {
  Mesh mesh = box({low_x, 84, 116}, {high_x, 136, 574}, 14, detail);
  mesh.append(ribs({low_x - 2, 82, 140}, {high_x + 2, 138, 550}, 2, 12, 4, detail));
  return mesh;
}

Mesh condenser(const Detail& detail) {
  Path corners;
  for (int k = 0; k < 14; ++k) {
    const double z = 150 + 29.0 * k;
    corners.emplace_back(k % 2 ? 1040 : 360, 84, z);
    corners.emplace_back(k % 2 ? 360 : 1040, 84, z);
  }
  const Detail along = detail.with_edge(detail.texture ? 14 : 1e9);
  return sweep(rounded_path(corners, 14.4, along), circle(4.5, detail), Ends::capped, detail);
}

const std::array<Vec3, 2> fan_centres = {Vec3(525, 168, 345), Vec3(875, 168, 345)};

Mesh fan_shroud(const Detail& detail) {
  std::vector<Hole> holes;
  for (const Vec3& c : fan_centres) holes.push_back({{c.x() - 350, c.z() - 130}, 128});
  for (const Hole& h : hole_field({30, 385}, {670, 425}, 14, 1, 10)) holes.push_back(h);
  return sheet(700, 430, holes, detail, [](double u, double v) {
    const double rim = smooth_step(20, 0, std::min({u, v, 700 - u, 430 - v}));
    double ring = 0;  // the sheet rises towards the fans
    for (const Vec3& c : fan_centres) {
      const double r = std::hypot(u - (c.x() - 350), v - (c.z() - 130));
      ring += smooth_step(164, 132, r);
    }
    return Vec3(350 + u, 146 - 14 * rim + 22 * ring, 130 + v);
  });
}

Mesh fan(const Vec3& centre, const Detail& detail) {
  const Frame frame = Frame::looking(centre, Vec3::UnitY(), Vec3::UnitZ());
  Mesh mesh = turned({{0, -12}, {44, -12}, {46, -6}, {46, 14}, {38, 22}, {0, 24}}, detail, 4);
  const Section outline = circle(1, detail.with_edge(detail.texture ? 0.25 : 1.2));
  for (int k = 0; k < 7; ++k) {
    const double angle = 2 * units::pi * k / 7;
    std::vector<Loop> loops;  // twisted aerofoils from hub to tip
    const int n = detail.steps(78);
    for (int i = 0; i <= n; ++i) {
      const double share = double(i) / n, r = 42 + 78 * share, chord = 34 + 10 * share;
      const double pitch = (42 - 18 * share) * units::deg, lean = angle + 0.25 * share * share;
      Loop loop;
      for (const Vec2& c : outline) {
        const double along = 0.5 * chord * c.x(), thick = 1.8 * c.y() - 2.5 * c.x() * c.x();
        const double tangential = along * std::cos(pitch) - thick * std::sin(pitch);
        const double axial = along * std::sin(pitch) + thick * std::cos(pitch);
        // Anticlockwise seen from outside, looking along -r.
        loop.emplace_back(r * std::cos(lean) - tangential * std::sin(lean), r * std::sin(lean) + tangential * std::cos(lean), axial + 4);
      }
      loops.push_back(std::move(loop));
    }
    mesh.append(loft(loops, Ends::capped, detail));
  }
  return placed(mesh, frame);
}

Mesh fan_motor(const Vec3& centre, const Detail& detail) {
  Mesh mesh = placed(turned({{0, 0}, {38, 0}, {40, 6}, {40, 36}, {26, 46}, {0, 48}}, detail, 4), facing(centre + Vec3(0, 26, 0), Vec3::UnitY()));
  for (int k = 0; k < 3; ++k) {  // struts out to the shroud
    const double a = 2 * units::pi * k / 3 + 0.5;
    const Vec3 out(std::cos(a), 0, std::sin(a));
    mesh.append(sweep(divided({centre + Vec3(0, 40, 0) + 34 * out, centre + Vec3(0, 40, 0) + 118 * out, centre + Vec3(0, 4, 0) + 136 * out}, detail),
                      rounded_rectangle(9, 5, 1.5, detail), Ends::capped, detail, Vec3::UnitY()));
  }
  return mesh;
}

Mesh expansion_tank(const Detail& detail) {
  Mesh mesh = box({1192, 352, 424}, {1336, 494, 560}, 46, detail);
  mesh.append(box({1184, 346, 486}, {1344, 500, 492}, 2, detail));
  mesh.append(moved(cylinder(26, 20, 2, detail), {1264, 423, 552}));
  return mesh;
}

Mesh expansion_cap(const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {33, 0}, {33, 16}, {24, 20}, {0, 20}}, detail, 2), {1264, 423, 570});
  for (int k = 0; detail.texture && k < 16; ++k) {
    const double a = units::pi / 8 * k;
    mesh.append(moved(cylinder(3, 15, 1, detail), {1264 + 33 * std::cos(a), 423 + 33 * std::sin(a), 570.5}));
  }
  return mesh;
}

}  // namespace

const std::vector<Connection>& connections() {
  static const std::vector<Connection> all = {
      {"radiator_upper", {326, 178, 500}, {0, 1, 0}, 9},  {"radiator_lower", {326, 172, 190}, {0, 1, 0}, 14},
      {"thermostat", {500, 470, 472}, {-1, 0, 0}, 9},     {"heater_inlet", {478, 826, 440}, {0, -1, 0}, 9},
      {"heater_return", {558, 826, 440}, {0, -1, 0}, 9},  {"expansion_tank", {1180, 380, 446}, {-1, 0, 0}, 7},
  };
  return all;
}

const Connection& connection(const std::string& name) {
  for (const Connection& c : connections())
    if (name == c.name) return c;
  throw UsageError("connection: no '" + name + "'");
}

Mesh stub(const Connection& at, double length, const Detail& detail) {
  const double r = at.radius, bore = 0.72 * r;
  const std::vector<Vec2> profile = {{bore, -length}, {r, -length}, {r, -0.5 * r}, {1.12 * r, -0.32 * r}, {r, 0}, {bore, 0}, {bore, -length}};
  return placed(turned(profile, detail), facing(at.tip, at.along));
}

void add_cooling(Parts& parts, const Detail& detail) {
  parts.body("radiator_tubes", radiator_tubes(detail));
  parts.sheet("radiator_fins", radiator_fins(detail));
  parts.body("radiator_tank_right", together({radiator_tank(304, 352, detail), stub(connection("radiator_upper"), 50, detail),
                                              stub(connection("radiator_lower"), 44, detail)}));
  parts.body("radiator_tank_left", radiator_tank(1048, 1096, detail));
  parts.body("condenser", condenser(detail));
  parts.sheet("fan_shroud", fan_shroud(detail));
  for (int k = 0; k < 2; ++k) {
    const std::string side = k == 0 ? "right" : "left";
    parts.body("fan_" + side, fan(fan_centres[k], detail));
    parts.body("fan_motor_" + side, fan_motor(fan_centres[k], detail));
  }
  parts.body("thermostat_housing", together({box({530, 440, 442}, {551, 500, 502}, 6, detail),
                                             placed(turned({{0, 0}, {26, 0}, {16, 14}, {0, 14}}, detail, 3), facing({531, 470, 472}, -Vec3::UnitX())),
                                             stub(connection("thermostat"), 32, detail)}));
  parts.body("heater_stub_inlet", stub(connection("heater_inlet"), 72, detail));
  parts.body("heater_stub_return", stub(connection("heater_return"), 72, detail));
  parts.body("expansion_tank", together({expansion_tank(detail), stub(connection("expansion_tank"), 24, detail)}));
  parts.body("expansion_tank_cap", expansion_cap(detail));
  parts.body("lower_coolant_hose",
             pipe(rounded_path({{326, 140, 190}, {326, 250, 190}, {520, 330, 200}, {590, 350, 200}, {590, 390, 300}, {590, 402, 300}}, 60, detail), 18, 14.3,
                  detail));
  parts.body("overflow_hose", round_bar(rounded_path({{1200, 380, 446}, {1150, 380, 446}, {1116, 320, 400}, {1116, 150, 540}, {1084, 128, 556}}, 50, detail),
                                        6.5, detail));
  Mesh clamps;
  for (const char* name : {"radiator_lower", "expansion_tank"}) {
    const Connection& c = connection(name);
    clamps.append(placed(hose_clamp(c.radius + 4, 12, detail), facing(c.tip - 14 * c.along, c.along)));
  }
  parts.body("hose_clamps", clamps);
}

}  // namespace tendril::engine_bay
