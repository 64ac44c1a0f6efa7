// view: pictures of a scene and its equilibrium.
#include <cstdio>
#include <filesystem>

#include "base/nearest_name.h"
#include "base/write_file.h"
#include "binding/assembly_classes.h"
#include "binding/bind_mesh.h"
#include "binding/card.h"
#include "binding/compose_assembly.h"
#include "binding/compose_motion.h"
#include "binding/examples.h"
#include "binding/flatten_classes.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/preform_classes.h"
#include "binding/route_classes.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "binding/show_picture.h"
#include "binding/solve_options.h"
#include "binding/variation_classes.h"

namespace tendril::lua {

/// What a picture will show. Drawn when it is saved.
struct View {
  std::shared_ptr<Scene> scene;
  std::shared_ptr<SceneEquilibrium> equilibrium;  ///< null: the scene is not solved
  PictureWish wish;
  std::shared_ptr<const assembly::Result> installation;  ///< several states of it; null: none
  std::shared_ptr<const SceneMotion> motion;             ///< the same; the equilibrium is its last one
};

namespace {

using Colour = std::variant<std::string, std::array<double, 3>, StabilityHandle>;
using OneOrMany = std::variant<std::string, std::vector<std::string>>;

/// Scenes and what was found in them, shared and not copied.
struct ShownKind {
  static const Kind& kind() {
    static const Kind kind{"a scene, an equilibrium, a motion, hoses, a hose, routes, an assembly or a board", "scene|equilibrium|motion|preform_result|hose|routes|assembly|board", [](lua_State* L, int index) {
      const bool fits = object<Scene>(L, index) || object<SceneEquilibrium>(L, index) || object<PreformHandle>(L, index) ||
                        object<HoseHandle>(L, index) || object<RoutesHandle>(L, index) || object<AssemblyHandle>(L, index) ||
                        object<FlattenHandle>(L, index) || object<SceneMotion>(L, index);
      return fits ? std::string() : describe(L, index);
    }};
    return kind;
  }
};

const std::vector<std::string>& colour_names() {
  static const std::vector<std::string> names{"clearance", "curvature", "tension", "twist"};
  return names;
}

Schema view_options() {
  return Schema{
      option<Colour>("color", "", "What the rods' colour says: \"clearance\", \"curvature\", \"tension\", \"twist\", {r, g, b} "
                                  "from 0 to 1, or a stability: how far tolerances move it; default: clearance when there are obstacles, else curvature"),
      option<std::vector<std::string>>("ghost", "", "Obstacles to see through, the others are solid; default: all"),
      option<MeshValue>("envelope", "", "A shell around the rods to see through; with color = \"clearance\" its colours say how near "
                                        "obstacles are to it, and the rods are plain"),
      option<std::string>("title", "", "On the card"),
  }
      .with_list(ShownKind::kind(), "what", "The scene, its equilibrium, or a motion of it (a strip of its states; with an envelope the space swept), hoses of method.preform (all, or one to colour it by its clearance), routes of method.route as they are nominally, an installation by method.assembly, a build board by method.flatten");
}

Schema page_options() {
  return Schema{
             option<std::array<int, 2>>("size", "pixels", "{width, height}; default {1600, 1200}"),
             option<std::vector<std::string>>("sheet", "", "Views in rows of two: \"iso\", \"front\", \"top\", \"side\", \"card\"; "
                                                           "default iso, front, top and card"),
             option<OneOrMany>("fit", "", "Rod, obstacle, robot or \"envelope\", or a list, that fills each view; default: rods, envelope and "
                                          "the robots that carry rods"),
         } + timeout_schema();
}

Schema save_options() {
  return page_options() + Schema{option<int>("frames", "", "States of an assembly or a motion that are shown, the last one among them")
                                     .at_least(1).at_most(100).preset(6)};
}

Schema frames_options() {
  return page_options() + Schema{option<int>("frames", "", "How many, evenly spaced; default: all that the motion kept").at_least(1).at_most(9999)};
}

/// As save_options(), made for a terminal.
Schema show_options() {
  return Schema{
             option<std::array<int, 2>>("size", "pixels", "{width, height}; default: as large as fits above the prompt"),
             option<std::vector<std::string>>("sheet", "", "Views in rows of two: \"iso\", \"front\", \"top\", \"side\", \"card\"; default iso"),
             option<OneOrMany>("fit", "", "Rod, obstacle, robot or \"envelope\", or a list, that fills each view"),
             option<int>("frames", "", "States of an assembly or a motion that are shown").at_least(1).at_most(100).preset(6),
         } + timeout_schema();
}

void read_moves(const StabilityHandle& stability, const SceneEquilibrium* shown, PictureWish& wish) {
  if (stability.result.moves.empty()) throw UsageError("view.new: 'color': the stability knows no moves: " + stability.result.message);
  const SceneEquilibrium& eq = *stability.equilibrium;
  for (std::size_t k = 0; k < eq.rods.size(); ++k) {
    if (!shown || k >= shown->rods.size() || shown->rods[k].name != eq.rods[k].name ||
        shown->rods[k].equilibrium.s.size() != eq.rods[k].equilibrium.s.size())
      throw UsageError("view.new: 'color': the stability is about another equilibrium than the one that is shown; show stability.equilibrium");
    wish.moves.push_back(stability.result.colour(static_cast<int>(k)));
  }
  wish.colour = RodColour::moves;
}

void read_colour(const Options& o, const SceneEquilibrium* shown, PictureWish& wish) {
  const Colour colour = o.get<Colour>("color");
  if (const auto* stability = std::get_if<StabilityHandle>(&colour)) return read_moves(*stability, shown, wish);
  if (const auto* rgb = std::get_if<std::array<double, 3>>(&colour)) {
    for (const double part : *rgb)
      if (part < 0 || part > 1) throw UsageError("view.new: 'color' has " + plain_number(part) + ", expected 0 to 1");
    wish.colour = RodColour::plain;
    wish.plain = {float((*rgb)[0]), float((*rgb)[1]), float((*rgb)[2])};
    return;
  }
  const std::string& name = std::get<std::string>(colour);
  for (std::size_t i = 0; i < colour_names().size(); ++i)
    if (colour_names()[i] == name) {
      wish.colour = static_cast<RodColour>(i);
      return;
    }
  throw UsageError("view.new: 'color': unknown " + unknown_name(name, "colours", colour_names()));
}

/// The entry on top of the stack, when it is a set of routes.
bool read_routes(lua_State* L, View& view) {
  const RoutesHandle* routes = object<RoutesHandle>(L, -1);
  if (!routes) return false;
  if (!view.wish.designs.empty()) throw UsageError("view.new: got several sets of designs, expected one");
  if (routes->result->routes.empty()) throw UsageError("view.new: there are no routes to show: " + routes->result->message);
  view.wish.designs = designs_of(*routes->result);
  return true;
}

/// The same of a set of hoses or one of them.
bool read_hoses(lua_State* L, View& view) {
  const PreformHandle* set = object<PreformHandle>(L, -1);
  const HoseHandle* hose = object<HoseHandle>(L, -1);
  if (!set && !hose) return false;
  if (!view.wish.designs.empty()) throw UsageError("view.new: got hoses twice, expected one set of hoses or one hose");
  const preform::Result& result = *(set ? set->result : hose->set.result);
  if (result.hoses.empty()) throw UsageError("view.new: there are no hoses to show: " + result.message);
  view.wish.designs = designs_of(result, hose ? std::optional<int>(hose->index) : std::nullopt);
  if (hose && result.space->has_obstacles()) view.wish.gap_scale = gap_scale(result);
  return true;
}

void show_equilibrium(View& view, std::shared_ptr<const SceneEquilibrium> equilibrium) {
  if (view.equilibrium) throw UsageError("view.new: got two equilibria, expected at most one");
  view.equilibrium = std::const_pointer_cast<SceneEquilibrium>(std::move(equilibrium));
}

/// The same of an installation or a build board.
bool read_assembly(lua_State* L, View& view) {
  if (const AssemblyHandle* assembly = object<AssemblyHandle>(L, -1)) {
    if (assembly->result->play.empty()) throw UsageError("view.new: the assembly has no states to show: " + assembly->result->message);
    show_equilibrium(view, assembly->result->play.back().equilibrium);
    view.installation = assembly->result;
    return true;
  }
  const FlattenHandle* board = object<FlattenHandle>(L, -1);
  if (!board) return false;
  if (!board->result->equilibrium) throw UsageError("view.new: the board has no layout to show: " + board->result->message);
  show_equilibrium(view, board->result->equilibrium);
  view.wish.extras = extras_of(*board->result);
  view.wish.views = {"top", "card"};
  return true;
}

/// The same of a motion.
bool read_motion(lua_State* L, View& view) {
  if (!object<SceneMotion>(L, -1)) return false;
  view.motion = Value<std::shared_ptr<SceneMotion>>::read(L, -1);
  if (view.motion->equilibria.empty()) throw UsageError("view.new: the motion has no states to show: " + view.motion->message);
  show_equilibrium(view, view.motion->equilibria.back());
  return true;
}

void read_shown(lua_State* L, const Options& o, View& view) {
  const lua_Integer count = o.index() ? luaL_len(L, o.index()) : 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_geti(L, o.index(), i);
    const bool scene = object<Scene>(L, -1) != nullptr;
    if (!read_hoses(L, view) && !read_routes(L, view) && !read_assembly(L, view) && !read_motion(L, view)) {
      if (scene ? view.scene != nullptr : view.equilibrium != nullptr)
        throw UsageError(std::string("view.new: got two ") + (scene ? "scenes" : "equilibria") + ", expected at most one of each");
      if (scene) view.scene = Value<std::shared_ptr<Scene>>::read(L, -1);
      else view.equilibrium = Value<std::shared_ptr<SceneEquilibrium>>::read(L, -1);
    }
    lua_pop(L, 1);
  }
  if (!view.scene && !view.equilibrium && view.wish.designs.empty())
    throw UsageError("view.new: nothing to show; give a scene, its equilibrium, or both");
  if (!view.scene) view.scene = std::make_shared<Scene>();
}

View make_view(lua_State* L, const Options& o) {
  View view;
  read_shown(L, o, view);
  const bool obstacles = view.equilibrium ? !view.equilibrium->obstacles.empty() : !view.scene->bodies().empty();
  view.wish.colour = obstacles ? RodColour::clearance : RodColour::curvature;
  if (o.has("color")) read_colour(o, view.equilibrium.get(), view.wish);
  if (const MeshValue* envelope = o.find<MeshValue>("envelope")) view.wish.envelope = envelope->surface;
  view.wish.ghost = o.maybe<std::vector<std::string>>("ghost");
  view.wish.title = o.maybe<std::string>("title").value_or("");
  compose_check(*view.scene, view.equilibrium.get(), view.wish);
  return view;
}

PictureWish wish_of(const View& view, const Options& o) {
  PictureWish wish = view.wish;
  if (const auto size = o.maybe<std::array<int, 2>>("size")) {
    wish.width = (*size)[0];
    wish.height = (*size)[1];
  }
  if (const auto sheet = o.maybe<std::vector<std::string>>("sheet")) wish.views = *sheet;
  if (const auto fit = o.maybe<OneOrMany>("fit")) {
    if (const std::string* one = std::get_if<std::string>(&*fit)) wish.fit = {*one};
    else wish.fit = std::get<std::vector<std::string>>(*fit);
  }
  return wish;
}

Picture picture_of(const View& view, const Options& o) {
  PictureWish wish = wish_of(view, o);
  if (view.installation) wish.extras = extras_of(*view.installation, o.get<int>("frames"));
  if (!view.motion) return compose_picture(*view.scene, view.equilibrium.get(), wish);
  const std::vector<MotionFrame> frames = key_frames(*view.motion, o.get<int>("frames"));
  return wish.envelope ? compose_sweep(*view.scene, frames, wish) : compose_strip(*view.scene, frames, wish);
}

SavedFile save_view(lua_State* L, const View& view, const std::string& path, const Options& o) {
  const PictureReport report = save_picture(picture_of(view, o), path, run_context(L, o));
  return {path, report.status, report.seconds};
}

ShownPicture show_view(lua_State* L, const View& view, const Options& o) {
  const RunContext context = run_context(L, o);
  return show_picture(L, "view:save(\"picture.png\") writes a file", [&](const PictureTerminal& terminal, Status& status) {
    View fitted = view;
    fitted.wish.views = {view.wish.views.front()};  // a terminal is small: one view, unless asked otherwise
    const PictureTerminal::Size size = terminal.fitting(4.0 / 3);
    fitted.wish.width = size.width;
    fitted.wish.height = size.height;
    PictureReport report;
    std::string png = picture_png(picture_of(fitted, o), context, &report);
    status = report.status;
    return png;
  });
}

ShownPicture show_file(lua_State* L, const SavedFile& file) {
  if (std::filesystem::path(file.path).extension() != ".png")
    throw UsageError("saved_file:show: '" + file.path + "' is no picture that a terminal shows, expected a .png");
  return show_picture(L, ("the picture is in " + file.path).c_str(), [&](const PictureTerminal&, Status&) { return read_file(file.path); });
}

/// Numbered pictures of a motion's states.
std::vector<SavedFile> save_frames(lua_State* L, const View& view, const std::string& folder, const Options& o) {
  if (!view.motion) throw UsageError("view:save_frames: this view shows one state, expected a motion");
  const int count = o.maybe<int>("frames").value_or(static_cast<int>(view.motion->equilibria.size()));
  const RunContext context = run_context(L, o);
  PictureWish wish = wish_of(view, o);
  if (!o.has("sheet")) wish.views = {"iso"};
  const std::vector<Picture> pictures = compose_frames(*view.scene, key_frames(*view.motion, count), wish);
  std::vector<SavedFile> files;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    RunContext own = context;
    if (context.progress)
      own.progress = [&, k](double share, const char* what) { context.progress((double(k) + share) / double(pictures.size()), what); };
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04zu.png", k + 1);
    const std::string path = (std::filesystem::path(folder) / name).string();
    const PictureReport report = save_picture(pictures[k], path, own);
    files.push_back({path, report.status, report.seconds});
    if (report.status != Status::solved) break;
  }
  return files;
}

}  // namespace

