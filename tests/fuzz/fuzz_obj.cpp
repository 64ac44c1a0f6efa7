// OBJ files: what is read is sound, and reads back from what is written of it bit by bit.
#include "geometry/mesh_file.h"
#include "mesh_promises.h"

using namespace tendril;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mesh mesh;
  if (!fuzz::accepts("mesh 'input'", [&] { mesh = parse_obj(fuzz::text_of(data, size), "input"); })) return 0;
  fuzz::expect_usable(mesh);
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) return 0;
  fuzz::expect(fuzz::same_bits(mesh, parse_obj(obj_of(mesh), "written")), "a mesh that is written reads back the same");
  return 0;
}
