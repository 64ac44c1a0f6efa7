// Battery, boxes and the conduits between them.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

Mesh battery_case(const Detail& detail) {
  Mesh mesh = box({130, 292, 350}, {302, 532, 506}, 5, detail);
  mesh.append(ribs({126, 300, 360}, {306, 524, 380}, 1, 15, 5, detail));
  return mesh;
}

Mesh battery_lid(const Detail& detail) {
  Mesh mesh = box({127, 289, 502}, {305, 535, 530}, 5, detail);
  for (int k = 0; k < 6; ++k) mesh.append(moved(cylinder(11, 4, 1, detail), {216, 322.0 + 36 * k, 528}));
  mesh.append(box({140, 346, 526}, {186, 520, 536}, 4, detail));
  return mesh;
}

Mesh terminal(const Vec3& at, const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {10, 0}, {8.6, 20}, {0, 20}}, detail, 1), at);
  mesh.append(moved(turned({{9, 4}, {15, 4}, {15, 16}, {9, 16}, {9, 4}}, detail, 1), at));
  mesh.append(box(at + Vec3(-6, -30, 5), at + Vec3(6, -11, 15), 2, detail));
  return mesh;
}

Mesh fuse_box(const Detail& detail) {
  Mesh mesh = tapered_box({58, 110, 420}, {206, 262, 486}, 8, 6, detail);
  mesh.append(box({52, 104, 484}, {212, 268, 520}, 10, detail));
  mesh.append(ribs({70, 120, 516}, {194, 252, 524}, 1, 6, 6, detail));
  return mesh;
}

Mesh control_unit(const Detail& detail) {
  Mesh mesh = box({190, 800, 440}, {350, 838, 570}, 5, detail);
  mesh.append(ribs({200, 790, 450}, {340, 804, 560}, 0, 12, 3, detail));
  mesh.append(box({210, 796, 412}, {330, 834, 442}, 4, detail));
  return mesh;
}

Mesh horn(const Detail& detail) {
  Mesh mesh = placed(turned({{0, 0}, {46, 0}, {50, 6}, {50, 14}, {44, 20}, {18, 24}, {18, 34}, {0, 34}}, detail, 3), facing({240, 96, 330}, Vec3(0, -1, 0)));
  mesh.append(strap({{240, 96, 330}, {240, 104, 330}, {240, 104, 400}, {240, 70, 420}, {240, 60, 610}}, 18, 3, Vec3::UnitX(), detail));
  return mesh;
}

Mesh conduit_clips(const Detail& detail) {
  Mesh mesh;
  for (const double x : {300.0, 440.0, 640.0, 840.0, 1000.0}) {
    mesh.append(placed(turned({{15, -6}, {17, -6}, {17, 6}, {15, 6}, {15, -6}}, detail), facing({x, 850, 590}, Vec3::UnitX())));
    mesh.append(box({x - 6, 862, 574}, {x + 6, 884, 580}, 1, detail));
  }
  return mesh;
}

}  // namespace

void add_electrics(Parts& parts, const Detail& detail) {
  parts.body("battery_case", battery_case(detail));
  parts.body("battery_lid", battery_lid(detail));
  parts.body("battery_terminal_positive", terminal({158, 318, 529}, detail));
  parts.body("battery_terminal_negative", terminal({274, 318, 529}, detail));
  parts.body("battery_strap", strap({{124, 412, 372}, {124, 412, 534}, {132, 412, 540}, {300, 412, 540}, {308, 412, 534}, {308, 412, 372}}, 22, 3,
                                    Vec3::UnitY(), detail));
  parts.body("battery_cable_positive",
             round_bar(rounded_path({{158, 290, 539}, {158, 262, 539}, {150, 240, 500}, {150, 236, 460}}, 24, detail), 7, detail));
  parts.body("battery_cable_negative",
             round_bar(rounded_path({{274, 290, 539}, {274, 266, 539}, {262, 258, 420}, {280, 300, 320}, {300, 410, 292}}, 30, detail), 7, detail));
  parts.body("fuse_box", fuse_box(detail));
  parts.body("control_unit", control_unit(detail));
  parts.body("horn", horn(detail));
  parts.body("harness_firewall",
             corrugated(rounded_path({{270, 815, 410}, {270, 850, 380}, {180, 850, 470}, {150, 850, 590}, {1060, 850, 590}, {1180, 830, 590}}, 45, detail), 14, 2, 6,
                        detail));
  parts.body("harness_engine",
             corrugated(rounded_path({{205, 200, 450}, {240, 200, 430}, {380, 250, 380}, {470, 350, 400}, {545, 372, 470}, {575, 362, 560}, {960, 362, 560}}, 50, detail),
                        10, 1.6, 5, detail));
  parts.body("harness_front", corrugated(rounded_path({{110, 110, 450}, {110, 84, 450}, {150, 82, 590}, {1290, 82, 590}, {1310, 110, 520}}, 40, detail), 9, 1.5, 5, detail));
  parts.body("conduit_clips", conduit_clips(detail));
}

}  // namespace tendril::engine_bay
