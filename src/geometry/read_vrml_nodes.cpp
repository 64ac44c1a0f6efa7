// The text of a VRML97 file into its nodes.

#include "geometry/read_vrml_nodes.h"

#include <algorithm>
#include <unordered_map>

#include <Eigen/Geometry>

#include "geometry/mesh_file.h"
#include "geometry/read_vrml_faces.h"
#include "geometry/read_vrml_text.h"

namespace tendril {

namespace {

enum class Type { unknown, nothing, script, group, transform, chosen, finest, shape, inlined, faces, coordinate,
                  box, sphere, cylinder, cone, elevation };

Type type_named(std::string_view name) {
  static const std::unordered_map<std::string_view, Type> types = [] {
    std::unordered_map<std::string_view, Type> map = {
        {"Group", Type::group},          {"Anchor", Type::group},         {"Billboard", Type::group},
        {"Collision", Type::group},      {"Transform", Type::transform},  {"Switch", Type::chosen},
        {"LOD", Type::finest},           {"Shape", Type::shape},          {"Inline", Type::inlined},
        {"IndexedFaceSet", Type::faces}, {"Coordinate", Type::coordinate}, {"Box", Type::box},
        {"Sphere", Type::sphere},        {"Cylinder", Type::cylinder},    {"Cone", Type::cone},
        {"ElevationGrid", Type::elevation}, {"Script", Type::script}};
    for (const char* name :
         {"Appearance", "Material", "ImageTexture", "MovieTexture", "PixelTexture", "TextureTransform", "TextureCoordinate",
          "Color", "Normal", "IndexedLineSet", "PointSet", "Text", "FontStyle", "AudioClip", "Background", "Fog",
          "NavigationInfo", "Viewpoint", "WorldInfo", "DirectionalLight", "PointLight", "SpotLight", "Sound",
          "ColorInterpolator", "CoordinateInterpolator", "NormalInterpolator", "OrientationInterpolator",
          "PositionInterpolator", "ScalarInterpolator", "CylinderSensor", "PlaneSensor", "ProximitySensor", "SphereSensor",
          "TimeSensor", "TouchSensor", "VisibilitySensor"})
      map[name] = Type::nothing;
    return map;
  }();
  const auto found = types.find(name);
  return found == types.end() ? Type::unknown : found->second;
}

VrmlKind kind_of(Type type) {
  switch (type) {
    case Type::group: return VrmlKind::group;
    case Type::transform: return VrmlKind::transform;
    case Type::chosen: return VrmlKind::chosen;
    case Type::finest: return VrmlKind::finest;
    case Type::shape: return VrmlKind::shape;
    case Type::inlined: return VrmlKind::inlined;
    case Type::coordinate: return VrmlKind::points;
    case Type::nothing: case Type::script: return VrmlKind::nothing;
    case Type::unknown: return VrmlKind::unread;
    default: return VrmlKind::surface;
  }
}

/// Whether the nodes in this field belong to what the node draws.
bool draws(Type type, std::string_view field) {
  switch (type) {
    case Type::group: case Type::transform: return field == "children";
    case Type::chosen: return field == "choice" || field == "children";
    case Type::finest: return field == "level" || field == "children";
    case Type::shape: return field == "geometry";
    case Type::faces: return field == "coord";
    default: return false;
  }
}

struct TransformFields {
  Vec3 translation = Vec3::Zero(), scale = Vec3::Ones(), center = Vec3::Zero();
  Quat rotation = Quat::Identity(), scale_orientation = Quat::Identity();

  VrmlPlace place() const {
    VrmlPlace place;
    place.linear = (rotation * scale_orientation).toRotationMatrix() * scale.asDiagonal() *
                   scale_orientation.conjugate().toRotationMatrix();
    place.offset = translation + center - place.linear * center;
    return place;
  }
};

/// Of Box, Sphere, Cylinder, Cone and ElevationGrid, with the defaults of the standard.
struct SolidFields {
  Vec3 size = Vec3::Constant(2);
  double radius = 1, height = 2;
  bool side = true, bottom = true, top = true, counter_clockwise = true;
  int columns = 0, rows = 0;
  double column_spacing = 1, row_spacing = 1;
  std::vector<double> heights;
};

class VrmlParser {
 public:
  VrmlParser(std::string_view content, const std::string& name, int file, VrmlNodes& out)
      : text_(content), name_(name), file_(file), out_(out),
        first_(static_cast<int>(out.nodes.size())) {}

