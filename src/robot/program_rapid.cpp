// RAPID: a module with a jointtarget for each point and MoveAbsJ through them (ABB: RAPID Instructions, Functions and Data
// types). Angles in degrees.
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "robot/program_text.h"

namespace tendril::program {

namespace {

constexpr const char* no_external_axes = "[9E9,9E9,9E9,9E9,9E9,9E9]";

// The inner list of "[[a,b,c,d,e,f],[...]]".
std::vector<double> target(const Source& source, const std::string& text, std::size_t offset) {
  const auto open = text.find("[["), close = text.find(']', open);
  if (open == text.npos || close == text.npos) source.fail(offset, "got '" + text + "', expected a jointtarget [[...],[...]]");
  std::vector<double> angles = number_list(source, std::string_view(text).substr(open + 2, close - open - 2), offset);
  if (static_cast<int>(angles.size()) != source.joints)
    source.fail(offset, "a jointtarget of " + std::to_string(angles.size()) + " axes, expected " + std::to_string(source.joints));
  for (double& a : angles) a *= units::deg;
  return angles;
}

// A routine's head ends without a semicolon: its first move stands in one statement with it.
void read_moves(const Source& source, const Statement& s, const std::map<std::string, std::vector<double>>& targets,
                JointPath& path) {
  const std::string low = lowered(s.text);
  for (std::size_t at = low.find("move"); at != low.npos; at = low.find("move", at + 1)) {
    if (at > 0 && low[at - 1] != ' ' && low[at - 1] != ')') continue;
    const std::size_t offset = s.offset_of(at);
    const std::string_view move = std::string_view(low).substr(at);
    if (!begins_with_word(move, "moveabsj")) {
      for (const char* other : {"movej", "movel", "movec", "movejdo", "moveldo", "movecdo", "movejsync", "movelsync", "movecsync",
                                "movejao", "movelao", "movecao"})
        if (begins_with_word(move, other))
          source.fail(offset, "moves to places are not read, only MoveAbsJ: '" + s.text.substr(at) + "'");
      continue;
    }
    std::string rest = trimmed(move.substr(8));
    if (rest.starts_with("\\conc")) rest = trimmed(std::string_view(rest).substr(rest.find(',') + 1));
    if (rest.starts_with("[")) {
      path.push_back(target(source, rest, offset));
      return;
    }
    const std::string name = trimmed(std::string_view(rest).substr(0, rest.find_first_of(",\\ ")));
    const auto found = targets.find(name);
    if (found == targets.end()) source.fail(offset, "the jointtarget '" + name + "' is not declared in this file");
    path.push_back(found->second);
    return;
  }
}

}  // namespace

std::string write_rapid(const Moves& moves) {
  std::string out = "MODULE " + moves.name + "\n";
  const bool zones = std::any_of(moves.share.begin(), moves.share.end(), [](double s) { return s > 0; });
  for (std::size_t i = 0; i < moves.shown.size(); ++i)
    out += "  CONST jointtarget p" + std::to_string(i + 1) + ":=[[" + angle_list(moves.shown[i], true, 5) + "]," +
           no_external_axes + "];\n";
  if (zones) {
    const double mm = moves.zone / units::mm;
    out += "  CONST zonedata corner:=[FALSE," + fixed(mm, 1) + "," + fixed(1.5 * mm, 1) + "," + fixed(1.5 * mm, 1) + "," +
           fixed(0.15 * mm, 2) + "," + fixed(1.5 * mm, 1) + "," + fixed(0.15 * mm, 2) + "];\n";
  }
  out += "  PROC main()\n";
  for (std::size_t i = 0; i < moves.shown.size(); ++i) {
    const std::string time = i == 0 ? "" : "\\T:=" + fixed(std::max(moves.seconds[i], 0.01), 3);
    out +=
        "    MoveAbsJ p" + std::to_string(i + 1) + ",v100" + time + "," + (moves.share[i] > 0 ? "corner" : "fine") + ",tool0;\n";
  }
  return out + "  ENDPROC\nENDMODULE\n";
}

JointPath read_rapid(const Source& source) {
  std::map<std::string, std::vector<double>> targets;
  JointPath path;
  const std::vector<Statement> statements = statements_of(source, "!");
  for (const Statement& s : statements) {  // data may stand after the routines
    const std::string low = lowered(s.text);
    const auto at = low.find("jointtarget "), assigned = low.find(":=");
    if (at == low.npos || assigned == low.npos || assigned < at) continue;
    targets[trimmed(std::string_view(low).substr(at + 12, assigned - at - 12))] =
        target(source, s.text.substr(assigned + 2), s.offset);
  }
  for (const Statement& s : statements) read_moves(source, s, targets, path);
  return path;
}

}  // namespace tendril::program
