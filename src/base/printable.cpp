#include "base/printable.h"

#include <algorithm>

namespace tendril {
namespace {

/// Back to where a character of UTF-8 begins.
std::size_t character_start(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) --at;
  return at;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string out(text);
  if (text.size() > longest) {
    const std::size_t head = character_start(text, 2 * longest / 3), tail = character_start(text, text.size() - longest / 3);
    out = std::string(text.substr(0, head)) + " ... " + std::string(text.substr(tail));
  }
  std::replace_if(out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return out;
}

}  // namespace tendril