  int read() {
    stack_.push_back({add(VrmlKind::group), Type::group, true, true, 1});
    for (;;) {
      const char next = text_.peek();
      if (next == 0 && stack_.size() == 1) return first_;
      if (next == 0)
        fail("the file ends within what line " + std::to_string(stack_.back().line) + " begins; is it truncated?");
      if (stack_.back().list) list_item(next);
      else body_item(next);
    }
  }

 private:
  /// What is open: a node's body, or the list of nodes in one of its fields.
  struct Open {
    int node;
    Type type;
    bool list;
    bool drawn;  ///< nodes found here become the node's children
    int line;
  };

  [[noreturn]] void fail(const std::string& why) { fail_at(text_.line(), why); }
  [[noreturn]] void fail_at(int line, const std::string& why) {
    fail_mesh(name_, "line " + std::to_string(line) + ": " + why);
  }
  /// What stands here, for a message.
  std::string found() {
    const char next = text_.peek();
    if (next == 0) return "the end of the file";
    const std::string_view word = text_.word();
    if (word.empty()) return std::string("'") + next + "'";
    return "'" + std::string(word.substr(0, 30)) + "'";
  }

  int add(VrmlKind kind) {
    out_.nodes.push_back({kind, -1, {}});
    open_.push_back(true);
    return static_cast<int>(out_.nodes.size()) - 1;
  }
  int add_unread(std::string_view type) {
    const auto at = std::find(out_.names.begin(), out_.names.end(), type);
    const int name = static_cast<int>(at - out_.names.begin());
    if (at == out_.names.end()) out_.names.emplace_back(type);
    const int node = add(VrmlKind::unread);
    out_.nodes[node].data = name;
    return node;
  }

  void list_item(char next) {
    if (next == ']') {
      if (stack_.size() == 1) fail("']' without a '[' before it");
      text_.take();
      stack_.pop_back();
    } else if (next == '"') {
      skip_string();
    } else if (next == '[' || next == '{' || next == '}') {
      fail(std::string("'") + next + "' where a node is expected");
    } else {
      const std::string_view word = text_.word();
      if (!plain_value(word)) statement(word);
      else if (stack_.back().drawn) fail("'" + std::string(word.substr(0, 30)) + "' where a node is expected");
    }
  }

  void body_item(char next) {
    if (next == '}') {
      text_.take();
      close();
      return;
    }
    const std::string_view word = text_.word();
    if (word.empty()) fail(std::string("'") + next + "' where the name of a field is expected");
    if (word == "ROUTE" || word == "PROTO" || word == "EXTERNPROTO") statement(word);
    else field(word);
  }

  static bool plain_value(std::string_view word) {
    const char c = word[0];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || word == "TRUE" || word == "FALSE";
  }

  void skip_string() {
    const int line = text_.line();
    std::string ignored;
    if (!text_.string(ignored)) fail_at(line, "a string that does not end; is the file truncated?");
  }

  /// A node, or what else may stand where one is expected. `word` is its first.
  void statement(std::string_view word) {
    if (word == "NULL") return;
    if (word == "ROUTE") return skip_route();
    if (word == "PROTO" || word == "EXTERNPROTO") return skip_prototype(word == "PROTO");
    if (word == "USE") return use();
    std::string_view name;
    if (word == "DEF") {
      name = text_.word();
      word = text_.word();
      if (name.empty() || word.empty()) fail("DEF without a name and a node");
    }
    open(word, name);
  }

  void attach(int child) {
    const Open& parent = stack_.back();
    if (parent.drawn) out_.nodes[parent.node].children.push_back(child);
  }

