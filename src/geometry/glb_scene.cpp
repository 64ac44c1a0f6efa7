#include "geometry/glb_scene.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/error.h"
#include "base/json_text.h"
#include "geometry/glb_file.h"
#include "geometry/mesh_export.h"

namespace tendril {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are in the order of the machine's bytes");

constexpr int float32 = 5126, uint16 = 5123, uint32 = 5125, vertex_data = 34962, index_data = 34963;

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string number(float value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <class Numbers>
std::string list(const Numbers& values) {
  std::string text = "[";
  for (const auto value : values) text += (text.size() > 1 ? "," : "") + number(static_cast<float>(value));
  return text + "]";
}

std::string int_list(const std::vector<int>& values) {
  std::string text = "[";
  for (const int value : values) text += (text.size() > 1 ? "," : "") + std::to_string(value);
  return text + "]";
}

/// glTF's y axis points up.
Frame y_up(const Frame& frame) {
  static const Quat turn(std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2, 0, 0);
  Quat rotation = (turn * frame.rotation).normalized();
  return {{frame.at.x(), frame.at.z(), -frame.at.y()}, rotation};
}

/// One of glTF's top-level lists.
struct JsonList {
  std::vector<std::string> items;
  int add(std::string item) {
    items.push_back(std::move(item));
    return static_cast<int>(items.size()) - 1;
  }
  /// `,"name":[...]`, nothing when it is empty.
  std::string text(const char* name) const {
    if (items.empty()) return "";
    std::string all = std::string(",\"") + name + "\":[";
    for (std::size_t i = 0; i < items.size(); ++i) all += (i ? "," : "") + items[i];
    return all + "]";
  }
};

/// glTF's colours are linear.
float linear(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

class GlbWriter {
 public:
  void add_times(const std::vector<double>& times) {
    const std::size_t start = data_.size();
    for (const double t : times) append(data_, static_cast<float>(t));
    times_ = accessor(start, 0, float32, times.size(), "SCALAR",
                      ",\"min\":" + list(std::vector{times.front()}) + ",\"max\":" + list(std::vector{times.back()}));
  }

  void add(const SurfacePart& part) { roots_.push_back(nodes_.add(node(part, "," + placed(y_up(part.pose))))); }

  void add(const MovingPart& moving) {
    if (!moving.sections.empty()) return add_bending(moving);
    add(moving.part);
    if (!moving.poses.empty()) animate(roots_.back(), moving.poses);
  }

  std::string file() {
    std::string json = R"({"asset":{"version":"2.0","generator":"tendril"},"scene":0,"scenes":[{"nodes":)" + int_list(roots_) + "}]" +
                       nodes_.text("nodes") + meshes_.text("meshes") + materials_.text("materials") + skins_.text("skins");
    if (!channels_.items.empty())
      json += ",\"animations\":[{\"name\":\"motion\"" + channels_.text("channels") + samplers_.text("samplers") + "}]";
    json += accessors_.text("accessors") + views_.text("bufferViews") + ",\"buffers\":[{\"byteLength\":" + std::to_string(data_.size()) + "}]}";
    return glb_file(std::move(json), data_, "glb: the scene");
  }

 private:
  /// Of the data from `start` on, which end here and always are whole words.
  int accessor(std::size_t start, int target, int component, std::size_t count, const char* type, const std::string& more = "") {
    const int view = views_.add("{\"buffer\":0,\"byteOffset\":" + std::to_string(start) + ",\"byteLength\":" + std::to_string(data_.size() - start) +
                                (target ? ",\"target\":" + std::to_string(target) : "") + "}");
    return accessors_.add("{\"bufferView\":" + std::to_string(view) + ",\"componentType\":" + std::to_string(component) + ",\"count\":" +
                          std::to_string(count) + ",\"type\":\"" + type + "\"" + more + "}");
  }

  int vectors(const std::vector<Vec3>& all, int target, bool bounds) {
    const std::size_t start = data_.size();
    Eigen::AlignedBox3f box;  // of the numbers as the file holds them
    for (const Vec3& v : all) {
      const Eigen::Vector3f in_file = v.cast<float>();
      for (int k = 0; k < 3; ++k) append(data_, in_file[k]);
      box.extend(in_file);
    }
    return accessor(start, target, float32, all.size(), "VEC3", bounds ? ",\"min\":" + list(box.min()) + ",\"max\":" + list(box.max()) : "");
  }

  int material(const SurfacePart& part) {
    std::string colour = "[";
    for (const float c : part.colour) colour += number(linear(c)) + ",";
    return materials_.add("{\"name\":" + json_string(part.name) + ",\"pbrMetallicRoughness\":{\"baseColorFactor\":" + colour + number(part.opacity) +
                          "],\"metallicFactor\":0,\"roughnessFactor\":0.7}" + (part.opacity < 1 ? ",\"alphaMode\":\"BLEND\"" : "") +
                          (part.double_sided ? ",\"doubleSided\":true" : "") + "}");
  }

  /// `attributes`: further ones of its vertices.
  int mesh(const SurfacePart& part, const Mesh& shape, const std::string& attributes) {
    std::string all = "\"POSITION\":" + std::to_string(vectors(shape.vertices, vertex_data, true));
    if (part.smooth) all += ",\"NORMAL\":" + std::to_string(vectors(smooth_normals(shape), vertex_data, false));
    const std::size_t start = data_.size();
    for (const auto& t : shape.triangles)
      for (const int corner : t) append(data_, static_cast<std::uint32_t>(corner));
    const int indices = accessor(start, index_data, uint32, 3 * shape.triangles.size(), "SCALAR");
    return meshes_.add("{\"name\":" + json_string(part.name) + ",\"primitives\":[{\"attributes\":{" + all + attributes + "},\"indices\":" +
                       std::to_string(indices) + ",\"material\":" + std::to_string(material(part)) + ",\"mode\":4}]}");
  }

  std::string node(const SurfacePart& part, const std::string& more) {
    return "{\"name\":" + json_string(part.name) + ",\"mesh\":" + std::to_string(mesh(part, *part.mesh, "")) + more + "}";
  }

  static std::string placed(const Frame& frame) {
    return "\"translation\":" + list(frame.at) + ",\"rotation\":" + list(frame.rotation.coeffs());  // x, y, z, w
  }

  void add_bending(const MovingPart& moving) {
    const SurfacePart& part = moving.part;
    Mesh shape = *part.mesh;
    for (Vec3& v : shape.vertices) v = y_up({part.pose.at + part.pose.rotation * v, Quat::Identity()}).at;
    const std::vector<Frame>& first = moving.sections.front();
    std::vector<int> joints;
    std::size_t start = data_.size();
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Frame frame = y_up(first[i]);
      joints.push_back(nodes_.add("{\"name\":" + json_string(part.name + ".section_" + std::to_string(i + 1)) + "," + placed(frame) + "}"));
      const Frame inverse = frame.inverse();
      Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
      matrix.topLeftCorner<3, 3>() = inverse.rotation.toRotationMatrix().cast<float>();
      matrix.topRightCorner<3, 1>() = inverse.at.cast<float>();
      for (int k = 0; k < 16; ++k) append(data_, matrix.data()[k]);  // by columns
    }
    const int inverses = accessor(start, 0, float32, first.size(), "MAT4");
    start = data_.size();
    for (const int section : moving.section_of_vertex)
      for (const int joint : {section, 0, 0, 0}) append(data_, static_cast<std::uint16_t>(joint));
    const int used = accessor(start, vertex_data, uint16, shape.vertices.size(), "VEC4");
    start = data_.size();
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
      for (const float weight : {1.f, 0.f, 0.f, 0.f}) append(data_, weight);
    const int weights = accessor(start, vertex_data, float32, shape.vertices.size(), "VEC4");

    const int skin = skins_.add("{\"name\":" + json_string(part.name) + ",\"joints\":" + int_list(joints) + ",\"inverseBindMatrices\":" +
                                std::to_string(inverses) + "}");
    const int drawn = mesh(part, shape, ",\"JOINTS_0\":" + std::to_string(used) + ",\"WEIGHTS_0\":" + std::to_string(weights));
    roots_.push_back(nodes_.add("{\"name\":" + json_string(part.name) + ",\"mesh\":" + std::to_string(drawn) + ",\"skin\":" + std::to_string(skin) + "}"));
    roots_.push_back(nodes_.add("{\"name\":" + json_string(part.name + ".sections") + ",\"children\":" + int_list(joints) + "}"));
    std::vector<Frame> poses(moving.sections.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t t = 0; t < poses.size(); ++t) poses[t] = moving.sections[t][i];
      animate(joints[i], poses);
    }
  }

  void animate(int node, const std::vector<Frame>& poses) {
    std::vector<Vec3> places;
    for (const Frame& pose : poses) places.push_back(y_up(pose).at);
    channel(node, "translation", vectors(places, 0, false));
    const std::size_t start = data_.size();
    Quat last = Quat::Identity();
    for (const Frame& pose : poses) {
      Quat q = y_up(pose).rotation;
      if (q.dot(last) < 0) q.coeffs() = -q.coeffs();  // the shorter way from time to time
      last = q;
      for (int k = 0; k < 4; ++k) append(data_, static_cast<float>(q.coeffs()[k]));
    }
    channel(node, "rotation", accessor(start, 0, float32, poses.size(), "VEC4"));
  }

  void channel(int node, const char* path, int output) {
    const int sampler = samplers_.add("{\"input\":" + std::to_string(times_) + ",\"output\":" + std::to_string(output) + "}");
    channels_.add("{\"sampler\":" + std::to_string(sampler) + ",\"target\":{\"node\":" + std::to_string(node) + ",\"path\":\"" + path + "\"}}");
  }

  std::string data_;
  std::vector<int> roots_;
  JsonList nodes_, meshes_, materials_, skins_, channels_, samplers_, accessors_, views_;
  int times_ = -1;
};

void check_times(const std::vector<double>& times) {
  bool rise = times.size() >= 2 && std::isfinite(times.front());
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    rise = rise && static_cast<float>(times[i]) < static_cast<float>(times[i + 1]) && std::isfinite(static_cast<float>(times[i + 1]));
  if (!rise || times.front() < 0)
    throw UsageError("glb: the times do not rise; at least two from 0 on, each above the last in single precision, expected");
}

void check_moving(const MovingPart& moving, std::size_t times) {
  const std::string who = "glb: part '" + moving.part.name + "': ";
  moving.part.mesh->check();
  if (!moving.poses.empty() && !moving.sections.empty()) throw UsageError(who + "poses and sections are given; one of them expected");
  if (!moving.poses.empty() && moving.poses.size() != times)
    throw UsageError(who + std::to_string(moving.poses.size()) + " poses at " + std::to_string(times) + " times");
  if (moving.sections.empty()) return;
  const std::size_t count = moving.sections.front().size();
  bool fit = moving.sections.size() == times && count > 0 && count <= 65535;
  for (const auto& sections : moving.sections) fit = fit && sections.size() == count;
  if (!fit) throw UsageError(who + "its sections do not fit; at each time the same 1 to 65535 expected");
  bool known = moving.section_of_vertex.size() == moving.part.mesh->vertices.size();
  for (const int section : moving.section_of_vertex) known = known && section >= 0 && static_cast<std::size_t>(section) < count;
  if (!known) throw UsageError(who + "a section for each vertex expected");
}

}  // namespace

std::string glb_of(const std::vector<SurfacePart>& parts) {
  GlbWriter writer;
  for (const SurfacePart& part : parts) writer.add(part);
  return writer.file();
}

std::string glb_of(const std::vector<MovingPart>& parts, const std::vector<double>& times) {
  check_times(times);
  for (const MovingPart& moving : parts) check_moving(moving, times.size());
  GlbWriter writer;
  writer.add_times(times);
  for (const MovingPart& moving : parts) writer.add(moving);
  return writer.file();
}

}  // namespace tendril
