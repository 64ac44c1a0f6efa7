// placed_robot: robots in a scene, and the rods that are fastened to their links.
#include "binding/bind_placed_robot.h"

#include "binding/card.h"
#include "binding/examples.h"
#include "binding/open.h"
#include "binding/robot_classes.h"

namespace tendril::lua {
namespace {

using Where = std::variant<std::string, double>;
using JointList = std::vector<double>;

Schema robot_options() {
  return {
      option<Frame>("at", "", "Where its base stands: d1, d2, d3 are the base's x, y, z axes; default: the scene's axes"),
      option<JointList>("joints", "rad or m", "Joint values; default: each as near to 0 as its limits allow"),
      option<double>("clearance", "m", "That rods are required to keep from its links").at_least(0).preset(0),
  };
}

Schema attach_options() {
  return {
      option<std::string>("kind", "", "What it holds: everything, the position only, or everything but sliding along d3")
          .one_of({"clamp", "swivel", "slide"}).preset("clamp"),
      option<bool>("orientation", "", "False: the position only, as a swivel").preset(true),
      option<double>("turns", "", "Extra full turns about the tangent relative to the start").preset(0),
  };
}

Attachment attachment_of(const PlacedRod& rod, const Where& where, const PlacedRobot& robot, const std::string& link, const Frame& frame,
                         const Options& o) {
  const std::string kind = o.get<std::string>("kind");
  if (kind == "slide" && !o.get<bool>("orientation"))
    throw UsageError("scene:attach: a clip that the rod slides through along d3 holds its orientation; leave 'orientation' out");
  Attachment attachment;
  attachment.rod = rod.name();
  const std::string* end = std::get_if<std::string>(&where);
  attachment.at = end ? rod.place(*end) : std::get<double>(where);
  attachment.robot = robot.name;
  attachment.link = robot.robot->link(link);
  attachment.in_link = frame;
  attachment.orientation = kind != "swivel" && o.get<bool>("orientation");
  attachment.slide = kind == "slide";
  attachment.turns = o.get<double>("turns");
  return attachment;
}

std::vector<std::string> attached_rods(const PlacedRobotHandle& handle) {
  std::vector<std::string> names;
  for (const auto& rod : handle.scene->rods())
    for (const Attachment& a : rod->attachments())
      if (a.robot == handle.name && (names.empty() || names.back() != rod->name())) names.push_back(rod->name());
  return names;
}

std::string describe_placed_robot(const PlacedRobotHandle& handle) {
  const PlacedRobot& placed = handle.robot();
  Card card("robot '" + placed.name + "' in a scene");
  card.row("design", placed.robot->name(), std::to_string(placed.bodies->size()) + " solid links");
  for (int k = 0; k < placed.robot->size(); ++k) {
    const Joint& joint = placed.robot->variable(k);
    card.row(joint.name, placed.joints[k], joint.kind == JointKind::prismatic ? "m" : "rad");
  }
  for (const auto& rod : handle.scene->rods())
    for (const Attachment& a : rod->attachments())
      if (a.robot == placed.name)
        card.row("carries '" + rod->name() + "'", "at " + rod->describe(a.at), placed.robot->links()[a.link].name);
  return card.text();
}

}  // namespace

void add_robots_to(Class<Scene>& scene) {
  scene
      .property("robots", "", "Names of the robots",
                [](const Scene& s) {
                  std::vector<std::string> names;
                  for (const PlacedRobot& robot : s.robots()) names.push_back(robot.name);
                  return names;
                })
      .method("robot",
              {.takes = {"name", "robot"}, .options = robot_options(),
               .does = "Places a robot. Its links are solid, called \"name.link\": rods touch them and keep clear of them as of obstacles.",
               .example = with_robot("print(arm:frame(\"flange\").at)  --> vec(1.665, 0, 2.015)")},
              [](std::shared_ptr<Scene> s, const std::string& name, const RobotValue& robot, const Options& o) {
                PlacedRobot placed{name, robot.robot, o.maybe<Frame>("at").value_or(Frame{})};
                placed.joints = o.maybe<JointList>("joints").value_or(JointList());
                if (o.has("joints")) robot.robot->check(placed.joints, ("scene:robot: '" + name + "'").c_str());
                placed.clearance = o.get<double>("clearance");
                s->add(std::move(placed));
                return PlacedRobotHandle{s, name};
              })
      .method("placed_robot", {.takes = {"name"}, .does = "The robot of this name.",
                               .example = with_robot("print(s:placed_robot(\"arm\").name)  --> arm")},
              [](std::shared_ptr<Scene> s, const std::string& name) {
                s->robot(name);
                return PlacedRobotHandle{s, name};
              })
      .method("attach",
              {.takes = {"rod", "where", "robot", "link", "frame"}, .options = attach_options(),
               .does = "Fastens a rod at \"start\", \"finish\" or an arc length in m to a robot's link; the frame is in the link's axes. "
                       "The hold goes with the link. Over four radii from there the rod is not compared with that link.",
               .example = with_robot("local m = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
                                     "s:rod(\"hose\", rod.new{length = 1.6, section = rod.section{outer = 0.03, inner = 0.02, material = m}})\n"
                                     "s:attach(\"hose\", \"start\", \"arm\", \"link_3\", frame{at = {0, 0, 0.3}, along = {0, 0, 1}})\n"
                                     "s:attach(\"hose\", \"finish\", \"arm\", \"flange\", frame{at = {0, 0, 0.05}, along = {0, 0, -1}})\n"
                                     "print(#s:placed_robot(\"arm\").rods)  --> 1")},
              [](std::shared_ptr<Scene> s, const std::string& rod, const Where& where, const std::string& robot, const std::string& link,
                 const Frame& frame, const Options& o) {
                s->attach(attachment_of(s->rod(rod), where, s->robot(robot), link, frame, o));
                return PlacedRodHandle{s, rod};
              });
}

void bind_placed_robot(lua_State* L) {
  Class<PlacedRobotHandle>(L, "A robot in a scene")
      .property("name", "", "Its name in the scene", [](const PlacedRobotHandle& r) { return r.name; })
      .property("design", "", "The robot itself", [](const PlacedRobotHandle& r) { return RobotValue{r.robot().robot}; })
      .property("joints", "rad or m", "Where its joints stand", [](const PlacedRobotHandle& r) { return r.robot().joints; })
      .property("at", "", "Where its base stands", [](const PlacedRobotHandle& r) { return r.robot().base; })
      .property("rods", "", "Names of the rods that are attached to it", attached_rods)
      .method("move", {.takes = {"joints"},
                       .does = "Moves its joints, and with the links what is attached to them. An error where values are beyond the limits.",
                       .example = with_robot("arm:move{0, 0.2, 0, 0, 0.5, 0}\nprint(arm.joints[5])  --> 0.5")},
              [](std::shared_ptr<PlacedRobotHandle> r, const JointList& joints) {
                r->scene->set_joints(r->name, joints);
                return r;
              })
      .method("frame", {.takes = {"link"}, .does = "Where a link is, in world axes.",
                        .example = with_robot("print(arm:frame(\"flange\").at)  --> vec(1.665, 0, 2.015)")},
              [](const PlacedRobotHandle& r, const std::string& link) {
                const PlacedRobot& placed = r.robot();
                return placed.link_frame(placed.robot->link(link));
              })
      .tostring(describe_placed_robot);
}

}  // namespace tendril::lua
