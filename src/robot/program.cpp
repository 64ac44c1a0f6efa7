#include "robot/program.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/file_access.h"
#include "base/nearest_name.h"
#include "base/number_text.h"
#include "base/units.h"
#include "base/write_file.h"
#include "robot/program_text.h"

namespace tendril {

namespace {

constexpr Dialect dialects[] = {Dialect::rapid, Dialect::krl, Dialect::urscript, Dialect::ls, Dialect::csv};

// Axes along z, y, y, x, y, x, upper arm upright.
bool is_upright_arm(const Robot& robot) {
  if (robot.size() != 6) return false;
  const std::vector<Frame> frames = robot.link_frames(std::vector<double>(6, 0.0));
  const Vec3 expected[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()};
  Vec3 at[6];
  for (int k = 0; k < 6; ++k) {
    const int joint = robot.variables()[k];
    if (robot.joints()[joint].kind == JointKind::prismatic) return false;
    if ((frames[joint + 1].rotation * robot.joints()[joint].axis - expected[k]).norm() > 1e-3) return false;
    at[k] = frames[joint + 1].at;
  }
  const Vec3 upper = at[2] - at[1];
  return upper.z() > 0 && std::abs(upper.x()) < 1e-3 * upper.z();
}

void check_options(const ProgramOptions& options) {
  if (!(options.speed > 0 && options.speed <= 1))
    throw UsageError("program: the speed is " + number_text(options.speed) + ", expected a share above 0, at most 1");
  if (!(options.zone >= 0 && std::isfinite(options.zone)))
    throw UsageError("program: the zone is " + number_text(options.zone) + " m, expected 0 or more");
  const bool good =
      !options.name.empty() && options.name.size() <= 24 && std::isalpha(static_cast<unsigned char>(options.name[0])) &&
      std::all_of(options.name.begin(), options.name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!good)
    throw UsageError("program: the name is '" + options.name +
                     "', expected a letter, then letters, digits and _, at most 24 in all");
}

void check_points(const Robot& robot, const JointPath& path) {
  if (path.empty()) throw UsageError("program: the path has no points");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string who = "program, point " + std::to_string(i + 1);
    robot.check(path[i], who.c_str());
    if (const std::string beyond = robot.beyond_limits(path[i], 1e-9); !beyond.empty())
      throw UsageError(who + ": beyond the joint limits: " + beyond);
  }
}

// The time of the joint that takes longest; infinite velocities count as none stated.
double seconds_between(const Robot& robot, const std::vector<double>& from, const std::vector<double>& to, double speed) {
  double longest = 0;
  for (int k = 0; k < robot.size(); ++k) {
    const double velocity = robot.variable(k).velocity;
    if (std::isinf(velocity))
      throw UsageError("program: the velocity of joint '" + robot.variable(k).name +
                       "' is not stated, so that moves have no time");
    longest = std::max(longest, std::abs(to[k] - from[k]) / (speed * velocity));
  }
  return longest;
}

program::Moves moves_of(const Robot& robot, const JointPath& path, const ProgramOptions& options, const AxisMap& axes) {
  program::Moves moves{options.name, {}, {}, options.speed, options.zone, {}, {}};
  const bool timed = options.dialect == Dialect::rapid || options.dialect == Dialect::urscript;
  std::vector<double> way;  // to each point, at the tip
  for (std::size_t i = 0; i < path.size(); ++i) {
    moves.shown.push_back(axes.shown(path[i]));
    moves.seconds.push_back(timed && i > 0 ? seconds_between(robot, path[i - 1], path[i], options.speed) : 0);
    way.push_back(i > 0 ? (robot.link_frame(robot.tip(), path[i]).at - robot.link_frame(robot.tip(), path[i - 1]).at).norm() : 0);
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool inner = i > 0 && i + 1 < path.size();
    const double half = inner ? 0.5 * std::min(way[i], way[i + 1]) : 0;
    moves.radius.push_back(std::min(options.zone, 0.99 * half));  // neighbours' zones must not meet
    moves.share.push_back(half > 0 ? moves.radius.back() / half : 0);
  }
  return moves;
}

}  // namespace

const char* name_of(Dialect dialect) {
  switch (dialect) {
    case Dialect::rapid:
      return "rapid";
    case Dialect::krl:
      return "krl";
    case Dialect::urscript:
      return "urscript";
    case Dialect::ls:
      return "ls";
    case Dialect::csv:
      return "csv";
  }
  return "unknown";
}

Dialect dialect_named(const std::string& name) {
  std::vector<std::string> names;
  for (Dialect each : dialects) {
    if (name == name_of(each)) return each;
    names.push_back(name_of(each));
  }
  throw UsageError("program: there is no dialect " + unknown_name(name, "dialects", names));
}

Dialect dialect_of_file(const std::string& path) {
  const std::string suffix = program::lowered(std::filesystem::path(path).extension().string());
  if (suffix == ".mod" || suffix == ".prg") return Dialect::rapid;
  if (suffix == ".src") return Dialect::krl;
  if (suffix == ".script" || suffix == ".urscript") return Dialect::urscript;
  if (suffix == ".ls") return Dialect::ls;
  if (suffix == ".csv" || suffix == ".txt") return Dialect::csv;
  throw UsageError("program '" + path + "': files of the suffix '" + suffix +
                   "' are not known (.mod, .prg, .src, .script, .urscript, .ls, .csv, .txt); name the dialect");
}

