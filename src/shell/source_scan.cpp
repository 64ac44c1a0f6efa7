#include "shell/source_scan.h"

#include <algorithm>
#include <cctype>

namespace tendril::shell {
namespace {

/// Number of '=' of a long bracket that opens at `at`, or -1.
int long_bracket(std::string_view text, std::size_t at) {
  if (at >= text.size() || text[at] != '[') return -1;
  std::size_t i = at + 1;
  while (i < text.size() && text[i] == '=') ++i;
  return i < text.size() && text[i] == '[' ? static_cast<int>(i - at - 1) : -1;
}

/// The place behind the long bracket of `level` that opened at `at`, or npos.
std::size_t end_of_long(std::string_view text, std::size_t at, int level) {
  const std::string closing = "]" + std::string(static_cast<std::size_t>(level), '=') + "]";
  const std::size_t found = text.find(closing, at);
  return found == std::string_view::npos ? found : found + closing.size();
}

std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    else if (text[i] == text[at]) return i + 1;
    else if (text[i] == '\n') return i;  // a string that was never closed ends with its line
  }
  return std::string_view::npos;
}

/// Behind the comment at `at`; npos when the text ends inside it.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
  const int level = long_bracket(text, at + 2);
  return level >= 0 ? end_of_long(text, at + 2, level) : text.find('\n', at);
}

char opening_of(char closing) { return closing == ')' ? '(' : closing == ']' ? '[' : '{'; }

}  // namespace

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

Scan scan(std::string_view text) {
  Scan result;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '-' && text.substr(i, 2) == "--") {
      const std::size_t end = end_of_comment(text, i);
      if (end == std::string_view::npos) {
        result.in_comment = true;
        return result;
      }
      i = end;
    } else if (c == '"' || c == '\'' || long_bracket(text, i) >= 0) {
      const std::size_t end = c == '[' ? end_of_long(text, i, long_bracket(text, i)) : end_of_string(text, i);
      if (end == std::string_view::npos) {
        result.string_at = i;
        return result;
      }
      result.group_start[end] = i;
      i = end;
    } else {
      if (c == '(' || c == '[' || c == '{') result.open.push_back({c, i});
      if ((c == ')' || c == ']' || c == '}') && !result.open.empty() && result.open.back().bracket == opening_of(c)) {
        result.group_start[i + 1] = result.open.back().at;
        result.open.pop_back();
      }
      ++i;
    }
  }
  return result;
}

std::vector<Link> chain_before(std::string_view text, const Scan& scan, std::size_t end) {
  std::vector<Link> links;
  for (std::size_t i = end;;) {
    while (i > 0 && text[i - 1] == ' ' && (i == end || !is_name_character(text[i]))) --i;  // f {x}, f 'x'
    if (const auto group = scan.group_start.find(i); group != scan.group_start.end()) {
      i = group->second;
      links.push_back({text[i] == '[' && long_bracket(text, i) < 0 ? Link::Kind::index : Link::Kind::call, {}});
      continue;
    }
    const std::size_t name_end = i;
    while (i > 0 && is_name_character(text[i - 1])) --i;
    if (i == name_end) return {};
    const std::string_view name = text.substr(i, name_end - i);
    const char before = i > 0 ? text[i - 1] : '\0';
    if (before != '.' && before != ':') {
      links.push_back({Link::Kind::name, name});
      break;
    }
    links.push_back({before == '.' ? Link::Kind::field : Link::Kind::method, name});
    --i;
  }
  std::reverse(links.begin(), links.end());
  return links;
}

}  // namespace tendril::shell
