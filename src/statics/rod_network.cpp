#include "statics/rod_network.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

/// Arc lengths of one rod's sections that belong to branch points, in the order of the branch points.
std::vector<double> joined_places(const SystemProblem& problem, int rod) {
  std::vector<double> places;
  for (const BranchPoint& branch : problem.branches)
    for (const JoinedSection& section : branch.sections)
      if (section.rod == rod) places.push_back(section.at);
  return places;
}

}  // namespace

RodNetwork::RodNetwork(const SystemProblem& problem, const SolveOptions& options, const std::vector<int>& segments,
                       int refinement)
    : problem_(problem), joints_({}, pattern_) {
  for (int k = 0; k < static_cast<int>(problem_.rods.size()); ++k) {
    const RodProblem& rod = problem_.rods[k];
    RodMesh mesh = cut_into_segments(rod, segments[k], refinement, joined_places(problem_, k));
    rods_.push_back({make_rod_system(rod, options, std::move(mesh)), pattern_.nodes});
    const int first = pattern_.nodes;
    pattern_.nodes += rods_.back().system->nodes();
    for (int i = first; i < pattern_.nodes; ++i)
      pattern_.edges.push_back(i + 1 < pattern_.nodes ? BlockPattern::Edge{i, i + 1} : BlockPattern::Edge{});
  }
  pattern_.nodes += static_cast<int>(problem_.branches.size());
  joints_ = Joints(place_joints(), pattern_);
  collect_holds();
  collect_shift_weights();
}

std::vector<Joints::Joint> RodNetwork::place_joints() {
  std::vector<Joints::Joint> joints;
  std::vector<int> seen(rods_.size(), 0);
  for (int b = 0; b < static_cast<int>(problem_.branches.size()); ++b)
    for (const JoinedSection& section : problem_.branches[b].sections) {
      const Part& part = rods_[section.rod];
      const int vertex = part.system->mesh().joint_vertex[seen[section.rod]++];
      const RodSystem::SectionNodes at = part.system->section_at(vertex);
      const int position = part.first_node + at.position, rotation = part.first_node + at.rotation;
      if (position == rotation) {
        joints.push_back({position, held_all, branch_node(b), section.relative});
        continue;
      }
      joints.push_back({position, held_position, branch_node(b), section.relative});
      joints.push_back({rotation, held_rotation, branch_node(b), section.relative});
    }
  return joints;
}

void RodNetwork::collect_holds() {
  held_.assign(nodes(), 0);
  for (const Part& part : rods_) {
    std::copy(part.system->held().begin(), part.system->held().end(), held_.begin() + part.first_node);
    for (RodSystem::Target target : part.system->targets()) {
      target.node += part.first_node;
      targets_.push_back(target);
    }
  }
  for (int b = 0; b < static_cast<int>(problem_.branches.size()); ++b) {
    const BranchPoint& branch = problem_.branches[b];
    const int mask = (branch.position ? held_position : 0) | (branch.orientation ? held_rotation : 0);
    if (mask == 0) continue;
    held_[branch_node(b)] = static_cast<HeldMask>(mask);
    targets_.push_back({branch_node(b), static_cast<HeldMask>(mask), branch.frame});
  }
  std::vector<std::vector<int>> at_node(nodes());
  for (int e = 0; e < static_cast<int>(pattern_.edges.size()); ++e)
    for (const int node : {pattern_.edges[e].a, pattern_.edges[e].b})
      if (node >= 0 && held_[node]) at_node[node].push_back(e);
  std::vector<char> has_target(nodes(), 0);
  for (const RodSystem::Target& target : targets_) {
    target_edges_.push_back(at_node[target.node]);
    has_target[target.node] |= target.mask;
  }
  for (int i = 0; i < nodes(); ++i)
    if (held_[i] & ~has_target[i]) dummies_.push_back(i);
}

void RodNetwork::collect_shift_weights() {
  shift_weights_.assign(nodes(), {0, 0});
  for (const Part& part : rods_) {
    size_ = std::max(size_, part.system->length());
    const double scale = part.system->bending_scale(), length = part.system->length();
    for (int i = 0; i < part.system->nodes(); ++i) {
      const double rotation = scale * part.system->node_length()[i];
      shift_weights_[part.first_node + i] = {0.01 * rotation / (length * length), rotation};
    }
  }
  for (const Joints::Joint& joint : joints_.all()) {
    if (joint.part & held_position) shift_weights_[joint.branch].position += shift_weights_[joint.section].position;
    if (joint.part & held_rotation) shift_weights_[joint.branch].rotation += shift_weights_[joint.section].rotation;
  }
}

