#include "method/route/harness_shape.h"

#include <algorithm>
#include <array>

#include "base/units.h"

namespace tendril::routing {

namespace {

double length_of(const std::vector<Vec3>& path) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += (path[i + 1] - path[i]).norm();
  return sum;
}

/// From the first point of a path towards what is `reach` (m) along it.
Vec3 heading(const std::vector<Vec3>& path, double reach) {
  Vec3 at = path.back();
  double gone = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double edge = (path[i + 1] - path[i]).norm();
    if (gone + edge >= reach && edge > 0) {
      at = path[i] + (reach - gone) / edge * (path[i + 1] - path[i]);
      break;
    }
    gone += edge;
  }
  const Vec3 way = at - path.front();
  return way.norm() > 0 ? Vec3(way.normalized()) : Vec3(Vec3::UnitX());
}

bool is_at(const HarnessEnd& end, int junction) { return end.junction && end.number == junction; }

/// Takes the branch out: its path goes on in all others that meet its second junction.
void contract(HarnessShape& shape, int gone) {
  const ShapeBranch taken = shape.branches[gone];
  shape.branches.erase(shape.branches.begin() + gone);
  const int from = taken.from.number, to = taken.to.number;
  for (ShapeBranch& branch : shape.branches) {
    if (is_at(branch.from, to)) {
      branch.path.insert(branch.path.begin(), taken.path.begin(), taken.path.end() - 1);
      branch.from.number = from;
    } else if (is_at(branch.to, to)) {
      branch.path.insert(branch.path.end(), taken.path.rbegin() + 1, taken.path.rend());
      branch.to.number = from;
    }
  }
  shape.junctions.erase(shape.junctions.begin() + to);
  for (ShapeBranch& branch : shape.branches)
    for (HarnessEnd* end : {&branch.from, &branch.to})
      if (end->junction && end->number > to) --end->number;
}

/// The branches that meet at a junction and where their paths lead.
void find_branches(HarnessShape& shape, int junction, double reach) {
  ShapeJunction& j = shape.junctions[junction];
  for (std::size_t b = 0; b < shape.branches.size(); ++b) {
    std::vector<Vec3> path = shape.branches[b].path;
    if (is_at(shape.branches[b].to, junction)) std::reverse(path.begin(), path.end());
    else if (!is_at(shape.branches[b].from, junction)) continue;
    j.branches.push_back(static_cast<int>(b));
    j.leaving.push_back(heading(path, reach));
    j.at = path.front();
  }
}

}  // namespace

Ends HarnessShape::ends(int branch, const std::vector<Frame>& connections) const {
  const ShapeBranch& b = branches[branch];
  const auto place = [&](const HarnessEnd& end) { return end.junction ? junctions[end.number].at : connections[end.number].at; };
  const auto out = [&](const HarnessEnd& end) -> Vec3 {
    if (!end.junction) return connections[end.number].d3();
    const ShapeJunction& j = junctions[end.number];
    return j.leaving[std::find(j.branches.begin(), j.branches.end(), branch) - j.branches.begin()];
  };
  return {place(b.from), out(b.from), place(b.to), -out(b.to)};
}

double HarnessShape::cost() const {
  double sum = 0;
  for (const ShapeBranch& branch : branches) sum += branch.factor * branch.points.length();
  return sum;
}

EndCones HarnessShape::cones(int branch, double cone) const {
  return {branches[branch].from.junction ? cone : 0, branches[branch].to.junction ? cone : 0};
}

EndCones HarnessShape::cones(int branch) const {
  const auto of = [&](const HarnessEnd& end) {
    if (!end.junction) return 0.0;
    const std::vector<int>& meeting = junctions[end.number].branches;
    return meeting[0] == branch || meeting[1] == branch ? 0.0 : units::pi;
  };
  return {of(branches[branch].from), of(branches[branch].to)};
}

void HarnessShape::take_directions() {
  for (std::size_t number = 0; number < junctions.size(); ++number) {
    ShapeJunction& j = junctions[number];
    for (std::size_t k = 2; k < j.branches.size(); ++k) j.leaving[k] = out_of(j.branches[k], static_cast<int>(number));
  }
}

Vec3 HarnessShape::out_of(int number, int junction) const {
  const ShapeBranch& branch = branches[number];
  const std::vector<Vec3> along = edge_directions(branch.points.points);
  return is_at(branch.from, junction) ? along.front() : Vec3(-along.back());
}

void HarnessShape::choose_trunks() {
  for (std::size_t number = 0; number < junctions.size(); ++number) {
    ShapeJunction& j = junctions[number];
    for (std::size_t k = 0; k < j.branches.size(); ++k) j.leaving[k] = out_of(j.branches[k], static_cast<int>(number));
    std::size_t one = 0, two = 1;
    for (std::size_t a = 0; a < j.leaving.size(); ++a)
      for (std::size_t b = a + 1; b < j.leaving.size(); ++b)
        if (j.leaving[a].dot(j.leaving[b]) < j.leaving[one].dot(j.leaving[two]) - 1e-9) one = a, two = b;
    for (const auto& [to, from] : {std::array{std::size_t(0), one}, std::array{std::size_t(1), two}}) {
      std::swap(j.branches[to], j.branches[from]);
      std::swap(j.leaving[to], j.leaving[from]);
    }
    const Vec3 through = j.leaving[0] - j.leaving[1];
    if (through.norm() > 1e-6) j.leaving[0] = through.normalized();
    j.leaving[1] = -j.leaving[0];
  }
}

HarnessShape shape_of(const Roadmap& roadmap, const HarnessTree& tree, const HarnessOptions& options, const std::vector<Vec3>& tips,
                      double least) {
  HarnessShape shape;
  const int connections = static_cast<int>(options.connections.size());
  shape.junctions.resize(tree.junctions.size());
  const auto end_of = [&](int end) { return end < connections ? HarnessEnd{false, end} : HarnessEnd{true, end - connections}; };
  for (const TreeBranch& branch : tree.branches) {
    ShapeBranch b{end_of(branch.from), end_of(branch.to), branch.wires, 1, {}, {}};
    b.factor = options.bundling + (1 - options.bundling) * static_cast<double>(branch.wires.size());
    if (!b.from.junction) b.path = {options.connections[b.from.number].at, tips[b.from.number]};
    for (const int node : branch.nodes) b.path.push_back(roadmap.place(node));
    if (!b.to.junction) b.path.insert(b.path.end(), {tips[b.to.number], options.connections[b.to.number].at});
    shape.branches.push_back(std::move(b));
  }
  for (std::size_t b = 0; b < shape.branches.size();) {
    const ShapeBranch& branch = shape.branches[b];
    if (branch.from.junction && branch.to.junction && length_of(branch.path) < least) contract(shape, static_cast<int>(b)), b = 0;
    else ++b;
  }
  for (std::size_t j = 0; j < shape.junctions.size(); ++j)
    find_branches(shape, static_cast<int>(j), 2 * options.min_bend_radius + options.end_straight);
  return shape;
}

PccDemands demands_of(const HarnessOptions& options, const ShapeBranch& branch, const EndCones& cones) {
  PccDemands demands;
  demands.radii = {options.min_bend_radius};
  demands.min_straight = options.min_straight;
  demands.end_straight = options.end_straight;
  demands.free_ends = options.free_ends;
  demands.free_start = !branch.from.junction;
  demands.free_finish = !branch.to.junction;
  demands.start_cone = cones.from;
  demands.finish_cone = cones.to;
  return demands;
}

}  // namespace tendril::routing