void bind_view(lua_State* L) {
  Class<ShownPicture>(L, "A picture that was shown in the terminal, or why not")
      .property("ok", "", "It was shown", [](const ShownPicture& p) { return p.status == Status::solved; })
      .property("status", "", "\"shown\", \"infeasible\" (the terminal shows none), \"cancelled\" or \"timeout\"",
                [](const ShownPicture& p) { return p.status == Status::solved ? "shown" : name_of(p.status); })
      .property("message", "", "\"shown\", or why not and what to do instead", [](const ShownPicture& p) { return p.message; })
      .property("seconds", "s", "Time it took", [](const ShownPicture& p) { return p.seconds; })
      .tostring([](const ShownPicture& p) {
        return p.by.empty() ? "not shown: " + p.message : "shown by " + p.by + " (" + quantity(p.seconds, "s") + ")";
      });
  Class<SavedFile>(L, "A file that was saved")
      .property("path", "", "Where", [](const SavedFile& f) { return f.path; })
      .property("ok", "", "It was written", [](const SavedFile& f) { return f.status == Status::solved; })
      .property("status", "", "\"saved\", \"cancelled\" or \"timeout\"",
                [](const SavedFile& f) { return f.status == Status::solved ? "saved" : name_of(f.status); })
      .property("seconds", "s", "Time it took", [](const SavedFile& f) { return f.seconds; })
      .method("show", {.does = "Shows a saved .png in a terminal that can (kitty, Ghostty, Konsole, iTerm2, WezTerm, sixels).",
                       .example = "local shown = study.chart{series = {{name = \"sag\", x = {1, 2, 3}, y = {1, 4, 9}}}}:save(\"sag.png\"):show()\n"
                                  "assert(shown.ok or shown.message)"},
              show_file)
      .tostring([](const SavedFile& f) {
        const bool saved = f.status == Status::solved;
        return (saved ? "saved " : std::string(name_of(f.status)) + ", not saved: ") + f.path + " (" + quantity(f.seconds, "s") + ")";
      });
  Class<View>(L, "A picture to be")
      .method("save",
              {.takes = {"path"}, .options = save_options(), .does = "Draws it into a .png; a missing folder is created.",
                         .example = with_equilibrium("view.new{s, eq}:save(\"hose.png\", {size = {320, 240}, sheet = {\"iso\"}})")},
              save_view)
      .method("show",
              {.options = show_options(), .does = "Draws it between the lines of a terminal that can (kitty, Ghostty, Konsole, iTerm2, WezTerm, sixels).",
               .example = with_equilibrium("local shown = view.new{s, eq}:show{sheet = {\"iso\"}}\n"
                                           "if not shown.ok then print(shown.message) end")},
              show_view)
      .method("save_frames",
              {.takes = {"folder"}, .options = frames_options(),
               .does = "A motion's states as frame_0001.png, frame_0002.png ... in a folder, for an animation: all through the same camera.",
               .example = with_hose("local m = s:motion{steps = 2, holds = {[\"hose.finish\"] = function(t)\n"
                                    "  return frame{at = {0.9, 0.2 * t, 0}, along = {1, 0, 0}} end}}\n"
                                    "print(#view.new{s, m}:save_frames(\"frames\", {size = {160, 120}}))  --> 3")},
              save_frames)
      .tostring([](const View& v) {
        return Card("view").row("rods", std::to_string(v.equilibrium ? v.equilibrium->rods.size() : 0))
            .row("obstacles", std::to_string(v.equilibrium ? v.equilibrium->obstacles.size() : v.scene->bodies().size()))
            .text();
      });
  Module(L, "view", "Pictures")
      .function("new",
                {.options = view_options(), .does = "A picture of a scene and its equilibrium; draw it with :save(path).",
                         .example = with_equilibrium("print(view.new{s, eq, color = \"curvature\"})")},
                make_view);
}

}  // namespace tendril::lua
