#include <catch2/catch.hpp>

#include "base/error.h"
#include "geometry/surroundings.h"
#include "method/envelope/arc_points.h"
#include "method/envelope/envelope.h"
#include "unit/method/envelope_cases.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Contains;

namespace {

EnvelopeOptions voxel(double h) {
  EnvelopeOptions options;
  options.voxel = h;
  return options;
}

Envelope built(const Places& places, double h) { return EnvelopeBuilder().build(collected(places), voxel(h)); }

RunContext threads(int count) {
  RunContext context;
  context.threads = count;
  return context;
}

double capsule_volume(double radius, double length) { return units::pi * radius * radius * (length + 4.0 / 3 * radius); }

/// How many times the outermost vertices must be doubled: genus from Euler's formula, for one closed part.
int euler(const Mesh& mesh) {
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangles.size()) / 2;
}

}  // namespace

TEST_CASE("an envelope is closed, manifold, outward and contains every outcome", "[envelope]") {
  const unsigned seeds[] = {1, 2, 3, 4, 5, 6};
  for (const unsigned seed : seeds) {
    const int rods = 1 + seed % 3;
    const double radius = 0.006 + 0.002 * (seed % 4), h = radius / (1 + seed % 4);
    const Places places = random_places(seed, rods, 12, 60 * seed, radius, 0.01 * seed);
    const Envelope envelope = built(places, h);
    CAPTURE(seed, rods, radius, h, envelope.mesh.triangles.size());
    REQUIRE(envelope.status == Status::solved);
    CHECK(closed_and_manifold(envelope.mesh));
    CHECK(envelope.volume > 0);
    CHECK(envelope.volume == Approx(envelope.mesh.volume()).epsilon(1e-9));
    CHECK(envelope.outcomes == places.outcomes());
    CHECK(points_outside(envelope, places, 40000, seed) == 0);
  }
}

TEST_CASE("the envelope of one straight rod is its capsule", "[envelope]") {
  Places places;
  places.rods = {{std::vector<double>(5, 0.015), 1}};
  const Vec3 from(1, 2, 3), along = Vec3(0.3, -0.2, 0.25);
  std::vector<Vec3> vertices;
  for (int i = 0; i <= 5; ++i) vertices.push_back(from + i / 5.0 * along);
  places.add(vertices);
  double before = INFINITY;
  for (const double h : {7.5e-3, 4e-3, 2e-3, 1e-3, 0.5e-3}) {
    const Envelope envelope = built(places, h);
    CAPTURE(h, envelope.margin);
    CHECK(closed_and_manifold(envelope.mesh));
    CHECK(euler(envelope.mesh) == 2);
    const double exact = capsule_volume(0.015, along.norm()), grown = capsule_volume(0.015 + envelope.margin, along.norm());
    const double error = envelope.volume / exact - 1;
    CHECK(error > 0);
    CHECK(envelope.volume < 1.002 * grown);  // triangles between vertices that lie at most the margin outside
    CHECK(error < 0.4 * before);
    before = error;
    CHECK(points_outside(envelope, places, 20000, 3) == 0);
  }
  CHECK(before < 4e-3);
}

TEST_CASE("a straight rod moved sideways sweeps a stadium", "[envelope]") {
  constexpr double radius = 0.01, length = 0.2, way = 0.15;
  Places places;
  places.rods = {{{radius}, 1}};
  for (int k = 0; k <= 30; ++k) {
    const Vec3 by(0, way * k / 30, 0);
    places.add({by, by + Vec3(length, 0, 0)});
  }
  // A rectangle, rounded: a plate, half cylinders along its four sides, a ball at its corners.
  const double exact = length * way * 2 * radius + units::pi * radius * radius * (length + way) + 4 * units::pi / 3 * std::pow(radius, 3);
  double before = INFINITY;
  for (const double h : {5e-3, 2e-3, 1e-3, 0.5e-3}) {
    const Envelope envelope = built(places, h);
    CAPTURE(h);
    CHECK(closed_and_manifold(envelope.mesh));
    CHECK(points_outside(envelope, places, 20000, 4) == 0);
    const double error = envelope.volume / exact - 1;
    CHECK(error > 0);
    CHECK(error < before);
    before = error;
  }
  CHECK(before < 0.01);  // the planes that cut the edges leave part of it
}

