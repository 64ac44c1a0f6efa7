#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/write_file.h"
#include "golden/picture_scenes.h"
#include "view/picture.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

Picture small_picture() {
  Picture picture;
  PictureTube hose;
  hose.name = "hose";
  hose.radius = 0.01;
  hose.points = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.05, 0}};
  picture.tubes.push_back(hose);
  picture.width = 160, picture.height = 120;
  picture.views = {"front"};
  return picture;
}

std::string complaint(const std::function<void(Picture&)>& spoil) {
  Picture picture = small_picture();
  spoil(picture);
  try {
    check_picture(picture);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no complaint";
}

std::filesystem::path fresh_folder(const char* name) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tendril_test_view_" + std::to_string(getpid()) + "_" + name);
  std::filesystem::remove_all(folder);
  return folder;
}

bool osmesa_is_loaded() {
  std::ifstream maps("/proc/self/maps");
  std::stringstream text;
  text << maps.rdbuf();
  return text.str().find("OSMesa") != std::string::npos;
}

}  // namespace

TEST_CASE("what cannot be drawn is refused with words") {
  CHECK_THAT(complaint([](Picture& p) { p.width = 0; }), Contains("size 0 x 120 pixels, expected 16 ... 16384"));
  CHECK_THAT(complaint([](Picture& p) { p.height = 20000; }), Contains("160 x 20000"));
  CHECK_THAT(complaint([](Picture& p) { p.width = -5; }), Contains("-5"));
  CHECK_THAT(complaint([](Picture& p) { p.width = p.height = 16384; }), Contains("at most 64 million"));
  CHECK_THAT(complaint([](Picture& p) { p.views = {"frnt"}; }), Contains("did you mean 'front'"));
  CHECK_THAT(complaint([](Picture& p) { p.views.clear(); }), Contains("0 views"));
  CHECK_THAT(complaint([](Picture& p) { p.views.assign(7, "iso"); }), Contains("7 views"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes.clear(); }), Contains("nothing to show"));
  CHECK_THAT(complaint([](Picture& p) { p.views = {"card"}; }), Contains("nothing to show"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].radius = 0; }), Contains("tube 'hose'") && Contains("radius"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].radius = NAN; }), Contains("radius"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].radii = {0.1}; }), Contains("1 radii for 3 points"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].radii = {0.1, -1, 0.1}; }), Contains("radius"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].values = {1, 2}; }), Contains("2 values for 3 points"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].points.resize(1); }), Contains("1 points, expected at least 2"));
  CHECK_THAT(complaint([](Picture& p) { p.tubes[0].points[1].y() = INFINITY; }), Contains("NaN or infinite"));
  CHECK_THAT(complaint([](Picture& p) { p.fit = PictureBox{{0, 0, 0}, {1, -1, 1}}; }), Contains("high lies below low"));
  CHECK_THAT(complaint([](Picture& p) { p.fit = PictureBox{{0, NAN, 0}, {1, 1, 1}}; }), Contains("fit box"));
  CHECK_THAT(complaint([](Picture& p) { p.scale.low = 2, p.scale.high = 1; }), Contains("is not below high"));
  CHECK_THAT(complaint([](Picture& p) { p.scale.limit = NAN; }), Contains("NaN"));
  CHECK_THAT(complaint([](Picture& p) {
               p.arrows.push_back({Vec3::Zero(), Vec3::Zero(), false, {}, ""});
             }),
             Contains("direction is zero"));
  CHECK_THAT(complaint([](Picture& p) { p.labels.push_back({Vec3(NAN, 0, 0), {}, "gap"}); }), Contains("label 'gap'"));
  CHECK_THAT(complaint([](Picture& p) { p.holds.push_back({}); }), Contains("radius"));
  CHECK_THAT(complaint([](Picture& p) {
               p.paths.push_back({"plan", {{0, 0, 0}, {0, 0, 1}}, {}, 0});
             }),
             Contains("path 'plan'") && Contains("width"));
  CHECK_THAT(complaint([](Picture& p) {
               p.surfaces.emplace_back().name = "bay";
               p.surfaces[0].share = 0.9;
             }),
             Contains("surface 'bay'") && Contains("share"));
  CHECK_THAT(complaint([](Picture& p) { p.surfaces.emplace_back().pose.rotation.coeffs() *= 2; }),
             Contains("not a rotation"));
  CHECK(complaint([](Picture&) {}) == "no complaint");
}

