// PLY, text and binary of either byte order: x, y, z of the element "vertex" and the index lists of "face".

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "geometry/mesh_file.h"
#include "geometry/text_cursor.h"

namespace tendril {

namespace {

enum class Type { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

Type type_named(std::string_view name) {
  if (name == "char" || name == "int8") return Type::int8;
  if (name == "uchar" || name == "uint8") return Type::uint8;
  if (name == "short" || name == "int16") return Type::int16;
  if (name == "ushort" || name == "uint16") return Type::uint16;
  if (name == "int" || name == "int32") return Type::int32;
  if (name == "uint" || name == "uint32") return Type::uint32;
  if (name == "float" || name == "float32") return Type::float32;
  if (name == "double" || name == "float64") return Type::float64;
  return Type::none;
}

struct Property {
  Type count = Type::none;  ///< none: a single value
  Type type = Type::none;
  std::string name;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name) : content_(content), text_(content), name_(name) {
    mesh_.name = name;
  }

  Mesh read() {
    header();
    for (const Element& element : elements_) body(element);
    for (const auto& corners : mesh_.triangles) check_corners(corners);
    for (const auto& corners : polygons_) {
      check_corners(corners);
      triangulate(mesh_.vertices, corners, mesh_.triangles);
    }
    return std::move(mesh_);
  }

 private:
  template <class Corners>
  void check_corners(const Corners& corners) {
    const int count = static_cast<int>(mesh_.vertices.size());
    for (int corner : corners)
      if (corner < 0 || corner >= count)
        fail_mesh(name_, "a face uses vertex " + std::to_string(std::int64_t{corner} + 1) + "; there are " +
                             std::to_string(count) + " vertices");
  }

  [[noreturn]] void bad_header(const std::string& why) {
    fail_mesh(name_, "line " + std::to_string(text_.line()) + ": " + why);
  }

  void header() {
    if (text_.word() != "ply") fail_mesh(name_, "not a PLY file: it does not begin with 'ply'");
    bool ended = false;
    for (text_.next_line(); !text_.done() && !ended; text_.next_line()) {
      const std::string_view word = text_.word();
      if (word == "format") format(text_.word());
      else if (word == "element") element();
      else if (word == "property") property();
      else if (word == "end_header") ended = true;
      else if (!word.empty() && word != "comment" && word != "obj_info")
        bad_header("'" + std::string(word.substr(0, 20)) + "' is no part of a PLY header");
    }
    if (!ended) fail_mesh(name_, "truncated: its header does not end");
    at_ = content_.size() - text_.rest();
  }

  void format(std::string_view word) {
    if (word == "ascii") binary_ = false;
    else if (word == "binary_little_endian" || word == "binary_big_endian") binary_ = true;
    else bad_header("unknown format '" + std::string(word.substr(0, 30)) + "'");
    swap_ = (word == "binary_big_endian") == (std::endian::native == std::endian::little);
  }

  void element() {
    Element element;
    element.name = text_.word();
    if (!text_.number(element.count) || element.count < 0) bad_header("an element without a count");
    if (element.count > static_cast<std::int64_t>(content_.size()))
      fail_mesh(name_, "truncated: " + std::to_string(element.count) + " of element '" + element.name.substr(0, 30) +
                           "' in a file of " + std::to_string(content_.size()) + " bytes");
    elements_.push_back(std::move(element));
  }

  void property() {
    if (elements_.empty()) bad_header("a property before any element");
    Property property;
    std::string_view word = text_.word();
    if (word == "list") {
      property.count = type_named(text_.word());
      if (property.count == Type::none) bad_header("a list whose count has an unknown type");
      word = text_.word();
    }
    property.type = type_named(word);
    if (property.type == Type::none) bad_header("unknown type '" + std::string(word.substr(0, 20)) + "'");
    property.name = text_.word();
    elements_.back().properties.push_back(std::move(property));
  }

  void body(const Element& element) {
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    if (vertices) mesh_.vertices.reserve(static_cast<std::size_t>(element.count));
    if (faces) mesh_.triangles.reserve(static_cast<std::size_t>(element.count));
    for (std::int64_t i = 0; i < element.count; ++i) {
      where_ = &element, number_ = i + 1;
      Vec3 p = Vec3::Zero();
      for (const Property& property : element.properties) {
        const bool corners = faces && (property.name == "vertex_indices" || property.name == "vertex_index");
        const double count = property.count == Type::none ? 1 : value(property.count);
        const int axis = vertices && property.name.size() == 1 ? property.name[0] - 'x' : -1;
        if (corners) polygon(count, property.type);
        else
          for (double k = 0; k < count; ++k) {
            const double read = value(property.type);
            if (axis >= 0 && axis < 3) p[axis] = read;
          }
      }
      if (vertices) mesh_.vertices.push_back(p);
    }
  }

  void polygon(double count, Type type) {
    if (!(count >= 3 && count <= most_corners))
      fail_here("has " + std::to_string(count > 0 ? static_cast<std::int64_t>(std::min(count, 1e15)) : 0) + " corners; 3 to " +
                std::to_string(most_corners) + " are read");
    const auto corner = [&] {
      const double index = value(type);
      return index >= 0 && index < 2147483647.0 ? static_cast<int>(index) : -1;
    };
    if (count == 3) {
      std::array<int, 3>& corners = mesh_.triangles.emplace_back();
      for (int& c : corners) c = corner();
    } else {
      for (int& c : polygons_.emplace_back(static_cast<int>(count))) c = corner();
    }
  }

  [[noreturn]] void fail_here(const std::string& why) {
    fail_mesh(name_, where_->name + " " + std::to_string(number_) + " " + why);
  }
  [[noreturn]] void truncated() {
    fail_mesh(name_, "truncated: it ends in " + where_->name + " " + std::to_string(number_) + " of " +
                         std::to_string(where_->count));
  }

  double value(Type type) {
    if (binary_) return binary_value(type);
    text_.skip_space();
    double read;
    if (text_.number(read)) return read;
    if (text_.done()) truncated();
    fail_here("holds '" + std::string(text_.word().substr(0, 20)) + "' where a number is expected");
  }

  template <class T>
  double take() {
    if (content_.size() - at_ < sizeof(T)) truncated();
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, content_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swap_)
      for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(bytes[k], bytes[sizeof(T) - 1 - k]);
    T result;
    std::memcpy(&result, bytes, sizeof(T));
    return static_cast<double>(result);
  }

  double binary_value(Type type) {
    switch (type) {
      case Type::int8: return take<std::int8_t>();
      case Type::uint8: return take<std::uint8_t>();
      case Type::int16: return take<std::int16_t>();
      case Type::uint16: return take<std::uint16_t>();
      case Type::int32: return take<std::int32_t>();
      case Type::uint32: return take<std::uint32_t>();
      case Type::float32: return take<float>();
      default: return take<double>();
    }
  }

  std::string_view content_;
  TextCursor text_;
  const std::string& name_;
  Mesh mesh_;
  std::vector<Element> elements_;
  std::vector<std::vector<int>> polygons_;  ///< of more than three corners, kept until all vertices are known
  bool binary_ = false, swap_ = false;
  std::size_t at_ = 0;
  const Element* where_ = nullptr;
  std::int64_t number_ = 0;
};

}  // namespace

Mesh parse_ply(std::string_view content, const std::string& name) { return PlyReader(content, name).read(); }

}  // namespace tendril
