#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "base/error.h"
#include "statics/batch.h"
#include "statics/solve.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

/// The unstressed shape of a rod that bends towards d1.
Rod::Shape arc_of(double radius) {
  return [radius](double s) {
    return Frame{{radius * (1 - std::cos(s / radius)), 0, radius * std::sin(s / radius)}, exp_rotation({0, s / radius, 0})};
  };
}

/// Hose of two parts with unequal bending stiffnesses and a bent reference shape, clamped at both ends, held in position
/// on the way and pulled aside.
SystemProblem rich_hose() {
  Section first = Section::round(0.016, 0.01, Material::from_poisson(5e6, 0.5, 1100));
  first.EI2 *= 1.6;
  Section second = first;
  second.EI1 *= 0.6;
  second.GJ *= 0.7;
  RodProblem problem;
  problem.rod.length = 1;
  problem.rod.segments = 20;
  problem.rod.parts = {{0.55, first}, {1, second}};
  problem.rod.shape = arc_of(3);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1, start.moved({0.85, 0.1, 0.1}, {0, 0, 1}, 0.4)}, {0.4, {{0.36, 0, 0}, Quat::Identity()}, true, false}};
  problem.loads = {{0.75, {0, 0.3, 0.1}, Vec3::Zero()}};
  problem.gravity = {0, 0, -9.81};
  return {{problem}, {}};
}

/// Five rods: one from a clamp to a branch point with levers, one that this point sits in the middle of, with a force on its
/// free end, one on to a second branch point whose place is held, one from there to a clamp; and one by itself.
SystemProblem rich_harness() {
  const Section section = Section::round(0.014, 0.008, Material::from_poisson(5e6, 0.5, 1100));
  auto rod = [&](double length, int segments) {
    RodProblem problem;
    problem.rod = Rod::uniform(length, section, segments);
    problem.gravity = {0, 0, -9.81};
    return problem;
  };
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  SystemProblem system;
  system.rods = {rod(0.4, 10), rod(0.3, 7), rod(0.5, 12), rod(0.35, 9), rod(0.6, 10)};
  system.rods[0].holds = {{0, start}};
  system.rods[2].holds = {{0, start.moved({0.35, 0.22, 0}, {0, 0, 1}, -1.4)}};
  system.rods[2].loads = {{0.5, {0.05, 0, -0.05}, Vec3::Zero()}};
  system.rods[3].holds = {{0.35, start.moved({0.98, -0.1, 0.05})}};
  system.rods[4].holds = {{0, start.moved({0, 1, 0})}, {0.6, start.moved({0.5, 1, 0})}};
  const Frame across{{0.01, 0, 0.004}, exp_rotation({1.3, 0, 0})};
  BranchPoint tee, joint;
  tee.frame = start.moved({0.38, 0, -0.03});
  tee.sections = {{0, 0.4, {}}, {1, 0, {{-0.004, 0.003, 0.012}, exp_rotation({0.1, -0.2, 0})}}, {2, 0.2, across}};
  joint.frame = start.moved({0.66, -0.02, -0.02});
  joint.position = true;
  joint.sections = {{1, 0.3, {{0, 0, -0.01}, Quat::Identity()}}, {3, 0, {{0, 0, 0.01}, exp_rotation({0, 0.3, 0})}}};
  system.branches = {tee, joint};
  return system;
}

/// Largest distance (m) and angle (rad) between an outcome and an equilibrium.
struct Difference {
  double place = 0, turn = 0;
};
Difference difference(const BatchResults& results, int outcome, const SystemEquilibrium& exact) {
  Difference largest;
  auto compare = [&](const Frame& a, const Frame& b) {
    largest.place = std::max(largest.place, (a.at - b.at).norm());
    largest.turn = std::max(largest.turn, a.rotation.angularDistance(b.rotation));
  };
  for (int k = 0; k < results.rods(); ++k) {
    REQUIRE(static_cast<int>(exact.rods[k].points.size()) == results.vertices(k));
    for (int v = 0; v < results.vertices(k); ++v)
      compare(results.frame(outcome, k, v), {exact.rods[k].points[v], exact.rods[k].rotations[v]});
  }
  for (int b = 0; b < results.branches(); ++b) compare(results.branch(outcome, b), exact.branches[b]);
  return largest;
}

