// The mesh of a link: read from its file when first asked for.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "geometry/triangle_surface.h"

namespace tendril {

/// Safe from several threads.
class LinkMesh {
 public:
  explicit LinkMesh(Mesh mesh);
  /// `scale`: metres in one unit of the file along its axes; a negative one mirrors.
  LinkMesh(std::string path, const Vec3& scale);
  LinkMesh(const LinkMesh&) = delete;
  LinkMesh& operator=(const LinkMesh&) = delete;

  const std::string& path() const { return path_; }  ///< empty: not from a file

  /// In m, in the axes of the shape. The first call reads the file; throws UsageError naming it when it is no mesh.
  const std::shared_ptr<const TriangleSurface>& surface() const;

 private:
  std::string path_;
  Vec3 scale_ = Vec3::Ones();
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const TriangleSurface> surface_;
};

}  // namespace tendril
