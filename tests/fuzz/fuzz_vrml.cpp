// VRML97 files: what is read is sound, and bounded by the size of the file.
#include "geometry/mesh_file.h"
#include "geometry/read_vrml.h"
#include "mesh_promises.h"

using namespace tendril;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mesh mesh;
  std::string left_out;
  if (!fuzz::accepts("mesh 'input.wrl'", [&] { mesh = parse_vrml(fuzz::text_of(data, size), "input.wrl", {}, left_out); })) return 0;
  fuzz::expect(mesh.triangles.size() <= 4'000'000, "a small file gives no more than 4 million triangles");
  fuzz::expect(left_out.find('\0') == left_out.npos, "what is left out can be printed");
  if (mesh.triangles.size() > 20'000) {
    fuzz::expect_indices(mesh);  // the rest would take longer than the reader itself
    return 0;
  }
  fuzz::expect_usable(mesh);
  return 0;
}