/// Outcome k: everything that may vary does, by up to `amount` of what is usual in a tolerance study.
void vary(const SystemProblem& nominal, int outcome, double amount, SystemProblem& out) {
  std::mt19937_64 random(1000 + outcome);
  auto number = [&](double most) { return std::uniform_real_distribution<double>(-most * amount, most * amount)(random); };
  auto vector = [&](double most) { return Vec3(number(most), number(most), number(most)); };
  out.branches = nominal.branches;
  for (std::size_t k = 0; k < nominal.rods.size(); ++k) {
    const RodProblem& was = nominal.rods[k];
    RodProblem& rod = out.rods[k];
    const double longer = 1 + number(0.05);
    rod.rod.length = was.rod.length * longer;
    for (std::size_t i = 0; i < was.rod.parts.size(); ++i) {
      rod.rod.parts[i].upto = was.rod.parts[i].upto * longer;
      Section& section = rod.rod.parts[i].section;
      section = was.rod.parts[i].section;
      section.EI1 *= 1 + number(0.2);
      section.EI2 *= 1 + number(0.2);
      section.GJ *= 1 + number(0.2);
      section.EA *= 1 + number(0.2);
      section.GA1 *= 1 + number(0.2);
      section.mass *= 1 + number(0.1);
    }
    if (was.rod.shape) rod.rod.shape = arc_of(3 * (1 + number(0.1)));
    for (std::size_t i = 0; i < was.holds.size(); ++i) {
      rod.holds[i] = was.holds[i];
      rod.holds[i].at *= longer;
      rod.holds[i].frame = {was.holds[i].frame.at + vector(0.01), was.holds[i].frame.rotation * exp_rotation(vector(0.15))};
    }
    for (std::size_t i = 0; i < was.loads.size(); ++i) {
      rod.loads[i].at = was.loads[i].at * longer;
      rod.loads[i].force = was.loads[i].force + vector(0.05);
    }
    rod.gravity = was.gravity + vector(0.3);
  }
  for (std::size_t b = 0; b < nominal.branches.size(); ++b)
    for (std::size_t j = 0; j < nominal.branches[b].sections.size(); ++j) {
      JoinedSection& section = out.branches[b].sections[j];
      section.at *= out.rods[section.rod].rod.length / nominal.rods[section.rod].rod.length;
      section.relative.at += vector(0.002);
      section.relative.rotation = section.relative.rotation * exp_rotation(vector(0.03));
    }
}

Batch::Fill varying(const SystemProblem& nominal, double amount = 1) {
  return [&nominal, amount](int outcome, SystemProblem& problem) { vary(nominal, outcome, amount, problem); };
}

RunContext threads(int count) {
  RunContext context;
  context.threads = count;
  return context;
}

std::vector<const BatchKernel*> kernels() {
  std::vector<const BatchKernel*> all;
  for (const InstructionSet set : {InstructionSet::common, InstructionSet::avx2, InstructionSet::avx512})
    if (const BatchKernel* kernel = batch_kernel(set)) all.push_back(kernel);
  return all;
}

