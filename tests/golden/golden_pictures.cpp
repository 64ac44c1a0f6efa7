// One line of the table below is one golden picture.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

#include "base/write_file.h"
#include "compare_pictures.h"
#include "picture_scenes.h"

using namespace tendril;
using namespace tendril::golden;

namespace {

struct Golden {
  const char* name;
  Picture (*scene)();
  std::vector<std::string> views;
  int width = 480, height = 360;
};

const Golden table[] = {
    {"bay_iso", scenes::hose_in_bay, {"iso"}},
    {"bay_sheet", scenes::hose_in_bay, {"iso", "front", "top", "card"}, 640, 480},
    {"bay_side", scenes::hose_in_bay, {"side"}},
    {"solid_front", scenes::hose_behind_solid, {"front"}},
    {"solid_iso", scenes::hose_behind_solid, {"iso"}},
    {"envelope", scenes::envelope_of_hose, {"iso", "top"}, 640, 240},
    {"envelope_clearance", scenes::envelope_by_clearance, {"iso", "front"}, 640, 240},
    {"straight_sheet", scenes::straight_hose, {"iso", "front", "side", "card"}},
};

std::string drawn(const Golden& golden) {
  Picture picture = golden.scene();
  picture.views = golden.views;
  picture.width = golden.width, picture.height = golden.height;
  return picture_png(picture, {});
}

}  // namespace

TEST_CASE("pictures look as they did") {
  for (const Golden& golden : table) DYNAMIC_SECTION(golden.name) {
      const std::filesystem::path kept = std::filesystem::path(GOLDEN_FOLDER) / (std::string(golden.name) + ".png");
      const std::string bytes = drawn(golden);
      if (std::getenv("TENDRIL_GOLDEN_UPDATE")) write_file(kept.string(), bytes);
      const Difference difference = difference_of(read_png(read_file(kept.string())), read_png(bytes));
      if (!difference.fits()) {
        const std::filesystem::path folder = DIFFERENCE_FOLDER;
        write_file((folder / (std::string(golden.name) + ".drawn.png")).string(), bytes);
        write_file((folder / (std::string(golden.name) + ".difference.png")).string(), write_png(difference.picture));
      }
      INFO("mean difference " << difference.mean << ", share of pixels off " << difference.share << "; see "
                              << DIFFERENCE_FOLDER);
      CHECK(difference.fits());
    }
}

TEST_CASE("the comparison sees what an eye would see, and no less") {
  const Pixels good = read_png(drawn(table[0]));
  CHECK(difference_of(good, good).mean == 0);
  CHECK(difference_of(good, good).fits());
  CHECK(difference_of(good, read_png(write_png(good))).mean == 0);
  Pixels moved = good;  // by one pixel to the right
  for (int y = 0; y < good.height; ++y)
    for (int x = 1; x < good.width; ++x)
      for (int k = 0; k < 3; ++k)
        moved.rgb[3 * (static_cast<std::size_t>(y) * good.width + x) + k] =
            good.rgb[3 * (static_cast<std::size_t>(y) * good.width + x - 1) + k];
  CHECK_FALSE(difference_of(good, moved).fits());
  Pixels spot = good;  // a patch of 30 x 30 pixels
  for (int y = 100; y < 130; ++y)
    for (int x = 100; x < 130; ++x) spot.rgb[3 * (static_cast<std::size_t>(y) * good.width + x)] ^= 0x80;
  CHECK_FALSE(difference_of(good, spot).fits());
  Pixels tinted = good;
  for (std::uint8_t& c : tinted.rgb) c = static_cast<std::uint8_t>(c > 2 ? c - 2 : c);
  CHECK_FALSE(difference_of(good, tinted).fits());
  Pixels small = good;
  --small.height;
  CHECK_FALSE(difference_of(good, small).fits());
  CHECK_THROWS_AS(read_png("nonsense"), UsageError);
}

TEST_CASE("a tube keeps its true width on the page") {
  // Radius 20 mm over 1040 mm that fill 10/12 of 600 pixels: 2 r = 19.2 pixels, with an outline of about 1 pixel on
  // both sides.
  Picture picture = scenes::straight_hose();
  picture.labels.clear();
  picture.card = {};
  picture.tubes[0].values.clear();
  picture.views = {"side"};
  picture.width = 600, picture.height = 300;
  const Pixels page = read_png(picture_png(picture, {}));
  int blue = 0, dark = 0;
  for (int y = 0; y < page.height; ++y) {
    const std::uint8_t* p = &page.rgb[3 * (static_cast<std::size_t>(y) * page.width + 300)];
    blue += p[2] > p[0] + 40;
    dark += p[0] < 170 && std::abs(p[0] - p[2]) <= 40;
  }
  CHECK(blue >= 17);
  CHECK(blue <= 20);
  CHECK(dark >= 1);
  CHECK(dark <= 5);
}

TEST_CASE("large pictures are drawn in tiles without a seam") {
  // Everything runs straight along x, past the border between two tiles: all columns must be alike.
  Picture picture;
  PictureTube hose;
  hose.radius = 0.02;
  hose.points = {{0, 0, 0.02}, {1, 0, 0.02}};
  picture.tubes.push_back(hose);
  scenes::Mesh bed, roof;
  bed.box({-1, -0.2, -0.03}, {2, 0.2, 0});
  roof.box({-1, -0.2, 0.03}, {2, -0.1, 0.05});
  picture.surfaces = {scenes::surface("bed", bed), scenes::surface("roof", roof)};
  picture.views = {"top"};
  picture.width = 2400, picture.height = 300;
  const Pixels page = read_png(picture_png(picture, {}));
  const auto at = [&](int x, int y) { return &page.rgb[3 * (static_cast<std::size_t>(y) * page.width + x)]; };
  int worst = 0, colours = 0;
  for (int y = 0; y < page.height - 60; ++y) {
    colours += y > 0 && std::abs(int(at(1200, y)[0]) - int(at(1200, y - 1)[0])) > 20;
    for (int x = 1560; x < 1640; ++x)
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(int(at(x, y)[k]) - int(at(1200, y)[k])));
  }
  CHECK(colours >= 4);  // there is something to see
  CHECK(worst <= 6);    // the grain of ambient occlusion
}
