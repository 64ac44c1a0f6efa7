#include "geometry/read_vrml_faces.h"

#include <utility>

#include "geometry/mesh_file.h"
#include "geometry/read_vrml_text.h"

namespace tendril {

namespace {

[[noreturn]] void fail_at_corner(const VrmlFaces& faces, std::size_t at, const std::string& name, const std::string& why) {
  VrmlText again(faces.corners_text);
  if (again.peek() == '[') again.take();
  int ignored;
  for (std::size_t i = 0; i <= at; ++i) again.number(ignored);
  fail_mesh(name, "line " + std::to_string(faces.corners_line + again.line() - 1) + ": " + why);
}

}  // namespace

void turn_inside_out(Mesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

Mesh VrmlCutter::cut(const VrmlFaces& faces, const std::vector<Vec3>& points, const std::string& name, int& short_faces) {
  Mesh mesh;
  mesh.triangles.reserve(faces.corners.size() / 4 + 1);
  const int count = static_cast<int>(points.size());
  const std::size_t size = faces.corners.size();
  std::vector<int> face;
  for (std::size_t i = 0; i <= size; ++i) {
    const int corner = i < size ? faces.corners[i] : -1;
    if (corner >= 0 && corner < count) {
      face.push_back(corner);
      if (face.size() > most_corners)
        fail_at_corner(faces, i, name, "a face of more than " + std::to_string(most_corners) + " corners");
      continue;
    }
    if (corner != -1)
      fail_at_corner(faces, i, name, "a face uses point " + std::to_string(corner) + "; there are " + std::to_string(count) +
                                         ", counted from 0");
    if (face.size() >= 3) triangulate(points, face, mesh.triangles);
    else if (!face.empty()) ++short_faces;
    face.clear();
  }
  if (!faces.counter_clockwise) turn_inside_out(mesh);

  if (own_.size() < points.size()) own_.resize(points.size(), -1);
  std::vector<int> used;
  for (auto& t : mesh.triangles)
    for (int& corner : t) {
      int& own = own_[corner];
      if (own < 0) {
        own = static_cast<int>(used.size());
        used.push_back(corner);
      }
      corner = own;
    }
  mesh.vertices.reserve(used.size());
  for (const int corner : used) {
    mesh.vertices.push_back(points[corner]);
    own_[corner] = -1;
  }
  return mesh;
}

}  // namespace tendril