/// Every number that the results of one outcome hold.
std::vector<double> numbers_of(const BatchResults& results, int outcome) {
  std::vector<double> all = {double(results[outcome].status), double(results[outcome].iterations),
                             results[outcome].last_step};
  for (int b = 0; b < results.branches(); ++b) {
    const Frame frame = results.branch(outcome, b);
    all.insert(all.end(), frame.at.begin(), frame.at.end());
    all.insert(all.end(), frame.rotation.coeffs().begin(), frame.rotation.coeffs().end());
  }
  for (int k = 0; k < results.rods(); ++k) {
    const auto frames = results.frames(outcome, k);
    all.insert(all.end(), frames.begin(), frames.end());
    for (int h = 0; h < results.holds(k); ++h) {
      const BatchResults::Support support = results.reaction(outcome, k, h);
      all.insert(all.end(), support.force.begin(), support.force.end());
      all.insert(all.end(), support.moment.begin(), support.moment.end());
    }
  }
  return all;
}

bool same_bits(const BatchResults& a, int i, const BatchResults& b, int j) {
  const std::vector<double> x = numbers_of(a, i), y = numbers_of(b, j);
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

bool all_numbers(const BatchResults& results, int outcome) {
  for (const double x : numbers_of(results, outcome))
    if (!std::isfinite(x)) return false;
  return true;
}

}  // namespace

TEST_CASE("batch: random outcomes equal the scalar solver's", "[batch]") {
  for (const SystemProblem& nominal : {rich_hose(), rich_harness()}) {
    SolveOptions tight;
    tight.tolerance = 1e-11;
    const SystemEquilibrium start = solve(nominal, tight);
    REQUIRE(start.ok());
    constexpr int outcomes = 50;
    const double amount = nominal.rods.size() == 1 ? 1 : 0.5;  // the harness hangs rather tight
    std::vector<SystemEquilibrium> exact;
    SystemProblem problem = nominal;
    for (int k = 0; k < outcomes; ++k) {
      vary(nominal, k, amount, problem);
      exact.push_back(solve(problem, tight, {}, &start));
      REQUIRE(exact.back().ok());
    }
    for (const BatchKernel* kernel : kernels()) {
      CAPTURE(nominal.rods.size(), kernel->name);
      Batch batch(nominal);
      batch.use(*kernel);
      BatchResults results;
      batch.solve(outcomes, varying(nominal, amount), results, threads(1));
      REQUIRE(results.size() == outcomes);
      int scalar = 0;
      for (int k = 0; k < outcomes; ++k) {
        CAPTURE(k);
        REQUIRE(results[k].ok());
        scalar += results[k].scalar;
        if (!results[k].scalar) CHECK(results[k].iterations <= 8);
        CHECK(results.message(k).empty());
        const Difference off = difference(results, k, exact[k]);
        CHECK(off.place < 1e-9);
        CHECK(off.turn < 1e-8);
        for (int r = 0; r < results.rods(); ++r)
          for (int h = 0; h < results.holds(r); ++h) {
            const Reaction& reaction = exact[k].rods[r].reactions[h];
            CHECK((results.reaction(k, r, h).force - reaction.force).norm() < 1e-6);
            CHECK((results.reaction(k, r, h).moment - reaction.moment).norm() < 1e-6);
          }
        for (int b = 0; b < results.branches(); ++b) {
          CHECK((results.branch_support(k, b).force - exact[k].branch_supports[b].force).norm() < 1e-6);
          CHECK((results.branch_support(k, b).moment - exact[k].branch_supports[b].moment).norm() < 1e-6);
        }
      }
      CHECK(scalar <= 2);
    }
  }
}

TEST_CASE("batch: what holds a harness carries its weight and loads", "[batch]") {
  const SystemProblem nominal = rich_harness();
  const Batch batch(nominal);
  BatchResults results;
  batch.solve(20, varying(nominal), results, threads(1));
  SystemProblem problem = nominal;
  for (int k = 0; k < 20; ++k) {
    vary(nominal, k, 1, problem);
    Vec3 sum = Vec3::Zero();
    for (int r = 0; r < results.rods(); ++r) {
      sum += problem.rods[r].rod.mass() * problem.rods[r].gravity;
      for (const PointLoad& load : problem.rods[r].loads) sum += load.force;
      for (int h = 0; h < results.holds(r); ++h) sum += results.reaction(k, r, h).force;
    }
    for (int b = 0; b < results.branches(); ++b) sum += results.branch_support(k, b).force;
    CHECK(sum.norm() < 1e-7);
    CHECK(results.branch_support(k, 0).force == Vec3(0, 0, 0));
    CHECK(results.branch_support(k, 1).moment == Vec3(0, 0, 0));
  }
}

