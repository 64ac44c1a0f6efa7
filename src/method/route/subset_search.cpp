#include "method/route/subset_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace tendril::routing {

namespace {

constexpr float unreachable = Roadmap::unreachable;
// Costs are summed in single precision; bounds that miss by less prove nothing.
constexpr double rounding = 1e-4;

double spanning_tree(const std::vector<int>& members, const std::vector<double>& between, int count) {
  std::vector<double> nearest(members.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> in(members.size(), false);
  double sum = 0;
  for (std::size_t added = 0, at = 0; added + 1 < members.size(); ++added) {
    in[at] = true;
    std::size_t next = at;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (in[i]) continue;
      nearest[i] = std::min(nearest[i], between[members[at] * count + members[i]]);
      if (in[next] || nearest[i] < nearest[next]) next = i;
    }
    sum += nearest[next];
    at = next;
  }
  return sum;
}

}  // namespace

int TreeWeights::crossing(Subset s) const {
  return static_cast<int>(std::count_if(wires.begin(), wires.end(), [s](const auto& w) { return ((s >> w[0]) & 1) != ((s >> w[1]) & 1); }));
}

/// Places by cost in steps of less than the cheapest edge: within one bucket no place can improve another, so that any order
/// settles them (Dial, 1969).
struct SubsetSearch::Queue {
  std::vector<std::vector<int>> buckets;
  std::vector<char> settled;
  double per_cost = 1;
  float least = 0;
  std::size_t bucket(float cost) const { return static_cast<std::size_t>((cost - least) * per_cost); }
  void push(int place, float cost) {
    const std::size_t b = bucket(cost);
    if (b >= buckets.size()) buckets.resize(b + 1);
    buckets[b].push_back(place);
  }
};

SubsetSearch::SubsetSearch(const PlaceGraph& graph, std::vector<std::vector<Entry>> entries, TreeWeights weights)
    : graph_(graph), entries_(std::move(entries)), weights_(std::move(weights)), count_(static_cast<int>(entries_.size())) {}

/// Dijkstra's algorithm from all values that the layer has. Labels that `keep` refuses are forgotten. False when stopped.
bool SubsetSearch::spread(Layer& layer, double factor, const std::function<bool(int, float)>& keep, Queue& queue,
                          const RunContext& context) const {
  queue.per_cost = 1 / (0.999 * factor * graph_.cheapest());
  queue.least = layer.empty() ? 0 : *std::min_element(layer.begin(), layer.end());
  queue.settled.assign(layer.size(), 0);
  for (int v = 0; v < graph_.size(); ++v)
    if (layer[v] < unreachable) queue.push(v, layer[v]);
  const float scale = static_cast<float>(factor);
  for (std::size_t b = 0; b < queue.buckets.size(); ++b) {
    if (context.stop()) return false;
    for (std::size_t i = 0; i < queue.buckets[b].size(); ++i) {
      const int place = queue.buckets[b][i];
      if (queue.settled[place] || queue.bucket(layer[place]) != b) continue;
      queue.settled[place] = 1;
      if (!keep(place, layer[place])) {
        layer[place] = -1;  // nothing comes below: it stays settled
        continue;
      }
      for (const PlaceGraph::Edge* e = graph_.begin(place); e != graph_.end(place); ++e) {
        const float through = layer[place] + scale * e->cost;
        if (!(through < layer[e->to])) continue;
        layer[e->to] = through;
        queue.push(e->to, through);
      }
    }
    queue.buckets[b].clear();
  }
  for (float& cost : layer)
    if (cost < 0) cost = unreachable;
  return true;
}

SubsetSearch::Layer SubsetSearch::start_of(Subset s) const {
  Layer layer(graph_.size(), unreachable);
  if (std::has_single_bit(s)) {
    const double factor = weights_.factor(s);
    for (const Entry& e : entries_[std::countr_zero(s)]) layer[e.place] = std::min(layer[e.place], static_cast<float>(factor * e.cost));
  } else {
    merge(s, layer);
  }
  return layer;
}

void SubsetSearch::merge(Subset s, Layer& layer) const {
  const Subset lowest = s & (~s + 1);
  for (Subset a = (s - 1) & s; a; a = (a - 1) & s) {
    if (!(a & lowest)) continue;  // each pair once
    const Layer &one = layers_[a], &two = layers_[s & ~a];
    for (std::size_t v = 0; v < layer.size(); ++v) layer[v] = std::min(layer[v], one[v] + two[v]);
  }
}

bool SubsetSearch::measure_distances(const RunContext& context) {
  distances_.assign(static_cast<std::size_t>(graph_.size()) * count_, unreachable);
  between_.assign(count_ * count_, std::numeric_limits<double>::infinity());
  const int workers = std::min(thread_count(context.threads), count_);
  std::vector<char> done(workers, 1);
  run_workers(workers, [&](int worker) {
    Queue queue;
    for (int t = worker; t < count_; t += workers) {
      Layer layer(graph_.size(), unreachable);
      for (const Entry& e : entries_[t]) layer[e.place] = std::min(layer[e.place], static_cast<float>(e.cost));
      if (!spread(layer, 1, [](int, float) { return true; }, queue, context)) done[worker] = 0;
      for (int v = 0; v < graph_.size(); ++v) distances_[static_cast<std::size_t>(v) * count_ + t] = layer[v];
    }
  });
  for (int a = 0; a < count_; ++a)
    for (int b = 0; b < count_; ++b)
      for (const Entry& e : entries_[b])
        between_[a * count_ + b] = std::min(between_[a * count_ + b], distances_[static_cast<std::size_t>(e.place) * count_ + a] + e.cost);
  return std::all_of(done.begin(), done.end(), [](char d) { return d; });
}

