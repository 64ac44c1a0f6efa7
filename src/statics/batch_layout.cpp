#include "statics/batch_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rod/rotation_log.h"
#include "statics/se3_packs.h"

namespace tendril {
namespace {

constexpr double same_place = 1e-9;  // of the rod's length, as in cutting a rod into segments

/// Arc lengths that must be vertices: both ends, holds, loads, joined sections, parts, breaks of the shape.
void places_of(const SystemProblem& system, int rod, const std::vector<int>& branch, const std::vector<int>& section,
               std::vector<double>& places) {
  const RodProblem& problem = system.rods[rod];
  places.assign({0.0, problem.rod.length});
  for (const Hold& hold : problem.holds) places.push_back(hold.at);
  for (const PointLoad& load : problem.loads) places.push_back(load.at);
  for (std::size_t k = 0; k < branch.size(); ++k) places.push_back(system.branches[branch[k]].sections[section[k]].at);
  for (const RodPart& part : problem.rod.parts) places.push_back(part.upto);
  places.insert(places.end(), problem.rod.shape_breaks.begin(), problem.rod.shape_breaks.end());
  for (double& place : places) place = std::clamp(place, 0.0, problem.rod.length);
}

void put(double* to, const Vec3& v) {
  to[0] = v.x();
  to[1] = v.y();
  to[2] = v.z();
}

void put(double* to, const Quat& q) {
  to[0] = q.w();
  put(to + 1, Vec3(q.vec()));
}

void put(double* to, const Frame& frame) {
  put(to, frame.at);
  put(to + 3, frame.rotation);
}

double stretch_stiffness_of(double h, const Section& section) {
  return h * h * section.EA / (12 * std::min(section.EI1, section.EI2));
}

/// The sets that nodes fall into by the segments between them.
class Groups {
 public:
  explicit Groups(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// False where both were in one set already.
  bool join(int a, int b) {
    a = of(a);
    b = of(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<int> parent_;
};

std::string why_not_rod(const SystemProblem& system, int rod) {
  const RodProblem& problem = system.rods[rod];
  if (problem.surroundings) return "it has contact with its surroundings";
  if (!problem.springs.empty()) return "it has springs";
  for (const PointLoad& load : problem.loads)
    if (!load.moment.isZero(0)) return "it has a dead moment";
  for (const Hold& hold : problem.holds) {
    if (hold.slide) return "it has a clip that slides";
    for (const BranchPoint& branch : system.branches)
      for (const JoinedSection& section : branch.sections)
        if (section.rod == rod && std::abs(section.at - hold.at) <= same_place * problem.rod.length)
          return "a section is both held and joined to a branch point";
  }
  return {};
}

/// Branch points and rods between them must form a forest.
bool has_loops(const SystemProblem& system) {
  const int rods = static_cast<int>(system.rods.size());
  Groups groups(rods + static_cast<int>(system.branches.size()));
  for (std::size_t b = 0; b < system.branches.size(); ++b)
    for (const JoinedSection& section : system.branches[b].sections)
      if (!groups.join(section.rod, rods + static_cast<int>(b))) return true;
  return false;
}

}  // namespace

std::string BatchLayout::why_not(const SystemProblem& problem, const SolveOptions& options) {
  if (options.element != Element::se3) return "batches use the SE(3) element";
  if (!options.stable_only) return "batches look for stable equilibria only";
  for (std::size_t k = 0; k < problem.rods.size(); ++k)
    if (std::string why = why_not_rod(problem, static_cast<int>(k)); !why.empty()) return why;
  for (const BranchPoint& branch : problem.branches)
    if (branch.sections.empty()) return "a branch point joins nothing";
  if (has_loops(problem)) return "rods and branch points form a closed loop";
  return {};
}

BatchLayout::BatchLayout(const SystemProblem& nominal) : nominal_(nominal) {
  rods_.resize(nominal.rods.size());
  nodes_.resize(nominal.branches.size());
  for (std::size_t b = 0; b < nominal.branches.size(); ++b)
    for (std::size_t j = 0; j < nominal.branches[b].sections.size(); ++j) {
      RodPlan& plan = rods_[nominal.branches[b].sections[j].rod];
      plan.joint_branch.push_back(static_cast<int>(b));
      plan.joint_section.push_back(static_cast<int>(j));
    }
  for (int k = 0; k < rods(); ++k) {
    length_ = std::max(length_, nominal.rods[k].rod.length);
    plan_rod(nominal, k);
  }
  plan_holds(nominal);
  plan_segments(nominal);
  for (const BatchNode& node : nodes_)
    if (node.held) unit_quaternions_.push_back(node.target + 3);
  for (const RodPlan& plan : rods_)
    for (const Vertex& vertex : plan.vertices)
      if (vertex.joint >= 0) unit_quaternions_.push_back(vertex.joint + 3);
}

void BatchLayout::plan_rod(const SystemProblem& system, int rod) {
  const RodProblem& problem = system.rods[rod];
  RodPlan& plan = rods_[rod];
  std::vector<double> places;
  places_of(system, rod, plan.joint_branch, plan.joint_section, places);
  std::vector<double> sorted = places, boundaries = {0};
  std::sort(sorted.begin(), sorted.end());
  const double length = problem.rod.length, same = same_place * length;
  for (const double place : sorted)
    if (place > boundaries.back() + same) boundaries.push_back(place);
  boundaries.back() = length;
  for (const double place : places) {
    int nearest = 0;
    for (std::size_t b = 1; b < boundaries.size(); ++b)
      if (std::abs(boundaries[b] - place) < std::abs(boundaries[nearest] - place)) nearest = static_cast<int>(b);
    plan.boundary_of_place.push_back(nearest);
  }
  std::vector<int> vertex_of_boundary = {0};
  for (std::size_t b = 1; b < boundaries.size(); ++b) {
    const double way = boundaries[b] - boundaries[b - 1];
    const int count = std::max(1, static_cast<int>(std::lround(problem.rod.segments * way / length)));
    plan.intervals.push_back({count, parameters_, -1});
    parameters_ += BatchBlocks::stiffness;
    if (problem.rod.shape) {
      plan.intervals.back().rates = parameters_;
      parameters_ += count * BatchBlocks::rates;
    }
    vertex_of_boundary.push_back(vertex_of_boundary.back() + count);
    const Section& section = problem.rod.section_at(0.5 * (boundaries[b] + boundaries[b - 1]));
    stretch_stiffness_ = std::max(stretch_stiffness_, stretch_stiffness_of(way / count, section));
    bending_scale_ = std::min(bending_scale_, std::min(section.EI1, section.EI2) / (length * length));
  }
  plan.vertices.assign(vertex_of_boundary.back() + 1, {-1, -1});
  std::size_t place = 2;
  for (std::size_t k = 0; k < problem.holds.size(); ++k)
    plan.hold_vertex.push_back(vertex_of_boundary[plan.boundary_of_place[place++]]);
  place += problem.loads.size();
  for (const int branch : plan.joint_branch) {
    plan.vertices[vertex_of_boundary[plan.boundary_of_place[place++]]] = {branch, parameters_};
    parameters_ += BatchBlocks::frame;
  }
  for (Vertex& vertex : plan.vertices)
    if (vertex.node < 0) {
      vertex.node = node_count();
      nodes_.emplace_back();
    }
}

void BatchLayout::plan_holds(const SystemProblem& system) {
  auto hold = [&](int node, bool position, bool orientation) {
    if (!position && !orientation) return;
    BatchNode& held = nodes_[node];
    held.held |= (position ? 1 : 0) | (orientation ? 2 : 0);
    if (held.target >= 0) return;
    held.target = parameters_;
    held.held_index = held_++;
    parameters_ += BatchBlocks::frame;
  };
  for (int k = 0; k < rods(); ++k)
    for (std::size_t j = 0; j < system.rods[k].holds.size(); ++j)
      hold(rods_[k].vertices[rods_[k].hold_vertex[j]].node, system.rods[k].holds[j].position,
           system.rods[k].holds[j].orientation);
  for (std::size_t b = 0; b < system.branches.size(); ++b)
    hold(branch_node(static_cast<int>(b)), system.branches[b].position, system.branches[b].orientation);
}

void BatchLayout::plan_segments(const SystemProblem& system) {
  std::vector<BatchSegment> links;
  for (int k = 0; k < rods(); ++k) {
    RodPlan& plan = rods_[k];
    const std::size_t first = links.size();
    for (std::size_t i = 0, v = 0; i < plan.intervals.size(); ++i)
      for (int j = 0; j < plan.intervals[i].count; ++j, ++v) {
        const Interval& interval = plan.intervals[i];
        BatchSegment link;
        link.child = plan.vertices[v].node;  // until the order is known: the start
        link.parent = plan.vertices[v + 1].node;
        link.stiffness = interval.stiffness;
        link.rates = interval.rates < 0 ? -1 : interval.rates + j * BatchBlocks::rates;
        link.start_joint = plan.vertices[v].joint;
        link.end_joint = plan.vertices[v + 1].joint;
        // Inside an interval the terms of both sides cancel.
        link.start_slope = j == 0;
        link.end_slope = j + 1 == interval.count;
        links.push_back(link);
      }
    const RodProblem& problem = system.rods[k];
    std::vector<int> vertex_of_boundary = {0};
    for (const Interval& interval : plan.intervals)
      vertex_of_boundary.push_back(vertex_of_boundary.back() + interval.count);
    for (std::size_t j = 0; j < problem.loads.size(); ++j) {
      const int vertex = vertex_of_boundary[plan.boundary_of_place[2 + problem.holds.size() + j]];
      const bool last = vertex == vertices(k) - 1;
      int& offset = last ? links[first + vertex - 1].end_force : links[first + vertex].start_force;
      if (offset < 0) {
        offset = parameters_;
        parameters_ += BatchBlocks::force;
      }
      plan.load_offset.push_back(offset);
    }
  }
  order(links);
}

/// Depth first from the roots: children before parents, chains in one go.
void BatchLayout::order(const std::vector<BatchSegment>& links) {
  std::vector<std::vector<int>> at(nodes_.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    at[links[i].child].push_back(static_cast<int>(i));
    at[links[i].parent].push_back(static_cast<int>(i));
  }
  struct Visit {
    int node, link;  // the link to the parent; -1: a root
    std::size_t next;
  };
  std::vector<char> seen(nodes_.size(), 0);
  std::vector<int> slot(nodes_.size(), -1), free;
  auto slot_of = [&](int node, bool& fresh) {
    fresh = slot[node] < 0;
    if (fresh && free.empty()) slot[node] = slots_++;
    else if (fresh) {
      slot[node] = free.back();
      free.pop_back();
    }
    return slot[node];
  };
  auto leave = [&](const Visit& visit) {
    if (visit.link < 0) {
      bool fresh;
      roots_.push_back(visit.node);
      root_slots_.push_back(slot_of(visit.node, fresh));
      return;
    }
    BatchSegment segment = links[visit.link];
    segment.reversed = segment.parent == visit.node;
    if (segment.reversed) std::swap(segment.child, segment.parent);
    segment.child_slot = slot_of(segment.child, segment.child_fresh);
    segment.parent_slot = slot_of(segment.parent, segment.parent_fresh);
    free.push_back(segment.child_slot);
    segments_.push_back(segment);
  };
  // Branch points come first among the nodes; a rod without any is begun at its last vertex.
  std::vector<int> starts;
  for (std::size_t b = 0; b < nominal_.branches.size(); ++b) starts.push_back(branch_node(static_cast<int>(b)));
  for (const RodPlan& plan : rods_) starts.push_back(plan.vertices.back().node);
  for (const int start : starts) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::vector<Visit> stack = {{start, -1, 0}};
    while (!stack.empty()) {
      Visit& visit = stack.back();
      if (visit.next == at[visit.node].size()) {
        leave(visit);
        stack.pop_back();
        continue;
      }
      const int link = at[visit.node][visit.next++];
      const int other = links[link].child == visit.node ? links[link].parent : links[link].child;
      if (seen[other]) continue;
      seen[other] = 1;
      stack.push_back({other, link, 0});
    }
  }
}

BatchStructure BatchLayout::structure() const {
  return {segments_.data(),   segment_count(),                   nodes_.data(), node_count(), roots_.data(),
          root_slots_.data(), static_cast<int>(roots_.size()), length_, 1};
}

std::vector<double> BatchLayout::node_frames(const std::vector<std::vector<Frame>>& vertices,
                                             const std::vector<Frame>& branches) const {
  std::vector<double> frames(7 * nodes_.size());
  for (std::size_t k = 0; k < rods_.size(); ++k)
    for (std::size_t v = 0; v < rods_[k].vertices.size(); ++v)
      if (rods_[k].vertices[v].joint < 0) put(&frames[7 * rods_[k].vertices[v].node], vertices[k][v]);
  for (std::size_t b = 0; b < branches.size(); ++b) put(&frames[7 * branch_node(static_cast<int>(b))], branches[b]);
  return frames;
}

std::vector<BatchLayout::Number> BatchLayout::numbers() const {
  std::vector<Number> all;
  auto plain = [&](int offset, int count, double scale) {
    for (int i = 0; i < count; ++i) all.push_back({offset + i, -1, scale});
  };
  auto frame = [&](int offset) {
    plain(offset, 3, length_);
    for (int axis = 0; axis < 3; ++axis) all.push_back({offset + 3, axis, 1});
  };
  std::vector<double> nominal(parameters_);
  read(nominal_, nominal.data());
  for (int k = 0; k < rods(); ++k) {
    const double length = nominal_.rods[k].rod.length;
    for (const Interval& interval : rods_[k].intervals) {
      const double* own = &nominal[interval.stiffness];
      for (int i = 0; i < 7; ++i) plain(interval.stiffness + i, 1, own[i]);
      const double stiffness = 1 / (std::max(own[4], own[5]) * length * length);
      plain(interval.stiffness + 7, 3, stiffness / length);
      for (int i = 0; interval.rates >= 0 && i < interval.count; ++i) {
        plain(interval.rates + i * BatchBlocks::rates, 3, 1);
        plain(interval.rates + i * BatchBlocks::rates + 3, 3, 1 / length);
        plain(interval.rates + i * BatchBlocks::rates + 6, 3, 1 / (length * length));
      }
    }
    for (const Vertex& vertex : rods_[k].vertices)
      if (vertex.joint >= 0) frame(vertex.joint);
    std::vector<int> loads = rods_[k].load_offset;
    std::sort(loads.begin(), loads.end());
    loads.erase(std::unique(loads.begin(), loads.end()), loads.end());
    for (const int load : loads)
      plain(load, 3, 1 / (nominal[rods_[k].intervals[0].stiffness + 4] * length * length));
  }
  for (const BatchNode& node : nodes_)
    if (node.held) frame(node.target);
  return all;
}

std::vector<BatchLayout::SegmentPlace> BatchLayout::segment_places(int rod) const {
  std::vector<SegmentPlace> places;
  for (const Interval& interval : rods_[rod].intervals)
    for (int i = 0; i < interval.count; ++i)
      places.push_back({interval.stiffness, interval.rates < 0 ? -1 : interval.rates + i * BatchBlocks::rates});
  return places;
}

std::vector<double> BatchLayout::arc_lengths(int rod, const double* parameters) const {
  std::vector<double> s = {0};
  for (const Interval& interval : rods_[rod].intervals) {
    const double from = s.back(), h = parameters[interval.stiffness];
    for (int i = 1; i <= interval.count; ++i) s.push_back(from + i * h);
  }
  return s;
}

// ---------------------------------------------------------------- reading an outcome

bool BatchLayout::same_structure(const SystemProblem& problem) const {
  if (problem.rods.size() != nominal_.rods.size() || problem.branches.size() != nominal_.branches.size()) return false;
  for (std::size_t b = 0; b < problem.branches.size(); ++b) {
    const BranchPoint &own = problem.branches[b], &nominal = nominal_.branches[b];
    if (own.position != nominal.position || own.orientation != nominal.orientation ||
        own.sections.size() != nominal.sections.size())
      return false;
    for (std::size_t j = 0; j < own.sections.size(); ++j)
      if (own.sections[j].rod != nominal.sections[j].rod) return false;
  }
  for (std::size_t k = 0; k < problem.rods.size(); ++k) {
    const RodProblem &own = problem.rods[k], &nominal = nominal_.rods[k];
    if (own.surroundings || !own.springs.empty() || own.rod.segments != nominal.rod.segments || own.holds.size() != nominal.holds.size() ||
        own.loads.size() != nominal.loads.size() || own.rod.parts.size() != nominal.rod.parts.size() ||
        own.rod.shape_breaks.size() != nominal.rod.shape_breaks.size() || !own.rod.shape != !nominal.rod.shape)
      return false;
    for (std::size_t j = 0; j < own.holds.size(); ++j) {
      const Hold &hold = own.holds[j], &was = nominal.holds[j];
      if (hold.position != was.position || hold.orientation != was.orientation || hold.slide || hold.turns != was.turns)
        return false;
    }
    for (const PointLoad& load : own.loads)
      if (!load.moment.isZero(0)) return false;
  }
  return true;
}

bool BatchLayout::read_intervals(const RodProblem& problem, const RodPlan& plan, const std::vector<double>& boundaries,
                                 double* to) const {
  const Rod& rod = problem.rod;
  Frame before = rod.shape ? rod.shape(0) : Frame{};
  for (std::size_t i = 0; i < plan.intervals.size(); ++i) {
    const Interval& interval = plan.intervals[i];
    const double from = boundaries[i], way = boundaries[i + 1] - from, h = way / interval.count;
    const Section& section = rod.section_at(from + 0.5 * way);
    double* out = to + interval.stiffness;
    out[0] = h;
    const double stiffness[6] = {section.GA1, section.GA2, section.EA, section.EI1, section.EI2, section.GJ};
    for (int j = 0; j < 6; ++j) {
      if (!(stiffness[j] > 0)) return false;
      out[1 + j] = 1 / stiffness[j];
    }
    if (!(section.mass >= 0)) return false;
    put(out + 7, section.mass * problem.gravity);
    for (int j = 0; interval.rates >= 0 && j < interval.count; ++j) {
      const Frame after = rod.shape(from + way * (j + 1) / interval.count);
      const Frame relative = before.inverse() * after;
      const Quat middle = rod.shape(from + way * (j + 0.5) / interval.count).rotation;
      const Vec3 slope = reference_slope({0, h, section, relative, before.rotation.conjugate() * middle});
      before = after;
      JacobianCoefficients<double> k;
      const Quat& q = relative.rotation;
      const V3<double> phi = rotation_log<double>({q.w(), {q.x(), q.y(), q.z()}}, k);
      const V3<double> v =
          inverse_left_jacobian(phi, k.c) * V3<double>{relative.at.x(), relative.at.y(), relative.at.z()};
      double* rates = to + interval.rates + j * BatchBlocks::rates;
      put(rates, Vec3(v.x, v.y, v.z) / h);
      put(rates + 3, Vec3(phi.x, phi.y, phi.z) / h);
      put(rates + 6, slope);
    }
  }
  return true;
}

bool BatchLayout::read_rod(const SystemProblem& system, int index, double* to, std::vector<double>& places) const {
  const RodProblem& problem = system.rods[index];
  const RodPlan& plan = rods_[index];
  const double length = problem.rod.length, same = same_place * length;
  if (!(length > 0 && std::isfinite(length))) return false;
  places_of(system, index, plan.joint_branch, plan.joint_section, places);
  std::vector<double>& boundaries = places;  // the first place of each boundary comes first: see below
  double at[64];
  std::vector<double> many;
  const std::size_t count = plan.intervals.size() + 1;
  double* boundary = at;
  if (count > 64) {
    many.resize(count);
    boundary = many.data();
  }
  std::fill(boundary, boundary + count, -1.0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    double& here = boundary[plan.boundary_of_place[k]];
    if (here < 0) here = places[k];
    else if (!(std::abs(here - places[k]) <= same)) return false;
  }
  for (std::size_t b = 1; b < count; ++b)
    if (!(boundary[b] > boundary[b - 1] + same)) return false;
  boundaries.assign(boundary, boundary + count);
  if (!read_intervals(problem, plan, boundaries, to)) return false;
  // The checks of RodProblem::check() that varied numbers can fail.
  double softest = INFINITY;
  for (const RodPart& part : problem.rod.parts) softest = std::min(softest, part.section.EA);
  if (!(problem.rod.mass() * problem.gravity.norm() <= softest)) return false;
  for (const int offset : plan.load_offset) std::fill_n(to + offset, 3, 0.0);
  for (std::size_t k = 0; k < problem.loads.size(); ++k)
    for (int j = 0; j < 3; ++j) to[plan.load_offset[k] + j] += problem.loads[k].force[j];
  for (std::size_t k = 0; k < plan.joint_branch.size(); ++k) {
    const JoinedSection& section = system.branches[plan.joint_branch[k]].sections[plan.joint_section[k]];
    const int place = plan.boundary_of_place[2 + problem.holds.size() + problem.loads.size() + k];
    int vertex = 0;
    for (int i = 0; i < place; ++i) vertex += plan.intervals[i].count;
    put(to + plan.vertices[vertex].joint, section.relative);
  }
  return true;
}

void BatchLayout::read_holds(const SystemProblem& system, double* to) const {
  auto hold = [&](int node, const Frame& frame, bool position, bool orientation) {
    double* out = to + nodes_[node].target;
    if (position) put(out, frame.at);
    if (orientation) put(out + 3, frame.rotation);
  };
  for (const BatchNode& node : nodes_)
    if (node.held) put(to + node.target, Frame{});
  for (int k = 0; k < rods(); ++k)
    for (std::size_t j = 0; j < system.rods[k].holds.size(); ++j) {
      const Hold& own = system.rods[k].holds[j];
      hold(rods_[k].vertices[rods_[k].hold_vertex[j]].node, own.frame, own.position, own.orientation);
    }
  for (std::size_t b = 0; b < system.branches.size(); ++b) {
    const BranchPoint& own = system.branches[b];
    if (own.position || own.orientation) hold(branch_node(static_cast<int>(b)), own.frame, own.position, own.orientation);
  }
}

bool BatchLayout::read(const SystemProblem& problem, double* parameters) const {
  if (!same_structure(problem)) return false;
  std::vector<double> places;
  places.reserve(32);
  for (int k = 0; k < rods(); ++k)
    if (!read_rod(problem, k, parameters, places)) return false;
  read_holds(problem, parameters);
  for (const int offset : unit_quaternions_) {
    const double* q = parameters + offset;
    if (!(std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) < 1e-9)) return false;
  }
  double finite = 0;
  for (int i = 0; i < parameters_; ++i) finite += 0 * parameters[i];
  return finite == 0;
}

}  // namespace tendril
