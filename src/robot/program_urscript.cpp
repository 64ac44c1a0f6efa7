// URScript: movej through joint positions (Universal Robots: The URScript Programming Language). Angles in rad.
#include <algorithm>

#include "robot/program_text.h"

namespace tendril::program {

std::string write_urscript(const Moves& moves) {
  std::string out = "def " + moves.name + "():\n";
  for (std::size_t i = 0; i < moves.shown.size(); ++i) {
    out += "  movej([" + angle_list(moves.shown[i], false, 7, ", ") + "], ";
    out += i == 0 ? "a=0.5, v=0.2" : "t=" + fixed(std::max(moves.seconds[i], 0.01), 3);
    if (moves.radius[i] > 0) out += ", r=" + fixed(moves.radius[i], 4);
    out += ")\n";
  }
  return out + "end\n";
}

namespace {

std::vector<double> joints(const Source& source, std::string_view list, std::size_t offset) {
  const auto open = list.find('['), close = list.find(']');
  if (open == list.npos || close == list.npos)
    source.fail(offset, "got '" + std::string(list) + "', expected a list of joint positions");
  std::vector<double> angles = number_list(source, list.substr(open + 1, close - open - 1), offset);
  if (static_cast<int>(angles.size()) != source.joints)
    source.fail(offset, "a list of " + std::to_string(angles.size()) + " joints, expected " + std::to_string(source.joints));
  return angles;
}

}  // namespace

JointPath read_urscript(const Source& source) {
  std::map<std::string, std::vector<double>> named;
  JointPath path;
  for (const Statement& line : lines_of(source, "#")) {
    for (const char* other : {"movel", "movep", "movec", "servoj", "servoc", "speedj", "speedl"})
      if (begins_with_word(line.text, other))
        source.fail(line.offset, "only movej to joint positions is read: '" + line.text + "'");
    if (begins_with_word(line.text, "movej")) {
      const auto open = line.text.find('(');
      const std::string inner = open == line.text.npos ? "" : trimmed(std::string_view(line.text).substr(open + 1));
      if (inner.starts_with("[")) {
        path.push_back(joints(source, inner, line.offset));
        continue;
      }
      if (inner.starts_with("p["))
        source.fail(line.offset, "moves to places are not read, only to joint positions: '" + line.text + "'");
      const std::string name = trimmed(std::string_view(inner).substr(0, inner.find_first_of(",)")));
      const auto found = named.find(name);
      if (found == named.end()) source.fail(line.offset, "the joint positions '" + name + "' are not set before");
      path.push_back(found->second);
      continue;
    }
    // name = [a, b, c, d, e, f]
    const auto assigned = line.text.find('=');
    if (assigned == line.text.npos) continue;
    std::string name = trimmed(std::string_view(line.text).substr(0, assigned));
    for (const char* scope : {"global ", "local "})
      if (name.starts_with(scope)) name = trimmed(std::string_view(name).substr(std::string_view(scope).size()));
    const std::string value = trimmed(std::string_view(line.text).substr(assigned + 1));
    const auto commas = std::count(value.begin(), value.end(), ',');
    if (value.starts_with("[") && value.ends_with("]") && commas == source.joints - 1)
      named[name] = joints(source, value, line.offset);
  }
  return path;
}

}  // namespace tendril::program
