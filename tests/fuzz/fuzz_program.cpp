// Programs of robot controllers. The first line names the dialect. What is read are points of six finite values, and a program
// that is written from them goes through the same points.
#include <cmath>

#include "base/units.h"
#include "fuzz_target.h"
#include "robot/program.h"

using namespace tendril;

namespace {

constexpr double limit = 100;  // rad

/// Axes along z, y, y, x, y, x, the upper arm upright: what the dialects' own axis maps are for.
const Robot& arm() {
  static const Robot robot = [] {
    const Vec3 at[] = {{0, 0, 0.4}, {0.3, 0, 0.4}, {0, 0, 1.05}, {0.4, 0, 0.2}, {0.76, 0, 0}, {0.2, 0, 0}};
    const Vec3 axis[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()};
    std::vector<Link> links{{"base"}};
    std::vector<Joint> joints;
    for (int k = 0; k < 6; ++k) {
      links.push_back({"link_" + std::to_string(k + 1)});
      joints.push_back({"joint_" + std::to_string(k + 1), JointKind::revolute, k, {at[k], Quat::Identity()}, axis[k], -limit, limit, 3.0});
    }
    return Robot("arm", links, joints);
  }();
  return robot;
}

bool within_limits(const JointPath& path) {
  for (const auto& point : path)
    if (!arm().within_limits(point)) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::text_of(data, size);
  const std::size_t end = std::min(input.find('\n'), input.size());
  Dialect dialect{};
  if (!fuzz::accepts("program: ", [&] { dialect = dialect_named(std::string(input.substr(0, end))); })) return 0;
  const std::string_view text = input.substr(std::min(end + 1, input.size()));

  JointPath path;
  if (!fuzz::accepts("program 'input", [&] { path = read_program(arm(), text, "input", dialect, {}); })) return 0;
  fuzz::expect(!path.empty(), "a program that is read has points");
  for (const auto& point : path) {
    fuzz::expect(point.size() == 6, "a point has a value for each joint");
    for (const double value : point) fuzz::expect(std::isfinite(value), "values are finite");
  }
  if (!within_limits(path)) return 0;
  ProgramOptions options;
  options.dialect = dialect;
  const JointPath again = read_program(arm(), write_program(arm(), path, options), "written", dialect, {});
  fuzz::expect(again.size() == path.size(), "a program that is written has as many points");
  for (std::size_t i = 0; i < path.size(); ++i)
    for (int k = 0; k < 6; ++k)
      fuzz::expect(std::abs(again[i][k] - path[i][k]) <= 2e-4 * units::deg, "a program that is written goes through the same points");
  return 0;
}