TEST_CASE("batch: the nominal problem as an outcome gives the nominal equilibrium", "[batch]") {
  for (const SystemProblem& nominal : {rich_hose(), rich_harness()}) {
    const SystemEquilibrium exact = solve(nominal);
    const Batch batch(nominal);
    BatchResults results;
    batch.solve(std::vector<SystemProblem>(3, nominal), results, threads(1));
    for (int k = 0; k < 3; ++k) {
      CHECK(results[k].iterations <= 2);
      CHECK(difference(results, k, exact).place < 1e-10);
    }
  }
}

TEST_CASE("batch: the first-order prediction saves iterations and is right to first order", "[batch]") {
  const SystemProblem nominal = rich_harness();
  const SystemEquilibrium start = solve(nominal);
  const BatchLayout layout(nominal);
  Batch::Start frames;
  for (const Equilibrium& rod : start.rods) {
    frames.vertices.emplace_back();
    for (std::size_t i = 0; i < rod.points.size(); ++i) frames.vertices.back().push_back({rod.points[i], rod.rotations[i]});
  }
  frames.branches = start.branches;
  const Batch batch(nominal, frames);
  std::vector<double> errors;
  for (const double amount : {0.2, 0.1, 0.05}) {
    SystemProblem problem = nominal;
    vary(nominal, 3, amount, problem);
    const SystemEquilibrium exact = solve(problem, {}, {}, &start);
    errors.push_back((batch.predicted(problem).branches[0].at - exact.branches[0].at).norm());
  }
  CAPTURE(errors[0], errors[1], errors[2]);
  CHECK(errors[1] < 0.35 * errors[0]);
  CHECK(errors[2] < 0.35 * errors[1]);
}

TEST_CASE("batch: the same bits for any number of threads, any order and any neighbours", "[batch]") {
  const SystemProblem nominal = GENERATE(0, 1) ? rich_harness() : rich_hose();
  constexpr int outcomes = 203;
  const Batch::Fill fill = varying(nominal);
  const Batch batch(nominal);
  BatchResults one;
  batch.solve(outcomes, fill, one, threads(1));
  for (const int count : {2, 3, 5}) {
    BatchResults several;
    batch.solve(outcomes, fill, several, threads(count));
    for (int k = 0; k < outcomes; ++k) CHECK(same_bits(one, k, several, k));
  }
  BatchResults backwards;
  batch.solve(outcomes, [&](int k, SystemProblem& problem) { fill(outcomes - 1 - k, problem); }, backwards, threads(1));
  for (int k = 0; k < outcomes; ++k) CHECK(same_bits(one, k, backwards, outcomes - 1 - k));
  BatchResults alone;
  batch.solve(1, [&](int, SystemProblem& problem) { fill(17, problem); }, alone, threads(1));
  CHECK(same_bits(one, 17, alone, 0));
}

