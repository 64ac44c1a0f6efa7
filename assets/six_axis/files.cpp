// The robot as files.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "six_axis/arm.h"

namespace tendril::six_axis {

namespace {

std::string numbers(const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%.15g %.15g %.15g", v.x(), v.y(), v.z());
  return text;
}

std::string link(const std::string& name) {
  const std::string geometry = "<geometry><mesh filename=\"package://tendril_six_axis/meshes/" + name + ".stl\"/></geometry>";
  return "  <link name=\"" + name + "\">\n    <visual>" + geometry + "</visual>\n    <collision>" + geometry +
         "</collision>\n  </link>\n";
}

std::string joint(const Joint& j) {
  char limit[160];
  std::snprintf(limit, sizeof limit, "<limit lower=\"%.15g\" upper=\"%.15g\" velocity=\"%.15g\" effort=\"0\"/>", j.lower, j.upper,
                j.velocity);
  return std::string("  <joint name=\"") + j.name + "\" type=\"revolute\">\n    <origin xyz=\"" + numbers(j.at * units::mm) +
         "\"/>\n    <parent link=\"" + j.parent + "\"/>\n    <child link=\"" + j.child + "\"/>\n    <axis xyz=\"" +
         numbers(j.axis) + "\"/>\n    " + limit + "\n  </joint>\n";
}

}  // namespace

std::string stl(const Mesh& mesh) {
  std::string out(84, '\0');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(out.data() + 80, &count, sizeof count);
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    float values[12];
    const Vec3 corners[] = {normal, a * units::mm, b * units::mm, c * units::mm};
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) values[3 * i + k] = static_cast<float>(corners[i][k]);
    out.append(reinterpret_cast<const char*>(values), sizeof values);
    out.append(2, '\0');
  }
  return out;
}

std::string urdf() {
  std::string out = "<?xml version=\"1.0\"?>\n<robot name=\"six_axis\">\n" + link("base");
  for (const Joint& j : joints()) out += link(j.child) + joint(j);
  // z out of the face, as tools are given.
  out += "  <link name=\"flange\"/>\n  <joint name=\"joint_flange\" type=\"fixed\">\n    <origin xyz=\"" +
         numbers({flange * units::mm, 0, 0}) +
         "\" rpy=\"0 1.570796326794896619 0\"/>\n    <parent link=\"link_6\"/>\n    <child link=\"flange\"/>\n  </joint>\n";
  return out + "</robot>\n";
}

std::string package_xml() {
  return "<?xml version=\"1.0\"?>\n<package format=\"2\">\n  <name>tendril_six_axis</name>\n  <version>0.1.0</version>\n"
         "  <description>A six-axis robot of plausible dimensions</description>\n  <license>MIT</license>\n</package>\n";
}

}  // namespace tendril::six_axis