double RodNetwork::neutral_shift() const {
  double largest = 0;
  for (const Part& part : rods_) largest = std::max(largest, part.system->neutral_shift());
  return largest;
}

RodState RodNetwork::state_from(const std::vector<std::vector<Frame>>& vertices, const std::vector<Frame>& branches) const {
  RodState state;
  state.r.reserve(nodes());
  state.q.reserve(nodes());
  for (int k = 0; k < rods(); ++k) {
    const RodState part = rods_[k].system->state_from(vertices[k]);
    state.r.insert(state.r.end(), part.r.begin(), part.r.end());
    state.q.insert(state.q.end(), part.q.begin(), part.q.end());
  }
  for (const Frame& frame : branches) {
    state.r.push_back(frame.at);
    state.q.push_back(frame.rotation);
  }
  joints_.put_in_place(state);
  return state;
}

Frame RodNetwork::branch_frame(int branch, const RodState& state) const {
  return {state.r[branch_node(branch)], state.q[branch_node(branch)]};
}

double RodNetwork::assemble(const RodState& state, Stress stress, BlockSystem& system) {
  system.resize(nodes(), static_cast<int>(pattern_.edges.size()));
  double energy = 0;
  int end = 0;
  for (const Part& part : rods_) {
    energy += part.system->assemble({state, part.first_node}, stress, {system, part.first_node});
    end = part.first_node + part.system->nodes();
  }
  for (int i = end; i < nodes(); ++i) {
    system.gradient[i].setZero();
    system.diagonal[i].setZero();
  }
  for (std::size_t e = end; e < system.upper.size(); ++e) system.upper[e].setZero();
  return energy;
}

double RodNetwork::gradient(const RodState& state, std::vector<Vec6>& gradient) {
  gradient.assign(nodes(), Vec6::Zero());
  double energy = 0;
  for (const Part& part : rods_)
    energy += part.system->gradient({state, part.first_node}, gradient.data() + part.first_node);
  return energy;
}

void RodNetwork::apply(RodState& state, const std::vector<Vec6>& step, double share) const {
  state.apply(step, share);
  joints_.put_in_place(state);
}

void RodNetwork::predict(const std::vector<Vec6>& step, double share) {
  for (const Part& part : rods_) part.system->predict(step.data() + part.first_node, share);
  joints_.predict(step);
}

double RodNetwork::size_of(const std::vector<Vec6>& step) const {
  double turn = 0, move = 0;
  bool finite = true;
  for (const Part& part : rods_) {
    double here = 0;
    for (int i = part.first_node; i < part.first_node + part.system->nodes(); ++i) {
      finite = finite && all_finite(step[i]);
      here = std::max(here, step[i].head<3>().squaredNorm());
      turn = std::max(turn, step[i].tail<3>().squaredNorm());
    }
    move = std::max(move, here / (part.system->length() * part.system->length()));
  }
  return finite ? std::sqrt(std::max(turn, move)) : INFINITY;
}

bool RodNetwork::has_moments() const {
  return std::any_of(rods_.begin(), rods_.end(), [](const Part& part) { return part.system->has_moments(); });
}

void RodNetwork::scale_moments(double share) {
  for (const Part& part : rods_) part.system->scale_moments(share);
}

std::vector<RodSystem::MomentTerm> RodNetwork::moment_terms(const RodState& state) const {
  std::vector<RodSystem::MomentTerm> terms;
  for (const Part& part : rods_)
    for (RodSystem::MomentTerm term : part.system->moment_terms({state, part.first_node})) {
      term.node += part.first_node;
      for (const Joints::Joint& joint : joints_.all())
        if (joint.section == term.node && (joint.part & held_rotation)) {
          term.body_moment = joint.relative.rotation * term.body_moment;
          term.node = joint.branch;
        }
      if (!(held_[term.node] & held_rotation)) terms.push_back(term);
    }
  return terms;
}

double RodNetwork::false_stress() const {
  double largest = 0;
  for (const Part& part : rods_) largest = std::max(largest, part.system->false_stress());
  return largest;
}

double RodNetwork::stretch_stiffness() const {
  double largest = 0;
  for (const Part& part : rods_) largest = std::max(largest, part.system->stretch_stiffness());
  return largest;
}

void RodNetwork::cap_stretch_stiffness(double limit) {
  for (const Part& part : rods_) part.system->cap_stretch_stiffness(limit);
}

}  // namespace tendril
