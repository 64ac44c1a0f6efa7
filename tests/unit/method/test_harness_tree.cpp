// The tree between several connections: against all trees there are, against lengths known in closed form, and its rules.
#include <atomic>
#include <catch2/catch.hpp>
#include <numeric>

#include "method/route/harness_tree.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

namespace {

using Goals = std::vector<std::vector<Roadmap::Goal>>;
using Wires = std::vector<std::array<int, 2>>;

constexpr double step = 0.02;

/// Places of a grid from the origin on, so many each way. A thick object's grid has walls of one more place all round.
SpaceDemands box_of(int x, int y, int z, double radius = 0) {
  SpaceDemands demands;
  demands.radius = radius;
  const Vec3 wall = Vec3::Constant(radius > 0 ? step : 1e-9);
  demands.keep_in = Eigen::AlignedBox3d(-wall, step * Vec3(x - 1, y - 1, z - 1) + wall);
  return demands;
}

struct Grid {
  FreeSpace space;
  Roadmap roadmap;
  Grid(const Scene& scene, const SpaceDemands& demands)
      : space(scene, demands, {Vec3(0.001, 0.001, 0), Vec3(0.001, 0.001, 0)}, 10, {}), roadmap(space, step) {}
  int at(int x, int y, int z = 0) const {
    const int node = roadmap.node(roadmap.nearest(step * Vec3(x, y, z)));
    REQUIRE((roadmap.place(node) - step * Vec3(x, y, z)).norm() < 1e-8);
    return node;
  }
};

Wires star(int count) {
  Wires wires;
  for (int t = 1; t < count; ++t) wires.push_back({0, t});
  return wires;
}

/// The cheapest of all trees over all sets of free nodes and all choices of goals; trees by their Pruefer codes.
class AllTrees {
 public:
  AllTrees(const Roadmap& roadmap, const Goals& goals, const Wires& wires, double bundling)
      : goals_(goals), wires_(wires), bundling_(bundling) {
    for (int i = 0; i < roadmap.nodes(); ++i)
      if (roadmap.is_free(i)) nodes_.push_back(i);
    const std::size_t n = nodes_.size();
    edges_.assign(n * n, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (const auto& neighbour : Roadmap::neighbours()) {
          auto cell = roadmap.cell(nodes_[i]);
          for (int k = 0; k < 3; ++k) cell[k] += neighbour.offset[k];
          if (roadmap.holds(cell) && roadmap.node(cell) == nodes_[j] && roadmap.passes(nodes_[i], nodes_[j]))
            edges_[i * n + j] = roadmap.cost_between(nodes_[i], nodes_[j], neighbour.steps);
        }
  }

  double best() {
    choose(0);
    return best_;
  }

 private:
  void choose(std::size_t connection) {
    if (connection == goals_.size()) return over_sets();
    for (const Roadmap::Goal& goal : goals_[connection]) {
      const auto found = std::find(nodes_.begin(), nodes_.end(), goal.node);
      if (found == nodes_.end()) continue;
      homes_.push_back(static_cast<int>(found - nodes_.begin()));
      ways_.push_back(goal.cost);
      choose(connection + 1);
      homes_.pop_back();
      ways_.pop_back();
    }
  }
  void over_sets() {
    unsigned needed = 0;
    for (const int home : homes_) needed |= 1u << home;
    for (unsigned set = 0; set < (1u << nodes_.size()); ++set)
      if ((set & needed) == needed) over_codes(set);
  }
  void over_codes(unsigned set) {
    std::vector<int> members;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if ((set >> i) & 1) members.push_back(static_cast<int>(i));
    const int n = static_cast<int>(members.size());
    std::vector<int> code(std::max(0, n - 2), 0);
    while (true) {
      judge(members, code);
      int digit = 0;
      while (digit < n - 2 && ++code[digit] == n) code[digit++] = 0;
      if (digit >= n - 2) return;
    }
  }
  void judge(const std::vector<int>& members, const std::vector<int>& code) {
    const int n = static_cast<int>(members.size());
    // Each edge removes a leaf: what hangs behind it is known by then.
    std::vector<int> degree(n, 1), loose(n, 0);
    std::vector<unsigned> behind(n, 0);
    for (const int c : code) ++degree[c];
    double sum = 0;
    for (std::size_t t = 0; t < homes_.size(); ++t) {
      const int place = static_cast<int>(std::find(members.begin(), members.end(), homes_[t]) - members.begin());
      behind[place] |= 1u << t;
      sum += factor(1u << t) * ways_[t];
    }
    const auto edge = [&](int leaf, int to) {
      const double cost = edges_[members[leaf] * nodes_.size() + members[to]];
      // A leaf without a connection is of no use: such trees are judged without it, as members of another set.
      sum += behind[leaf] ? factor(behind[leaf]) * cost : std::numeric_limits<double>::infinity();
      behind[to] |= behind[leaf];
      degree[leaf] = 0;
      --degree[to];
    };
    for (const int c : code) {
      int leaf = 0;
      while (degree[leaf] != 1) ++leaf;
      edge(leaf, c);
      if (!(sum < best_)) return;
    }
    if (n > 1) {
      int a = 0;
      while (degree[a] != 1) ++a;
      int b = a + 1;
      while (degree[b] != 1) ++b;
      edge(a, b);
    }
    best_ = std::min(best_, sum);
  }
  double factor(unsigned set) const {
    int crossing = 0;
    for (const auto& [a, b] : wires_) crossing += ((set >> a) & 1) != ((set >> b) & 1);
    return bundling_ + (1 - bundling_) * crossing;
  }

  const Goals& goals_;
  const Wires& wires_;
  double bundling_;
  std::vector<int> nodes_, homes_;
  std::vector<double> edges_, ways_;
  double best_ = std::numeric_limits<double>::infinity();
};

/// Branches hang together as a tree, end where they say, and cost what they should.
void check_consistent(const Roadmap& roadmap, const Goals& goals, const TreeOptions& options, const HarnessTree& tree) {
  const int count = static_cast<int>(goals.size());
  const Wires wires = options.wires.empty() ? star(count) : options.wires;
  std::vector<int> degree(count + tree.junctions.size(), 0);
  std::vector<std::vector<int>> next(degree.size());
  double cost = 0, length = 0;
  for (const TreeBranch& branch : tree.branches) {
    for (const int end : {branch.from, branch.to}) ++degree[end];
    next[branch.from].push_back(branch.to);
    next[branch.to].push_back(branch.from);
    cost += branch.cost;
    length += branch.length;
    for (const auto& [end, node] : {std::pair{branch.from, branch.nodes.front()}, std::pair{branch.to, branch.nodes.back()}}) {
      if (end >= count) CHECK(tree.junctions[end - count] == node);
      else CHECK(std::any_of(goals[end].begin(), goals[end].end(), [node = node](const auto& g) { return g.node == node; }));
    }
    for (std::size_t i = 0; i + 1 < branch.nodes.size(); ++i) {
      CHECK(roadmap.passes(branch.nodes[i], branch.nodes[i + 1]));
      CHECK((roadmap.place(branch.nodes[i]) - roadmap.place(branch.nodes[i + 1])).norm() < 1.74 * step);
    }
  }
  for (std::size_t end = 0; end < degree.size(); ++end) CHECK((end < goals.size() ? degree[end] == 1 : degree[end] >= 3));
  CHECK(cost == Approx(tree.cost).epsilon(1e-5));
  CHECK(length == Approx(tree.length).epsilon(1e-9));
  // The wires in a branch are those of which it separates the ends.
  for (const TreeBranch& branch : tree.branches) {
    std::vector<bool> reached(next.size(), false);
    std::vector<int> open{branch.to};
    reached[branch.to] = true;
    while (!open.empty()) {
      const int end = open.back();
      open.pop_back();
      for (const int other : next[end])
        if (!reached[other] && !(end == branch.to && other == branch.from)) reached[other] = true, open.push_back(other);
    }
    std::vector<int> across;
    for (std::size_t w = 0; w < wires.size(); ++w)
      if (reached[wires[w][0]] != reached[wires[w][1]]) across.push_back(static_cast<int>(w));
    CHECK(across == branch.wires);
  }
}

}  // namespace

TEST_CASE("the best of all trees is found", "[harness]") {
  Random random(7);
  for (int run = 0; run < 60; ++run) {
    INFO("run " << run);
    Scene scene;
    SpaceDemands demands = run % 2 ? box_of(3, 3, 1) : box_of(2, 2, 2);
    demands.preference = run % 3 ? 0 : 2;
    demands.preference_range = 0.05;
    if (run % 3 == 0) {
      PlacedObstacle far = solid_of("far", Box{Vec3(0.01, 0.01, 0.01)}, Vec3(0.075, 0.02, 0));
      far.prefer = Preference::avoid;
      scene.add(far);
    }
    const Box post{Vec3(0.004, 0.004, 0.004)};
    scene.add(solid_of("post", post, step * Vec3(run / 2 % 2, run / 4 % 2, 0)));
    if (run % 2) scene.add(solid_of("other post", post, step * Vec3(2, run / 2 % 3, 0)));
    const Grid grid(scene, demands);
    REQUIRE(grid.roadmap.free_nodes() == 7);
    const int count = 3 + run % 3;
    Goals goals;
    while (static_cast<int>(goals.size()) < count) {
      goals.emplace_back();
      for (int g = 0; g < 1 + run % 4 / 3; ++g)
        goals.back().push_back({static_cast<int>(random.in(0, grid.roadmap.nodes() - 0.001)), random.in(0, 0.02)});
      if (std::none_of(goals.back().begin(), goals.back().end(), [&](const auto& g) { return grid.roadmap.is_free(g.node); })) goals.pop_back();
    }
    TreeOptions options;
    options.bundling = random.in(0.01, 1);
    if (run % 7 == 3) {
      options.wires.push_back({count - 1, 0});
      for (int t = 0; t + 1 < count; ++t) options.wires.push_back({t, t + 1});
    }
    const HarnessTree tree = best_tree(grid.roadmap, goals, options);
    REQUIRE(tree.status == Status::solved);
    const double best = AllTrees(grid.roadmap, goals, options.wires.empty() ? star(count) : options.wires, options.bundling)
                            .best();
    CHECK(tree.cost == Approx(best).epsilon(2e-6));
    check_consistent(grid.roadmap, goals, options, tree);
  }
}

TEST_CASE("three connections meet at the Steiner point of the grid's metric", "[harness]") {
  // Ways of 8 directions: from (-a, 0) and (a, 0) diagonally to (0, a), whatever the bundling.
  const Grid grid(Scene(), box_of(21, 21, 1));
  const Goals goals{{{grid.at(10, 18), 0}}, {{grid.at(4, 0), 0}}, {{grid.at(16, 0), 0}}};
  for (const double bundling : {0.0, 0.2, 0.5, 1.0}) {
    TreeOptions options;
    options.bundling = bundling;
    const HarnessTree tree = best_tree(grid.roadmap, goals, options);
    REQUIRE(tree.status == Status::solved);
    REQUIRE(tree.junctions.size() == 1);
    CHECK(tree.junctions[0] == grid.at(10, 6));
    CHECK(tree.length == Approx(step * (2 * 6 * std::sqrt(2.0) + 12)).epsilon(1e-6));
    CHECK(tree.cable_length == Approx(step * (2 * 6 * std::sqrt(2.0) + 2 * 12)).epsilon(1e-6));
    check_consistent(grid.roadmap, goals, options, tree);
  }
}

TEST_CASE("a wall with one window gathers a harness", "[harness]") {
  // Through one window at the middle of the wall go all wires from one side to the other.
  Scene scene;
  scene.add(solid_of("low wall", Box{Vec3(0.004, 0.184, 1)}, Vec3(0.2, 0.09, 0)));
  scene.add(solid_of("high wall", Box{Vec3(0.004, 0.184, 1)}, Vec3(0.2, 0.31, 0)));
  const Grid grid(scene, box_of(21, 21, 1));
  REQUIRE(grid.roadmap.is_free(grid.at(10, 10)));
  REQUIRE_FALSE(grid.roadmap.is_free(grid.at(10, 9)));
  REQUIRE_FALSE(grid.roadmap.is_free(grid.at(10, 11)));
  const Goals goals{{{grid.at(0, 10), 0}}, {{grid.at(20, 4), 0}}, {{grid.at(20, 10), 0}}, {{grid.at(20, 16), 0}}};
  const HarnessTree tree = best_tree(grid.roadmap, goals);
  REQUIRE(tree.status == Status::solved);
  int through = 0;
  for (const TreeBranch& branch : tree.branches)
    if (std::count(branch.nodes.begin(), branch.nodes.end(), grid.at(10, 10))) {
      ++through;
      CHECK(branch.wires == std::vector<int>{0, 1, 2});
    }
  CHECK(through == 1);
}

TEST_CASE("bundling weighs the harness's length against that of its wires", "[harness]") {
  Random random(11);
  for (int run = 0; run < 8; ++run) {
    INFO("run " << run);
    Scene scene;
    for (int i = 0; i < 12; ++i)
      scene.add(solid_of("box " + std::to_string(i), Box{Vec3(random.in(0.02, 0.09), random.in(0.02, 0.09), random.in(0.02, 0.09))},
                         Vec3(random.in(0, 0.28), random.in(0, 0.28), random.in(0, 0.28))));
    const Grid grid(scene, box_of(15, 15, 15, 0.018));
    const std::vector<float> reached = [&] {
      for (int start = 0;; ++start)
        if (grid.roadmap.is_free(start)) return grid.roadmap.costs_to({{start, 0}});
    }();
    Goals goals;
    while (goals.size() < 5) {
      const int node = static_cast<int>(random.in(0, grid.roadmap.nodes() - 0.001));
      if (reached[node] < Roadmap::unreachable) goals.push_back({{node, 0}});
    }
    double harness = 0, cable = 0;
    for (const double bundling : {0.0, 0.1, 0.3, 0.5, 0.8, 1.0}) {
      TreeOptions options;
      options.bundling = bundling;
      const HarnessTree tree = best_tree(grid.roadmap, goals, options);
      REQUIRE(tree.status == Status::solved);
      check_consistent(grid.roadmap, goals, options, tree);
      if (bundling == 0) {
        double shortest = 0;
        for (std::size_t t = 1; t < goals.size(); ++t) shortest += grid.roadmap.costs_to({goals[0][0]})[goals[t][0].node];
        CHECK(tree.cable_length == Approx(shortest).epsilon(1e-5));
      } else {
        CHECK(tree.length <= harness * (1 + 1e-6));
        CHECK(tree.cable_length >= cable * (1 - 1e-6));
      }
      harness = tree.length;
      cable = tree.cable_length;
    }
  }
}

TEST_CASE("the tree is the same for any number of threads", "[harness]") {
  Scene scene;
  scene.add(solid_of("box", Box{Vec3(0.1, 0.1, 0.1)}, Vec3(0.14, 0.14, 0.14)));
  const Grid grid(scene, box_of(15, 15, 15, 0.018));
  Goals goals;
  for (const auto& [x, y, z] : {std::array{0, 0, 0}, {14, 0, 3}, {2, 14, 14}, {14, 14, 14}, {0, 7, 14}, {14, 7, 0}, {7, 0, 14}})
    goals.push_back({{grid.at(x, y, z), 0.01 * x}});
  RunContext one;
  one.threads = 1;
  const HarnessTree expected = best_tree(grid.roadmap, goals, {}, one);
  REQUIRE(expected.status == Status::solved);
  for (const int threads : {2, 3, 5}) {
    RunContext some;
    some.threads = threads;
    const HarnessTree tree = best_tree(grid.roadmap, goals, {}, some);
    CHECK(tree.cost == expected.cost);
    CHECK(tree.labels == expected.labels);
    CHECK(tree.junctions == expected.junctions);
    REQUIRE(tree.branches.size() == expected.branches.size());
    for (std::size_t b = 0; b < tree.branches.size(); ++b) CHECK(tree.branches[b].nodes == expected.branches[b].nodes);
  }
}

TEST_CASE("groups without a wire between them stay apart", "[harness]") {
  const Grid grid(Scene(), box_of(11, 11, 1));
  const Goals goals{{{grid.at(0, 0), 0}}, {{grid.at(0, 10), 0}}, {{grid.at(10, 0), 0}}, {{grid.at(10, 10), 0}}};
  TreeOptions options;
  options.wires = {{1, 0}, {2, 3}};
  const HarnessTree tree = best_tree(grid.roadmap, goals, options);
  REQUIRE(tree.status == Status::solved);
  CHECK(tree.junctions.empty());
  REQUIRE(tree.branches.size() == 2);
  CHECK(tree.length == Approx(step * 20).epsilon(1e-9));
  CHECK(tree.branches[0].wires == std::vector<int>{0});
  CHECK(tree.branches[1].wires == std::vector<int>{1});
  check_consistent(grid.roadmap, goals, options, tree);
}

TEST_CASE("what keeps a harness's connections apart is said", "[harness]") {
  Scene scene;
  scene.add(solid_of("wall", Box{Vec3(0.01, 2, 2)}, Vec3(0.1, 0, 0)));
  const Grid grid(scene, box_of(11, 11, 1));
  const Goals goals{{{grid.at(0, 0), 0}}, {{grid.at(0, 10), 0}}, {{grid.at(10, 0), 0}}};
  const HarnessTree tree = best_tree(grid.roadmap, goals);
  CHECK(tree.status == Status::infeasible);
  CHECK(tree.apart == std::array{0, 2});
  CHECK(tree.branches.empty());
  REQUIRE_FALSE(grid.roadmap.is_free(grid.at(5, 5)));
  CHECK(best_tree(grid.roadmap, {goals[0], {{grid.at(5, 5), 0}}}).apart == std::array{1, 1});
  CHECK(best_tree(grid.roadmap, {goals[0], {}}).apart == std::array{1, 1});
}

TEST_CASE("a tree that is cancelled says so", "[harness]") {
  const Grid grid(Scene(), box_of(11, 11, 1));
  const std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(best_tree(grid.roadmap, {{{grid.at(0, 0), 0}}, {{grid.at(0, 10), 0}}}, {}, context).status == Status::cancelled);
}

TEST_CASE("a tree's options are checked", "[harness]") {
  const Grid grid(Scene(), box_of(11, 11, 1));
  const std::vector<Roadmap::Goal> goal{{grid.at(1, 1), 0}};
  const Goals three(3, goal);
  const auto message = [&](const Goals& goals, const TreeOptions& options) -> std::string {
    try {
      best_tree(grid.roadmap, goals, options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  const auto with = [](auto change) {
    TreeOptions options;
    change(options);
    return options;
  };
  CHECK(message(Goals(1, goal), {}) == "harness: 1 connections, 2 to 9 expected");
  CHECK(message(Goals(10, goal), {}) ==
        "harness: 10 connections, 2 to 9 expected; route parts of it one after the other, each an obstacle for the next");
  CHECK(message(three, with([](auto& o) { o.bundling = 1.5; })) == "harness: 'bundling' is 1.5, 0 to 1 expected");
  CHECK(message(three, with([](auto& o) { o.bundling = std::nan(""); })) == "harness: 'bundling' is nan, 0 to 1 expected");
  CHECK(message(three, with([](auto& o) { o.wires = {{0, 1}, {1, 3}}; })) == "harness: wire 2 ends at connection 4, 1 to 3 expected");
  CHECK(message(three, with([](auto& o) { o.wires = {{0, 1}, {2, 2}}; })) == "harness: wire 2 begins and ends at connection 3");
  CHECK(message(three, with([](auto& o) { o.wires = {{0, 1}}; })) == "harness: no wire ends at connection 3");
  CHECK(message({goal, {{-1, 0}}}, {}) == "harness: a connection enters the grid at a node that it does not have");
  CHECK(message({goal, {{0, -2}}}, {}) ==
        "harness: the way of a connection to the grid costs -2 m; a finite length of at least 0 expected");
  CHECK(message(three, with([](auto& o) { o.memory = 1000; })) ==
        "harness: 3 connections over 121 free places need 1 MB, at most 0.001 MB allowed; take a larger 'grid' or a box to 'keep_in'");
}