AxisMap AxisMap::same(int joints) { return {std::vector<double>(joints, 1.0), std::vector<double>(joints, 0.0), 0}; }

void AxisMap::check(int joints) const {
  if (static_cast<int>(sign.size()) != joints || static_cast<int>(zero.size()) != joints)
    throw UsageError("axis map: got " + std::to_string(sign.size()) + " signs and " + std::to_string(zero.size()) +
                     " zeros, expected " + std::to_string(joints) + " each");
  for (double s : sign)
    if (s != 1 && s != -1) throw UsageError("axis map: a sign is " + number_text(s) + ", expected 1 or -1");
  for (double z : zero)
    if (!std::isfinite(z)) throw UsageError("axis map: a zero is " + number_text(z) + ", expected a finite number");
  if (!std::isfinite(coupling))
    throw UsageError("axis map: the coupling is " + number_text(coupling) + ", expected a finite number");
  if (coupling != 0 && joints < 3) throw UsageError("axis map: a coupling needs three joints");
}

std::vector<double> AxisMap::shown(Robot::JointValues q) const {
  std::vector<double> out(q.size());
  for (std::size_t k = 0; k < q.size(); ++k) out[k] = sign[k] * q[k] + zero[k];
  if (coupling != 0) out[2] += coupling * out[1];
  return out;
}

std::vector<double> AxisMap::joints(Robot::JointValues shown) const {
  std::vector<double> out(shown.begin(), shown.end());
  if (coupling != 0) out[2] -= coupling * shown[1];
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = sign[k] * (out[k] - zero[k]);
  return out;
}

AxisMap usual_axes(const Robot& robot, Dialect dialect) {
  AxisMap map = AxisMap::same(robot.size());
  if (dialect != Dialect::krl && dialect != Dialect::ls) return map;
  if (!is_upright_arm(robot))
    throw UsageError(
        std::string("program: what '") + name_of(dialect) + "' calls the axes of '" + robot.name() +
        "' is not known: it is no arm of six axes along z, y, y, x, y, x with its upper arm upright; give the axis map");
  if (dialect == Dialect::krl) {
    map.sign = {-1, 1, 1, -1, 1, -1};
    map.zero = {0, -units::pi / 2, units::pi / 2, 0, 0, 0};
  } else {
    map.sign = {1, 1, -1, -1, -1, -1};
    map.coupling = -1;
  }
  return map;
}

std::string write_program(const Robot& robot, const JointPath& path, const ProgramOptions& options) {
  check_options(options);
  check_points(robot, path);
  bool turning = robot.size() == 6;
  for (int k = 0; k < robot.size(); ++k) turning &= robot.variable(k).kind != JointKind::prismatic;
  if (options.dialect != Dialect::csv && !turning)
    throw UsageError("program: '" + robot.name() + "' has other than six turning joints: only csv is written for it");
  const AxisMap axes = options.axes.sign.empty() ? usual_axes(robot, options.dialect) : options.axes;
  axes.check(robot.size());
  const program::Moves moves = moves_of(robot, path, options, axes);
  switch (options.dialect) {
    case Dialect::rapid:
      return program::write_rapid(moves);
    case Dialect::krl:
      return program::write_krl(moves);
    case Dialect::urscript:
      return program::write_urscript(moves);
    case Dialect::ls:
      return program::write_ls(moves);
    case Dialect::csv:
      return program::write_csv(robot, moves);
  }
  return "";
}

JointPath read_program(const Robot& robot, std::string_view text, const std::string& name, Dialect dialect, const AxisMap& given,
                       bool degrees) {
  const AxisMap axes = given.sign.empty() ? usual_axes(robot, dialect) : given;
  axes.check(robot.size());
  const program::Source source{text, name, robot.size()};
  JointPath path;
  switch (dialect) {
    case Dialect::rapid:
      path = program::read_rapid(source);
      break;
    case Dialect::krl:
      path = program::read_krl(source);
      break;
    case Dialect::urscript:
      path = program::read_urscript(source);
      break;
    case Dialect::ls:
      path = program::read_ls(source);
      break;
    case Dialect::csv:
      path = program::read_csv(source, robot, degrees);
      break;
  }
  if (path.empty()) throw UsageError("program '" + name + "': there are no moves in it");
  for (auto& point : path) point = axes.joints(point);
  return path;
}

JointPath read_program_file(const Robot& robot, const std::string& path, Dialect dialect, const AxisMap& axes, bool degrees) {
  std::error_code error;
  readable_path(path);  // before anything is told about a file
  if (!std::filesystem::is_regular_file(path, error)) throw UsageError("program '" + path + "': there is no such file");
  std::string text = read_file(path);
  if (dialect == Dialect::krl)
    for (const char* suffix : {".dat", ".DAT"})
      if (const auto beside = std::filesystem::path(path).replace_extension(suffix);
          std::filesystem::is_regular_file(beside, error)) {
        text += "\n" + read_file(beside.string());
        break;
      }
  return read_program(robot, text, path, dialect, axes, degrees);
}

}  // namespace tendril
