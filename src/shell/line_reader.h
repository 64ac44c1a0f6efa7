// Where an interactive session gets its lines from.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::shell {

struct Line {
  enum class Kind { text, interrupted, end };
  Kind kind = Kind::end;
  std::string text;  ///< without the newline at its end; a pasted block has newlines inside
};

class LineReader {
 public:
  virtual ~LineReader() = default;

  virtual Line read(const char* prompt) = 0;

  /// Puts a line into the history.
  virtual void remember(const std::string&) {}
};

/// What could stand at the end of a text: `typed` is the part of the text that the candidates replace.
struct Completion {
  std::size_t typed = 0;  ///< characters
  std::vector<std::string> candidates;
};
using Completer = std::function<Completion(std::string_view text_before_cursor)>;

/// Editing with history and completion, on a terminal. `history_file` empty: not kept.
std::unique_ptr<LineReader> make_line_editor(Completer completer, const std::string& history_file);

/// Lines as they come, for pipes and for terminals that understand no escapes.
std::unique_ptr<LineReader> make_plain_reader();

}  // namespace tendril::shell
