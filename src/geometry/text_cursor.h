// Walks through a text file: words and numbers, line by line, without copying.
#pragma once

#include <charconv>
#include <limits>
#include <string_view>
#include <type_traits>

namespace tendril {

class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  bool done() const { return at_ >= end_; }
  int line() const { return line_; }  ///< counted from 1
  std::size_t rest() const { return static_cast<std::size_t>(end_ - at_); }

  /// Past blanks within the line, and past a line break that a backslash hides.
  void skip_blanks() {
    while (at_ < end_) {
      if (*at_ == ' ' || *at_ == '\t' || *at_ == '\r') {
        ++at_;
      } else if (*at_ == '\\' && hidden_break() > 0) {
        at_ += hidden_break();
        ++line_;
      } else {
        return;
      }
    }
  }
  bool at_line_end() {
    skip_blanks();
    return at_ >= end_ || *at_ == '\n';
  }
  void next_line() {
    while (at_ < end_ && *at_ != '\n') ++at_;
    if (at_ < end_) ++at_, ++line_;
  }
  /// To the next word, over line ends too.
  void skip_space() {
    while (!done() && at_line_end() && !done()) next_line();
  }
  /// The next word of the line; empty at its end.
  std::string_view word() {
    skip_blanks();
    const char* first = at_;
    finish_word();
    return {first, static_cast<std::size_t>(at_ - first)};
  }
  /// Past what is left of the word at hand, if anything.
  void finish_word() {
    while (at_ < end_ && !blank(*at_)) ++at_;
  }
  /// False, without moving on, when there is no number.
  template <class Number>
  bool number(Number& value) {
    skip_blanks();
    const char* first = at_ < end_ && *at_ == '+' ? at_ + 1 : at_;
    const auto [after, error] = std::from_chars(first, end_, value);
    if (error == std::errc::result_out_of_range && after != first) {
      // Too small or too large for the type: as good as nothing; or not finite, and of whole numbers the largest, for whoever checks.
      using Limits = std::numeric_limits<Number>;
      if constexpr (std::is_integral_v<Number>) value = *first == '-' ? Limits::min() : Limits::max();
      else value = shrinks(first, after) ? Number{} : Limits::infinity();
    } else if (error != std::errc{}) {
      return false;
    }
    at_ = after;
    return true;
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  static bool shrinks(const char* first, const char* after) {
    const std::string_view digits(first, static_cast<std::size_t>(after - first));
    return digits.find("e-") != digits.npos || digits.find("E-") != digits.npos;
  }
  int hidden_break() const {
    if (at_ + 1 < end_ && at_[1] == '\n') return 2;
    if (at_ + 2 < end_ && at_[1] == '\r' && at_[2] == '\n') return 3;
    return 0;
  }

  const char* at_;
  const char* end_;
  int line_ = 1;
};

}  // namespace tendril
