// Wavefront OBJ: vertices and faces; all else is skipped.

#include "geometry/mesh_file.h"
#include "geometry/text_cursor.h"

namespace tendril {

namespace {

class ObjReader {
 public:
  ObjReader(std::string_view content, const std::string& name) : cursor_(content), name_(name) { mesh_.name = name; }

  Mesh read() {
    for (; !cursor_.done(); cursor_.next_line()) {
      const std::string_view statement = cursor_.word();
      if (statement == "v") vertex();
      else if (statement == "f") face();
      else if (!known(statement) && unknown_.empty()) unknown_ = statement, unknown_line_ = cursor_.line();
    }
    if (mesh_.vertices.empty() && !unknown_.empty())
      fail_mesh(name_, "not an OBJ file: line " + std::to_string(unknown_line_) + " begins with '" +
                           std::string(unknown_.substr(0, 20)) + "'");
    if (largest_ >= static_cast<int>(mesh_.vertices.size()))
      fail(largest_line_, "a face uses vertex " + std::to_string(largest_ + 1) + ", but the file has " +
                              std::to_string(mesh_.vertices.size()) + " vertices; is it truncated?");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& why) {
    fail_mesh(name_, "line " + std::to_string(line) + ": " + why);
  }

  static bool known(std::string_view statement) {
    if (statement.empty() || statement[0] == '#') return true;
    for (std::string_view other : {"vt", "vn", "vp", "g", "o", "s", "usemtl", "mtllib", "l", "p", "mg", "usemap", "maplib",
                                   "cstype", "deg", "curv", "curv2", "surf", "parm", "trim", "hole", "end", "shadow_obj"})
      if (statement == other) return true;
    return false;
  }

  void vertex() {
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      if (!cursor_.number(p[k])) fail(cursor_.line(), "a vertex without three numbers; is the file truncated?");
    mesh_.vertices.push_back(p);
  }

  void face() {
    corners_.clear();
    while (!cursor_.at_line_end()) {
      int index;
      if (!cursor_.number(index) || index == 0) fail(cursor_.line(), "a face whose corners are not vertex numbers");
      cursor_.finish_word();  // texture and normal
      // Negative numbers count back from the last vertex.
      index = index > 0 ? index - 1 : static_cast<int>(mesh_.vertices.size()) + index;
      if (index < 0) fail(cursor_.line(), "a face counts back beyond the first vertex");
      if (index > largest_) largest_ = index, largest_line_ = cursor_.line();
      corners_.push_back(index);
    }
    if (corners_.size() < 3)
      fail(cursor_.line(), "a face of " + std::to_string(corners_.size()) + " corners; is the file truncated?");
    if (corners_.size() > most_corners)
      fail(cursor_.line(), "a face of " + std::to_string(corners_.size()) + " corners; " + std::to_string(most_corners) +
                               " at most are read");
    // A polygon is cut by the shape that its vertices give it, which must be there by now.
    if (corners_.size() > 3 && largest_ >= static_cast<int>(mesh_.vertices.size()))
      fail(cursor_.line(), "a face uses vertex " + std::to_string(largest_ + 1) + ", but only " +
                               std::to_string(mesh_.vertices.size()) + " come before it; is the file damaged?");
    triangulate(mesh_.vertices, corners_, mesh_.triangles);
  }

  TextCursor cursor_;
  const std::string& name_;
  Mesh mesh_;
  std::vector<int> corners_;
  int largest_ = -1, largest_line_ = 0, unknown_line_ = 0;
  std::string_view unknown_;
};

}  // namespace

Mesh parse_obj(std::string_view content, const std::string& name) { return ObjReader(content, name).read(); }

}  // namespace tendril