TEST_CASE("the name of a picture must end in .png, and nothing is written otherwise") {
  const auto folder = fresh_folder("name");
  for (const char* name : {"hose.jpg", "hose", "", "png", ".png"}) {
    INFO(name);
    CHECK_THROWS_WITH(save_picture(small_picture(), (folder / name).string() + (*name ? "" : "x")), Contains(".png"));
  }
  CHECK_FALSE(std::filesystem::exists(folder));
}

TEST_CASE("a picture makes its folder, is the same to the bit twice, and says how it went") {
  const auto folder = fresh_folder("twice");
  Picture picture = scenes::hose_in_bay();
  picture.width = 400, picture.height = 300;
  const PictureReport report = save_picture(picture, (folder / "a" / "b" / "one.png").string());
  save_picture(picture, (folder / "two.PNG").string());
  CHECK(read_file((folder / "a" / "b" / "one.png").string()) == read_file((folder / "two.PNG").string()));
  CHECK(report.status == Status::solved);
  std::size_t triangles = 0;
  for (const PictureSurface& s : picture.surfaces) triangles += s.triangles.size();
  CHECK(report.triangles == triangles);
  CHECK(report.edges > 100);
  CHECK(report.seconds > 0);
  CHECK_FALSE(report.steps.empty());
  std::filesystem::remove_all(folder);
}

TEST_CASE("threads do not change a bit") {
  Picture picture = scenes::hose_in_bay();
  picture.width = 300, picture.height = 220;
  RunContext one, many;
  one.threads = 1, many.threads = 4;
  CHECK(picture_png(picture, one) == picture_png(picture, many));
}

TEST_CASE("a folder that cannot be made is named") {
  CHECK_THROWS_WITH(save_picture(small_picture(), "/proc/nowhere/hose.png"), Contains("/proc/nowhere/hose.png"));
}

TEST_CASE("a cancelled picture writes nothing and says so") {
  const auto folder = fresh_folder("cancel");
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const PictureReport report = save_picture(small_picture(), (folder / "hose.png").string(), context);
  CHECK(report.status == Status::cancelled);
  CHECK_FALSE(std::filesystem::exists(folder));
  context.cancel = nullptr;
  context.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(save_picture(small_picture(), (folder / "hose.png").string(), context).status == Status::timeout);
}

