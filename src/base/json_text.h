// Text in JSON files.
#pragma once

#include <string>
#include <string_view>

namespace tendril {

/// In quotation marks, with what JSON does not allow as it stands escaped. Text that is not UTF-8 is written with a question
/// mark for each of its bytes above 127: readers refuse a whole file for one bad byte.
std::string json_string(std::string_view text);

bool is_utf8(std::string_view text);

}  // namespace tendril
