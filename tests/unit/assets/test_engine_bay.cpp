// The engine bay as a whole: size, parts, closedness, and the same bits every time.
#include <catch2/catch.hpp>
#include <set>

#include "engine_bay/bay.h"
#include "engine_bay/ply.h"

using namespace tendril;
using namespace tendril::engine_bay;

namespace {

struct Total {
  std::size_t triangles = 0, bodies = 0, sheets = 0;
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
};

// Checks every part on the way.
Total check_parts(const std::vector<Part>& parts) {
  Total total;
  std::set<std::string> names;
  for (const Part& part : parts) {
    INFO(part.name);
    const Figures f = figures(part.mesh);
    CHECK(names.insert(part.name).second);
    CHECK(f.crossed_edges == 0);
    CHECK(f.slivers == 0);
    if (part.closed) {
      CHECK(f.open_edges == 0);
      CHECK(f.volume > 0);
      ++total.bodies;
    } else {
      CHECK(f.open_edges > 0);
      ++total.sheets;
    }
    total.triangles += f.triangles;
    total.low = total.low.cwiseMin(f.low);
    total.high = total.high.cwiseMax(f.high);
  }
  return total;
}

void check_size(const Total& total) {
  const Vec3 size = total.high - total.low;
  CHECK(size.x() == Approx(1400).margin(30));
  CHECK(size.y() == Approx(900).margin(30));
  CHECK(size.z() == Approx(700).margin(30));
  CHECK(total.bodies >= 60);
  CHECK(total.sheets >= 8);
}

}  // namespace

TEST_CASE("the fine engine bay: over a million triangles, closed bodies and open sheets", "[assets]") {
  const Total total = check_parts(engine_bay::engine_bay(fine()));
  check_size(total);
  CHECK(total.triangles > 1'000'000);
  CHECK(total.triangles < 1'500'000);
}

TEST_CASE("the light engine bay has the same parts in few triangles", "[assets]") {
  const std::vector<Part> light_parts = engine_bay::engine_bay(light());
  const Total total = check_parts(light_parts);
  check_size(total);
  CHECK(total.triangles > 10'000);
  CHECK(total.triangles < 30'000);
}

TEST_CASE("the same detail gives the same bits", "[assets]") {
  const std::string once = ply(engine_bay::engine_bay(light())), again = ply(engine_bay::engine_bay(light()));
  CHECK(once == again);
  CHECK(part_list(engine_bay::engine_bay(light())) == part_list(engine_bay::engine_bay(light())));
}

TEST_CASE("the file holds what its header says", "[assets]") {
  const std::vector<Part> parts = engine_bay::engine_bay(light());
  std::size_t points = 0, triangles = 0;
  for (const Part& part : parts) points += part.mesh.points.size(), triangles += part.mesh.triangles.size();
  const std::string file = ply(parts), mark = "end_header\n";
  const std::size_t body = file.find(mark) + mark.size();
  CHECK(file.find("element vertex " + std::to_string(points) + "\n") != std::string::npos);
  CHECK(file.find("element face " + std::to_string(triangles) + "\n") != std::string::npos);
  CHECK(file.size() - body == 12 * points + 13 * triangles);
}

TEST_CASE("every connection is the tip of a stub, free in front", "[assets]") {
  const std::vector<Part> parts = engine_bay::engine_bay(fine());
  for (const Connection& c : connections()) {
    INFO(c.name);
    CHECK(c.along.norm() == Approx(1));
    double rim = 1e9, before = 1e9;  // nearest vertex to the tip's rim, and to a place before it
    const Vec3 ahead = c.tip + 30 * c.along;
    for (const Part& part : parts) {
      for (const Vec3& p : part.mesh.points) {
        const Vec3 d = p - c.tip;
        const double off = (d - c.along * c.along.dot(d)).norm();
        if (std::abs(c.along.dot(d)) < 1e-6) rim = std::min(rim, std::abs(off - c.radius));
        if (part.name != "lower_coolant_hose" && part.name != "overflow_hose") before = std::min(before, (p - ahead).norm());
      }
    }
    CHECK(rim < 1e-6);
    CHECK(before > 1.4 * c.radius);
  }
}
