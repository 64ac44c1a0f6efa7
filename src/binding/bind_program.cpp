#include "binding/bind_program.h"

#include "robot/program.h"

namespace tendril::lua {
namespace {

using Numbers = std::vector<double>;

Schema axes_options() {
  return {
      option<Numbers>("sign", "", "1 or -1 for each joint: the controller shows sign * q + zero. Default of the map: that of the dialect's "
                                  "maker for upright arms of six axes"),
      option<Numbers>("zero", "rad", "What the controller shows for each joint where q is 0; default with a sign: 0"),
      option<double>("coupling", "", "How much of the second axis the third one shows on top; FANUC: -1 with sign -1; default with a sign: 0"),
  };
}

std::vector<std::string> dialect_names() { return {"rapid", "krl", "urscript", "ls", "csv"}; }

Schema program_options() {
  return Schema{option<std::string>("dialect", "", "RAPID (ABB), KRL (KUKA), URScript, LS (FANUC), or rows of numbers").required().one_of(dialect_names())} +
         program_form();
}

Schema read_options() {
  return Schema{
             option<std::string>("dialect", "", "Default: by the suffix (.mod, .prg; .src; .script; .ls; .csv, .txt)").one_of(dialect_names()),
             option<std::string>("unit", "", "Of the turning joints in a csv file").one_of({"deg", "rad"}).preset("deg"),
         } +
         axes_options();
}

AxisMap axes_of(const Robot& robot, const Options& o) {
  if (!o.has("sign") && !o.has("zero") && !o.has("coupling")) return {};
  const int joints = robot.size();
  AxisMap map = AxisMap::same(joints);
  map.sign = o.maybe<Numbers>("sign").value_or(map.sign);
  map.zero = o.maybe<Numbers>("zero").value_or(map.zero);
  map.coupling = o.maybe<double>("coupling").value_or(0);
  map.check(joints);
  return map;
}

std::string program(const RobotValue& value, const JointPath& path, const Options& o) {
  return program_text(*value.robot, path, o.get<std::string>("dialect"), o);
}

JointPath read(const RobotValue& value, const std::string& path, const Options& o) {
  const Dialect dialect = o.has("dialect") ? dialect_named(o.get<std::string>("dialect")) : dialect_of_file(path);
  return read_program_file(*value.robot, path, dialect, axes_of(*value.robot, o), o.get<std::string>("unit") == "deg");
}

const char* const path_example =
    "local bot = robot.load(\"builtin:six_axis\")\n"
    "local path = {{0, 0, 0, 0, 0.5, 0}, {0.4, 0.2, 0, 0, 0.5, 0}}\n";

}  // namespace

Schema program_form() {
  return Schema{
             option<std::string>("name", "", "Of the program").preset("path"),
             option<double>("speed", "", "Share of the joints' velocities").above(0).at_most(1).preset(0.5),
             option<double>("zone", "m", "How near to each point but the first and last the corner may be cut; 0: stop at each").at_least(0).preset(0),
         } +
         axes_options();
}

std::string program_text(const Robot& robot, const std::vector<std::vector<double>>& path, const std::string& dialect, const Options& o) {
  ProgramOptions options;
  options.dialect = dialect_named(dialect);
  options.name = o.get<std::string>("name");
  options.speed = o.get<double>("speed");
  options.zone = o.get<double>("zone");
  options.axes = axes_of(robot, o);
  return write_program(robot, path, options);
}

void add_programs(Class<RobotValue>& bound) {
  bound
      .method("program", {.takes = {"path"}, .options = program_options(),
                          .does = "A joint path as the program of a robot controller, in text: moves from point to point by their joints.",
                          .example = std::string(path_example) + "print(bot:program(path, {dialect = \"rapid\", speed = 0.3}))"},
              program)
      .method("read_program", {.takes = {"file"}, .options = read_options(),
                               .does = "The points that a program or a table of joint values goes through: what bot:program writes, and programs of others "
                                       "that move by joints alone.",
                               .example = std::string(path_example) + "local file <close> = io.open(\"weld.ls\", \"w\")\n"
                                                                      "file:write(bot:program(path, {dialect = \"ls\"})):flush()\n"
                                                                      "print(#bot:read_program(\"weld.ls\"))  --> 2"},
              read);
}

}  // namespace tendril::lua
