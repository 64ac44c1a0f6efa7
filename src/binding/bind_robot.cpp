// robot: links, joints, kinematics, collision.
#include "binding/bind_mesh.h"
#include "binding/bind_program.h"
#include "binding/card.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/robot_classes.h"
#include "binding/scene_classes.h"
#include "robot/load_robot.h"
#include "scene/placed_robot.h"

namespace tendril::lua {
namespace {

using JointList = std::vector<double>;

const char* const arm = "local bot = robot.load(\"builtin:six_axis\")\n";

Schema reaches_options() {
  return {
      option<std::string>("link", "", "The link to bring there; default: the robot's tip"),
      option<JointList>("near", "rad or m", "Joint values: the nearest solutions come first, and joints that are free stay there; default: 0"),
      option<bool>("limits", "", "Only within the joint limits").preset(true),
      option<bool>("turns", "", "Also solutions that differ by whole turns, where the limits leave room").preset(true),
      option<int>("starts", "", "Of the numeric search, for arms without a closed form").at_least(1).at_most(1e6).preset(100),
  };
}

Schema collides_options() {
  return {
      option<Scene>("scene", "", "Its obstacles count as well, against all links that move; default: the robot alone"),
      option<Frame>("at", "", "Where the robot's base stands in the scene; default: the origin, z up"),
  };
}

std::string range_text(const Joint& joint) {
  if (joint.kind == JointKind::continuous) return "endless";
  const char* unit = joint.kind == JointKind::prismatic ? "m" : "rad";
  return quantity(joint.lower, unit) + " ... " + quantity(joint.upper, unit);
}

std::string velocity_text(const Joint& joint) {
  if (std::isinf(joint.velocity)) return "";
  return joint.kind == JointKind::prismatic ? quantity(joint.velocity, "m") + "/s" : quantity(joint.velocity, "rad") + "/s";
}

std::string text_of(const RobotValue& value) {
  std::vector<std::vector<std::string>> rows;
  for (int k = 0; k < value.robot->size(); ++k) {
    const Joint& joint = value.robot->variable(k);
    rows.push_back({joint.name, name_of(joint.kind), range_text(joint), velocity_text(joint)});
  }
  Card card("robot " + value.robot->name());
  card.row("links", std::to_string(value.robot->links().size())).row("tip", value.robot->links()[value.robot->tip()].name);
  return card.text() + "\n" + table_text({"joint", "kind", "limits", "velocity"}, rows);
}

std::vector<std::vector<double>> rows_of(const Jacobian& jacobian) {
  std::vector<std::vector<double>> rows(6);
  for (int i = 0; i < 6; ++i)
    for (Eigen::Index k = 0; k < jacobian.cols(); ++k) rows[i].push_back(jacobian(i, k));
  return rows;
}

Pushed reaches(lua_State* L, RobotValue& value, const Frame& target, const Options& o) {
  const int link = o.has("link") ? value.robot->link(o.get<std::string>("link")) : value.robot->tip();
  auto& inverse = value.inverse[link];
  if (!inverse) inverse = std::make_shared<const InverseKinematics>(value.robot, link);
  InverseOptions options;
  options.near = o.maybe<JointList>("near").value_or(JointList());
  options.limits = o.get<bool>("limits");
  options.turns = o.get<bool>("turns");
  options.starts = o.get<int>("starts");
  const InverseResult result = inverse->solve(target, options, run_context(L));
  if (result.solutions.empty()) lua_pushnil(L);
  else Value<std::vector<JointList>>::push(L, result.solutions);
  const std::string why = result.status == Status::cancelled || result.status == Status::timeout ? "stopped before the end" : result.message;
  if (why.empty()) lua_pushnil(L);
  else Value<std::string>::push(L, why);
  return {2};
}

const RobotCollision& collision_of(lua_State* L, RobotValue& value) {
  if (value.collision) return *value.collision;
  auto made = std::make_shared<const RobotCollision>(value.robot, PairOptions{}, run_context(L));
  if (!made->decided()) throw UsageError("robot: the search for pairs of links that always or never touch was interrupted");
  value.collision = std::move(made);
  return *value.collision;
}

void append_numbers(std::string& text, std::initializer_list<double> numbers) {
  for (double x : numbers) text.append(reinterpret_cast<const char*>(&x), sizeof x);
}

// What tells one set of obstacles from another: their shapes and where they are.
std::string signature(const Scene& scene, const Frame& base) {
  std::string text;
  const auto append_frame = [&](const Frame& f) {
    append_numbers(text, {f.at.x(), f.at.y(), f.at.z(), f.rotation.x(), f.rotation.y(), f.rotation.z(), f.rotation.w()});
  };
  append_frame(base);
  for (const PlacedObstacle& obstacle : scene.obstacles()) {
    append_frame(obstacle.body.pose);
    if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape)) {
      text += "mesh" + std::to_string(reinterpret_cast<std::uintptr_t>(surface->get()));
      continue;
    }
    const Solid& solid = std::get<Solid>(obstacle.body.shape);
    text += "solid" + std::to_string(solid.index());
    if (const Box* box = std::get_if<Box>(&solid)) append_numbers(text, {box->size.x(), box->size.y(), box->size.z()});
    if (const Sphere* sphere = std::get_if<Sphere>(&solid)) append_numbers(text, {sphere->radius});
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&solid)) append_numbers(text, {cylinder->radius, cylinder->length});
  }
  return text;
}

