#include "method/assembly/board_layout.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril::assembly {

namespace {

// A sector must be narrower than a half plane; and its sides stay free.
constexpr double widest = 0.95 * units::pi, inner_share = 0.8;

struct Sector {
  double low, high;
  double width() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
  double nearest(double angle) const {
    const double half = 0.5 * inner_share * width();
    return middle() + std::clamp(std::remainder(angle - middle(), 2 * units::pi), -half, half);
  }
};

/// A branch as seen from the node that it leaves.
struct Child {
  int piece, node;
  double angle;   ///< as it leaves in the given state
  double weight;  ///< m of rods beyond
};

class Layout {
 public:
  Layout(const BoardGraph& graph, const SystemEquilibrium& state) : graph_(graph), state_(state), places_(graph.nodes.size(), Vec3::Zero()) {}

  std::vector<Vec3> run() {
    const int root = graph_.middle();
    std::vector<Child> children = children_of(root, -1);
    if (children.empty()) return places_;
    std::sort(children.begin(), children.end(), [](const Child& a, const Child& b) { return a.angle < b.angle; });
    std::vector<Sector> sectors = shared({0, 2 * units::pi}, children);
    // The whole is turned to where the branches are.
    double sine = 0, cosine = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      sine += children[i].weight * std::sin(children[i].angle - sectors[i].middle());
      cosine += children[i].weight * std::cos(children[i].angle - sectors[i].middle());
    }
    const double turn = std::atan2(sine, cosine);
    for (std::size_t i = 0; i < children.size(); ++i)
      set(root, children[i], {sectors[i].low + turn, sectors[i].high + turn}, children[i].angle);
    return places_;
  }

 private:
  /// From the node to where the piece is after a fifth of its length.
  double direction(int node, int piece) const {
    const BoardPiece& p = graph_.pieces[piece];
    const double at = p.from == node ? p.begin + 0.2 * p.length() : p.end - 0.2 * p.length();
    const Vec3 away = state_.rods[p.rod].frame_at(at).at - place_of(graph_.nodes[node], state_);
    return std::atan2(away.y(), away.x());
  }

  double weight(int node, int came_by) const {
    double sum = graph_.pieces[came_by].length();
    for (const int piece : graph_.nodes[node].pieces)
      if (piece != came_by) sum += weight(other_end(piece, node), piece);
    return sum;
  }

  int other_end(int piece, int node) const { return graph_.pieces[piece].from == node ? graph_.pieces[piece].to : graph_.pieces[piece].from; }

  std::vector<Child> children_of(int node, int came_by) const {
    std::vector<Child> children;
    for (const int piece : graph_.nodes[node].pieces)
      if (piece != came_by) children.push_back({piece, other_end(piece, node), direction(node, piece), weight(other_end(piece, node), piece)});
    return children;
  }

  /// The sector shared out by weight, in order; none wider than allowed.
  static std::vector<Sector> shared(const Sector& whole, const std::vector<Child>& children) {
    double sum = 0;
    for (const Child& child : children) sum += child.weight;
    std::vector<Sector> sectors;
    double low = whole.low;
    for (const Child& child : children) {
      const double high = low + whole.width() * child.weight / sum, middle = 0.5 * (low + high);
      const double half = std::min(0.5 * (high - low), 0.5 * widest);
      sectors.push_back({middle - half, middle + half});
      low = high;
    }
    return sectors;
  }

  /// `wanted`: the direction of the child's piece on the board, if its sector allows.
  void set(int node, const Child& child, const Sector& sector, double wanted) {
    const double angle = sector.nearest(wanted);
    const double distance = (place_of(graph_.nodes[child.node], state_) - place_of(graph_.nodes[node], state_)).norm();
    places_[child.node] = places_[node] + distance * Vec3(std::cos(angle), std::sin(angle), 0);
    std::vector<Child> next = children_of(child.node, child.piece);
    if (next.empty()) return;
    // Turns from the way on that the piece came.
    const double came = direction(child.node, child.piece) + units::pi;
    for (Child& c : next) c.angle = std::remainder(c.angle - came, 2 * units::pi);
    std::sort(next.begin(), next.end(), [](const Child& a, const Child& b) { return a.angle < b.angle; });
    const std::vector<Sector> sectors = shared(sector, next);
    for (std::size_t i = 0; i < next.size(); ++i) set(child.node, next[i], sectors[i], angle + next[i].angle);
  }

  const BoardGraph& graph_;
  const SystemEquilibrium& state_;
  std::vector<Vec3> places_;
};

}  // namespace

std::vector<Vec3> board_layout(const BoardGraph& graph, const SystemEquilibrium& state) {
  if (graph.has_loop()) return {};
  return Layout(graph, state).run();
}

}  // namespace tendril::assembly
