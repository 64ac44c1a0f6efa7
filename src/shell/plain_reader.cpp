#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "shell/interrupts.h"
#include "shell/line_reader.h"

namespace tendril::shell {
namespace {

/// Reads through stdio, so that a script's io.read() takes the lines that follow.
class PlainReader : public LineReader {
 public:
  Line read(const char*) override {
    Line line;
    for (;;) {
      const int c = std::getc(stdin);
      if (c == '\n') break;
      if (c == EOF) {
        if (errno == EINTR && std::ferror(stdin)) {
          std::clearerr(stdin);
          if (Interrupts::flag()) return {Line::Kind::interrupted, {}};
          errno = 0;
          continue;
        }
        if (line.text.empty()) return {Line::Kind::end, {}};
        break;
      }
      line.text += static_cast<char>(c);
    }
    line.kind = Line::Kind::text;
    return line;
  }
};

}  // namespace

std::unique_ptr<LineReader> make_plain_reader() { return std::make_unique<PlainReader>(); }

}  // namespace tendril::shell
