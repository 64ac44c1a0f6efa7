// Optimised parameters of a dress pack: known optima from scans, derivatives, bounds, what is refused.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/parameters.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

PackProblem planar_hose(int segments = 12) {
  PackProblem pack = planar_pack(segments);
  pack.names = {"hose"};
  return pack;
}

/// A longer hose, clipped to the upper arm as well.
PackProblem clipped_hose() {
  PackProblem pack = planar_hose();
  pack.rods[0].rod.length = pack.rods[0].rod.parts.back().upto = pack.rods[0].holds[1].at = 1.4;
  pack.rods[0].holds.push_back({0.65, {{0.4, 0.1, 0}, Frame::looking({}, {1, 0, 0}, {0, 0, 1}).rotation}});
  pack.attachments.push_back({0, 2, 1, Frame::looking({0.45, 0.1, 0}, {1, 0, 0}, {0, 0, 1})});
  return pack;
}

std::vector<PackTask> planar_tasks() {
  return {{JointPath({degrees({10, 60}), degrees({60, -60})}).resampled(3)}, {JointPath({degrees({10, 60}), degrees({30, -20})}), 0.5}};
}

ParameterOptions planar_options() {
  ParameterOptions options;
  options.steps = 12;
  options.demands.force = {10, 10};
  options.demands.curvature = {3, 1};
  return options;
}

/// The least of the objective over one number, by a scan that is made finer twice.
std::pair<double, double> scanned(const PackProblem& pack, const PackParameter& parameter, const ParameterOptions& options) {
  const std::vector<PackParameter> all{parameter};
  const std::vector<PackTask> tasks = planar_tasks();
  const ParameterProblem problem(pack, all, tasks, options);
  double best = 0.5, least = INFINITY, spacing = 1.0 / 40;
  for (int round = 0; round < 3; ++round, spacing *= 0.06) {
    const double centre = best;
    for (int k = -20; k <= 20; ++k) {
      const double x = centre + k * spacing;
      if (x < 0 || x > 1) continue;
      const ParameterProblem::Point point = problem.at(Eigen::VectorXd::Constant(1, x), {});
      if (point.ok() && point.objective < least) least = point.objective, best = x;
    }
  }
  return {(1 - best) * parameter.lower + best * parameter.upper, least};
}

}  // namespace

TEST_CASE("parameters: what a pack offers, by name", "[dress_pack]") {
  const std::vector<std::string> names = parameter_names(clipped_hose());
  const auto has = [&](const char* name) { return std::count(names.begin(), names.end(), name) == 1; };
  CHECK(names.size() == 2 + 3 * 6);
  for (const char* name : {"hose.length", "hose.0.65.at", "hose.start.x", "hose.finish.rz", "hose.0.65.ry"}) CHECK(has(name));
}

TEST_CASE("parameters: each one changes what it says", "[dress_pack]") {
  const PackProblem pack = clipped_hose();
  const auto with = [&](const char* name, double lower, double upper, double value) {
    PackProblem out = pack;
    pack_parameter(pack, name, lower, upper).apply(value, out);
    out.check();
    return out;
  };
  const PackProblem longer = with("hose.length", 1.3, 2, 1.5);
  CHECK(longer.rods[0].rod.length == Approx(1.5));
  CHECK(longer.rods[0].holds[1].at == Approx(1.5));
  CHECK(longer.rods[0].holds[2].at == 0.65);
  CHECK(with("hose.0.65.at", 0.4, 0.8, 0.7).rods[0].holds[2].at == 0.7);
  CHECK(with("hose.finish.y", -1, 1, 0.2).attachments[1].in_link.at == Vec3(0, 0.2, 0));
  const Quat before = pack.attachments[0].in_link.rotation, turned = with("hose.start.rx", -1, 1, 0.3).attachments[0].in_link.rotation;
  CHECK((log_rotation(before.conjugate() * turned) - Vec3(0.3, 0, 0)).norm() < 1e-12);
  CHECK(pack_parameter(pack, "hose.length", 1.3, 2).start == 1.4);
  CHECK(pack_parameter(pack, "hose.start.ry", -1, 1).start == 0);
}

