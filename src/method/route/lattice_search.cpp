#include "method/route/lattice_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <unordered_map>

#include "method/route/gap_cache.h"

namespace tendril::routing {

namespace {

constexpr double fine_spacing = 5e-3;  // m, of remembered gaps
constexpr float never = std::numeric_limits<float>::infinity();

/// A state of the lattice: a node of the roadmap and a direction. Numbers are node * directions + direction.
using State = std::int64_t;
constexpr State none = -1, goal_state = -2;

/// What the search knows of the directions at one node.
struct Place {
  std::vector<float> cost;
  std::vector<State> parent;
  std::vector<char> done;
  Vec3 onward = Vec3::Zero();  ///< unit, the way to the goal by the grid; zero at the goal
  explicit Place(std::size_t directions) : cost(directions, never), parent(directions, none), done(directions, 0) {}
};

struct Waiting {
  float estimate, cost;
  State state;
  bool operator<(const Waiting& other) const {
    return estimate > other.estimate || (estimate == other.estimate && state > other.state);
  }
};

/// The pair of arcs between an end and a state.
struct Connector {
  State state;
  float cost;
};

class Search {
 public:
  Search(const FreeSpace& space, const Roadmap& roadmap, const StateLattice& lattice, const Ends& ends,
         const LatticeSearchOptions& options, const RunContext& context)
      : roadmap_(roadmap), lattice_(lattice), ends_(ends), options_(options), context_(context), gaps_(space, fine_spacing),
        directions_(static_cast<int>(lattice.directions().size())), place_of_(roadmap.nodes(), -1) {}

  LatticePath run();

 private:
  Vec3 start() const { return ends_.start + options_.end_straight * ends_.start_along; }
  Vec3 finish() const { return ends_.finish - options_.end_straight * ends_.finish_along; }
  int node_of(State state) const { return static_cast<int>(state / directions_); }
  int direction_of(State state) const { return static_cast<int>(state % directions_); }
  Vec3 at(State state) const { return roadmap_.place(node_of(state)); }
  const Vec3& along(State state) const { return lattice_.directions()[direction_of(state)]; }

  Place& place(int node);
  float estimate(Place& place, int node, int direction) const;
  void offer(State state, State parent, float cost);
  void expand(State state, float cost);
  float passed(const std::vector<Vec3>& samples, const Vec3& from, double length);
  float connector_cost(const Vec3& from, const Vec3& along, const Vec3& to, const Vec3& to_along, double exempt);
  std::vector<Connector> connectors(const Vec3& end, const Vec3& along, bool forward);
  std::vector<Roadmap::Goal> goals() const;
  PccPoints chain() const;

