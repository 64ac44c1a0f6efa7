#include "robot/program_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/printable.h"
#include "base/units.h"

namespace tendril::program {

namespace {

constexpr std::string_view blanks = " \t\r\n";

// A line up to its comment, with blanks for what its strings say.
std::string code_of(std::string_view line, std::string_view comment) {
  std::string code;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!quoted && line.substr(i, comment.size()) == comment) break;
    code += quoted && line[i] != '"' ? ' ' : line[i];
  }
  return code;
}

}  // namespace

void Source::fail(std::size_t offset, const std::string& why) const {
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n');
  throw UsageError("program '" + name + ":" + std::to_string(line) + "': " + printable(why));
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  const bool zero = std::string_view(text).find_first_of("123456789") == std::string_view::npos;
  return zero && text[0] == '-' ? text + 1 : text;
}

std::string angle_list(const std::vector<double>& angles, bool degrees, int digits, const char* between) {
  std::string out;
  for (double angle : angles) out += (out.empty() ? "" : between) + fixed(degrees ? angle / units::deg : angle, digits);
  return out;
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks), last = text.find_last_not_of(blanks);
  return first == text.npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::string lowered(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool begins_with_word(std::string_view text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  return text.size() == word.size() || !(std::isalnum(static_cast<unsigned char>(text[word.size()])) || text[word.size()] == '_');
}

std::size_t Statement::offset_of(std::size_t place) const {
  std::size_t found = offset;
  for (const auto& [begin, in_source] : lines)
    if (begin <= place) found = in_source;
  return found;
}

std::vector<Statement> lines_of(const Source& source, std::string_view comment) {
  std::vector<Statement> lines;
  for (std::size_t at = 0; at < source.text.size();) {
    const std::size_t end = std::min(source.text.find('\n', at), source.text.size());
    const std::string line = code_of(source.text.substr(at, end - at), comment);
    const auto first = line.find_first_not_of(blanks);
    if (first != line.npos) lines.push_back({trimmed(line), at + first});
    at = end + 1;
  }
  return lines;
}

std::vector<Statement> statements_of(const Source& source, std::string_view comment) {
  std::vector<Statement> statements;
  Statement open{"", 0};
  for (const Statement& line : lines_of(source, comment)) {
    std::size_t at = 0;
    while (at <= line.text.size()) {
      const std::size_t end = line.text.find(';', at);
      const std::string part = trimmed(std::string_view(line.text).substr(at, end - at));
      if (!part.empty()) {
        if (open.text.empty()) open.offset = line.offset + at;
        open.text += open.text.empty() ? "" : " ";
        open.lines.push_back({open.text.size(), line.offset + at});
        open.text += part;
      }
      if (end == line.text.npos) break;
      if (!open.text.empty()) statements.push_back(open);
      open = {"", 0};
      at = end + 1;
    }
  }
  if (!open.text.empty()) statements.push_back(open);
  return statements;
}

double number(const Source& source, std::string_view text, std::size_t offset) {
  std::string word = trimmed(text);
  double unit = 1;
  if (lowered(std::string_view(word).substr(0, 4)) == "d2r(" && word.back() == ')') {
    word = trimmed(std::string_view(word).substr(4, word.size() - 5));
    unit = units::deg;
  }
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    source.fail(offset, "got '" + word + "', expected a finite number");
  return unit * value;
}

std::vector<double> number_list(const Source& source, std::string_view text, std::size_t offset) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    numbers.push_back(number(source, text.substr(at, end - at), offset));
    at = end + 1;
  }
  return numbers;
}

}  // namespace tendril::program