TEST_CASE("parameters: gradient against finite differences", "[dress_pack]") {
  PackProblem pack = six_axis_pack(12);
  pack.names = {"hose"};
  std::vector<PackParameter> parameters{pack_parameter(pack, "hose.length", 1.4, 1.9)};
  for (const char* name : {"hose.start.x", "hose.start.rx", "hose.start.ry", "hose.finish.z", "hose.finish.rz"}) {
    PackParameter one = pack_parameter(pack, name, -0.6, 0.9);
    one.start += 0.05;
    parameters.push_back(one);
  }
  const std::vector<PackTask> tasks{{problematic_path(4), 1}, {JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, 10, 20, 20, 20})}), 2}};
  ParameterOptions options;
  options.steps = 10;
  options.demands.force = {20, 10};
  options.demands.twist = {1, 0.5};
  options.demands.curvature = {4, 1};
  options.length_weight = 0.3;
  const ParameterProblem problem(pack, parameters, tasks, options);
  const ParameterProblem::Point point = problem.at(problem.start(), {});
  REQUIRE(point.ok());
  Eigen::VectorXd gradient;
  REQUIRE(problem.gradient(point, gradient, {}));
  for (int i = 0; i < problem.variables(); ++i) {
    CAPTURE(parameters[i].name);
    const Eigen::VectorXd by = 2e-4 * Eigen::VectorXd::Unit(problem.variables(), i);
    const double slope = (problem.at(point.x + by, {}).objective - problem.at(point.x - by, {}).objective) / 4e-4;
    CHECK(gradient[i] == Approx(slope).epsilon(2e-5).margin(1e-5 * gradient.norm()));
  }
}

TEST_CASE("optimised parameters: the length of a hose, the best of a fine scan", "[dress_pack]") {
  const PackProblem pack = planar_hose();
  const PackParameter length = pack_parameter(pack, "hose.length", 1.15, 2.2);
  ParameterOptions options = planar_options();
  options.length_weight = 10;
  const auto [best, least] = scanned(pack, length, options);
  const ParameterResult found = optimise_parameters(pack, {length}, planar_tasks(), options);
  CAPTURE(found.message, best);
  REQUIRE(found.ok());
  CHECK(best > 1.3);
  CHECK(best < 2.1);
  CHECK(found.objective <= least * (1 + 1e-4));
  CHECK(found.values[0] == Approx(best).margin(2e-3));
  CHECK(found.pack.rods[0].rod.length == Approx(found.values[0]));
  CHECK(found.objective < 0.9 * found.objective_before);
  REQUIRE(found.before.size() == 2);
  REQUIRE(found.after.size() == 2);
  for (const PackMotion& motion : found.after) CHECK(motion.ok());
}

TEST_CASE("optimised parameters: the place of a clip, the best of a fine scan", "[dress_pack]") {
  const PackProblem pack = clipped_hose();
  const PackParameter clip = pack_parameter(pack, "hose.0.65.at", 0.5, 0.8);
  const auto [best, least] = scanned(pack, clip, planar_options());
  const ParameterResult found = optimise_parameters(pack, {clip}, planar_tasks(), planar_options());
  CAPTURE(found.message, best);
  REQUIRE(found.ok());
  CHECK(found.objective <= least * (1 + 1e-4));
  CHECK(found.values[0] == Approx(best).margin(2e-3));
  CHECK(found.objective < found.objective_before);
}

TEST_CASE("optimised parameters: several at once leave no slope inside, and none pulls into the bounds", "[dress_pack]") {
  const PackProblem pack = planar_hose();
  const std::vector<PackParameter> parameters{pack_parameter(pack, "hose.length", 1.1, 1.3), pack_parameter(pack, "hose.start.y", 0, 0.2),
                                              pack_parameter(pack, "hose.finish.rx", -0.8, 0.8), pack_parameter(pack, "hose.start.rx", -0.8, 0.8)};
  const std::vector<PackTask> tasks = planar_tasks();
  ParameterOptions options = planar_options();
  options.tolerance = 1e-9;
  const ParameterResult found = optimise_parameters(pack, parameters, tasks, options);
  CAPTURE(found.message);
  REQUIRE(found.ok());
  CHECK(found.objective < 0.9 * found.objective_before);
  double last = found.objective_before;
  for (const double objective : found.history) {
    CHECK(objective <= last);
    last = objective;
  }
  const ParameterProblem problem(pack, parameters, tasks, options);
  Eigen::VectorXd x(4), gradient;
  for (int i = 0; i < 4; ++i) {
    CHECK(found.values[i] >= parameters[i].lower);
    CHECK(found.values[i] <= parameters[i].upper);
    x[i] = (found.values[i] - parameters[i].lower) / (parameters[i].upper - parameters[i].lower);
  }
  const ParameterProblem::Point point = problem.at(x, {});
  REQUIRE(problem.gradient(point, gradient, {}));
  CHECK(point.objective == Approx(found.objective).epsilon(1e-9));
  const double size = 2e-3 * (1 + found.objective_before);
  bool at_bound = false;
  for (int i = 0; i < 4; ++i) {
    CAPTURE(parameters[i].name, x[i], gradient[i]);
    at_bound |= x[i] < 1e-9 || x[i] > 1 - 1e-9;
    if (x[i] > 1e-9) CHECK(gradient[i] < size);
    if (x[i] < 1 - 1e-9) CHECK(gradient[i] > -size);
  }
  CHECK(at_bound);
}

