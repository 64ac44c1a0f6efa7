// KRL: PTP to axis positions (KUKA System Software: Operating and Programming Instructions). Angles in degrees.
#include <cmath>

#include "base/units.h"
#include "robot/program_text.h"

namespace tendril::program {

namespace {

// {A1 0,A2 -90,...}, perhaps with a type in front: {E6AXIS: A1 0, ...}. Axes that are left out keep what `angles` holds.
bool read_axes(const Source& source, const std::string& text, std::size_t offset, std::vector<double>& angles) {
  const auto open = text.find('{'), close = text.rfind('}');
  if (open == text.npos || close == text.npos || close < open)
    source.fail(offset, "got '" + text + "', expected {A1 ..., A2 ..., ...}");
  std::string inner = lowered(std::string_view(text).substr(open + 1, close - open - 1));
  if (const auto colon = inner.find(':'); colon != inner.npos) inner = inner.substr(colon + 1);
  int given = 0;
  for (std::size_t at = 0; at < inner.size();) {
    const std::size_t end = std::min(inner.find(',', at), inner.size());
    const std::string entry = trimmed(std::string_view(inner).substr(at, end - at));
    at = end + 1;
    if (entry.size() < 3 || (entry[0] != 'a' && entry[0] != 'e')) return false;  // X, Y, Z, A, B, C: a place
    const auto blank = entry.find_first_of(" \t");
    if (blank == entry.npos || blank < 2) return false;
    if (entry[0] == 'e') continue;  // an external axis
    const int axis = entry[1] - '1';
    if (blank != 2 || axis < 0 || axis >= source.joints) source.fail(offset, "there is no axis '" + entry.substr(0, blank) + "'");
    angles[axis] = number(source, std::string_view(entry).substr(blank), offset) * units::deg;
    ++given;
  }
  return given > 0;
}

}  // namespace

std::string write_krl(const Moves& moves) {
  std::string out = "DEF " + moves.name + "()\n  BAS(#INITMOV,0)\n  BAS(#VEL_PTP,10)\n";
  int last_share = -1;
  for (std::size_t i = 0; i < moves.shown.size(); ++i) {
    if (i == 1) out += "  BAS(#VEL_PTP," + std::to_string(std::max(1, static_cast<int>(std::lround(100 * moves.speed)))) + ")\n";
    const int share = static_cast<int>(std::lround(100 * moves.share[i]));
    if (share > 0 && share != last_share) out += "  $APO.CPTP=" + std::to_string(last_share = share) + "\n";
    std::string axes;
    for (std::size_t k = 0; k < moves.shown[i].size(); ++k)
      axes += (k ? ",A" : "A") + std::to_string(k + 1) + " " + fixed(moves.shown[i][k] / units::deg, 5);
    out += "  PTP {" + axes + "}" + (share > 0 ? " C_PTP" : "") + "\n";
  }
  return out + "END\n";
}

JointPath read_krl(const Source& source) {
  std::map<std::string, std::vector<double>> positions;
  JointPath path;
  const std::vector<Statement> lines = lines_of(source, ";");
  for (const Statement& line : lines) {
    const std::string low = lowered(line.text);
    if (low.find("e6axis ") == low.npos && low.find("axis ") == low.npos) continue;
    const auto assigned = low.find('=');
    if (assigned == low.npos || !(begins_with_word(low, "decl") || begins_with_word(low, "global") ||
                                  begins_with_word(low, "e6axis") || begins_with_word(low, "axis")))
      continue;
    const std::string head = trimmed(std::string_view(low).substr(0, assigned));
    std::vector<double> angles(source.joints, 0.0);
    if (read_axes(source, line.text, line.offset, angles)) positions[head.substr(head.find_last_of(" \t") + 1)] = angles;
  }
  for (const Statement& line : lines) {
    const std::string low = lowered(line.text);
    for (const char* other : {"lin", "circ", "spl", "lin_rel", "circ_rel", "ptp_rel", "slin", "scirc", "sptp"})
      if (begins_with_word(low, other)) source.fail(line.offset, "only PTP to axes is read: '" + line.text + "'");
    if (!begins_with_word(low, "ptp")) continue;
    std::vector<double> angles = path.empty() ? std::vector<double>(source.joints, 0.0) : path.back();
    if (const std::string rest = trimmed(std::string_view(low).substr(3)); !rest.starts_with("{")) {
      const std::string name = rest.substr(0, rest.find_first_of(" \t"));
      const auto found = positions.find(name);
      if (found == positions.end()) source.fail(line.offset, "the axis position '" + name + "' is not declared in this file");
      angles = found->second;
    } else {
      int axes = 0;
      for (std::size_t k = rest.find('a'); k != rest.npos; k = rest.find('a', k + 1))
        axes += k + 1 < rest.size() && std::isdigit(static_cast<unsigned char>(rest[k + 1]));
      if (!read_axes(source, line.text, line.offset, angles))
        source.fail(line.offset, "moves to places are not read, only to axes: '" + line.text + "'");
      if (path.empty() && axes < source.joints) source.fail(line.offset, "the first point leaves axes out");
    }
    path.push_back(angles);
  }
  return path;
}

}  // namespace tendril::program
