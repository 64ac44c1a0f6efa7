#include "robot/urdf.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "base/error.h"
#include "base/file_access.h"
#include "base/nearest_name.h"
#include "base/printable.h"
#include "base/write_file.h"
#include "robot/package_path.h"

namespace tendril {

namespace {

using Node = pugi::xml_node;

// Joints as the file has them, before they are put in order.
struct FileJoint {
  Joint joint;
  std::string parent, child, mimics;
  Node node;
};

class UrdfReader {
 public:
  UrdfReader(const std::string& text, const std::string& path) : text_(text), path_(path) {}
  std::shared_ptr<const Robot> read();

 private:
  [[noreturn]] void fail_at(std::ptrdiff_t offset, const std::string& why) const;
  [[noreturn]] void fail(Node node, const std::string& why) const { fail_at(node.offset_debug(), why); }

  Node root(pugi::xml_document& document) const;
  std::string attribute(Node node, const char* name) const;
  double number(Node node, const char* name, const std::string& text) const;
  double number(Node node, const char* name) const { return number(node, name, attribute(node, name)); }
  double number(Node node, const char* name, double otherwise) const {
    return node.attribute(name) ? number(node, name) : otherwise;
  }
  Vec3 numbers(Node node, const char* name) const;
  Frame origin(Node owner) const;

  void read_link(Node node);
  LinkShape read_shape(Node node);
  std::shared_ptr<const LinkMesh> mesh(Node node);
  void read_joint(Node node);
  void read_limits(Node node, Joint& joint) const;
  void check_names() const;
  int base() const;
  void collect(int link, std::vector<Link>& links, std::vector<Joint>& joints);
  void resolve_mimicry(std::vector<Joint>& joints) const;

