// Enough of Lua's syntax to know where the cursor stands in a text that is not finished.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::shell {

/// Brackets and strings of a text.
struct Scan {
  struct Open {
    char bracket;
    std::size_t at;
  };
  std::vector<Open> open;                         ///< brackets not closed yet, outermost first
  std::map<std::size_t, std::size_t> group_start;  ///< by the place behind a closed bracket or string: where it starts
  std::optional<std::size_t> string_at;           ///< the text ends inside a string that starts here
  bool in_comment = false;                        ///< the text ends inside a comment
};

Scan scan(std::string_view text);

/// One step of a chain such as `eq:rod("hose").points[1]`.
struct Link {
  enum class Kind { name, field, method, call, index } kind;
  std::string_view name;  ///< of name, field and method
};

/// The chain that ends at `end`; empty when there is none.
std::vector<Link> chain_before(std::string_view text, const Scan& scan, std::size_t end);

bool is_name_character(char c);

}  // namespace tendril::shell