TEST_CASE("odd but fair pictures are drawn") {
  Picture picture = small_picture();
  SECTION("a tube of no extent") { picture.tubes[0].points = {{1, 1, 1}, {1, 1, 1}}; }
  SECTION("a tube that turns back on itself") { picture.tubes[0].points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}; }
  SECTION("values that are all NaN") { picture.tubes[0].values = {NAN, NAN, NAN}; }
  SECTION("infinite values") { picture.tubes[0].values = {INFINITY, -INFINITY, 1}; }
  SECTION("far away") {
    for (Vec3& p : picture.tubes[0].points) p += Vec3(1e7, 1e7, 1e7);
  }
  SECTION("very small") {
    for (Vec3& p : picture.tubes[0].points) p *= 1e-6;
    picture.tubes[0].radius = 1e-8;
  }
  SECTION("very large") {
    for (Vec3& p : picture.tubes[0].points) p *= 1e6;
  }
  SECTION("all views on a narrow page") {
    picture.views = {"iso", "front", "top", "side", "card", "iso"};
    picture.width = 16, picture.height = 200;
    picture.card = {"A title far too long for a page of this size", {{"label", "value"}, {"label", "value", true}}};
  }
  SECTION("hostile text") {
    picture.card = {std::string("\xff\xfe\x80 % \0 \n\t", 10) + std::string(100000, 'x'),
                    {{"\xf0\x9f\x98\x80", "\xc0\x80"}}};
    picture.labels.push_back({{0.1, 0, 0}, {}, std::string(50000, '"')});
    picture.views = {"iso", "card"};
  }
  SECTION("hundreds of labels, holds and arrows") {
    for (int i = 0; i < 300; ++i) {
      picture.labels.push_back({{0.1, 0, 0}, Vec3(0.1, 0, 0.001 * i), "label " + std::to_string(i)});
      picture.arrows.push_back({{0.1, 0, 0}, Vec3(0, 1, i), true, {}, ""});
      picture.holds.push_back({Frame{}, 0.01, PictureHold::Kind::guide, "h"});
    }
  }
  SECTION("surfaces without a triangle and with bad ones") {
    scenes::Mesh mesh;
    mesh.box({0, 0, 0}, {0.1, 0.1, 0.1});
    mesh.triangles.push_back({0, 1, 500});
    mesh.vertices.push_back({NAN, NAN, NAN});
    mesh.triangles.push_back({0, 1, 8});
    picture.surfaces.push_back(scenes::surface("bad", mesh));
    picture.surfaces.push_back(scenes::surface("empty", {}));
  }
  SECTION("no tube at all") {
    scenes::Mesh mesh;
    mesh.sphere({0, 0, 0}, 1);
    picture.surfaces.push_back(scenes::surface("ball", mesh));
    picture.tubes.clear();
  }
  SECTION("a card alone") {
    picture.views = {"card"};
    picture.card.title = "Result";
    for (int i = 0; i < 100; ++i) picture.card.rows.push_back({"row " + std::to_string(i), "1"});
  }
  SECTION("a path of equal points, and one dashed finer than any pixel") {
    picture.paths.push_back({"point", {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
    picture.paths.push_back({"long", {{-1e6, 0, 0}, {1e6, 0, 0}}, {}, 1, true});
  }
  const std::string png = picture_png(picture, {});
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
}

TEST_CASE("bad triangles are reported") {
  Picture picture = small_picture();
  scenes::Mesh mesh;
  mesh.box({0, 0, 0}, {0.1, 0.1, 0.1});
  mesh.triangles.push_back({0, 1, 500});
  picture.surfaces.push_back(scenes::surface("bad", mesh));
  PictureReport report;
  picture_png(picture, {}, &report);
  CHECK(report.left_out == 1);
  CHECK(report.triangles == 12);
}

TEST_CASE("a missing font is named with its package") {
  const auto folder = fresh_folder("fonts");
  std::filesystem::create_directories(folder);
  setenv("TENDRIL_FONTS", folder.c_str(), 1);
  CHECK_THROWS_WITH(picture_png(small_picture(), {}), Contains("DejaVuSans.ttf") && Contains("fonts-dejavu-core"));
  std::ofstream(folder / "DejaVuSans.ttf") << std::string(5000, 'x');
  CHECK_THROWS_WITH(picture_png(small_picture(), {}), Contains("not a TrueType font"));
  unsetenv("TENDRIL_FONTS");
  CHECK_NOTHROW(picture_png(small_picture(), {}));
  std::filesystem::remove_all(folder);
}

// The module loads once a process: these run in a process of their own, started below.
TEST_CASE("missing module", "[.fresh]") {
  REQUIRE_FALSE(osmesa_is_loaded());
  setenv("TENDRIL_MODULES", "/nonexistent", 1);
  CHECK_THROWS_WITH(picture_png(small_picture(), {}),
                    Contains("/nonexistent/tendril_render.so") && Contains("missing") && Contains("TENDRIL_MODULES"));
  const auto folder = fresh_folder("module");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "tendril_render.so") << "not a library";
  setenv("TENDRIL_MODULES", folder.c_str(), 1);
  CHECK_THROWS_WITH(picture_png(small_picture(), {}), Contains("cannot be loaded"));
  std::filesystem::remove_all(folder);
  unsetenv("TENDRIL_MODULES");
  check_picture(small_picture());
  CHECK_FALSE(osmesa_is_loaded());
  CHECK_NOTHROW(picture_png(small_picture(), {}));
  CHECK(osmesa_is_loaded());
}

TEST_CASE("nothing of OpenGL is loaded before the first picture; a missing or broken module is named") {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  CHECK(std::system(("'" + self + "' '[.fresh]' >/dev/null").c_str()) == 0);
}
