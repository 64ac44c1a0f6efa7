// How many straight objects between random places of the engine bay's light form find a route that they keep under gravity, by the
// number of clips that may be added: a soft hose and a stiff one. Prints a table.
//   clipped_routes [pairs, 20] [seed, 1] [numbers of clips, 0 2 4 8] [why: says what fails]
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench/bay_routes.h"
#include "method/route/route.h"

namespace {

using namespace tendril;

struct Object {
  const char* name;
  Section section;
};

/// Young's modulus in Pa; density in kg/m3, what flows in the hose included.
Object soft() { return {"soft: 20/12 mm, 6 MPa", Section::round(0.020, 0.012, Material::from_poisson(6e6, 0.49, 1150))}; }
Object stiff() {
  return {"stiff: 16/10 mm, 80 MPa, filled", Section::round(0.016, 0.010, Material::from_poisson(80e6, 0.4, 1980))};
}

Scene light_bay() {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets";
  PlacedObstacle bay;
  bay.name = "bay";
  bay.body.shape = std::make_shared<const TriangleSurface>(load_mesh((folder / "engine_bay_light.ply").string(), 1e-3).mesh);
  Scene scene{Vec3(0, 0, -9.81)};
  scene.add(std::move(bay));
  return scene;
}

route::Options options_for(const Section& section, const routing::Ends& ends, int clips) {
  route::Options options;
  options.from = Frame::looking(ends.start, ends.start_along);
  options.to = Frame::looking(ends.finish, ends.finish_along);
  options.section = section;
  options.space.radius = section.radius();
  options.space.clearance = 0.005;
  options.curve = bench::bay_curve();
  options.max_clips = clips;
  return options;
}

struct Tally {
  int routed = 0, kept = 0;
  std::vector<double> seconds, clips;
  double slowest = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 20;
  const unsigned long seed = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
  const bool why = std::strcmp(argv[argc - 1], "why") == 0;
  std::vector<int> numbers;
  for (int k = 3; k < argc - why; ++k) numbers.push_back(std::atoi(argv[k]));
  if (numbers.empty()) numbers = {0, 2, 4, 8};
  const Scene scene = light_bay();
  std::printf("%-34s %6s %7s %7s %14s %12s %12s\n", "object", "clips", "routed", "kept", "clips (median)", "median s", "worst s");
  for (const Object& object : {soft(), stiff()}) {
    routing::SpaceDemands demands;
    demands.radius = object.section.radius();
    demands.clearance = 0.005;
    const routing::FreeSpace space(scene, demands, {}, 0.1);
    for (const int clips : numbers) {
      std::mt19937_64 random(seed);
      Tally tally;
      for (int pair = 0; pair < pairs; ++pair) {
        const route::Result result = route::run(scene, options_for(object.section, bench::random_ends(space, random), clips));
        tally.routed += !result.routes.empty();
        tally.kept += result.ok;
        tally.seconds.push_back(result.seconds);
        tally.slowest = std::max(tally.slowest, result.seconds);
        if (result.ok) tally.clips.push_back(double(result.routes.front().design.clips.size()));
        if (why && !result.ok) std::printf("  pair %d: %s\n", pair, result.message.c_str());
      }
      std::printf("%-34s %6d %7d %7d %14g %12.3f %12.3f\n", object.name, clips, tally.routed, tally.kept, median(tally.clips),
                  median(tally.seconds), tally.slowest);
      std::fflush(stdout);
    }
  }
}