  void use() {
    const std::string name(text_.word());
    const auto known = named_.find(name);
    if (known == named_.end()) fail("USE of '" + name.substr(0, 60) + "', which no DEF before it names");
    if (known->second >= 0 && open_[known->second - first_])
      fail("USE of '" + name.substr(0, 60) + "' within its own DEF: a loop");
    attach(known->second >= 0 ? known->second : add_unread("node within a Script"));
  }

  void open(std::string_view type_name, std::string_view name) {
    const int line = text_.line();
    const Type type = type_named(type_name);
    if (text_.peek() != '{')
      fail_at(line, found() + " after '" + std::string(type_name.substr(0, 30)) + "', where '{' is expected");
    text_.take();
    if (type == Type::script) {
      out_.animated = true;
      if (!name.empty()) named_[std::string(name)] = -1;
      return skip_to_end(line, true);
    }
    const int node = type == Type::unknown ? add_unread(type_name) : add(kind_of(type));
    if (!name.empty()) named_[std::string(name)] = node;
    attach(node);
    stack_.push_back({node, type, false, false, line});
    if (type == Type::transform) transforms_.emplace_back();
    else if (type == Type::faces) faces_.emplace_back();
    else if (type == Type::inlined) out_.nodes[node].data = static_cast<int>(out_.links.size()), out_.links.push_back({{}, file_, line});
    else if (type == Type::coordinate) out_.nodes[node].data = static_cast<int>(out_.points.size()), out_.points.emplace_back();
    else if (type >= Type::box) solids_.emplace_back();
  }

  void close() {
    const Open body = stack_.back();
    stack_.pop_back();
    VrmlNode& node = out_.nodes[body.node];
    open_[body.node - first_] = false;
    if (body.type == Type::transform) {
      node.data = static_cast<int>(out_.places.size());
      out_.places.push_back(transforms_.back().place());
      transforms_.pop_back();
    } else if (body.type == Type::faces) {
      close_faces(node, body.line);
    } else if (body.type >= Type::box) {
      node.data = static_cast<int>(out_.surfaces.size());
      out_.surfaces.push_back(solid(body.type, body.line));
      solids_.pop_back();
    }
  }

  void field(std::string_view name) {
    const Type type = stack_.back().type;
    if (type == Type::transform && transform_field(name)) return;
    if (type == Type::chosen && name == "whichChoice") return read_number(out_.nodes[stack_.back().node].data, name);
    if (type == Type::coordinate && name == "point") return read_points();
    if (type == Type::inlined && name == "url") return read_addresses();
    if (type == Type::faces && name == "coordIndex") return read_corners();
    if (type == Type::faces && name == "ccw") return read_flag(faces_.back().counter_clockwise, name);
    if (type >= Type::box && solid_field(name)) return;
    value(draws(type, name), name);
  }

  /// Nodes, or what is of no interest: a field of any type is told by how its value begins.
  void value(bool drawn, std::string_view name) {
    const int line = text_.line();
    const char next = text_.peek();
    if (next == '[') {
      text_.take();
      const Open& body = stack_.back();
      stack_.push_back({body.node, body.type, true, drawn, line});
      return;
    }
    if (next == '"') return skip_string();
    const std::string_view word = text_.word();
    if (word.empty()) fail(found() + " where the value of '" + std::string(name.substr(0, 30)) + "' is expected");
    if (plain_value(word)) {
      while (is_number(text_.peek())) text_.word();
      return;
    }
    if (word == "IS") {
      text_.word();
      return;
    }
    // A node on its own: its parent remembers, until it is attached, whether it is drawn.
    stack_.back().drawn = drawn;
    const std::size_t depth = stack_.size();
    statement(word);
    stack_[depth - 1].drawn = false;
  }

  static bool is_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

