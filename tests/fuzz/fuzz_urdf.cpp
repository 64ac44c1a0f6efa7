// URDF files: a robot that is read stands everywhere in its range, at finite places.
#include <algorithm>
#include <set>

#include "fuzz_target.h"
#include "robot/urdf.h"

using namespace tendril;

namespace {

/// The middle, or either end, of the part of a joint's range that can be moved through.
std::vector<double> values(const Robot& robot, double share) {
  std::vector<double> q;
  for (int k = 0; k < robot.size(); ++k) {
    const Joint& joint = robot.variable(k);
    const double lower = std::max(joint.lower, -Robot::largest_number), upper = std::min(joint.upper, Robot::largest_number);
    q.push_back(lower + share * (upper - lower));
  }
  return q;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::shared_ptr<const Robot> robot;
  const std::string text(fuzz::text_of(data, size));
  if (!fuzz::accepts("robot '", [&] { robot = parse_urdf(text, "input.urdf"); })) return 0;
  fuzz::expect(robot->links().size() == robot->joints().size() + 1, "every link but the base hangs on a joint");
  std::set<std::string> names;
  for (const Link& link : robot->links()) fuzz::expect(names.insert(link.name).second, "links have names of their own");
  for (std::size_t k = 0; k < robot->joints().size(); ++k) {
    const Joint& joint = robot->joints()[k];
    fuzz::expect(joint.parent >= 0 && joint.parent <= static_cast<int>(k), "joints hang on links before them");
    fuzz::expect(joint.lower <= joint.upper, "limits are in order");
    fuzz::expect(joint.mimics >= -1 && joint.mimics < static_cast<int>(robot->joints().size()), "joints mimic joints");
  }
  for (const double share : {0.0, 0.5, 1.0})
    for (const Frame& frame : robot->link_frames(values(*robot, share)))
      fuzz::expect(frame.at.allFinite() && std::abs(frame.rotation.norm() - 1) < 1e-9, "links stand at finite frames");
  return 0;
}
