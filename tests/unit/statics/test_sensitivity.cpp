#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "statics/sensitivity.h"
#include "sensitivity_cases.h"

using namespace tendril;
using namespace tendril::sensitivity_cases;

namespace {

/// The same measure in a changed problem: the finish stays the finish, and a gap stays with the material.
Measure carried_over(Measure m, const RodMesh& before, const RodMesh& after) {
  const bool at_finish = m.at == before.s.back();
  if (at_finish) m.at = after.s.back();
  if (at_finish || m.what != Measure::What::gap) return m;
  int i = 0;
  while (i + 2 < before.vertices() && before.s[i + 1] <= m.at) ++i;
  m.at = after.s[i] + (m.at - before.s[i]) / before.segments[i].length * after.segments[i].length;
  return m;
}

/// Values of all measures after a parameter has grown by `by`, solved anew from a state near by; empty: not solved.
std::vector<double> values_after(const SystemProblem& problem, const Parameter& parameter, double by, const Solved& near,
                                 const std::vector<Measure>& measures) {
  Solved solved(changed(problem, parameter, by), &near.state);
  if (!solved.ok) return {};
  const Sensitivity there(solved.solver.network(), solved.state);
  std::vector<double> values;
  for (const Measure& m : measures)
    values.push_back(there.measure(carried_over(m, near.solver.network().rod(m.rod).mesh(), solved.solver.network().rod(m.rod).mesh())).value);
  return values;
}

/// A derivative by central differences of the fourth order, with two steps: how far they differ tells how good they are. A
/// smallest bend radius may jump from vertex to vertex, an equilibrium may be near a fold.
struct Difference {
  double slope, doubt;
};
std::vector<Difference> numeric(const SystemProblem& problem, const Parameter& parameter, const Solved& near,
                                const std::vector<Measure>& measures) {
  std::vector<double> slopes[2];
  for (int round = 0; round < 2; ++round) {
    const double h = step_of(parameter, problem) / (round == 0 ? 1 : 3);
    const auto at = [&](double by) { return values_after(problem, parameter, by, near, measures); };
    const auto a = at(h), b = at(-h), c = at(2 * h), d = at(-2 * h);
    if (a.empty() || b.empty() || c.empty() || d.empty()) return {};
    for (std::size_t k = 0; k < measures.size(); ++k) slopes[round].push_back((8 * (a[k] - b[k]) - (c[k] - d[k])) / (12 * h));
  }
  std::vector<Difference> all;
  for (std::size_t k = 0; k < measures.size(); ++k) all.push_back({slopes[1][k], std::abs(slopes[0][k] - slopes[1][k])});
  return all;
}

/// The largest change of a measure that any parameter makes in its step: what rounding is to be compared with.
double scale_of(const std::vector<double>& gradient, const std::vector<Parameter>& parameters, const SystemProblem& problem) {
  double largest = 0;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    largest = std::max(largest, std::abs(gradient[k]) * step_of(parameters[k], problem));
  return largest;
}

/// How many derivatives were compared with differences, and how many of those differences were doubtful.
struct Compared {
  int all = 0, doubtful = 0;
};
void compare(const SystemProblem& problem, std::mt19937& random, Compared& count) {
  Solved solved(problem);
  if (!solved.ok) return;
  const Sensitivity sensitivity(solved.solver.network(), solved.state);
  REQUIRE(sensitivity.ok());
  const std::vector<Measure> measures = measures_of(problem, random);
  const std::vector<Parameter> parameters = parameters_of(problem);
  std::vector<std::vector<double>> adjoint;
  for (const Measure& m : measures) adjoint.push_back(sensitivity.gradient(m, parameters));
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const std::vector<double> forward = sensitivity.forward(measures, parameters[p]);
    const std::vector<Difference> differences = numeric(problem, parameters[p], solved, measures);
    for (std::size_t m = 0; m < measures.size(); ++m) {
      INFO(name_of(measures[m]) << " by " << name_of(parameters[p]));
      const double scale = scale_of(adjoint[m], parameters, problem) / step_of(parameters[p], problem);
      // Where nothing changes the measure, its own rounding is what is left.
      const double rounding = 1e-12 * std::abs(sensitivity.measure(measures[m]).value) / step_of(parameters[p], problem);
      CAPTURE(adjoint[m][p], forward[m], sensitivity.measure(measures[m]).value);
      CHECK(std::abs(adjoint[m][p] - forward[m]) <= 1e-10 * scale + rounding);
      if (differences.empty()) continue;
      ++count.all;
      const double allowed = 1e-5 * std::abs(differences[m].slope) + 1e-7 * scale;
      if (differences[m].doubt > allowed) {
        ++count.doubtful;
        continue;
      }
      CHECK(std::abs(adjoint[m][p] - differences[m].slope) <= 2 * allowed);
    }
  }
}

}  // namespace

TEST_CASE("sensitivity: one rod, every measure by every parameter against differences of solved problems", "[sensitivity]") {
  Compared count;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    compare(random_rod(random), random, count);
  }
  CHECK(count.all > 20000);
  CHECK(count.doubtful < 0.01 * count.all);
}

TEST_CASE("sensitivity: rods at a branch point, every measure by every parameter", "[sensitivity]") {
  Compared count;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    compare(random_tee(random), random, count);
  }
  CHECK(count.all > 9000);
  CHECK(count.doubtful < 0.01 * count.all);
}