  const Roadmap& roadmap_;
  const StateLattice& lattice_;
  const Ends& ends_;
  const LatticeSearchOptions& options_;
  const RunContext& context_;
  GapCache gaps_;
  const int directions_;
  std::vector<int> place_of_;
  std::vector<Place> places_;
  std::vector<float> field_;
  std::unordered_map<State, float> to_goal_;
  std::priority_queue<Waiting> waiting_;
  float goal_cost_ = never;
  State goal_parent_ = none;
  long states_ = 0;
};

Place& Search::place(int node) {
  int& index = place_of_[node];
  if (index >= 0) return places_[index];
  index = static_cast<int>(places_.size());
  places_.emplace_back(directions_);
  // The way that the grid's costs fall steepest, over all neighbours: smoother than the best one alone.
  Vec3 down = Vec3::Zero();
  const std::array<int, 3> here = roadmap_.cell(node);
  for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
    const std::array<int, 3> there{here[0] + n.offset[0], here[1] + n.offset[1], here[2] + n.offset[2]};
    if (!roadmap_.holds(there)) continue;
    const float cost = field_[roadmap_.node(there)];
    if (cost < field_[node]) down += (field_[node] - cost) / n.steps * Vec3(n.offset[0], n.offset[1], n.offset[2]) / n.steps;
  }
  if (down.norm() > 0) places_[index].onward = down.normalized();
  return places_[index];
}

float Search::estimate(Place& place, int node, int direction) const {
  double rest = options_.eagerness * field_[node];
  if (options_.turning && field_[node] > 2 * lattice_.radius()) {
    const double gamma = std::acos(std::clamp(place.onward.dot(lattice_.directions()[direction]), -1.0, 1.0));
    rest += lattice_.radius() * (gamma - std::sin(gamma));
  }
  return static_cast<float>(rest);
}

void Search::offer(State state, State parent, float cost) {
  const int node = node_of(state), direction = direction_of(state);
  Place& here = place(node);
  if (here.done[direction] || cost >= here.cost[direction]) return;
  if (here.cost[direction] == never) ++states_;
  here.cost[direction] = cost;
  here.parent[direction] = parent;
  waiting_.push({cost + estimate(here, node, direction), cost, state});
}

/// What the samples of a way cost (m); infinite where one of them is not free.
float Search::passed(const std::vector<Vec3>& samples, const Vec3& from, double length) {
  double sum = 0;
  for (const Vec3& sample : samples) {
    const Vec3 p = from + sample;
    if (!gaps_.is_free(p)) return never;
    sum += roadmap_.cost(roadmap_.node(roadmap_.nearest(p)));
  }
  return static_cast<float>(length * sum / samples.size());
}

void Search::expand(State state, float cost) {
  const int node = node_of(state);
  const std::array<int, 3> here = roadmap_.cell(node);
  const Vec3 from = roadmap_.place(node);
  for (const Primitive& primitive : lattice_.from(direction_of(state))) {
    const std::array<int, 3> there{here[0] + primitive.offset[0], here[1] + primitive.offset[1], here[2] + primitive.offset[2]};
    if (!roadmap_.holds(there)) continue;
    const int other = roadmap_.node(there);
    if (!(field_[other] < Roadmap::unreachable)) continue;
    // The cheapest that it can be, before a single gap is looked at.
    const Place& target = place(other);
    if (target.done[primitive.to] || cost + primitive.length >= target.cost[primitive.to]) continue;
    const float way = passed(primitive.samples, from, primitive.length);
    if (way < never) offer(State(other) * directions_ + primitive.to, state, cost + way);
  }
  if (const auto end = to_goal_.find(state); end != to_goal_.end() && cost + end->second < goal_cost_) {
    goal_cost_ = cost + end->second;
    goal_parent_ = state;
    waiting_.push({goal_cost_, goal_cost_, goal_state});
  }
}

/// What the pair of arcs costs; infinite where it bends too sharply or meets something. `exempt`: arc length at its beginning, or
/// from 1 - exempt on where it is negative, where nothing need be kept clear of.
float Search::connector_cost(const Vec3& from, const Vec3& from_along, const Vec3& to, const Vec3& to_along, double exempt) {
  const auto arcs = biarc(from, from_along, to, to_along);
  if (!arcs || arcs->smallest_radius() < lattice_.radius() * (1 - 1e-9) || arcs->length > 1.5 * lattice_.longest()) return never;
  const int pieces = std::max(1, static_cast<int>(std::ceil(arcs->length / (2 * fine_spacing))));
  double sum = 0;
  for (int i = 0; i <= pieces; ++i) {
    const double share = double(i) / pieces, s = share * arcs->length;
    const Vec3 p = arcs->at(share, from, from_along);
    const bool free_end = exempt >= 0 ? s < exempt : arcs->length - s < -exempt;
    if (!free_end && !gaps_.is_free(p)) return never;
    sum += roadmap_.cost(roadmap_.node(roadmap_.nearest(p)));
  }
  return static_cast<float>(arcs->length * sum / (pieces + 1));
}

/// To states around an end. `forward`: from the end to them, else from them to the end.
std::vector<Connector> Search::connectors(const Vec3& end, const Vec3& end_along, bool forward) {
  std::vector<Connector> found;
  const std::array<int, 3> middle = roadmap_.nearest(end);
  const int reach = static_cast<int>(std::ceil(lattice_.longest() / lattice_.step()));
  const double exempt = std::max(0.0, options_.free_ends - options_.end_straight);
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const std::array<int, 3> cell{middle[0] + x, middle[1] + y, middle[2] + z};
        if (!roadmap_.holds(cell)) continue;
        const int node = roadmap_.node(cell);
        const Vec3 p = roadmap_.place(node), way = forward ? Vec3(p - end) : Vec3(end - p);
        if (!roadmap_.is_free(node) || way.norm() > lattice_.longest() || way.dot(end_along) <= 0) continue;
        for (int d = 0; d < directions_; ++d) {
          const Vec3& along = lattice_.directions()[d];
          if (way.dot(along) <= 0) continue;
          const float cost = forward ? connector_cost(end, end_along, p, along, exempt) : connector_cost(p, along, end, end_along, -exempt);
          if (cost < never) found.push_back({State(node) * directions_ + d, cost});
        }
      }
  return found;
}

