// STL files, text and binary: what is read is sound, and reads back from what is written of it in single precision.
#include "geometry/mesh_file.h"
#include "mesh_promises.h"

using namespace tendril;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mesh mesh;
  if (!fuzz::accepts("mesh 'input'", [&] { mesh = parse_stl(fuzz::text_of(data, size), "input"); })) return 0;
  fuzz::expect_usable(mesh);
  for (const Vec3& v : mesh.vertices)
    if (!v.cast<float>().allFinite()) return 0;
  fuzz::expect(fuzz::same_bits(fuzz::unshared(mesh), parse_stl(stl_of(mesh), "written")),
               "a mesh that is written reads back the same in single precision");
  return 0;
}