TEST_CASE("a rigid motion moves the envelope", "[envelope]") {
  const Places places = random_places(11, 2, 10, 200, 0.01, 0.03);
  const Quat turn = exp_rotation({0.4, -1.1, 0.7});
  const Vec3 by(3, -20, 100);
  Places moved = places;
  for (auto& rod : moved.numbers)
    for (std::size_t i = 0; i < rod.size(); i += 3) {
      const Vec3 p = turn * Vec3(rod[i], rod[i + 1], rod[i + 2]) + by;
      for (int k = 0; k < 3; ++k) rod[i + k] = p[k];
    }
  const Envelope first = built(places, 2e-3), second = built(moved, 2e-3);
  CHECK(second.volume == Approx(first.volume).epsilon(0.004));  // the directions do not turn with it
  CHECK(euler(first.mesh) == euler(second.mesh));
  CHECK(points_outside(second, moved, 20000, 5) == 0);
  // Moved by whole voxels, without a turn: the same but for the rounding of the origin.
  Places shifted = places;
  for (auto& rod : shifted.numbers)
    for (double& n : rod) n += 8.0;
  const Envelope third = built(shifted, 2e-3);
  CHECK(third.volume == Approx(first.volume).epsilon(1e-5));
}

TEST_CASE("an envelope has the same bits for any number of threads and any kernel", "[envelope]") {
  const Places places = random_places(21, 3, 15, 300, 0.008, 0.03);
  const EnvelopeOutcomes outcomes = collected(places);
  EnvelopeBuilder builder;
  const Envelope one = builder.build(outcomes, voxel(3e-3), threads(1));
  const auto same = [&](const Envelope& other) {
    return other.mesh.triangles == one.mesh.triangles && other.mesh.vertices == one.mesh.vertices && other.volume == one.volume;
  };
  for (const int count : {2, 3, 7}) {
    EnvelopeOutcomes others(places.rods);
    others.add_points(places.outcomes(), places, threads(count));
    CHECK(same(builder.build(others, voxel(3e-3), threads(count))));
  }
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    const envelope::Kernel* kernel = envelope::kernel_for(set);
    if (!kernel) continue;
    CAPTURE(kernel->name);
    EnvelopeBuilder other;
    other.use(*kernel);
    CHECK(same(other.build(outcomes, voxel(3e-3), threads(2))));
  }
  // Memory that was used for something larger and something smaller before.
  builder.build(collected(random_places(3, 4, 20, 100, 0.01, 0.05)), voxel(5e-3));
  Envelope again = builder.build(collected(random_places(3, 1, 3, 5, 0.01, 0.05)), voxel(5e-3));
  builder.build(outcomes, voxel(3e-3), threads(2), again);
  CHECK(same(again));
}

TEST_CASE("outcomes may come one by one", "[envelope]") {
  const Places places = random_places(31, 2, 8, 300, 0.008, 0.03);
  EnvelopeOutcomes single(places.rods);
  for (int k = 0; k < places.outcomes(); ++k)
    CHECK(single.add_points(1, [&](int, int rod) { return places(k, rod); }) == Status::solved);
  const Envelope one = EnvelopeBuilder().build(single, voxel(3e-3)), all = built(places, 3e-3);
  CHECK(one.outcomes == 300);
  CHECK(one.mesh.vertices == all.mesh.vertices);
  CHECK(one.mesh.triangles == all.mesh.triangles);
}

