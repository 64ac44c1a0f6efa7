#include "six_axis/arm.h"

namespace tendril::six_axis {

const std::vector<Joint>& joints() {
  using units::deg;
  static const std::vector<Joint> all = {
      {"joint_1", "base", "link_1", {0, 0, 350}, Vec3::UnitZ(), -170 * deg, 170 * deg, 110 * deg},
      {"joint_2", "link_1", "link_2", {350, 0, 430}, Vec3::UnitY(), -65 * deg, 85 * deg, 95 * deg},
      {"joint_3", "link_2", "link_3", {0, 0, 1020}, Vec3::UnitY(), -170 * deg, 70 * deg, 95 * deg},
      {"joint_4", "link_3", "link_4", {300, 0, 215}, Vec3::UnitX(), -300 * deg, 300 * deg, 190 * deg},
      {"joint_5", "link_4", "link_5", {820, 0, 0}, Vec3::UnitY(), -112 * deg, 112 * deg, 150 * deg},
      {"joint_6", "link_5", "link_6", {110, 0, 0}, Vec3::UnitX(), -360 * deg, 360 * deg, 220 * deg},
  };
  return all;
}

}  // namespace tendril::six_axis
