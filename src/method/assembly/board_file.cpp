#include <cstdio>

#include "base/units.h"
#include "method/assembly/flatten.h"

namespace tendril::assembly {

namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string row(const std::string& kind, const std::string& name, const Vec3& at) {
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, ",%.6f,%.6f\n", at.x() / units::mm, at.y() / units::mm);
  return kind + "," + csv_field(name) + numbers;
}

}  // namespace

std::string board_csv(const FlattenResult& result) {
  std::string text = "kind,name,x [mm],y [mm]\n";
  for (const BoardPoint& point : result.points) text += row("point", point.name, point.at);
  for (const BoardLine& line : result.lines)
    for (const Vec3& p : line.points) text += row("line", line.rod, p);
  return text;
}

}  // namespace tendril::assembly