/// Every node with a way to the finish.
std::vector<Roadmap::Goal> Search::goals() const {
  std::vector<Roadmap::Goal> goals;
  for (const auto& [state, cost] : to_goal_) goals.push_back({node_of(state), cost});
  std::sort(goals.begin(), goals.end(), [](const auto& a, const auto& b) { return std::tie(a.node, a.cost) < std::tie(b.node, b.cost); });
  return goals;
}

PccPoints Search::chain() const {
  std::vector<State> states;
  for (State s = goal_parent_; s != none;) {
    states.push_back(s);
    const Place& here = places_[place_of_[node_of(s)]];
    s = here.parent[direction_of(s)];
  }
  std::reverse(states.begin(), states.end());
  PccPoints chain;
  chain.points.push_back(ends_.start);
  Vec3 from = start(), from_along = ends_.start_along;
  const auto join = [&](const Vec3& to, const Vec3& to_along) {
    const auto arcs = biarc(from, from_along, to, to_along);
    for (int i = 0; i < 2; ++i) {
      if (arcs->turns[i] < 1e-9) continue;
      chain.points.push_back(arcs->vertices[i]);
      chain.radii.push_back(arcs->radii[i]);
    }
    from = to;
    from_along = to_along;
  };
  for (const State s : states) join(at(s), along(s));
  join(finish(), ends_.finish_along);
  chain.points.push_back(ends_.finish);
  return chain;
}

LatticePath Search::run() {
  LatticePath path;
  using Outcome = LatticePath::Outcome;
  for (const Connector& c : connectors(finish(), ends_.finish_along, false)) to_goal_[c.state] = c.cost;
  field_ = roadmap_.costs_to(goals());
  const float direct = connector_cost(start(), ends_.start_along, finish(), ends_.finish_along, 0);
  if (direct < never) {
    goal_cost_ = direct;
    waiting_.push({direct, direct, goal_state});
  }
  for (const Connector& c : connectors(start(), ends_.start_along, true))
    if (field_[node_of(c.state)] < Roadmap::unreachable) offer(c.state, none, c.cost);
  path.outcome = waiting_.empty() ? Outcome::no_way : Outcome::exhausted;
  for (long popped = 0; !waiting_.empty(); ++popped) {
    const Waiting next = waiting_.top();
    waiting_.pop();
    if (next.state == goal_state) {
      path.outcome = Outcome::found;
      path.cost = next.cost + 2 * options_.end_straight;
      path.chain = chain();
      break;
    }
    Place& here = place(node_of(next.state));
    const int direction = direction_of(next.state);
    if (here.done[direction] || next.cost > here.cost[direction]) continue;
    here.done[direction] = 1;
    if (states_ > options_.most_states) {
      path.outcome = Outcome::capped;
      break;
    }
    if (popped % 256 == 0 && context_.stop()) {
      path.outcome = Outcome::stopped;
      break;
    }
    expand(next.state, next.cost);
  }
  path.states = states_;
  path.queries = gaps_.queries();
  return path;
}

}  // namespace

LatticePath lattice_search(const FreeSpace& space, const Roadmap& roadmap, const StateLattice& lattice, const Ends& ends,
                           const LatticeSearchOptions& options, const RunContext& context) {
  return Search(space, roadmap, lattice, ends, options, context).run();
}

}  // namespace tendril::routing