TEST_CASE("optimised parameters: the same bits for any number of threads", "[dress_pack]") {
  const PackProblem pack = planar_hose();
  const std::vector<PackParameter> parameters{pack_parameter(pack, "hose.length", 1.1, 1.7), pack_parameter(pack, "hose.finish.rx", -0.8, 0.8)};
  RunContext one, three;
  one.threads = 1;
  three.threads = 3;
  const ParameterResult a = optimise_parameters(pack, parameters, planar_tasks(), planar_options(), one);
  const ParameterResult b = optimise_parameters(pack, parameters, planar_tasks(), planar_options(), three);
  CHECK(a.values == b.values);
  CHECK(a.objective == b.objective);
}

TEST_CASE("optimised parameters: interrupted, the best so far is kept", "[dress_pack]") {
  const PackProblem pack = planar_hose();
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  context.progress = [&](double, const char* what) {
    if (std::string(what) == "optimisation") cancel = true;
  };
  const std::vector<PackParameter> parameters{pack_parameter(pack, "hose.length", 1.1, 1.7)};
  const ParameterResult found = optimise_parameters(pack, parameters, planar_tasks(), planar_options(), context);
  CHECK(found.status == Status::cancelled);
  CHECK_THAT(found.message, Contains("best parameters so far"));
  CHECK(found.iterations == 1);
  CHECK(found.objective <= found.objective_before);
  const ParameterResult never = optimise_parameters(pack, parameters, planar_tasks(), planar_options(), context);
  CHECK(never.status == Status::cancelled);
  CHECK(never.values[0] == Approx(1.2));
}

TEST_CASE("optimised parameters: what makes no sense is refused, what cannot begin is infeasible", "[dress_pack]") {
  const PackProblem pack = clipped_hose();
  CHECK_THROWS_WITH(pack_parameter(pack, "hose.lenght", 1, 2), Contains("there is no parameter 'hose.lenght'") && Contains("did you mean 'hose.length'"));
  CHECK_THROWS_WITH(pack_parameter(pack, "hose.length", 1.5, 2), Contains("with 1.4 between them"));
  CHECK_THROWS_WITH(pack_parameter(pack, "hose.length", -1, 2), Contains("expected more than 0"));
  CHECK_THROWS_WITH(pack_parameter(pack, "hose.length", 0.5, 2), Contains("carries a hold of hose over"));
  CHECK_THROWS_WITH(pack_parameter(pack, "hose.0.65.at", 0.5, 1.5), Contains("carries a hold of hose over"));
  const PackParameter length = pack_parameter(pack, "hose.length", 1.3, 1.6);
  const std::vector<PackTask> tasks = planar_tasks();
  const auto refuses = [&](std::vector<PackParameter> parameters, std::vector<PackTask> paths, auto change_options, const char* says) {
    ParameterOptions options = planar_options();
    change_options(options);
    CHECK_THROWS_WITH(optimise_parameters(pack, parameters, paths, options), Contains(says));
  };
  const auto as_is = [](ParameterOptions&) {};
  refuses({}, tasks, as_is, "no parameters");
  refuses({length}, {}, as_is, "no paths");
  refuses({length, length}, tasks, as_is, "'hose.length' is given twice");
  PackParameter broken = length;
  broken.apply = nullptr;
  refuses({broken}, tasks, as_is, "'hose.length' changes nothing");
  broken = length;
  broken.upper = NAN;
  refuses({broken}, tasks, as_is, "the bounds of 'hose.length'");
  broken = length;
  broken.start = 3;
  refuses({broken}, tasks, as_is, "'hose.length' starts at 3");
  refuses({length}, {{tasks[0].path, -1}}, as_is, "the weight of a path is -1");
  refuses({length}, tasks, [](ParameterOptions& o) { o.steps = 0; }, "0 time steps");
  refuses({length}, tasks, [](ParameterOptions& o) { o.length_weight = INFINITY; }, "the weight of the length");
  refuses({length}, tasks, [](ParameterOptions& o) { o.tolerance = 0; }, "tolerance and radius");
  refuses({length}, tasks, [](ParameterOptions& o) { o.demands.clearance = 0.01; }, "without clearance");
  const ParameterResult beyond = optimise_parameters(pack, {length}, {tasks[0], {JointPath({degrees({0, 0}), degrees({0, 200})})}}, planar_options());
  CHECK(beyond.status == Status::infeasible);
  CHECK_THAT(beyond.message, Contains("path 2: via point 1"));
  PackProblem torn = planar_hose();
  torn.rods[0] = hose(0.3, 12);
  const ParameterResult taut = optimise_parameters(torn, {pack_parameter(torn, "hose.length", 0.2, 0.4)}, tasks, planar_options());
  CHECK(taut.status == Status::infeasible);
  CHECK_THAT(taut.message, Contains("the rods cannot follow path 1"));
}