TEST_CASE("memory is bounded: places are reduced to their hulls", "[envelope]") {
  const Places places = random_places(41, 2, 6, 5000, 0.01, 0.03);
  EnvelopeOutcomes few(places.rods, EnvelopeOutcomes::Keep::hull, 256);
  few.add_points(places.outcomes(), places);
  CHECK(few.size() == 5000);
  CHECK(few.bytes() < 14 * 3 * 4 * 600);  // of 14 nodes
  EnvelopeOutcomes many(places.rods, EnvelopeOutcomes::Keep::hull, 8192);
  many.add_points(places.outcomes(), places);
  const Envelope reduced = EnvelopeBuilder().build(few, voxel(3e-3)), all = EnvelopeBuilder().build(many, voxel(3e-3));
  CHECK(points_outside(reduced, places, 200000, 6) == 0);
  CHECK(reduced.margin == Approx(all.margin + 1e-5).epsilon(1e-6));
  CHECK(reduced.volume > 0.999 * all.volume);
  CHECK(reduced.volume < 1.004 * all.volume);
}

TEST_CASE("a share of the outcomes", "[envelope]") {
  const Places places = random_places(51, 2, 10, 400, 0.008, 0.02);
  const EnvelopeOutcomes outcomes = collected(places, EnvelopeOutcomes::Keep::all);
  double before = 0;
  for (const double share : {0.01, 0.5, 0.9, 0.95, 1.0}) {
    EnvelopeOptions options = voxel(2e-3);
    options.share = share;
    const Envelope envelope = EnvelopeBuilder().build(outcomes, options);
    CAPTURE(share);
    CHECK(envelope.outcomes == std::lround(share * 400));
    CHECK(static_cast<int>(envelope.left_out.size()) == 400 - envelope.outcomes);
    CHECK(closed_and_manifold(envelope.mesh));
    const auto left_out = [&](int k) { return std::binary_search(envelope.left_out.begin(), envelope.left_out.end(), k); };
    CHECK(points_outside(envelope, places, 100000, 7, [&](int k) { return !left_out(k); }) == 0);
    // Each outcome that is left out reaches beyond the envelope of the others somewhere, or might as well have been in.
    if (share > 0.4 && share < 1) CHECK(points_outside(envelope, places, 100000, 8, left_out) > 0);
    CHECK(envelope.volume > before);
    before = envelope.volume;
  }
  CHECK(before == built(places, 2e-3).volume);
}

TEST_CASE("cavities are filled, with what floats inside", "[envelope]") {
  // Hoops about a globe leave a void; a short rod floats in it.
  constexpr double globe = 0.1, radius = 0.02;
  constexpr int segments = 24, hoops = 12;
  Places places;
  std::vector<std::vector<Vec3>> rods;
  for (int j = 0; j < hoops; ++j) {
    std::vector<Vec3> hoop;
    const double longitude = units::pi * j / hoops;
    for (int i = 0; i <= segments; ++i) {
      const double latitude = 2 * units::pi * i / segments;
      hoop.push_back(globe * Vec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)));
    }
    rods.push_back(hoop);
    places.rods.push_back({std::vector<double>(segments, radius), 1});
  }
  for (const bool island : {false, true}) {
    if (island) {
      rods.push_back({{-0.02, 0, 0}, {0.02, 0, 0}});
      places.rods.push_back({{radius}, 1});
    }
    places.numbers.clear();
    for (const auto& rod : rods) places.add(rod);
    const Envelope envelope = built(places, 5e-3);
    CAPTURE(island);
    CHECK(envelope.cavities == 1);
    CHECK(closed_and_manifold(envelope.mesh));
    CHECK(euler(envelope.mesh) == 2);  // one sphere
    const double ball = 4 * units::pi / 3 * std::pow(globe + radius, 3);
    CHECK(envelope.volume > 0.95 * ball);
    CHECK(envelope.volume < 1.1 * ball);
  }
  // One hoop is a torus: its hole is no cavity.
  places.rods.resize(1);
  places.numbers.resize(1);
  const Envelope torus = built(places, 5e-3);
  CHECK(torus.cavities == 0);
  CHECK(euler(torus.mesh) == 0);
}