  template <class Number>
  void read_number(Number& number, std::string_view name) {
    if (!text_.number(number)) no_number(name);
  }
  [[noreturn]] void no_number(std::string_view name) {
    fail(found() + " where a number of '" + std::string(name) + "' is expected");
  }
  template <int n>
  void read_vector(Eigen::Matrix<double, n, 1>& v, std::string_view name) {
    for (int k = 0; k < n; ++k) read_number(v[k], name);
  }
  void read_flag(bool& flag, std::string_view name) {
    const std::string_view word = text_.word();
    if (word != "TRUE" && word != "FALSE")
      fail((word.empty() ? found() : "'" + std::string(word.substr(0, 30)) + "'") + " where TRUE or FALSE of '" +
           std::string(name) + "' is expected");
    flag = word == "TRUE";
  }
  /// In brackets, or a single one of `size` numbers.
  template <class Number>
  void read_numbers(std::vector<Number>& numbers, std::size_t size, std::string_view name) {
    numbers.clear();
    const bool list = text_.peek() == '[';
    if (list) text_.take();
    for (Number read; (list || numbers.size() < size) && text_.number(read);) numbers.push_back(read);
    if (list ? text_.peek() != ']' : numbers.size() != size) no_number(name);
    if (list) text_.take();
    if (numbers.size() % size != 0)
      fail("'" + std::string(name) + "' has " + std::to_string(numbers.size()) + " numbers; a multiple of " + std::to_string(size) +
           " expected");
  }

  bool transform_field(std::string_view name) {
    TransformFields& fields = transforms_.back();
    if (name == "translation") read_vector(fields.translation, name);
    else if (name == "scale") read_vector(fields.scale, name);
    else if (name == "center") read_vector(fields.center, name);
    else if (name == "rotation") read_rotation(fields.rotation, name);
    else if (name == "scaleOrientation") read_rotation(fields.scale_orientation, name);
    else return false;
    return true;
  }
  void read_rotation(Quat& rotation, std::string_view name) {
    Eigen::Vector4d v;
    read_vector(v, name);
    const double length = v.head<3>().stableNorm();
    if (v[3] == 0) rotation = Quat::Identity();  // often written with an axis of zeros
    else if (!(length > 0) || !v.allFinite())
      fail("'" + std::string(name) + "' about an axis without a direction; x y z angle expected");
    else rotation = Quat(Eigen::AngleAxisd(v[3], v.head<3>() / length));
  }

  void read_points() {
    std::vector<double> numbers;
    read_numbers(numbers, 3, "point");
    std::vector<Vec3>& points = out_.points[out_.nodes[stack_.back().node].data];
    points.resize(numbers.size() / 3);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = Vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  }
  void read_corners() {
    VrmlFaces& fields = faces_.back();
    text_.peek();
    fields.corners_line = text_.line();
    fields.corners_text = text_.rest();
    read_numbers(fields.corners, 1, "coordIndex");
  }
  void read_addresses() {
    std::vector<std::string>& addresses = out_.links[out_.nodes[stack_.back().node].data].addresses;
    const bool list = text_.peek() == '[';
    if (list) text_.take();
    while (text_.peek() == '"' && (list || addresses.empty()))
      if (!text_.string(addresses.emplace_back())) fail("a string that does not end; is the file truncated?");
    if (list && text_.peek() != ']') fail(found() + " where an address in quotation marks is expected");
    if (list) text_.take();
  }

  bool solid_field(std::string_view name) {
    SolidFields& fields = solids_.back();
    const Type type = stack_.back().type;
    if (type == Type::elevation) {
      if (name == "height") read_numbers(fields.heights, 1, name);
      else if (name == "xDimension") read_number(fields.columns, name);
      else if (name == "zDimension") read_number(fields.rows, name);
      else if (name == "xSpacing") read_number(fields.column_spacing, name);
      else if (name == "zSpacing") read_number(fields.row_spacing, name);
      else if (name == "ccw") read_flag(fields.counter_clockwise, name);
      else return false;
      return true;
    }
    if (name == "size") read_vector(fields.size, name);
    else if (name == "radius" || name == "bottomRadius") read_number(fields.radius, name);
    else if (name == "height") read_number(fields.height, name);
    else if (name == "side") read_flag(fields.side, name);
    else if (name == "bottom") read_flag(fields.bottom, name);
    else if (name == "top") read_flag(fields.top, name);
    else return false;
    return true;
  }

