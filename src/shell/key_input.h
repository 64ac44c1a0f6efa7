// Characters from a terminal, with pasted blocks recognised (bracketed paste: ESC [200~ ... ESC [201~).
#pragma once

#include <deque>
#include <functional>
#include <string>

namespace tendril::shell {

class KeyInput {
 public:
  enum class Got { character, interrupted, end };

  /// `on_signal` is called when a signal other than an interrupt ends the wait.
  explicit KeyInput(int file, std::function<void()> on_signal = {}) : file_(file), on_signal_(std::move(on_signal)) {}

  /// The next character, decoded from UTF-8; a byte that is none comes as U+FFFD. A pasted block is typed in: tabs as
  /// spaces, other control characters dropped. Of a block of several lines the first is typed with its newline, the last
  /// is typed after it, and the whole lines in between are kept for `take_block`.
  Got next(wchar_t& character);

  /// The lines of a paste that follow the line just typed, "" for none; joined by newlines.
  std::string take_block();

 private:
  Got byte(unsigned char& b, int timeout_ms = -1);
  bool follows(const char* sequence);
  Got read_paste();
  void deliver(const std::string& pasted);

  int file_;
  std::function<void()> on_signal_;
  std::deque<unsigned char> waiting_;
  std::string block_;
};

}  // namespace tendril::shell
