// Bolts and nuts by pattern, each pattern a part.
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

std::vector<Vec3> on_circle(const Vec3& centre, const Vec3& along, double radius, int count) {
  const Frame frame = facing(centre, along);
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k) {
    const double a = 2 * units::pi * (k + 0.5) / count;
    places.push_back(frame.at + radius * (std::cos(a) * frame.d1() + std::sin(a) * frame.d2()));
  }
  return places;
}

std::vector<Vec3> in_line(const Vec3& from, const Vec3& to, int count) {
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k) places.push_back(from + (to - from) * (count > 1 ? double(k) / (count - 1) : 0.0));
  return places;
}

std::vector<Vec3> both(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

void add_fasteners(Parts& parts, const Detail& detail) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  parts.body("valve_cover_bolts", bolts(rim_places({566, 431, 527}, {1004, 589, 527}, 6, 2), z, 6, detail));
  parts.body("oil_pan_bolts", bolts(rim_places({570, 408, 122}, {1000, 612, 122}, 8, 3), -z, 6, detail));
  parts.body("timing_cover_bolts", bolts(both(in_line({1040, 406, 110}, {1040, 406, 400}, 5), in_line({1040, 610, 110}, {1040, 610, 530}, 6)), x, 6, detail));
  parts.body("bell_housing_bolts", bolts(on_circle({546, 500, 235}, -x, 166, 14), -x, 7, detail));
  parts.body("gearbox_bolts", bolts(on_circle({255, 500, 208}, -x, 77, 9), -x, 6, detail));
  parts.body("intake_flange_bolts", bolts(both(in_line({588, 386, 500}, {982, 386, 500}, 5), in_line({588, 386, 452}, {982, 386, 452}, 5)), -y, 7, detail));
  parts.body("exhaust_flange_nuts", bolts(both(in_line({594, 626, 486}, {976, 626, 486}, 5), in_line({594, 626, 446}, {976, 626, 446}, 5)), y, 8, detail));
  parts.body("fender_bolts_right", bolts(in_line({8, 110, 659}, {8, 830, 659}, 7), z, 7, detail));
  parts.body("fender_bolts_left", bolts(in_line({1392, 110, 659}, {1392, 830, 659}, 7), z, 7, detail));
  parts.body("crossmember_bolts", bolts(in_line({90, 42, 648}, {1310, 42, 648}, 6), z, 8, detail));
  parts.body("brace_bolts", bolts(both(in_line({165, 640, 600}, {165, 662, 600}, 2), in_line({1235, 640, 600}, {1235, 662, 600}, 2)), z, 8, detail));
  parts.body("fan_shroud_bolts", bolts(in_line({380, 140, 548}, {1020, 140, 548}, 6), y, 5, detail));
  parts.body("booster_nuts", bolts(on_circle({1130, 873, 480}, -y, 60, 4), -y, 7, detail));
  parts.body("hose_bridge_bolts", bolts({{408, 446, 311}, {408, 562, 311}}, z, 7, detail));
  parts.body("mount_bolts", bolts({{182, 600, 402}, {1218, 520, 402}, {1060, 508, 504}, {1060, 532, 504}}, z, 9, detail));
  parts.body("control_unit_bolts", bolts({{184, 838, 460}, {184, 838, 550}, {356, 838, 460}, {356, 838, 550}}, -y, 6, detail));
}

}  // namespace tendril::engine_bay
