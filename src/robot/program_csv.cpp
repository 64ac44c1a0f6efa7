// Joint paths as rows of numbers: a head of names, then one point a row. Separated by commas, semicolons, tabs or blanks.
#include <cctype>

#include "base/units.h"
#include "robot/program_text.h"

namespace tendril::program {

std::string write_csv(const Robot& robot, const Moves& moves) {
  std::string out;
  std::vector<bool> turning;
  for (int k = 0; k < robot.size(); ++k) {
    turning.push_back(robot.variable(k).kind != JointKind::prismatic);
    out += (k ? "," : "") + robot.variable(k).name + (turning.back() ? " (deg)" : " (m)");
  }
  out += "\n";
  for (const auto& point : moves.shown) {
    for (std::size_t k = 0; k < point.size(); ++k)
      out += (k ? "," : "") + fixed(turning[k] ? point[k] / units::deg : point[k], turning[k] ? 7 : 9);
    out += "\n";
  }
  return out;
}

JointPath read_csv(const Source& source, const Robot& robot, bool degrees) {
  JointPath path;
  bool head_allowed = true;
  for (const Statement& line : lines_of(source, "#")) {
    const bool letters = line.text.find_first_of("0123456789") == line.text.npos ||
                         std::isalpha(static_cast<unsigned char>(line.text[0])) || line.text[0] == '"';
    if (head_allowed && letters) {
      head_allowed = false;
      continue;
    }
    head_allowed = false;
    const char separator = line.text.find(';') != line.text.npos    ? ';'
                           : line.text.find(',') != line.text.npos  ? ','
                           : line.text.find('\t') != line.text.npos ? '\t'
                                                                    : ' ';
    std::vector<double> point;
    for (std::size_t at = 0; at <= line.text.size();) {
      const std::size_t end = std::min(line.text.find(separator, at), line.text.size());
      const std::string word = trimmed(std::string_view(line.text).substr(at, end - at));
      const bool turns = static_cast<int>(point.size()) < robot.size() &&
                         robot.variable(static_cast<int>(point.size())).kind != JointKind::prismatic;
      if (!(separator == ' ' && word.empty()))
        point.push_back(number(source, word, line.offset) * (degrees && turns ? units::deg : 1));
      at = end + 1;
    }
    if (static_cast<int>(point.size()) != source.joints)
      source.fail(line.offset,
                  "a row of " + std::to_string(point.size()) + " numbers, expected " + std::to_string(source.joints));
    path.push_back(std::move(point));
  }
  return path;
}

}  // namespace tendril::program