  const std::string& text_;
  const std::string& path_;
  std::vector<Link> links_;
  std::vector<Node> link_nodes_;
  std::map<std::string, int> link_number_;
  std::vector<FileJoint> joints_;
  std::set<std::string> joint_names_;
  std::vector<int> order_;                                         ///< of the file's joints, as collected
  std::map<std::string, std::shared_ptr<const LinkMesh>> meshes_;  ///< by file and scale
};

void UrdfReader::fail_at(std::ptrdiff_t offset, const std::string& why) const {
  const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
  const std::string line = offset >= 0 ? ":" + std::to_string(1 + std::count(text_.begin(), end, '\n')) : "";
  throw UsageError("robot '" + path_ + line + "': " + printable(why));
}

Node UrdfReader::root(pugi::xml_document& document) const {
  if (text_.find_first_not_of(" \t\r\n") == text_.npos) fail_at(-1, "the file is empty");
  const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
  if (!parsed) fail_at(parsed.offset, std::string("this is no well-formed XML: ") + parsed.description());
  const Node robot = document.document_element();
  if (std::strcmp(robot.name(), "robot") != 0) fail(robot, std::string("got <") + robot.name() + ">, expected <robot>");
  for (Node child : robot.children())
    if (std::strncmp(child.name(), "xacro:", 6) == 0)
      fail(child,
           std::string("<") + child.name() + "> is a macro: turn the xacro file into URDF first (xacro FILE.xacro > FILE.urdf)");
  return robot;
}

std::string UrdfReader::attribute(Node node, const char* name) const {
  const pugi::xml_attribute found = node.attribute(name);
  if (!found) fail(node, std::string("<") + node.name() + "> has no '" + name + "'");
  return found.value();
}

double UrdfReader::number(Node node, const char* name, const std::string& text) const {
  const auto first = text.find_first_not_of(" \t\r\n+");
  const auto last = text.find_last_not_of(" \t\r\n");
  double value = 0;
  bool good = first != text.npos;
  if (good) {
    const auto [end, error] = std::from_chars(text.data() + first, text.data() + last + 1, value);
    good = error == std::errc() && end == text.data() + last + 1 && std::isfinite(value);
  }
  if (!good) fail(node, std::string("'") + name + "' of <" + node.name() + "> is '" + text + "', expected a finite number");
  return value;
}

Vec3 UrdfReader::numbers(Node node, const char* name) const {
  const std::string text = attribute(node, name);
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r\n", at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  if (words.size() != 3)
    fail(node, std::string("'") + name + "' of <" + node.name() + "> is '" + text + "', expected three numbers");
  const Vec3 read(number(node, name, words[0]), number(node, name, words[1]), number(node, name, words[2]));
  if (!(read.cwiseAbs().maxCoeff() <= Robot::largest_number))
    fail(node, std::string("'") + name + "' of <" + node.name() + "> is '" + text + "', expected numbers of at most 1e9");
  return read;
}

// <origin xyz= rpy=>: turns about the fixed x, y, z axes, in this order.
Frame UrdfReader::origin(Node owner) const {
  Frame frame;
  const Node node = owner.child("origin");
  if (!node) return frame;
  if (node.attribute("xyz")) frame.at = numbers(node, "xyz");
  if (node.attribute("rpy")) {
    const Vec3 turn = numbers(node, "rpy");
    frame.rotation = exp_rotation({0, 0, turn.z()}) * exp_rotation({0, turn.y(), 0}) * exp_rotation({turn.x(), 0, 0});
    frame.rotation.normalize();
  }
  return frame;
}

std::shared_ptr<const LinkMesh> UrdfReader::mesh(Node node) {
  const Vec3 scale = node.attribute("scale") ? numbers(node, "scale") : Vec3::Ones();
  if ((scale.array() == 0).any()) fail(node, "'scale' of <mesh> holds a 0");
  std::string file;
  try {
    file = resolve_mesh_path(attribute(node, "filename"), path_);
  } catch (const UsageError& missing) {
    const std::string why = missing.what();
    if (why.starts_with("robot '")) throw;
    fail(node, why);
  }
  const std::string key = file + "|" + node.attribute("scale").value();
  std::shared_ptr<const LinkMesh>& known = meshes_[key];
  if (!known) known = std::make_shared<const LinkMesh>(file, scale);
  return known;
}

LinkShape UrdfReader::read_shape(Node node) {
  const Node geometry = node.child("geometry");
  if (!geometry) fail(node, std::string("<") + node.name() + "> has no <geometry>");
  const Node body = geometry.find_child([](Node child) { return child.type() == pugi::node_element; });
  if (!body) fail(geometry, "<geometry> is empty");
  const std::string kind = body.name();
  LinkShape shape;
  shape.pose = origin(node);
  if (kind == "mesh") {
    shape.shape = mesh(body);
    return shape;
  }
  if (kind == "box")
    shape.shape = Solid(Box{numbers(body, "size")});
  else if (kind == "cylinder")
    shape.shape = Solid(Cylinder{number(body, "radius"), number(body, "length")});
  else if (kind == "sphere")
    shape.shape = Solid(Sphere{number(body, "radius")});
  else
    fail(body, "a body of the kind <" + kind + "> is not known: mesh, box, cylinder or sphere expected");
  try {
    check(std::get<Solid>(shape.shape), kind.c_str());
  } catch (const UsageError& wrong) {
    fail(body, wrong.what());
  }
  return shape;
}

void UrdfReader::read_link(Node node) {
  Link link;
  link.name = attribute(node, "name");
  if (link.name.empty()) fail(node, "a link without a name");
  if (!link_number_.emplace(link.name, static_cast<int>(links_.size())).second)
    fail(node, "the link '" + link.name + "' is there twice");
  for (Node child : node.children("visual")) link.visual.push_back(read_shape(child));
  for (Node child : node.children("collision")) link.collision.push_back(read_shape(child));
  links_.push_back(std::move(link));
  link_nodes_.push_back(node);
}

void UrdfReader::read_limits(Node node, Joint& joint) const {
  const Node limit = node.child("limit");
  if (!limit) {
    if (joint.kind == JointKind::continuous) return;
    fail(node, "the joint '" + joint.name + "' is " + name_of(joint.kind) + " and has no <limit>");
  }
  const double velocity = number(limit, "velocity", 0);
  if (velocity < 0) fail(limit, "'velocity' of <limit> is less than 0");
  if (velocity > 0) joint.velocity = velocity;
  if (joint.kind == JointKind::continuous) return;
  joint.lower = number(limit, "lower", 0);
  joint.upper = number(limit, "upper", 0);
  if (joint.lower > joint.upper)
    fail(limit, "the lower limit " + attribute(limit, "lower") + " of joint '" + joint.name + "' lies above the upper one, " +
                    (limit.attribute("upper") ? limit.attribute("upper").value() : "0 (not given)"));
}

void UrdfReader::read_joint(Node node) {
  FileJoint read;
  read.node = node;
  Joint& joint = read.joint;
  joint.name = attribute(node, "name");
  if (joint.name.empty()) fail(node, "a joint without a name");
  if (!joint_names_.insert(joint.name).second) fail(node, "the joint '" + joint.name + "' is there twice");
  const std::string kind = attribute(node, "type");
  bool known = false;
  for (JointKind each : {JointKind::fixed, JointKind::revolute, JointKind::continuous, JointKind::prismatic})
    if (kind == name_of(each)) {
      joint.kind = each;
      known = true;
    }
  if (!known)
    fail(node, "the joint '" + joint.name + "' is of the kind '" + kind + "', expected fixed, revolute, continuous or prismatic");
  for (const char* end : {"parent", "child"}) {
    const Node link = node.child(end);
    if (!link) fail(node, "the joint '" + joint.name + "' has no <" + end + ">");
    (end[0] == 'p' ? read.parent : read.child) = attribute(link, "link");
  }
  joint.origin = origin(node);
  if (joint.kind != JointKind::fixed) {
    if (const Node axis = node.child("axis")) {
      joint.axis = numbers(axis, "xyz");
      if (!(joint.axis.norm() > 1e-9)) fail(axis, "the axis of joint '" + joint.name + "' is zero");
    }
    read_limits(node, joint);
    if (const Node mimic = node.child("mimic")) {
      read.mimics = attribute(mimic, "joint");
      joint.factor = number(mimic, "multiplier", 1);
      joint.shift = number(mimic, "offset", 0);
    }
  }
  joints_.push_back(std::move(read));
}

void UrdfReader::check_names() const {
  std::vector<std::string> names;
  for (const Link& link : links_) names.push_back(link.name);
  std::map<std::string, std::string> carried;  // link: joint
  for (const FileJoint& read : joints_) {
    const std::string who = "the joint '" + read.joint.name + "' ";
    for (const char* end : {"parent", "child"}) {
      const std::string& link = end[0] == 'p' ? read.parent : read.child;
      if (!link_number_.count(link))
        fail(read.node.child(end), who + "joins the unknown link " + unknown_name(link, "links", names));
    }
    if (read.parent == read.child) fail(read.node, who + "joins '" + read.child + "' to itself");
    const auto [at, is_new] = carried.emplace(read.child, read.joint.name);
    if (!is_new) fail(read.node, who + "carries '" + read.child + "', which '" + at->second + "' carries already");
    if (!read.mimics.empty() && !joint_names_.count(read.mimics))
      fail(read.node.child("mimic"), who + "mimics the unknown joint " +
                                         unknown_name(read.mimics, "joints", {joint_names_.begin(), joint_names_.end()}));
  }
}

// The one link that no joint carries.
int UrdfReader::base() const {
  std::set<std::string> carried;
  for (const FileJoint& read : joints_) carried.insert(read.child);
  int found = -1;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (carried.count(links_[i].name)) continue;
    if (found >= 0)
      fail(link_nodes_[i], "no joint carries '" + links_[found].name + "' nor '" + links_[i].name + "': a robot has one base");
    found = static_cast<int>(i);
  }
  if (found < 0) fail(joints_.front().node, "the joints go round in a circle: every link is carried by another one");
  return found;
}

// Depth first, joints in the order of the file; a stack of its own, as a file may nest as deep as it likes.
void UrdfReader::collect(int first, std::vector<Link>& links, std::vector<Joint>& joints) {
  std::map<std::string, std::vector<int>> carries;
  for (int k = static_cast<int>(joints_.size()) - 1; k >= 0; --k) carries[joints_[k].parent].push_back(k);
  std::map<std::string, int> placed;
  const auto place = [&](int link) {
    placed[links_[link].name] = static_cast<int>(links.size());
    links.push_back(links_[link]);
  };
  place(first);
  std::vector<int> left = carries[links_[first].name];
  while (!left.empty()) {
    const int k = left.back();
    left.pop_back();
    order_.push_back(k);
    joints.push_back(joints_[k].joint);
    joints.back().parent = placed.at(joints_[k].parent);
    place(link_number_.at(joints_[k].child));
    const std::vector<int>& more = carries[joints_[k].child];
    left.insert(left.end(), more.begin(), more.end());
  }
  if (links.size() == links_.size()) return;
  for (const FileJoint& read : joints_)
    if (!placed.count(read.child))
      fail(read.node, "the joints go round in a circle: '" + read.child + "' does not hang on the base '" + links[0].name + "'");
}

void UrdfReader::resolve_mimicry(std::vector<Joint>& joints) const {
  std::map<std::string, int> number;
  for (std::size_t k = 0; k < joints.size(); ++k) number[joints[k].name] = static_cast<int>(k);
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (const std::string& followed = joints_[order_[k]].mimics; !followed.empty()) joints[k].mimics = number.at(followed);
}

std::shared_ptr<const Robot> UrdfReader::read() {
  pugi::xml_document document;
  const Node robot = root(document);
  for (Node child : robot.children("link")) read_link(child);
  for (Node child : robot.children("joint")) read_joint(child);
  if (links_.empty()) fail(robot, "the robot has no links");
  check_names();
  std::vector<Link> links;
  std::vector<Joint> joints;
  collect(base(), links, joints);
  resolve_mimicry(joints);
  std::string name = robot.attribute("name").value();
  if (name.empty()) name = std::filesystem::path(path_).stem().string();
  try {
    return std::make_shared<const Robot>(std::move(name), std::move(links), std::move(joints));
  } catch (const UsageError& wrong) {
    throw UsageError("robot '" + path_ + "': " + wrong.what());
  }
}

}  // namespace

std::shared_ptr<const Robot> parse_urdf(const std::string& text, const std::string& path) {
  return UrdfReader(text, path).read();
}

std::shared_ptr<const Robot> load_urdf(const std::string& path) {
  std::error_code error;
  if (path.empty()) throw UsageError("robot: no file name was given");
  readable_path(path);  // before anything is told about a file
  if (std::filesystem::is_directory(path, error)) throw UsageError("robot '" + path + "': it is a folder, not a file");
  if (!std::filesystem::exists(path, error)) throw UsageError("robot '" + path + "': there is no such file");
  return parse_urdf(read_file(path), path);
}

}  // namespace tendril
