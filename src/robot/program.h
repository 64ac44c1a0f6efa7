// Joint paths as programs of robot controllers, and back: RAPID (ABB), KRL (KUKA), URScript (Universal Robots), LS (FANUC),
// and plain CSV.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "robot/robot.h"

namespace tendril {

enum class Dialect { rapid, krl, urscript, ls, csv };

/// "rapid", "krl", "urscript", "ls", "csv"; and by the suffix of a file (.mod, .prg, .src, .script, .urscript, .ls, .csv, .txt in
/// any case of letters). Throw UsageError for others.
const char* name_of(Dialect dialect);
Dialect dialect_named(const std::string& name);
Dialect dialect_of_file(const std::string& path);

/// What a controller calls the joint values: axis k shows sign * q + zero, and axis 3 also coupling * (axis 2). FANUC's third
/// axis is coupled: it shows the forearm's angle to the level, whatever axis 2 does.
struct AxisMap {
  std::vector<double> sign;  ///< +1 or -1, one for each joint
  std::vector<double> zero;  ///< rad: what the controller shows where q is 0
  double coupling = 0;

  static AxisMap same(int joints);
  /// Throws UsageError for lists of another length, signs other than 1 and -1, numbers that are not finite.
  void check(int joints) const;
  std::vector<double> shown(Robot::JointValues q) const;  ///< rad
  std::vector<double> joints(Robot::JointValues shown) const;
};

/// The map of a dialect's maker for arms of six axes along z, y, y, x, y, x whose zero position has the upper arm upright and
/// the forearm level: RAPID and URScript as they are; KRL has axes 1, 4 and 6 the other way and axes 2 and 3 at -90 and
/// 90 degrees; LS has axes 3 to 6 the other way and axis 3 coupled. CSV: as they are, for any robot. Throws UsageError for KRL
/// and LS and arms of another kind: their map must be given.
AxisMap usual_axes(const Robot& robot, Dialect dialect);

struct ProgramOptions {
  Dialect dialect = Dialect::rapid;
  std::string name = "path";
  AxisMap axes = {};   ///< empty: usual_axes()
  double speed = 0.5;  ///< share of the joints' own velocities, > 0, at most 1
  double zone = 0;     ///< m around each point but the first and last within which the corner may be cut; 0: stop at each
};

using JointPath = std::vector<std::vector<double>>;

/// The program that goes through the points. RAPID and URScript get the time of each move, after the joint that takes longest;
/// KRL and LS the share of speed; zones are carried over to shares of the way between the points at the robot's tip where
/// the dialect has no lengths. The first move is slow: no one knows where it comes from. Throws UsageError: no points, points
/// of another size, not finite or beyond the joint limits; names, speeds and zones that cannot be; robots without
/// velocities (RAPID, URScript), or with other than six turning joints (all but CSV).
std::string write_program(const Robot& robot, const JointPath& path, const ProgramOptions& options);

/// The points that a program goes through, in its order. `source` stands in messages. Read are: MoveAbsJ to jointtargets;
/// PTP to axes (axes that are left out keep their value; declared in the same text); movej to lists of joints; J to
/// positions by joints; rows of numbers. Throws UsageError with the line: moves by places or along lines, which would be lost;
/// names that are not declared; lists of another length; numbers that are none. What is beyond the robot's limits is left to
/// the caller.
JointPath read_program(const Robot& robot, std::string_view text, const std::string& source, Dialect dialect, const AxisMap& axes,
                       bool degrees = true);

/// The same of a file. Beside a .src file the .dat file of its name is read as well: KRL declares positions there (in messages
/// its lines go on from those of the .src file).
JointPath read_program_file(const Robot& robot, const std::string& path, Dialect dialect, const AxisMap& axes,
                            bool degrees = true);

}  // namespace tendril