TEST_CASE("batch: told what varies it gives the same bits, told too little the same equilibria", "[batch]") {
  const SystemProblem nominal = rich_harness();
  const auto fill = [&](int outcome, SystemProblem& problem) {
    problem = nominal;
    problem.rods[0].holds[0].frame.at.y() += 0.002 * outcome;
    problem.rods[3].holds[0].frame.rotation = nominal.rods[3].holds[0].frame.rotation * exp_rotation({0.01 * outcome, 0, 0});
  };
  const SystemEquilibrium found = solve(nominal);
  Batch::Start start;
  for (const Equilibrium& rod : found.rods) {
    start.vertices.emplace_back();
    for (std::size_t i = 0; i < rod.points.size(); ++i) start.vertices.back().push_back({rod.points[i], rod.rotations[i]});
  }
  start.branches = found.branches;
  std::vector<SystemProblem> varied(1, nominal);
  fill(1, varied[0]);
  const Batch all(nominal, start), told(nominal, start, {}, varied);
  varied[0].rods[3] = nominal.rods[3];
  const Batch too_little(nominal, start, {}, varied);
  BatchResults a, b, c;
  all.solve(20, fill, a);
  told.solve(20, fill, b);
  too_little.solve(20, fill, c);
  for (int k = 0; k < 20; ++k) {
    CHECK(same_bits(a, k, b, k));
    REQUIRE(c[k].ok());
    for (int rod = 0; rod < a.rods(); ++rod)
      CHECK((a.frame(k, rod, a.vertices(rod) / 2).at - c.frame(k, rod, a.vertices(rod) / 2).at).norm() < 1e-8);
  }
}

TEST_CASE("batch: AVX2 and AVX-512 give the same bits", "[batch]") {
  const BatchKernel *four = batch_kernel(InstructionSet::avx2), *eight = batch_kernel(InstructionSet::avx512);
  if (!four || !eight) {
    WARN("skipped: this processor has no AVX-512");
    return;
  }
  const SystemProblem nominal = GENERATE(0, 1) ? rich_harness() : rich_hose();
  Batch batch(nominal);
  BatchResults narrow, wide;
  batch.use(*four);
  batch.solve(100, varying(nominal), narrow, threads(1));
  batch.use(*eight);
  batch.solve(100, varying(nominal), wide, threads(1));
  for (int k = 0; k < 100; ++k) CHECK(same_bits(narrow, k, wide, k));
}

TEST_CASE("batch: an impossible outcome falls back and leaves its neighbours alone", "[batch]") {
  const SystemProblem nominal = rich_hose();
  constexpr int outcomes = 24;
  const Batch::Fill fill = varying(nominal);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Batch batch(nominal);
  BatchResults good, mixed;
  batch.solve(outcomes, fill, good, threads(1));
  batch.solve(outcomes, [&](int k, SystemProblem& problem) {
    problem = nominal;
    fill(k, problem);
    RodProblem& rod = problem.rods[0];
    if (k == 3) rod.holds[1].frame.at.x() = nan;
    if (k == 5) rod.rod.length = -1;
    if (k == 6) rod.rod.parts[1].section.EI1 = 0;
    if (k == 9) rod.loads[0].at = 7;
    if (k == 10) rod.gravity = {0, 0, 1e9};
    if (k == 12) rod.holds.pop_back();
    if (k == 13) rod.holds[1].frame = rod.holds[0].frame.moved({-0.5, 0, 0}, {0, 0, 1}, 3);  // far from the nominal place
    if (k == 14) {
      rod.holds[2].at = 0.3 * rod.rod.length;  // elsewhere along the rod: another split into segments
      rod.rod.segments = 30;
    }
  }, mixed, threads(1));
  for (int k = 0; k < outcomes; ++k) {
    CAPTURE(k, mixed.message(k));
    CHECK(all_numbers(mixed, k));
    const bool senseless = k == 3 || k == 5 || k == 6 || k == 9 || k == 10;
    const bool other = k == 12 || k == 13 || k == 14;
    if (!senseless && !other) CHECK(same_bits(good, k, mixed, k));
    CHECK(mixed[k].ok() == !senseless);
    CHECK(mixed[k].scalar == (senseless || other));
    CHECK(mixed.message(k).empty() == !senseless);
  }
  CHECK_THAT(mixed.message(3), Contains("hold at 1"));
  CHECK_THAT(mixed.message(5), Contains("'length'"));
  CHECK_THAT(mixed.message(6), Contains("EI"));
  CHECK_THAT(mixed.message(9), Contains("outside the rod"));
  CHECK_THAT(mixed.message(10), Contains("weighs"));
}

