// Walks through the text of a VRML97 file: words, numbers, strings and brackets; commas and comments are blanks.
#pragma once

#include <array>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace tendril {

class VrmlText {
 public:
  explicit VrmlText(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  /// Of what peek() or the last token found, counted from 1.
  int line() const { return line_; }
  /// All that is still to be read.
  std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

  /// The first character of the next token, which stays; 0 at the end.
  char peek() {
    while (at_ < end_) {
      const unsigned char c = static_cast<unsigned char>(*at_);
      if (c > ' ' && c != ',' && c != '#') return *at_;
      if (c == '\n' || (c == '\r' && !(at_ + 1 < end_ && at_[1] == '\n'))) ++line_;
      if (c == '#') skip_comment();
      else ++at_;
    }
    return 0;
  }
  /// Takes one character: a bracket that peek() saw.
  void take() { ++at_; }

  /// What stands up to the next blank, bracket or quotation mark; empty at these. Numbers and names are words.
  std::string_view word() {
    peek();
    const char* first = at_;
    while (at_ < end_ && !ends_word(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  /// False, without moving on, when there is no number. What is too large for the type becomes infinite or `int`'s
  /// largest, what is too small 0. A hexadecimal number is read by its `0` alone: no field of interest holds one.
  template <class Number>
  bool number(Number& value) {
    peek();
    const char* first = at_ < end_ && *at_ == '+' ? at_ + 1 : at_;
    const auto [after, error] = std::from_chars(first, end_, value);
    if (error == std::errc::result_out_of_range && after != first) value = out_of_range<Number>({first, after});
    else if (error != std::errc{}) return false;
    at_ = after;
    return true;
  }

  /// The text between quotation marks, which peek() saw; `\"` and `\\` stand for what follows the backslash. False
  /// when it does not end.
  bool string(std::string& value) {
    value.clear();
    for (++at_; at_ < end_ && *at_ != '"'; ++at_) {
      if (*at_ == '\\' && at_ + 1 < end_) ++at_;
      if (*at_ == '\n') ++line_;
      value += *at_;
    }
    if (at_ >= end_) return false;
    ++at_;
    return true;
  }

 private:
  static bool ends_word(char c) {
    static constexpr std::array<bool, 256> ends = [] {
      std::array<bool, 256> table{};
      for (int k = 0; k <= ' '; ++k) table[k] = true;
      for (const char k : {',', '#', '"', '[', ']', '{', '}'}) table[static_cast<unsigned char>(k)] = true;
      return table;
    }();
    return ends[static_cast<unsigned char>(c)];
  }
  void skip_comment() {
    while (at_ < end_ && *at_ != '\n' && *at_ != '\r') ++at_;
  }
  template <class Number>
  static Number out_of_range(std::string_view digits) {
    if constexpr (std::is_integral_v<Number>) return std::numeric_limits<Number>::max();
    const bool small = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos;
    return small ? Number{} : std::numeric_limits<Number>::infinity();
  }

  const char* at_;
  const char* end_;
  int line_ = 1;
};

}  // namespace tendril
