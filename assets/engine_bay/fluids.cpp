// Brakes, reservoirs and thin lines.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

Mesh cap(const Vec3& at, double radius, const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {radius, 0}, {radius, 0.5 * radius}, {0.7 * radius, 0.62 * radius}, {0, 0.62 * radius}}, detail, 1.5), at);
  for (int k = 0; detail.texture && k < 12; ++k) {
    const double a = units::pi / 6 * k;
    mesh.append(moved(cylinder(2, 0.45 * radius, 0.6, detail), at + Vec3(radius * std::cos(a), radius * std::sin(a), 0.5)));
  }
  return mesh;
}

Mesh brake_booster(const Detail& detail) {
  return placed(turned({{0, 0}, {70, 0}, {104, 14}, {110, 30}, {114, 32}, {114, 40}, {108, 42}, {96, 70}, {50, 84}, {30, 92}, {0, 92}}, detail, 8),
                facing({1130, 872, 480}, -Vec3::UnitY()));
}

Mesh master_cylinder(const Detail& detail) {
  Mesh mesh = placed(turned({{0, 0}, {26, 0}, {26, 10}, {18, 12}, {18, 124}, {12, 130}, {0, 130}}, detail, 3), facing({1130, 784, 480}, -Vec3::UnitY()));
  for (const double y : {690.0, 750.0}) mesh.append(moved(cylinder(10, 20, 2, detail), {1130, y, 490}));
  return mesh;
}

Mesh washer_tank(const Detail& detail) {
  Mesh mesh = box({1130, 124, 84}, {1262, 300, 276}, 28, detail);
  mesh.append(box({1124, 118, 178}, {1268, 306, 183}, 2, detail));
  mesh.append(round_bar(rounded_path({{1160, 150, 262}, {1119, 120, 310}, {1119, 112, 560}}, 50, detail), 14, detail));
  return mesh;
}

Mesh steering_reservoir(const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {12, 0}, {30, 16}, {33, 20}, {33, 96}, {26, 106}, {0, 106}}, detail, 4), {1136, 420, 420});
  mesh.append(moved(turned({{32.5, 40}, {36, 40}, {36, 56}, {32.5, 56}, {32.5, 40}}, detail), {1136, 420, 420}));
  return mesh;
}

Mesh brake_unit(const Detail& detail) {
  Mesh mesh = box({228, 762, 244}, {330, 846, 322}, 6, detail);
  mesh.append(placed(cylinder(32, 66, 4, detail), facing({228, 804, 284}, -Vec3::UnitX())));
  for (int k = 0; k < 4; ++k) mesh.append(moved(cylinder(7, 10, 1, detail), {246.0 + 22 * k, 780, 320}));
  return mesh;
}

// Four hard lines from the brake unit along the firewall to the master cylinder and the wheels.
Mesh brake_lines(const Detail& detail) {
  Mesh mesh;
  for (int k = 0; k < 4; ++k) {
    const double x = 246 + 22.0 * k, y = 868 - 8.0 * k, z = 360 + 10.0 * k;
    const Path corners = k < 2 ? Path{{x, 780, 328}, {x, 780, z}, {x, y, z}, {1100, y, z}, {1130, y - 20, 420}, {1130, 700.0 + 40 * k, 440}, {1130, 700.0 + 40 * k, 466}}
                               : Path{{x, 780, 328}, {x, 780, z}, {x - 60, 770, z}, {130.0 - 10 * k, 800, z + 30}, {60.0 + 10 * k, 800, 300}};
    mesh.append(round_bar(rounded_path(corners, 16, detail), 3, detail.with_edge(std::max(detail.edge, 5.0))));
  }
  return mesh;
}

}  // namespace

void add_fluids(Parts& parts, const Detail& detail) {
  parts.body("brake_booster", brake_booster(detail));
  parts.body("master_cylinder", master_cylinder(detail));
  parts.body("brake_reservoir", together({box({1100, 664, 506}, {1160, 768, 548}, 10, detail), box({1096, 660, 524}, {1164, 772, 529}, 1.5, detail)}));
  parts.body("brake_reservoir_cap", cap({1130, 742, 547}, 20, detail));
  parts.body("brake_unit", brake_unit(detail));
  parts.body("brake_lines", brake_lines(detail));
  parts.body("washer_tank", washer_tank(detail));
  parts.body("washer_cap", cap({1119, 112, 558}, 20, detail));
  parts.body("steering_reservoir", steering_reservoir(detail));
  parts.body("steering_reservoir_cap", cap({1136, 420, 524}, 24, detail));
  parts.body("fuel_line", round_bar(rounded_path({{800, 872, 330}, {800, 840, 330}, {560, 846, 520}, {548, 640, 545}, {548, 358, 545}, {580, 358, 534}}, 30, detail), 4.5, detail));
  parts.body("air_conditioning_line_suction",
             round_bar(rounded_path({{960, 340, 230}, {960, 340, 256}, {895, 330, 280}, {895, 225, 320}, {1110, 225, 360}, {1110, 130, 500}}, 40, detail), 8, detail));
  parts.body("air_conditioning_line_pressure",
             round_bar(rounded_path({{980, 340, 230}, {980, 320, 245}, {1000, 240, 230}, {1105, 200, 210}, {1105, 90, 160}, {1040, 84, 150}}, 30, detail), 6, detail));
}

}  // namespace tendril::engine_bay
