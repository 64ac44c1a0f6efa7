// The container of a GLB file: a header, glTF's JSON, and the numbers it refers to.
#pragma once

#include <string>
#include <string_view>

namespace tendril {

/// The whole file (glTF 2.0, binary). `data`: whole words, the first of glTF's buffers. Throws UsageError "who: ..." when it were
/// larger than the 4 GB that such a file can hold.
std::string glb_file(std::string json, std::string_view data, const std::string& who);

}  // namespace tendril
