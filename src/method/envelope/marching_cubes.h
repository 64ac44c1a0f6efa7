// The surface between the nodes inside and outside, as a mesh without duplicate vertices.
#pragma once

#include <optional>
#include <vector>

#include "geometry/mesh.h"
#include "method/envelope/field.h"

namespace tendril::envelope {

/// One vertex for each crossed edge, numbered block by block. A vertex' number is its block's first plus a count of bits:
/// nothing is searched for, nothing welded.
class MarchingCubes {
 public:
  /// Numbers vertices and counts triangles.
  void count(const Field& field, const RunContext& context);
  std::size_t vertices() const { return vertices_; }
  std::size_t triangles() const { return triangles_; }

  /// Writes them: vertices in m about `origin`.
  std::optional<Status> write(const BlockMap& map, const Field& field, const Vec3& origin, Mesh& mesh,
                              const RunContext& context) const;

 private:
  /// Of one block.
  struct Numbers {
    std::uint16_t before[3][7];  ///< its vertices before those of an axis and layer
    std::uint16_t vertices = 0;
    std::uint32_t triangles = 0;
    int first_vertex = 0, first_triangle = 0;
  };
  class Writer;
  static void count_block(const FieldBlock& block, Numbers& numbers);

  std::vector<Numbers> numbers_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

/// The volume within a closed mesh, m^3; summed in an order that does not depend on the number of threads.
double volume_of(const Mesh& mesh, const RunContext& context);

}  // namespace tendril::envelope
