#include "harness/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_text.h"
#include "base/printable.h"

namespace tendril {
namespace {

/// Builds a Json from the parser's events; the parser itself does not recurse.
class Builder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  Json root;
  std::string wrong;          ///< empty, or why reading ended
  std::size_t position = 0;   ///< bytes read when it did, where known; else 0

  bool null() override { return put({nullptr}); }
  bool boolean(bool value) override { return put({value}); }
  bool number_integer(number_integer_t value) override { return put({static_cast<double>(value)}); }
  bool number_unsigned(number_unsigned_t value) override { return put({static_cast<double>(value)}); }
  bool number_float(number_float_t value, const string_t&) override { return put({static_cast<double>(value)}); }
  bool string(string_t& value) override { return put({std::move(value)}); }
  bool binary(binary_t&) override { return fail("binary data have no place in a text"); }
  bool start_object(std::size_t) override { return open({Json::Object()}); }
  bool start_array(std::size_t) override { return open({Json::List()}); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    std::get<Json::Object>(open_.back().value).push_back({std::move(value), {}});
    return true;
  }

  bool end_object() override {
    std::vector<std::string_view> keys;
    for (const JsonMember& member : std::get<Json::Object>(open_.back().value)) keys.push_back(member.key);
    std::sort(keys.begin(), keys.end());
    const auto twice = std::adjacent_find(keys.begin(), keys.end());
    if (twice != keys.end()) return fail("the key '" + std::string(*twice) + "' stands twice in one object");
    return close();
  }

  bool parse_error(std::size_t at, const std::string&, const nlohmann::detail::exception& error) override {
    wrong = error.what();
    wrong.erase(0, wrong.find("] ") == wrong.npos ? 0 : wrong.find("] ") + 2);  // the library's own number of the error
    position = at;
    return false;
  }

 private:
  bool fail(std::string why) {
    wrong = std::move(why);
    return false;
  }

  bool open(Json value) {
    if (static_cast<int>(open_.size()) >= json_depth)
      return fail("lists and objects are nested deeper than " + std::to_string(json_depth));
    open_.push_back(std::move(value));
    return true;
  }

  bool close() {
    Json done = std::move(open_.back());
    open_.pop_back();
    return put(std::move(done));
  }

  bool put(Json value) {
    if (open_.empty()) root = std::move(value);
    else if (auto* list = std::get_if<Json::List>(&open_.back().value)) list->push_back(std::move(value));
    else std::get<Json::Object>(open_.back().value).back().value = std::move(value);
    return true;
  }

  std::vector<Json> open_;
};

void append_number(std::string& text, double number) {
  char digits[40];
  const double size = std::abs(number);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e15);  // 6000000, not 6e+06
  const auto end = plain ? std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed).ptr
                         : std::to_chars(digits, digits + sizeof digits, number).ptr;
  const std::string_view written(digits, static_cast<std::size_t>(end - digits));
  text += written;
  if (written == "-0") text += ".0";  // readers take "-0" for a whole number and lose the sign
}

void append_word(std::string& text, std::string_view word) {
  if (!is_utf8(word)) throw UsageError("the text '" + printable(word, 60) + "' is not UTF-8, which JSON needs");
  text += json_string(word);
}

bool is_scalar(const Json& json) { return json.value.index() < 4; }

bool is_scalars(const Json& json) {
  const auto* list = std::get_if<Json::List>(&json.value);
  return list && std::all_of(list->begin(), list->end(), is_scalar);
}

/// All of it on one line.
void append_line(std::string& text, const Json& json) {
  if (std::holds_alternative<std::nullptr_t>(json.value)) text += "null";
  else if (const bool* flag = std::get_if<bool>(&json.value)) text += *flag ? "true" : "false";
  else if (const double* number = std::get_if<double>(&json.value)) append_number(text, *number);
  else if (const std::string* word = std::get_if<std::string>(&json.value)) append_word(text, *word);
  else if (const auto* list = std::get_if<Json::List>(&json.value)) {
    text += '[';
    for (const Json& item : *list) {
      if (&item != list->data()) text += ", ";
      append_line(text, item);
    }
    text += ']';
  } else {
    const auto& object = std::get<Json::Object>(json.value);
    text += '{';
    for (const JsonMember& member : object) {
      if (&member != object.data()) text += ", ";
      append_word(text, member.key);
      text += ": ";
      append_line(text, member.value);
    }
    text += '}';
  }
}

void append(std::string& text, const Json& json, std::size_t indent);

/// Items or members between brackets, one a line.
template <class Entries, class AppendEntry>
void append_block(std::string& text, const Entries& entries, const char* brackets, std::size_t indent, AppendEntry append_entry) {
  text += brackets[0];
  for (const auto& entry : entries) {
    text += &entry == entries.data() ? "\n" : ",\n";
    text.append(indent + 2, ' ');
    append_entry(entry);
  }
  text += '\n';
  text.append(indent, ' ');
  text += brackets[1];
}

void append(std::string& text, const Json& json, std::size_t indent) {
  constexpr std::size_t widest = 110;
  const auto* list = std::get_if<Json::List>(&json.value);
  const auto* object = std::get_if<Json::Object>(&json.value);
  if (!list && !object) return append_line(text, json);
  if (list && is_scalars(json)) return append_line(text, json);
  if (object && std::all_of(object->begin(), object->end(),
                            [](const JsonMember& m) { return is_scalar(m.value) || is_scalars(m.value); })) {
    std::string line;
    append_line(line, json);
    if (line.size() + indent <= widest) {
      text += line;
      return;
    }
  }
  if (list) return append_block(text, *list, "[]", indent, [&](const Json& item) { append(text, item, indent + 2); });
  append_block(text, *object, "{}", indent, [&](const JsonMember& member) {
    append_word(text, member.key);
    text += ": ";
    append(text, member.value, indent + 2);
  });
}

}  // namespace

const Json* Json::find(std::string_view key) const {
  if (const Object* object = std::get_if<Object>(&value))
    for (const JsonMember& member : *object)
      if (member.key == key) return &member.value;
  return nullptr;
}

Json* Json::find(std::string_view key) { return const_cast<Json*>(std::as_const(*this).find(key)); }

Json parse_json(std::string_view text, const std::string& who) {
  Builder builder;
  nlohmann::json::sax_parse(text, &builder);
  if (builder.wrong.empty()) return std::move(builder.root);
  std::string where;
  if (builder.position > 0 && builder.wrong.find(" line ") == std::string::npos) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(builder.position, text.size()));
    where = "line " + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": ";
  }
  throw UsageError(who + ": " + where + printable(builder.wrong, 400));
}

std::string json_text(const Json& json) {
  std::string text;
  append(text, json, 0);
  text += '\n';
  return text;
}

}  // namespace tendril