/// The best of all trees that part at one place only.
double SubsetSearch::known_cost() const {
  std::vector<double> factors;
  for (int t = 0; t < count_; ++t) factors.push_back(weights_.factor(Subset(1) << t));
  double best = std::numeric_limits<double>::infinity();
  for (int v = 0; v < graph_.size(); ++v) {
    double sum = 0;
    for (int t = 0; t < count_; ++t) sum += factors[t] * distances_[static_cast<std::size_t>(v) * count_ + t];
    best = std::min(best, sum);
  }
  return best;
}

void SubsetSearch::prepare_bounds() {
  rest_.assign(others() + 1, {});
  for (Subset s = 1; s <= others(); ++s) {
    Rest& rest = rest_[s];
    for (int t = 0; t < count_; ++t) {
      if ((s >> t) & 1) continue;
      rest.members.push_back(t);
      rest.across.push_back(0);
      for (const auto& [a, b] : weights_.wires)
        if ((a == t && ((s >> b) & 1)) || (b == t && ((s >> a) & 1))) ++rest.across.back();
    }
    for (const auto& [a, b] : weights_.wires)
      if (!((s >> a) & 1) && !((s >> b) & 1)) rest.wires += distance(a, b);
    rest.tree = spanning_tree(rest.members, between_, count_);
  }
}

/// What a tree that has joined S with the place needs at least for all that lies outside S. Each wire is no shorter than the
/// way between its ends; and the tree no shorter than half a round trip (of which the least spanning tree of the members
/// and the two shortest ways to the place are a bound), nor than its longest way.
double SubsetSearch::least_more(Subset s, int place) const {
  const Rest& rest = rest_[s];
  const float* to = distances_.data() + static_cast<std::size_t>(place) * count_;
  constexpr double none = std::numeric_limits<double>::infinity();
  double wires = rest.wires, farthest = 0, nearest = none, second = none;
  for (std::size_t i = 0; i < rest.members.size(); ++i) {
    const double way = to[rest.members[i]];
    wires += rest.across[i] * way;
    farthest = std::max(farthest, way);
    second = std::min(second, std::max(nearest, way));
    nearest = std::min(nearest, way);
  }
  const double round = rest.members.size() > 1 ? 0.5 * (rest.tree + nearest + second) : nearest;
  return weights_.bundling * std::max(farthest, round) + (1 - weights_.bundling) * wires;
}

bool SubsetSearch::run(const RunContext& context) {
  prepare_bounds();
  bound_ = known_cost() * (1 + rounding) + rounding * graph_.cheapest();
  layers_.assign(others() + 1, {});
  std::vector<long> labels(others() + 1, 0);
  for (int size = 1; size < count_; ++size) {
    std::vector<Subset> sets;
    for (Subset s = 1; s <= others(); ++s)
      if (std::popcount(s) == size) sets.push_back(s);
    const int workers = std::min(thread_count(context.threads), static_cast<int>(sets.size()));
    std::vector<char> done(workers, 1);
    run_workers(workers, [&](int worker) {
      Queue queue;
      for (std::size_t i = worker; i < sets.size(); i += workers) {
        const Subset s = sets[i];
        layers_[s] = start_of(s);
        const auto keep = [&](int place, float cost) {
          const bool kept = cost + least_more(s, place) <= bound_;
          labels[s] += kept;
          return kept;
        };
        if (!spread(layers_[s], weights_.factor(s), keep, queue, context)) done[worker] = 0;
      }
    });
    if (!std::all_of(done.begin(), done.end(), [](char d) { return d; })) return false;
  }
  for (const long n : labels) labels_ += n;
  find_root_entry();
  return true;
}

void SubsetSearch::find_root_entry() {
  cost_ = std::numeric_limits<double>::infinity();
  const std::vector<Entry>& roots = entries_.back();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double cost = layers_[others()][roots[i].place] + weights_.factor(others()) * roots[i].cost;
    if (cost < cost_) cost_ = cost, root_entry_ = static_cast<int>(i);
  }
}

SubsetSearch::Origin SubsetSearch::origin(Subset s, int place) const {
  const Layer& layer = layers_[s];
  const double factor = weights_.factor(s);
  Origin best;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](double cost, const Origin& origin) {
    if (cost < least) least = cost, best = origin;
  };
  if (std::has_single_bit(s)) {
    const std::vector<Entry>& entries = entries_[std::countr_zero(s)];
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (entries[i].place == place) offer(factor * entries[i].cost, {Origin::Kind::entry, -1, static_cast<int>(i), 0});
  }
  const Subset lowest = s & (~s + 1);
  for (Subset a = (s - 1) & s; a; a = (a - 1) & s)
    if (a & lowest)
      offer(double(layers_[a][place]) + layers_[s & ~a][place], {Origin::Kind::merge, -1, -1, a});
  for (const PlaceGraph::Edge* e = graph_.begin(place); e != graph_.end(place); ++e)
    if (layer[e->to] < layer[place]) offer(layer[e->to] + factor * e->cost, {Origin::Kind::edge, e->to, -1, 0});
  return best;
}

}  // namespace tendril::routing
