#include "engine_bay/ply.h"

#include <bit>
#include <cstring>
#include <sstream>

namespace tendril::engine_bay {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

}  // namespace

std::string ply(const std::vector<Part>& parts) {
  std::size_t points = 0, triangles = 0;
  for (const Part& part : parts) points += part.mesh.points.size(), triangles += part.mesh.triangles.size();

  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\ncomment engine bay, mm\nelement vertex " << points
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << triangles
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string out = header.str();
  out.reserve(out.size() + 12 * points + 13 * triangles);
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.points)
      for (int a = 0; a < 3; ++a) put(out, static_cast<float>(p[a]));
  std::int32_t first = 0;
  for (const Part& part : parts) {
    for (const auto& t : part.mesh.triangles) {
      put(out, static_cast<unsigned char>(3));
      for (const std::uint32_t corner : t) put(out, first + static_cast<std::int32_t>(corner));
    }
    first += static_cast<std::int32_t>(part.mesh.points.size());
  }
  return out;
}

std::string part_list(const std::vector<Part>& parts) {
  std::ostringstream out;
  std::size_t first = 0;
  for (const Part& part : parts) {
    out << part.name << ' ' << (part.closed ? "body" : "sheet") << ' ' << first << ' ' << part.mesh.triangles.size() << '\n';
    first += part.mesh.triangles.size();
  }
  for (const Connection& c : connections())
    out << "connection " << c.name << "  " << c.tip.transpose() << "  " << c.along.transpose() << "  " << c.radius << '\n';
  return out.str();
}

}  // namespace tendril::engine_bay
