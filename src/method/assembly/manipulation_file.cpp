#include "method/assembly/manipulation_file.h"

#include <charconv>

#include "base/json_text.h"
#include "base/units.h"

namespace tendril::assembly {

namespace {

/// The shortest text that reads back as the same number.
std::string exact(double value) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// "[a, b, ...]" of what `text` gives for 0 ... count - 1.
template <class Text>
std::string json_list(std::size_t count, Text text) {
  std::string list = "[";
  for (std::size_t i = 0; i < count; ++i) list += (i ? ", " : "") + text(i);
  return list + "]";
}

}  // namespace

std::string manipulation_csv(const Manipulation& manipulation, double duration) {
  std::string text = "grip,t [s],x [mm],y [mm],z [mm],qw,qx,qy,qz\n";
  for (std::size_t g = 0; g < manipulation.grips.size(); ++g)
    for (std::size_t i = 0; i < manipulation.times.size(); ++i) {
      const Frame& pose = manipulation.poses[g][i];
      text += csv_field(manipulation.grips[g].name) + "," + exact(duration * manipulation.times[i]);
      for (int k = 0; k < 3; ++k) text += "," + exact(pose.at[k] / units::mm);
      for (const double q : {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()}) text += "," + exact(q);
      text += "\n";
    }
  return text;
}

std::string manipulation_json(const Manipulation& manipulation, double duration) {
  const std::string times = json_list(manipulation.times.size(), [&](std::size_t i) { return exact(duration * manipulation.times[i]); });
  const auto grip_text = [&](std::size_t g) {
    const Grip& grip = manipulation.grips[g];
    const std::vector<Frame>& poses = manipulation.poses[g];
    std::string text = "{\"name\": " + json_string(grip.name) + ", \"connection\": " + (grip.connection ? "true" : "false");
    if (grip.branch < 0) text += ", \"at\": " + exact(grip.at);
    text += ",\n     \"t\": " + times;
    text += ",\n     \"place\": " + json_list(poses.size(), [&](std::size_t i) {
      return json_list(3, [&](std::size_t k) { return exact(poses[i].at[k] / units::mm); });
    });
    return text + ",\n     \"quaternion\": " + json_list(poses.size(), [&](std::size_t i) {
      const Quat& q = poses[i].rotation;
      const double parts[] = {q.w(), q.x(), q.y(), q.z()};
      return json_list(4, [&](std::size_t k) { return exact(parts[k]); });
    }) + "}";
  };
  std::string text = "{\"duration\": " + exact(duration) + ",\n \"grips\": [";
  for (std::size_t g = 0; g < manipulation.grips.size(); ++g) text += (g ? ",\n    " : "\n    ") + grip_text(g);
  return text + "\n ]}\n";
}

}  // namespace tendril::assembly
