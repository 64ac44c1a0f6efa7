#include "geometry/glb_file.h"

#include <cstdint>

#include "base/error.h"

namespace tendril {
namespace {

void append(std::string& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(word >> (8 * byte) & 0xff);
}

}  // namespace

std::string glb_file(std::string json, std::string_view data, const std::string& who) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + json.size() + 8 + data.size();
  if (size > 0xffffffffu) throw UsageError(who + ": too large for a GLB file, which holds at most 4 GB; save it as .ply");
  std::string out = "glTF";
  out.reserve(size);
  append(out, 2);
  append(out, size);
  append(out, json.size());
  out += "JSON" + json;
  append(out, data.size());
  out.append("BIN\0", 4);
  out += data;
  return out;
}

}  // namespace tendril