TEST_CASE("batch: large deviations are solved by lanes or by the scalar solver, none is lost", "[batch]") {
  const SystemProblem nominal = rich_hose();
  const Batch batch(nominal);
  BatchResults results;
  batch.solve(150, varying(nominal, 3), results, threads(1));
  int scalar = 0;
  for (int k = 0; k < 150; ++k) {
    CAPTURE(k, results.message(k));
    CHECK(results[k].ok());
    scalar += results[k].scalar;
  }
  CAPTURE(scalar);
  CHECK(scalar < 75);
}

TEST_CASE("batch: cancelled, it keeps what is done", "[batch]") {
  const SystemProblem nominal = rich_hose();
  const Batch::Fill fill = varying(nominal);
  const Batch batch(nominal);
  BatchResults whole, part;
  batch.solve(120, fill, whole, threads(1));
  std::atomic<bool> cancel = false;
  RunContext context = threads(1);
  context.cancel = &cancel;
  batch.solve(120, [&](int k, SystemProblem& problem) {
    fill(k, problem);
    if (k == 60) cancel = true;
  }, part, context);
  int done = 0;
  for (int k = 0; k < 120; ++k) {
    if (!part[k].ok()) {
      CHECK(part[k].status == Status::cancelled);
      CHECK_THAT(part.message(k), Contains("interrupted"));
      continue;
    }
    ++done;
    CHECK(same_bits(whole, k, part, k));
  }
  CHECK(done > 40);
  CHECK(done <= 60);

  RunContext late = threads(2);
  late.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  batch.solve(20, fill, part, late);
  for (int k = 0; k < 20; ++k) {
    CHECK(part[k].status == Status::timeout);
    CHECK_THAT(part.message(k), Contains("out of time"));
  }
}

TEST_CASE("batch: what it does not take, and why", "[batch]") {
  const SystemProblem nominal = rich_hose();
  CHECK(Batch::why_not(nominal).empty());
  auto refused = [&](auto change, const char* why) {
    SystemProblem problem = nominal;
    change(problem);
    CHECK_THAT(Batch::why_not(problem), Contains(why));
    CHECK_THROWS_WITH(Batch(problem), Contains(why));
  };
  refused([](SystemProblem& p) { p.rods[0].loads[0].moment.x() = 1; }, "dead moment");
  refused([](SystemProblem& p) { p.rods[0].holds[2].slide = true; }, "slides");
  SystemProblem loop = rich_harness();
  loop.branches[1].sections.push_back({2, 0.5, {}});
  loop.rods[2].loads.clear();
  CHECK_THAT(Batch::why_not(loop), Contains("closed loop"));
  SolveOptions staggered;
  staggered.element = Element::staggered;
  CHECK_THAT(Batch::why_not(nominal, staggered), Contains("SE(3)"));
  SolveOptions nearest;
  nearest.stable_only = false;
  CHECK_THAT(Batch::why_not(nominal, nearest), Contains("stable"));
  SystemProblem broken = nominal;
  broken.rods[0].gravity.x() = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(Batch(broken), UsageError);
  CHECK_THROWS_WITH(Batch(nominal, Batch::Start{{std::vector<Frame>(3)}, {}}), Contains("3 vertices, expected"));
  CHECK_THROWS_WITH(Batch(nominal, Batch::Start{{}, {}}), Contains("0 rods and 0 branch points, expected 1 and 0"));
  CHECK_THROWS_WITH(Batch(nominal, Batch::Start{{std::vector<Frame>(21, nominal.rods[0].holds[1].frame)}, {}}),
                    Contains("not a stable equilibrium"));
  const Batch batch(nominal);
  BatchResults results;
  CHECK_THROWS_WITH(batch.solve(50, [](int k, SystemProblem&) { if (k == 20) throw UsageError("outcome 20"); }, results, threads(2)),
                    "outcome 20");
}
