// method.flatten: a system of rods laid out on a plane build board.
#include "base/write_file.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/flatten_classes.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using assembly::BoardLine;
using assembly::BoardPoint;
using assembly::FlattenResult;

Schema flatten_schema() {
  return Schema{
             option<std::vector<std::string>>("rods", "", "Names; default: all of the scene, which must hang together"),
             option<double>("spacing", "m", "Least distance between axes of rods that do not meet; 0: four times the thickest radius").at_least(0).preset(0),
         } +
         timeout_schema();
}

std::string describe_board(const FlattenHandle& h) {
  const FlattenResult& r = *h.result;
  Card card("build board");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  if (r.lines.empty()) return card.text();
  card.row("width", r.width, "m").row("height", r.height, "m").row("crossings", std::to_string(r.crossings));
  card.row("largest strain", plain_number(100 * r.worst_strain) + " %", "of lying flat");
  std::vector<std::vector<std::string>> rows;
  for (const BoardLine& line : r.lines) rows.push_back({line.rod, quantity(line.length, "m"), quantity(line.design_length, "m")});
  return card.text() + "\n" + table_text({"rod", "length on the board", "designed"}, rows);
}

SavedFile save_board(const FlattenHandle& h, const std::string& path) {
  if (!path.ends_with(".csv")) throw UsageError("board:save: got '" + path + "', expected a file name that ends in .csv; draw it with view.new{board}:save(\"board.png\")");
  if (h.result->lines.empty()) throw UsageError("board:save: there is no layout: " + h.result->message);
  write_file(path, assembly::board_csv(*h.result));
  return {path, Status::solved, 0};
}

const std::string example =
    "local rubber = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
    "local r = rod.new{length = 0.4, section = rod.section{outer = 0.012, material = rubber}}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:rod(\"trunk\", r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.4, 0, 0}, along = {1, 0, 0}}})\n"
    "s:rod(\"left\", r, {from = frame{at = {0.4, 0, 0}, along = {1, 1, 0}}, to = frame{at = {0.7, 0.2, 0}, along = {1, 0, 0}}})\n"
    "s:rod(\"right\", r, {from = frame{at = {0.4, 0, 0}, along = {1, -1, 0}}, to = frame{at = {0.7, -0.2, 0}, along = {1, 0, 0}}})\n"
    "s:branch(\"fork\", {{\"trunk\", \"finish\"}, {\"left\", \"start\"}, {\"right\", \"start\"}})\n"
    "local board = method.flatten(s, {})\n";

}  // namespace

void bind_flatten(lua_State* L) {
  Class<BoardPoint>(L, "A junction or a free end on a build board")
      .property("name", "", "Of the branch point, or \"rod.finish\"", [](const BoardPoint& p) { return p.name; })
      .property("at", "m", "Board axes: z = 0", [](const BoardPoint& p) { return p.at; });
  Class<BoardLine>(L, "A rod on a build board")
      .property("rod", "", "Its name", [](const BoardLine& l) { return l.rod; })
      .property("length", "m", "On the board", [](const BoardLine& l) { return l.length; })
      .property("design_length", "m", "Unstressed", [](const BoardLine& l) { return l.design_length; })
      .property("points", "m", "Board axes", [](const BoardLine& l) { return l.points; });
  Class<FlattenHandle>(L, "A layout on a plane build board; draw it with view.new{board}")
      .property("ok", "", "It lies flat, without crossings, as far apart as asked for", [](const FlattenHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const FlattenHandle& h) { return name_of(h.result->status); })
      .property("message", "", "How it lies; what crosses or is strained", [](const FlattenHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const FlattenHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const FlattenHandle& h) { return h.result->steps; })
      .property("points", "", "Junctions and free ends", [](const FlattenHandle& h) { return h.result->points; })
      .property("lines", "", "Rods", [](const FlattenHandle& h) { return h.result->lines; })
      .property("width", "m", "Of the board", [](const FlattenHandle& h) { return h.result->width; })
      .property("height", "m", "Of the board", [](const FlattenHandle& h) { return h.result->height; })
      .property("crossings", "", "That are left", [](const FlattenHandle& h) { return h.result->crossings; })
      .property("strain", "", "Of lying flat, at most", [](const FlattenHandle& h) { return h.result->worst_strain; })
      .property("equilibrium", "", "On the board; nil: none", [](const FlattenHandle& h) { return std::const_pointer_cast<SceneEquilibrium>(h.result->equilibrium); })
      .method("save", {.takes = {"path"}, .does = "Writes the layout into a .csv, in mm: junctions and ends, then the points of each rod.",
                       .example = example + "board:save(\"board.csv\")"},
              save_board)
      .tostring(describe_board);
}

void add_flatten_to(Module& method) {
  method.function("flatten",
                  {.takes = {"scene"}, .options = flatten_schema(),
                   .does = "Gravity and surroundings off: a system of rods relaxed to its own shape, then laid on a plane build board without crossings.",
                   .example = example + "print(board.ok, board.crossings)  --> true\t0"},
                  [](lua_State* state, const std::shared_ptr<Scene>& scene, const Options& o) {
                    assembly::FlattenOptions options;
                    if (o.has("rods")) options.rods = o.get<std::vector<std::string>>("rods");
                    options.spacing = o.get<double>("spacing");
                    return FlattenHandle{std::make_shared<const FlattenResult>(assembly::flatten(*scene, options, run_context(state, o)))};
                  });
}

}  // namespace tendril::lua
