// Words out of foreign files, for messages.
#pragma once

#include <string>
#include <string_view>

namespace tendril {

/// The text with a question mark for every control character, which could end the message or steer the terminal, and with dots
/// for the middle of what is longer than `longest` bytes.
std::string printable(std::string_view text, std::size_t longest = 300);

}  // namespace tendril
