// Error against run time of nominal routing: the step of its grid, the objective, the seconds of all processors, with and without a weight of
// clearance, for five random pairs of connections in the engine bay of over a million triangles. Tree and field are there; the
// state lattice of the step and the roadmap are made anew, as for every call of method.route.
//   route_grid
#include <cstdio>
#include <ctime>
#include <limits>

#include "bench/bay_routes.h"
#include "method/route/nominal_routing.h"

namespace {

using namespace tendril;

struct Row {
  double step_mm, objective, seconds;  ///< seconds: of all threads; objective: m, of the exact costs; not a number where there is no route
};

Row routed(const routing::Ends& ends, double weight, double step_mm) {
  const std::clock_t began = std::clock();
  const double grid = 1e-3 * step_mm;
  routing::SpaceDemands demands = bench::bay_space();
  demands.clearance_weight = weight;
  routing::NominalOptions options;
  options.ends = ends;
  options.curve = bench::bay_curve();
  const double margin = 2 * options.curve.radii.front() + options.curve.end_straight + demands.radius + demands.clearance;
  const routing::FreeSpace space(bench::engine_bay(), demands, {ends.start, ends.finish}, margin);
  const routing::StateLattice lattice(grid, options.curve.radii.front(), 0.5 * grid);
  const routing::NominalRoute route = routing::nominal_routing(space, routing::Roadmap(space, grid), lattice, options);
  Row row{step_mm, std::numeric_limits<double>::quiet_NaN(), double(std::clock() - began) / CLOCKS_PER_SEC};
  if (route.status == routing::NominalRoute::Status::found) row.objective = route.objective;
  return row;
}

}  // namespace

int main() {
  const routing::FreeSpace space(bench::engine_bay(), bench::bay_space(), {}, 0.3);
  std::mt19937_64 random(5);
  std::printf("| ends | weight | grid, mm | objective, mm | above the best of all | seconds |\n|---|---|---|---|---|---|\n");
  for (int pair = 1; pair <= 5; ++pair) {
    const routing::Ends ends = bench::random_ends(space, random);
    for (const double weight : {0.0, 1.0}) {
      std::vector<Row> rows;
      double best = std::numeric_limits<double>::infinity();
      for (const double step_mm : {40.0, 30.0, 20.0, 15.0, 10.0}) {
        rows.push_back(routed(ends, weight, step_mm));
        if (rows.back().objective < best) best = rows.back().objective;
      }
      for (const Row& row : rows)
        std::printf("| %d, %.0f mm apart | %g | %g | %.1f | %.2f %% | %.2f |\n", pair, 1e3 * (ends.finish - ends.start).norm(), weight,
                    row.step_mm, 1e3 * row.objective, 100 * (row.objective / best - 1), row.seconds);
      std::fflush(stdout);
    }
  }
}