TEST_CASE("rods apart are parts of one mesh", "[envelope]") {
  Places places;
  places.rods.assign(3, {{0.01}, 1});
  for (int r = 0; r < 3; ++r) places.add({{0, 0.1 * r, 0}, {0.1, 0.1 * r, 0.02}});
  const Envelope envelope = built(places, 2e-3);
  CHECK(euler(envelope.mesh) == 6);
  CHECK(envelope.volume == Approx(3 * capsule_volume(0.01, std::hypot(0.1, 0.02))).epsilon(0.03));
}

TEST_CASE("an envelope is an obstacle like any mesh", "[envelope]") {
  Places places;
  places.rods = {{{0.01}, 1}};
  places.add({{0, 0, 0}, {0.1, 0, 0}});
  Surroundings surroundings;
  Obstacle obstacle;
  obstacle.shape = std::make_shared<const TriangleSurface>(built(places, 1e-3).mesh);
  surroundings.add(obstacle);
  CHECK(surroundings.closest({0.05, 0, 0.05}, 1).distance == Approx(0.04).epsilon(0.01));
}

TEST_CASE("segments of different radii", "[envelope]") {
  Places places;
  places.rods = {{{0.01, 0.02, 0.012}, 1}};
  std::mt19937 random(61);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 100; ++k) {
    std::vector<Vec3> vertices;
    for (int v = 0; v < 4; ++v) vertices.push_back(Vec3(0.06 * v, 0, 0) + 0.02 * Vec3(normal(random), normal(random), normal(random)));
    places.add(vertices);
  }
  const Envelope envelope = built(places, 4e-3);
  CHECK(closed_and_manifold(envelope.mesh));
  CHECK(points_outside(envelope, places, 100000, 9) == 0);
}

TEST_CASE("the curved centre line between vertices is contained", "[envelope]") {
  // A quarter circle of radius R in one segment, whose frames turn about y: d3 is the tangent.
  constexpr double R = 0.2, radius = 0.01;
  const auto frame = [&](double angle) {
    return std::vector<double>{R * std::sin(angle), 0, R * (std::cos(angle) - 1),
                               std::cos(0.5 * (angle + 0.5 * units::pi)), 0, std::sin(0.5 * (angle + 0.5 * units::pi)), 0};
  };
  std::vector<double> frames;
  for (const double angle : {0.0, 0.25 * units::pi, 0.5 * units::pi}) {
    const auto one = frame(angle);
    frames.insert(frames.end(), one.begin(), one.end());
  }
  double before = INFINITY;
  for (const int pieces : {1, 2, 4, 8}) {
    EnvelopeOutcomes outcomes({{{radius, radius}, pieces}});
    outcomes.add_frames(1, [&](int, int) { return std::span<const double>(frames); });
    const Envelope envelope = EnvelopeBuilder().build(outcomes, voxel(2e-3));
    CAPTURE(pieces);
    const double chord = 0.25 * units::pi / pieces;
    CHECK(envelope.sagitta >= R * (1 - std::cos(0.5 * chord)));  // the arc's own
    CHECK(envelope.sagitta == Approx(R * (1 - std::cos(0.5 * chord))).epsilon(0.04));
    const InsideTest test(envelope.mesh);
    int outside = 0;
    for (int i = 0; i <= 500; ++i)
      for (int j = 0; j < 40; ++j) {
        const double angle = 0.5 * units::pi * i / 500, around = 2 * units::pi * j / 40;
        const Vec3 out(std::sin(angle), 0, std::cos(angle));
        outside += !test.inside(R * out - Vec3(0, 0, R) + radius * (std::cos(around) * out + std::sin(around) * Vec3::UnitY()));
      }
    CHECK(outside == 0);
    CHECK(envelope.volume < before);
    before = envelope.volume;
    CHECK(arc_pieces(frames, 1.001 * envelope.sagitta) == pieces);
  }
  CHECK(before == Approx(capsule_volume(radius, 0.5 * units::pi * R)).epsilon(0.1));
}

