// JSON (RFC 8259) as plain data: read strictly, written for people to read.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tendril {

struct JsonMember;

/// A value. Objects keep the order of their members.
struct Json {
  using List = std::vector<Json>;
  using Object = std::vector<JsonMember>;
  std::variant<std::nullptr_t, bool, double, std::string, List, Object> value;

  const Json* find(std::string_view key) const;  ///< of an object; null: no such member, or no object
  Json* find(std::string_view key);
};

struct JsonMember {
  std::string key;
  Json value;
};

/// How deep lists and objects may stand within each other.
inline constexpr int json_depth = 32;

/// Throws UsageError "who: ..." with line and column for what is no JSON, for numbers beyond the range of a double, lists nested
/// deeper than json_depth, and keys that stand twice in one object.
Json parse_json(std::string_view text, const std::string& who);

/// Two blanks of indentation, a member a line; what holds only numbers, words and lists of numbers on one line where it is short
/// enough, lists of numbers always. Numbers have as few digits as give the same bits again, the sign of zero included. A pure
/// function of the value. Numbers must be finite; throws UsageError for texts that are not UTF-8.
std::string json_text(const Json& json);

}  // namespace tendril