  Mesh solid(Type type, int line) {
    const SolidFields& fields = solids_.back();
    if (type == Type::elevation) {
      const std::size_t needed = fields.columns > 0 && fields.rows > 0 ? std::size_t(fields.columns) * std::size_t(fields.rows) : 0;
      if (fields.heights.size() != needed)
        fail_at(line, "an ElevationGrid of " + std::to_string(fields.columns) + " x " + std::to_string(fields.rows) + " with " +
                          std::to_string(fields.heights.size()) + " heights");
      Mesh mesh = vrml_elevation(fields.columns, fields.rows, fields.column_spacing, fields.row_spacing, fields.heights);
      if (!fields.counter_clockwise) turn_inside_out(mesh);
      return mesh;
    }
    const bool round = type != Type::box;
    if (round ? !(fields.radius > 0 && fields.height > 0) : !(fields.size.minCoeff() > 0))
      fail_at(line, "a solid whose size is not above 0");
    if (type == Type::box) return vrml_box(fields.size);
    if (type == Type::sphere) return vrml_sphere(fields.radius);
    if (type == Type::cone) return vrml_cone(fields.radius, fields.height, fields.side, fields.bottom);
    return vrml_cylinder(fields.radius, fields.height, fields.side, fields.bottom, fields.top);
  }

  void close_faces(VrmlNode& node, int line) {
    const VrmlFaces faces = std::move(faces_.back());
    faces_.pop_back();
    const int coordinate = node.children.empty() ? -1 : node.children.back();
    node.children.clear();
    node.data = static_cast<int>(out_.surfaces.size());
    Mesh& mesh = out_.surfaces.emplace_back();
    if (faces.corners.empty()) return;
    if (coordinate < 0 || out_.nodes[coordinate].kind != VrmlKind::points)
      fail_at(line, "an IndexedFaceSet whose 'coord' is no Coordinate node");
    mesh = cutter_.cut(faces, out_.points[out_.nodes[coordinate].data], name_, out_.short_polygons);
  }

  void skip_route() {
    out_.animated = true;
    const std::string_view from = text_.word(), to = text_.word(), where = text_.word();
    if (from.empty() || to != "TO" || where.empty()) fail("a ROUTE that does not read 'ROUTE node.event TO node.event'");
  }

  void skip_prototype(bool with_body) {
    const int line = text_.line();
    text_.word();
    if (text_.peek() != '[') fail(found() + " where the '[' of a PROTO is expected");
    text_.take();
    skip_to_end(line, false);
    const char next = text_.peek();
    if (with_body ? next != '{' : next != '[' && next != '"')
      fail(found() + (with_body ? " where the '{' of a PROTO is expected" : " where the address of an EXTERNPROTO is expected"));
    if (next == '"') return skip_string();
    text_.take();
    skip_to_end(line, false);
  }

  /// Past the bracket that ends what an opening one, already taken, began. `remember`: what DEF names within.
  void skip_to_end(int line, bool remember) {
    for (std::size_t depth = 1; depth > 0;) {
      const char next = text_.peek();
      if (next == 0) fail("the file ends within what line " + std::to_string(line) + " begins; is it truncated?");
      if (next == '"') {
        skip_string();
        continue;
      }
      const std::string_view word = text_.word();
      if (remember && word == "DEF") named_[std::string(text_.word())] = -1;
      if (!word.empty()) continue;
      if (next == '[' || next == '{') ++depth;
      else --depth;
      text_.take();
    }
  }

  VrmlText text_;
  const std::string& name_;
  int file_;
  VrmlNodes& out_;
  int first_;
  std::vector<Open> stack_;
  std::vector<bool> open_;  ///< of the nodes from `first_` on: its body has not ended
  std::unordered_map<std::string, int> named_;  ///< by DEF; -1: within what is skipped
  std::vector<TransformFields> transforms_;     ///< of the nodes that are open
  std::vector<VrmlFaces> faces_;
  std::vector<SolidFields> solids_;
  VrmlCutter cutter_;
};

}  // namespace

int parse_vrml_nodes(std::string_view content, const std::string& name, int file, VrmlNodes& nodes) {
  return VrmlParser(content, name, file, nodes).read();
}

}  // namespace tendril