const RobotCollision& collision_within(lua_State* L, RobotValue& value, const Scene& scene, const Frame& base) {
  const RobotCollision& alone = collision_of(L, value);
  const std::string wanted = signature(scene, base);
  if (value.surrounded && value.surroundings == wanted) return *value.surrounded;
  auto with = std::make_shared<RobotCollision>(alone);
  for (const PlacedObstacle& obstacle : scene.obstacles()) with->add_obstacle(obstacle.body.shape, base.inverse() * obstacle.body.pose);
  value.surrounded = with;
  value.surroundings = wanted;
  return *value.surrounded;
}

std::vector<std::array<std::string, 2>> collides(lua_State* L, RobotValue& value, const JointList& q, const Options& o) {
  const Scene* scene = o.find<Scene>("scene");
  if (!scene && o.has("at")) throw UsageError("robot:collides: 'at' needs a 'scene'");
  const Frame* at = o.find<Frame>("at");
  const RobotCollision& collision = scene ? collision_within(L, value, *scene, at ? *at : Frame{}) : collision_of(L, value);
  std::vector<std::array<std::string, 2>> pairs;
  const auto name = [&](int link) { return value.robot->links()[link].name; };
  for (const RobotContact& contact : collision.contacts(q))
    pairs.push_back({name(contact.link), contact.obstacle >= 0 ? scene->obstacles()[contact.obstacle].name : name(contact.other_link)});
  return pairs;
}

std::vector<std::array<std::string, 3>> pairs_of(lua_State* L, RobotValue& value) {
  std::vector<std::array<std::string, 3>> list;
  for (const LinkPair& pair : collision_of(L, value).pairs())
    list.push_back({value.robot->links()[pair.a].name, value.robot->links()[pair.b].name, name_of(pair.kind)});
  return list;
}

MeshValue mesh_of_link(const RobotValue& value, const std::string& name) {
  const Link& link = value.robot->links()[value.robot->link(name)];
  const auto& shapes = link.visual.empty() ? link.collision : link.visual;
  Mesh joined = joined_mesh(shapes, name);
  if (joined.triangles.empty()) throw UsageError("robot:mesh: the link '" + name + "' has no body");
  return make_mesh_value(std::move(joined));
}

void bind_joint(lua_State* L) {
  Class<JointValue>(L, "A joint of a robot that moves by itself: one entry of its joint values")
      .property("name", "", "Its name", [](const JointValue& j) { return j.joint().name; })
      .property("kind", "", "\"revolute\", \"continuous\" or \"prismatic\"", [](const JointValue& j) { return name_of(j.joint().kind); })
      .property("lower", "rad or m", "Lower limit; -math.huge without one", [](const JointValue& j) { return j.robot->lower()[j.variable]; })
      .property("upper", "rad or m", "Upper limit; math.huge without one", [](const JointValue& j) { return j.robot->upper()[j.variable]; })
      .property("velocity", "rad/s or m/s", "The fastest it goes; math.huge when that is not stated", [](const JointValue& j) { return j.joint().velocity; })
      .property("link", "", "The link that it carries", [](const JointValue& j) { return j.robot->links()[j.robot->variables()[j.variable] + 1].name; })
      .tostring([](const JointValue& j) {
        const std::string fast = velocity_text(j.joint());
        return "joint " + j.joint().name + " (" + name_of(j.joint().kind) + "), " + range_text(j.joint()) + (fast.empty() ? "" : ", " + fast);
      });
}