TEST_CASE("outcomes of a batch", "[envelope]") {
  RodProblem hose;
  hose.rod = Rod::uniform(1.0, Section::round(0.02, 0, Material::from_poisson(5e6, 0.5, 1100)), 10);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  hose.holds = {{0, start}, {1.0, start.moved({0.7, 0, 0})}};
  hose.gravity = {0, 0, -9.81};
  const SystemProblem nominal{{hose}, {}};
  const Batch batch(nominal);
  const auto fill = [&](int outcome, SystemProblem& problem) {
    std::mt19937 random(outcome);
    std::uniform_real_distribution<double> within(-0.02, 0.02);
    problem.rods[0].holds[1].frame.at = nominal.rods[0].holds[1].frame.at + Vec3(within(random), within(random), within(random));
  };
  BatchResults results;
  batch.solve(120, fill, results);
  const int pieces = arc_pieces(results.frames(0, 0), 1e-4);
  CHECK(pieces > 2);
  EnvelopeOutcomes outcomes({{std::vector<double>(10, 0.01), pieces}});
  int added = 0;
  CHECK(outcomes.add(results, &added) == Status::solved);
  CHECK(added == 120);
  const Envelope envelope = EnvelopeBuilder().build(outcomes, voxel(2e-3));
  CHECK(closed_and_manifold(envelope.mesh));
  CHECK(envelope.sagitta < 2e-4);
  // Points about the curved centre line, of all outcomes.
  const InsideTest test(envelope.mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  int outside = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto frames = results.frames(static_cast<int>(random() % 120), 0);
    const std::size_t v = random() % 10;
    const envelope::ElementArc arc(&frames[7 * v], &frames[7 * v + 7]);
    const double s = share(random), step = 1e-4;
    const Vec3 along = arc.at(std::min(1.0, s + step)) - arc.at(std::max(0.0, s - step));
    const Frame section = Frame::looking(arc.at(s), along);
    const double around = 2 * units::pi * share(random);
    outside += !test.inside(section.at + 0.01 * (std::cos(around) * section.d1() + std::sin(around) * section.d2()));
  }
  CHECK(outside == 0);
  // What is not solved is not added, and another number of rods is a mistake.
  std::atomic<bool> cancel = true;
  RunContext stopped;
  stopped.cancel = &cancel;
  BatchResults none;
  batch.solve(8, fill, none, stopped);
  CHECK(outcomes.add(none, &added) == Status::solved);
  CHECK(added == 0);
  EnvelopeOutcomes two({{{0.01}, 1}, {{0.01}, 1}});
  CHECK_THROWS_WITH(two.add(results), "envelope: outcomes of 1 rods, expected 2");
}

TEST_CASE("an envelope can be stopped", "[envelope]") {
  const EnvelopeOutcomes outcomes = collected(random_places(71, 2, 10, 100, 0.01, 0.03));
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const Envelope cancelled = EnvelopeBuilder().build(outcomes, voxel(2e-3), context);
  CHECK(cancelled.status == Status::cancelled);
  CHECK(cancelled.mesh.triangles.empty());
  RunContext late;
  late.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(EnvelopeBuilder().build(outcomes, voxel(2e-3), late).status == Status::timeout);
  EnvelopeOutcomes none({{{0.01}, 1}});
  CHECK(none.add_points(3, [](int, int) { return std::span<const double>(); }, late) == Status::timeout);
  CHECK(none.size() == 0);
}

