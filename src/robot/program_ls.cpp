// LS: joint moves to taught positions by joints, as FANUC's controllers write programs in text. Angles in degrees.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/units.h"
#include "robot/program_text.h"

namespace tendril::program {

namespace {

constexpr const char* attributes =
    "/ATTR\n"
    "OWNER\t\t= MNEDITOR;\n"
    "COMMENT\t\t= \"\";\n"
    "PROG_SIZE\t= 0;\n"
    "FILE_NAME\t= ;\n"
    "VERSION\t\t= 0;\n"
    "LINE_COUNT\t= {lines};\n"
    "MEMORY_SIZE\t= 0;\n"
    "PROTECT\t\t= READ_WRITE;\n"
    "TCD:  STACK_SIZE\t= 0,\n"
    "      TASK_PRIORITY\t= 50,\n"
    "      TIME_SLICE\t= 0,\n"
    "      BUSY_LAMP_OFF\t= 0,\n"
    "      ABORT_REQUEST\t= 0,\n"
    "      PAUSE_REQUEST\t= 0;\n"
    "DEFAULT_GROUP\t= 1,*,*,*,*;\n"
    "CONTROL_CODE\t= 00000000 00000000;\n";

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "P[3]" or "P[3:name]" -> 3; 0 when it is none.
int position_number(std::string_view text) {
  if (text.substr(0, 2) != "p[") return 0;
  int number = 0;
  for (std::size_t i = 2; i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) && number < 100'000; ++i)
    number = 10 * number + (text[i] - '0');
  return number;
}

// The joints of the positions behind /POS.
std::map<int, std::vector<double>> positions_of(const Source& source, std::size_t from) {
  std::map<int, std::vector<double>> found;
  const std::string low = lowered(source.text);
  for (std::size_t at = low.find("p[", from); at != low.npos; at = low.find("p[", at + 1)) {
    const std::size_t open = low.find('{', at), close = low.find('}', at);
    if (open == low.npos || close == low.npos || close < open) source.fail(at, "a position without { and }");
    const std::string_view inner = std::string_view(low).substr(open + 1, close - open - 1);
    std::vector<double> angles;
    for (int k = 1; k <= source.joints; ++k) {
      const std::string name = "j" + std::to_string(k);
      std::size_t place = inner.find(name);
      while (place != inner.npos && inner.find_first_not_of(" \t", place + 2) != inner.find('=', place))
        place = inner.find(name, place + 1);
      if (place == inner.npos) break;
      const std::size_t value = inner.find('=', place) + 1, unit = inner.find("deg", value);
      if (unit == inner.npos) source.fail(open + 1 + place, "J" + std::to_string(k) + " is not in deg");
      angles.push_back(number(source, inner.substr(value, unit - value), open + 1 + place) * units::deg);
    }
    if (static_cast<int>(angles.size()) == source.joints) found[position_number(std::string_view(low).substr(at))] = angles;
    at = close;
  }
  return found;
}

}  // namespace

std::string write_ls(const Moves& moves) {
  std::string head = attributes;
  head.replace(head.find("{lines}"), 7, std::to_string(moves.shown.size()));
  std::string out = "/PROG  " + upper_case(moves.name) + "\n" + head + "/MN\n";
  const int speed = std::max(1, static_cast<int>(std::lround(100 * moves.speed)));
  for (std::size_t i = 0; i < moves.shown.size(); ++i) {
    const int share = static_cast<int>(std::lround(100 * moves.share[i]));
    std::string number = std::to_string(i + 1);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, ' ');
    out += number + ":J P[" + std::to_string(i + 1) + "] " + std::to_string(i == 0 ? std::min(speed, 10) : speed) + "% " +
           (share > 0 ? "CNT" + std::to_string(share) : "FINE") + "    ;\n";
  }
  out += "/POS\n";
  for (std::size_t i = 0; i < moves.shown.size(); ++i) {
    out += "P[" + std::to_string(i + 1) + "]{\n   GP1:\n\tUF : 0, UT : 1,\n";
    for (std::size_t k = 0; k < moves.shown[i].size(); ++k)
      out += std::string("\tJ") + std::to_string(k + 1) + "= " + fixed(moves.shown[i][k] / units::deg, 4) + " deg" +
             (k + 1 == moves.shown[i].size() ? "\n" : (k % 3 == 2 ? ",\n" : ","));
    out += "};\n";
  }
  return out + "/END\n";
}

JointPath read_ls(const Source& source) {
  const std::string low = lowered(source.text);
  const std::size_t program = low.find("/mn"), place = low.find("/pos");
  if (program == low.npos || place == low.npos || place < program) source.fail(0, "no LS program: it has no /MN and /POS");
  const std::map<int, std::vector<double>> positions = positions_of(source, place);
  JointPath path;
  for (const Statement& line : lines_of({source.text.substr(0, place), source.name, source.joints}, "!")) {
    if (line.offset < program) continue;
    // "  12:J P[3] 50% FINE ;", "  13:L P[4] 100mm/sec ..."
    const std::string text = lowered(line.text);
    const auto colon = text.find(':');
    if (colon == text.npos || text.find_first_not_of("0123456789 ") != colon) continue;
    const std::string statement = trimmed(std::string_view(text).substr(colon + 1));
    if (begins_with_word(statement, "l") || begins_with_word(statement, "c") || begins_with_word(statement, "a"))
      source.fail(line.offset, "only joint moves (J) are read: '" + line.text + "'");
    if (!begins_with_word(statement, "j")) continue;
    const std::string target = trimmed(std::string_view(statement).substr(1));
    const int number = position_number(target);
    if (number == 0) source.fail(line.offset, "only moves to positions P[] are read: '" + line.text + "'");
    const auto found = positions.find(number);
    if (found == positions.end())
      source.fail(line.offset, "P[" + std::to_string(number) + "] is not given by its joints in this file");
    path.push_back(found->second);
  }
  return path;
}

}  // namespace tendril::program