void bind_robot_class(lua_State* L) {
  Class<RobotValue> bound(L, "Rigid links joined in a tree; it never changes. Joint values are lists of numbers (rad or m) in the order of `joints`; "
                       "frames stand in the axes of its base, with d1, d2, d3 as a link's x, y, z axes");
  bound
      .property("name", "", "Its name", [](const RobotValue& r) { return r.robot->name(); })
      .property("joints", "", "The joints that move by themselves, in the order of joint values",
                [](const RobotValue& r) {
                  std::vector<JointValue> list;
                  for (int k = 0; k < r.robot->size(); ++k) list.push_back({r.robot, k});
                  return list;
                })
      .property("links", "", "Names of the links, the base first",
                [](const RobotValue& r) {
                  std::vector<std::string> names;
                  for (const Link& link : r.robot->links()) names.push_back(link.name);
                  return names;
                })
      .property("tip", "", "Name of the link at the end of the arm", [](const RobotValue& r) { return r.robot->links()[r.robot->tip()].name; })
      .method("link_frame", {.takes = {"link", "q"}, .does = "Where a link is.",
                             .example = std::string(arm) + "print(bot:link_frame(\"flange\", {0, 0, 0, 0, 0, 0}).at)  --> vec(1.665, 0, 2.015)"},
              [](const RobotValue& r, const std::string& link, const JointList& q) { return r.robot->link_frame(r.robot->link(link), q); })
      .method("jacobian", {.takes = {"link", "q"},
                           .does = "How a link's frame moves with the joints, in the link's own axes: three rows for its origin (m), three for its "
                                   "rotation vector (rad), a column for each joint.",
                           .example = std::string(arm) + "local J = bot:jacobian(\"flange\", {0, 0, 0, 0, 0, 0})\nprint(#J, #J[1])  --> 6  6"},
              [](const RobotValue& r, const std::string& link, const JointList& q) { return rows_of(r.robot->jacobian(r.robot->link(link), q)); })
      .method("reaches", {.takes = {"frame"}, .options = reaches_options(), .returns = "(number)[][]|nil, string?",
                          .does = "All joint values that bring a link to a frame, or nil and the reason. With solutions the second result tells "
                                  "which joints are free there, or nil.",
                          .example = std::string(arm) + "local f = bot:link_frame(\"flange\", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})\n"
                                                        "local all = bot:reaches(f, {near = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}})\n"
                                                        "print(string.format(\"%.3f\", all[1][6]))  --> 0.600"},
              reaches)
      .method("within_limits", {.takes = {"q"}, .returns = "boolean, string?", .does = "Whether joint values keep the limits; if not, also which do not.",
                                .example = std::string(arm) + "print(bot:within_limits({0, 0, 0, 0, 3, 0}))"
                                                              "  --> false 'joint_5' at 3, limits -1.95477 ... 1.95477"},
              [](lua_State* state, const RobotValue& r, const JointList& q) {
                const std::string beyond = r.robot->beyond_limits(q);
                lua_pushboolean(state, beyond.empty());
                if (beyond.empty()) return Pushed{1};
                Value<std::string>::push(state, beyond);
                return Pushed{2};
              })
      .method("collides", {.takes = {"q"}, .options = collides_options(),
                           .does = "The pairs that touch, each {link, link} or {link, obstacle}; an empty list: none.",
                           .example = std::string(arm) + "print(#bot:collides({0, 0, 0, 0, 0, 0}))  --> 0"},
              collides)
      .method("pairs", {.does = "What bot:collides looks at: {link, link, kind} for all pairs of links with bodies. Kinds: \"checked\"; \"rigid\", "
                                "\"neighbours\", \"always\" and \"never\" (touching, at 10,000 places within the limits) are not.",
                        .example = std::string(arm) + "print(table.concat(bot:pairs()[1], \" \"))  --> base link_1 neighbours"},
              pairs_of)
      .method("mesh", {.takes = {"link"}, .does = "A link's bodies as one mesh, in the link's axes: for pictures, and as an obstacle.",
                       .example = std::string(arm) + "print(bot:mesh(\"link_6\").watertight)  --> true"},
              mesh_of_link)
      .tostring(text_of);
  add_programs(bound);
}

}  // namespace

void bind_robot(lua_State* L) {
  bind_joint(L);
  bind_robot_class(L);
  Module(L, "robot", "Robots: what carries a dress pack")
      .function("load", {.takes = {"source"},
                         .does = "A robot from a URDF file, or \"builtin:six_axis\", an industrial arm of 2.5 m reach that comes with the program. "
                                 "Meshes are looked for beside the file and in its package.",
                         .example = std::string(arm) + "print(#bot.joints, bot.joints[4].name)  --> 6  joint_4"},
                [](const std::string& source) { return RobotValue{load_robot(source)}; });
}

}  // namespace tendril::lua