TEST_CASE("what an envelope refuses", "[envelope]") {
  CHECK_THROWS_WITH(EnvelopeOutcomes({}), "envelope: no rods; at least one expected");
  CHECK_THROWS_WITH(EnvelopeOutcomes({{{}, 1}}), "envelope: rod 1 has no segments; one radius for each is expected");
  CHECK_THROWS_WITH(EnvelopeOutcomes({{{0.01, -1}, 1}}),
                    "envelope: rod 1: the radius of segment 2 is -1; a finite number of metres above 0 is expected");
  CHECK_THROWS_WITH(EnvelopeOutcomes({{{0.01}, 65}}), "envelope: rod 1 has 65 pieces a segment, expected 1 to 64");
  CHECK_THROWS_WITH(EnvelopeOutcomes({{{0.01}, 1}}, EnvelopeOutcomes::Keep::hull, 2),
                    "envelope: room for 2 places a node, expected at least 64");

  EnvelopeOutcomes outcomes({{{0.01}, 1}});
  EnvelopeBuilder builder;
  CHECK_THROWS_WITH(builder.build(outcomes), "envelope: no outcomes; at least one expected");
  CHECK_THROWS_WITH(outcomes.add_points(-1, {}), "envelope: -1 outcomes to add, expected 0 or more");
  std::vector<double> points{0, 0, 0, 0.1, 0, NAN};
  const auto add = [&] { outcomes.add_points(1, [&](int, int) { return std::span<const double>(points); }); };
  CHECK_THROWS_WITH(add(), Contains("envelope: outcome 1, rod 1, vertex 2: the number nan; finite numbers within 1e+09 are expected"));
  points[5] = 1e10;
  CHECK_THROWS_WITH(add(), Contains("the number 1e+10"));
  points.pop_back();
  CHECK_THROWS_WITH(add(), "envelope: outcome 1, rod 1: got 5 numbers, expected 3 for each of 2 vertices");
  CHECK(outcomes.size() == 0);
  points = {0, 0, 0, 0.1, 0, 0};
  add();
  CHECK(outcomes.size() == 1);

  const auto with = [&](double h, double share, double memory) {
    EnvelopeOptions options;
    options.voxel = h, options.share = share, options.memory = memory;
    return builder.build(outcomes, options);
  };
  CHECK_THROWS_WITH(with(0, 1, 2e9), "envelope: the voxel is 0 m; a finite length above 0 is expected");
  CHECK_THROWS_WITH(with(NAN, 1, 2e9), Contains("the voxel is nan m"));
  CHECK_THROWS_WITH(with(0.02, 1, 2e9),
                    "envelope: a voxel of 20 mm for a rod of radius 10 mm; expected at most the radius, better half of it");
  CHECK_THROWS_WITH(with(2e-3, 0, 2e9), "envelope: the share is 0; expected above 0 and at most 1");
  CHECK_THROWS_WITH(with(2e-3, 0.9, 2e9), Contains("collect them with Keep::all"));
  CHECK_THROWS_WITH(with(2e-3, 1, 0), Contains("0 bytes of memory are allowed"));
  CHECK_THROWS_WITH(with(2e-5, 1, 1e6), Contains("envelope: a voxel of 0.02 mm needs about") && Contains("0.001 GB are allowed; take a voxel of at least"));
  CHECK_THROWS_WITH(with(0.3e-3, 1, 1e6), Contains("million triangles") || Contains("needs about"));
  CHECK_THROWS_WITH(with(1e-9, 1, 1e30), Contains("cannot resolve in single precision; expected a voxel of at least"));
  CHECK(with(2e-3, 1, 1e6).status == Status::solved);  // and nothing is broken by what was refused
}

TEST_CASE("outcomes far from the origin and far from each other", "[envelope]") {
  Places places;
  places.rods = {{{0.01}, 1}};
  const Vec3 far(1e8, -1e8, 5e7);
  places.add({far, far + Vec3(0.1, 0, 0)});
  const Envelope envelope = built(places, 2e-3);
  CHECK(envelope.volume == Approx(capsule_volume(0.01, 0.1)).epsilon(0.05));
  places.add({{0, 0, 0}, {0.1, 0, 0}});
  CHECK_THROWS_WITH(built(places, 2e-3), Contains("cannot resolve in single precision"));
}
