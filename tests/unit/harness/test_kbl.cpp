// KBL files: what is read, what is refused, and what comes of it in a scene.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/error.h"
#include "base/write_file.h"
#include "harness/departure.h"
#include "harness/write_kbl.h"

using namespace tendril;

namespace {

constexpr double mm = 1e-3;
const std::string sample = "assets/t_harness.kbl";

std::string with(const std::string& from, const std::string& to) {
  std::string text = read_file(sample);
  const auto at = text.find(from);
  REQUIRE(at != text.npos);
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  try {
    parse_kbl(text, "x.kbl");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

struct Imported {
  Scene scene;
  ImportedHarness harness;
};

Imported imported(const std::string& path, const HarnessImportOptions& options) {
  Imported made{Scene(options.gravity), {}};
  made.harness = import_harness(read_harness(path), options, made.scene);
  return made;
}

std::string shared_file() {
  const char* folder = std::getenv("TENDRIL_SHARED");
  return (folder ? std::string(folder) : "../shared") + "/data/kbl/old_beetle_main.kbl";
}

}  // namespace

TEST_CASE("an import ends when it is told to") {
  const std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  Scene scene;
  CHECK_THROWS_WITH(import_harness(read_harness(sample), {}, scene, context), "scene.import: " + std::string(sample) + ": interrupted after 0 segments");
}

TEST_CASE("a small harness is read as it stands in the file") {
  const HarnessFile file = read_harness(sample);
  CHECK(file.format == "KBL 2.4");
  CHECK(file.name == "T harness");
  REQUIRE(file.nodes.size() == 4);
  REQUIRE(file.segments.size() == 3);
  REQUIRE(file.wires.size() == 4);
  CHECK((file.nodes[2].at - Vec3(0.8, 0.15, 0.3)).norm() < 1e-15);
  CHECK(file.nodes[3].min_bend_radius == Approx(20 * mm));
  CHECK(file.nodes[0].components == std::vector<std::string>{"X1"});
  const HarnessSegment& trunk = file.segments[0];
  CHECK(trunk.virtual_length == Approx(400.595 * mm));
  CHECK(trunk.area == Approx(35e-6));
  CHECK(trunk.wires == std::vector<int>{0, 1, 2, 3});
  CHECK(file.segments[1].wires == std::vector<int>{0, 1});
  REQUIRE(trunk.fixings.size() == 1);
  CHECK(trunk.fixings[0].kind == "CLIP");
  CHECK(trunk.fixings[0].location == 0.5);
  REQUIRE(trunk.fixings[0].place);
  CHECK((trunk.fixings[0].place->d3() - Vec3::UnitX()).norm() < 1e-12);
  REQUIRE(trunk.protections.size() == 1);
  CHECK(trunk.protections[0].kind == "TAPE");
  CHECK(trunk.protections[0].mass == Approx(5e-3));
  CHECK(file.wires[2].outer == Approx(3 * mm));
  CHECK(file.wires[2].conductor_area == Approx(2.5e-6));
  CHECK(file.wires[2].mass == Approx(27e-3));
  CHECK(file.wires[2].min_bend_radius == Approx(9 * mm));
  CHECK(file.wires[2].segments == std::vector<int>{0, 2});
}

TEST_CASE("units are those of the file's own table") {
  const HarnessFile centimetres = parse_kbl(with("<Si_prefix>milli</Si_prefix></Unit>", "<Si_prefix>centi</Si_prefix></Unit>"), "x.kbl");
  CHECK(centimetres.segments[0].virtual_length == Approx(4.00595));
  CHECK(centimetres.segments[0].area == Approx(35e-6));
  CHECK(centimetres.nodes[1].at.x() == Approx(0.4));  // points are in mm always
}

TEST_CASE("what is no harness is refused with the line") {
  CHECK(complaint("") == "scene.import: x.kbl: the file is empty");
  CHECK(complaint("<a").find("this is no well-formed XML") != std::string::npos);
  CHECK(complaint("\n<vec/>").find("x.kbl:2: this is no KBL file: its root is <vec>, expected <kbl:KBL_container>") != std::string::npos);
  CHECK(complaint("<KBL_container/>").find("the file has no geometry: 0 nodes, 0 segments") != std::string::npos);
  const auto refuses = [](const std::string& from, const std::string& to, const std::string& why) {
    const std::string got = complaint(with(from, to));
    INFO(got);
    CHECK(got.find(why) != std::string::npos);
  };
  refuses("<Coordinates>130</Coordinates>", "<Coordinates>inf</Coordinates>", "x.kbl:8: <Coordinates>: got 'inf', expected a finite number");
  refuses("<Coordinates>130</Coordinates>", "", "x.kbl:8: <Cartesian_point>: got 2 <Coordinates>, expected 3");
  refuses("<Coordinates>130</Coordinates>", "<Coordinates>1e12</Coordinates>", "it lies farther than 1000 km from the origin");
  refuses("<Node id=\"lamp\">", "<Node id=\"plug\">", "<Node id=\"plug\">: another Node has this id");
  refuses("<Node id=\"lamp\">", "<Node>", "<Node>: it has no id");
  refuses("<Segment id=\"to_lamp\"", "<Segment id=\"trunk\"", "<Segment id=\"trunk\">: another Segment has this id");
  refuses("<Start_node>plug</Start_node>", "<Start_node>plug_2</Start_node>", "refers to 'plug_2', which is not in the file");
  refuses("<Start_node>plug</Start_node>", "<Start_node>trunk</Start_node>", "refers to 'trunk', which is a Segment, expected a Node");
  refuses("<Start_node>plug</Start_node>", "", "names no Node");
  refuses("<Degree>3</Degree>", "<Degree>2.5</Degree>", "its degree must be a whole number from 1 to 24");
  refuses("<Degree>3</Degree>", "<Degree>4</Degree>", "4 control points are too few for degree 4");
  refuses("<Location>0.5</Location>", "<Location>1.5</Location>", "Location must lie from 0 to 1");
  refuses("<Unit_component>u_mm</Unit_component><Value_component>400.595", "<Unit_component>u_g_m</Unit_component><Value_component>1",
          "<Virtual_length>: its unit 'u_g_m' is not that of a length");
  refuses("<Value_component>400.595", "<Value_component>-4", "got -0.004 (SI), expected 0 to 1e6");
  refuses("<Si_prefix>milli", "<Si_prefix>mega", "unknown Si_prefix 'mega'");
  refuses("<Segments>trunk to_lamp", "<Segments>trunk nowhere", "refers to 'nowhere', which is not in the file");
  refuses("<Connection id=\"k_1\"><Wire>w_1", "<Connection id=\"k_1\"><Wire>w_9", "there is no wire 'w_9'");
  refuses("<Fixing>fixing_1", "<Fixing>fixing_9", "there is no fixing 'fixing_9'");
  refuses("<Node id=\"plug\">", "<Elsewhere><Node id=\"plug\"/></Elsewhere><Node id=\"plug_2\">", "a Node that is not where the file's own are");
  CHECK_THROWS_WITH(read_harness("bay.step"), Catch::Contains("'bay.step': '.step' is no harness file; expected .kbl"));
  CHECK_THROWS_WITH(read_harness("builtin:t_harnes"), Catch::Contains("did you mean 't_harness'?"));
}

TEST_CASE("deep nesting does not overflow anything") {
  std::string text = "<KBL_container>";
  for (int k = 0; k < 200000; ++k) text += "<a>";
  CHECK_FALSE(complaint(text).empty());
  for (int k = 0; k < 200000; ++k) text += "</a>";
  text += "</KBL_container>";
  CHECK(complaint(text).find("the file has no geometry") != std::string::npos);
}

TEST_CASE("an imported harness lies as it is drawn, without stress") {
  const Imported made = imported(sample, {});
  CHECK(made.harness.branches == 1);
  CHECK(made.harness.held_ends == 3);
  CHECK(made.harness.clips == 1);
  CHECK(made.harness.notes.empty());
  const SceneEquilibrium eq = made.scene.solve();
  REQUIRE(eq.ok());
  CHECK(eq.iterations() <= 3);
  CHECK(eq.energy().total() < 1e-12);
  for (int k = 0; k < 3; ++k) CHECK(departure(made.harness, k, eq.rod(made.harness.segments[k].rod).equilibrium).distance < 1e-9);
  const ImportedSegment& trunk = made.harness.segments[0];
  CHECK(trunk.length == Approx(trunk.stated_length).epsilon(1e-5));
  CHECK(trunk.mass == Approx((2 * 6.6 + 2 * 27 + 5) * 1e-3 * trunk.length).epsilon(1e-9));
  CHECK(trunk.EI_slipping < trunk.EI);
  CHECK(trunk.EI < trunk.EI_glued);
  CHECK(trunk.outer > 4.5 * mm);   // two wires of 3 mm and two of 1.6 mm
  CHECK(trunk.outer < 8.5 * mm);
  CHECK(trunk.min_bend_radius >= 9 * mm);
  CHECK(made.harness.segments[2].min_bend_radius >= 20 * mm);  // of its node
}

TEST_CASE("the supports of a harness carry its weight") {
  for (const HarnessClip clips : {HarnessClip::fixed, HarnessClip::slide, HarnessClip::swivel, HarnessClip::none}) {
    HarnessImportOptions options;
    options.gravity = {0, 0, -9.81};
    options.clips = clips;
    const Imported made = imported(sample, options);
    const SceneEquilibrium eq = made.scene.solve();
    INFO("clips " << static_cast<int>(clips) << ": " << eq.message());
    REQUIRE(eq.ok());
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (const SolvedRod& rod : eq.rods) {
      mass += rod.problem.rod.mass();
      for (std::size_t h = 0; h < rod.problem.holds.size(); ++h) sum += rod.equilibrium.reactions[h].force;
    }
    CHECK(sum.z() == Approx(9.81 * mass).epsilon(1e-6));
    CHECK(sum.head<2>().norm() < 1e-6 * sum.z());
    CHECK(made.harness.clips == (clips == HarnessClip::none ? 0 : 1));
  }
}

TEST_CASE("a straight harness is bent by where it is held") {
  HarnessImportOptions options;
  options.shape = HarnessShape::straight;
  const Imported made = imported(sample, options);
  const SceneEquilibrium eq = made.scene.solve();
  REQUIRE(eq.ok());
  CHECK(eq.energy().bend > 1e-4);
}

TEST_CASE("unsound segments are left out and named") {
  const std::string path = (std::filesystem::temp_directory_path() / "tendril_unsound.kbl").string();
  write_file(path, with("<Value_component>400.595", "<Value_component>300"));
  const Imported made = imported(path, {});
  std::filesystem::remove(path);
  CHECK(made.harness.segments[0].rod.empty());
  CHECK(made.harness.segments[0].left_out.find("400.595 mm long, stated are 300 mm") != std::string::npos);
  CHECK(made.scene.rods().size() == 2);
  REQUIRE(made.harness.notes.size() == 1);
  CHECK(made.harness.notes[0].find("left out: its centre line is") == 0);
  CHECK(made.harness.wire_lengths()[0] == Approx(made.harness.segments[1].length));
}

TEST_CASE("a settled harness goes back into its file and comes again") {
  HarnessImportOptions options;
  options.gravity = {0, 0, -9.81};
  const Imported first = imported(sample, options);
  const SceneEquilibrium eq = first.scene.solve();
  REQUIRE(eq.ok());
  const std::string text = settled_kbl(first.harness, eq), original = *first.harness.file.content;

  const HarnessFile file = parse_kbl(text, "settled.kbl");
  for (std::size_t k = 0; k < 3; ++k) {
    const CentreLine line(file, file.segments[k]);
    const Equilibrium& rod = eq.rod(first.harness.segments[k].rod).equilibrium;
    CHECK(line.sound());
    CHECK(line.reading() == KnotReading::clamped);
    CHECK(line.length() == Approx(rod.settled_length()).margin(0.05 * mm));
    for (std::size_t i = 0; i < rod.s.size(); ++i) CHECK((line.at(line.length() * rod.s[i] / rod.s.back()) - rod.points[i]).norm() < 0.2 * mm);
  }
  CHECK((file.nodes[1].at - eq.branch("branch").frame.at).norm() < 1e-8);
  CHECK(file.segments[0].virtual_length == Approx(CentreLine(file, file.segments[0]).length()).margin(1e-8));

  // The rest is what it was: from the units on nothing changes, nor do wires, fixings and comments.
  const auto tail = [](const std::string& t) { return t.substr(t.find("<Unit id=")); };
  CHECK(tail(text) == tail(original));
  CHECK(text.find("<!-- A small harness of three branches") != std::string::npos);
  CHECK(text.find("id=\"c_1\"") == std::string::npos);  // only the old curve used it
  CHECK(text.find("id=\"p_plug\"") != std::string::npos);
  CHECK(file.wires.size() == 4);

  Scene again(options.gravity);
  const ImportedHarness second = import_harness(file, options, again);
  CHECK(again.rods().size() == 3);
  CHECK(settled_kbl(first.harness, eq) == text);
}

TEST_CASE("sliding clips are written where the rod has slipped to") {
  HarnessImportOptions options;
  options.gravity = {0, 0, -9.81};
  options.clips = HarnessClip::slide;
  const Imported made = imported(sample, options);
  const SceneEquilibrium eq = made.scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& trunk = eq.rod("trunk");
  double slid_to = -1;
  for (std::size_t h = 0; h < trunk.problem.holds.size(); ++h)
    if (trunk.problem.holds[h].slide) slid_to = trunk.equilibrium.reactions[h].s / trunk.problem.rod.length;
  REQUIRE(slid_to > 0);
  CHECK(std::abs(slid_to - 0.5) > 1e-6);  // where it is drawn
  CHECK(parse_kbl(settled_kbl(made.harness, eq), "x.kbl").segments[0].fixings[0].location == Approx(slid_to).margin(1e-6));
}

TEST_CASE("a car's main harness: every segment is sound, lengths fit, nothing is lost") {
  const std::string path = shared_file();
  if (!std::filesystem::exists(path)) {
    WARN("skipped: there is no " << path);
    return;
  }
  const Imported made = imported(path, {});
  CHECK(made.harness.file.nodes.size() == 184);
  CHECK(made.scene.rods().size() == 183);
  CHECK(made.harness.file.wires.size() == 216);
  CHECK(made.harness.clips == 16);
  double largest = 0, sum = 0;
  int cut = 0, unclamped = 0;
  for (const ImportedSegment& segment : made.harness.segments) {
    largest = std::max(largest, std::abs(segment.length - segment.stated_length));
    sum += segment.length;
    cut += segment.cut_off > 0;
    unclamped += segment.reading == KnotReading::unclamped;
  }
  CHECK(largest < 0.01 * mm);
  CHECK(sum == Approx(36.6645522).epsilon(1e-7));
  CHECK(cut == 5);
  CHECK(unclamped == 183);
  const SceneEquilibrium eq = made.scene.solve();
  CHECK(eq.ok());
  CHECK(eq.energy().total() < 1e-12);
  CHECK(parse_kbl(settled_kbl(made.harness, eq), path).segments.size() == 183);
}
