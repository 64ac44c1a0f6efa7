#include "method/route/harness_variables.h"

#include <algorithm>
#include <cmath>

namespace tendril::routing {

namespace {

using Kind = HarnessVariables::Variable::Kind;

constexpr double shortest = 0.8, longest = 1.3;  // of the design's stretches
constexpr double most_tilt = 0.6;                // rad
constexpr double length_scale = 0.05, tilt_scale = 0.3;

/// The rotation (rad, own axes) that a change w of v is in exp(v).
Vec3 own_turn(const Vec3& v, const Vec3& w) {
  const double angle = v.norm();
  const Vec3 c = v.cross(w), cc = v.cross(c);
  if (angle < 1e-4) return w - 0.5 * c + cc / 6;
  const double half = std::sin(0.5 * angle);
  return w - 2 * half * half / (angle * angle) * c + (angle - std::sin(angle)) / (angle * angle * angle) * cc;
}

}  // namespace

HarnessDesign design_as_routed(const HarnessResult& harness) {
  HarnessDesign design;
  for (const HarnessBranch& branch : harness.branches) design.lengths.push_back(branch.length);
  for (std::size_t j = 0; j < harness.junctions.size(); ++j) {
    std::vector<Frame> sections;
    for (const int b : harness.junctions[j].branches) {
      const Curve curve = harness.branches[b].points.curve();
      const HarnessEnd& from = harness.branches[b].from;
      const bool begins = from.junction && from.number == static_cast<int>(j);
      sections.push_back(curve.at(begins ? 0 : curve.length()));
    }
    const Frame first = sections.front();
    for (Frame& section : sections) section = Frame{Vec3::Zero(), (first.rotation.conjugate() * section.rotation).normalized()};
    design.sections.push_back(std::move(sections));
  }
  return design;
}

HarnessVariables::HarnessVariables(const Scene& scene, const HarnessResult& harness, const HarnessDesign& design) : first_(design) {
  HarnessResult built = harness;
  built.design = design;
  group_.resize(harness.branches.size());
  place_.resize(harness.branches.size());
  const Scene alone = scene_of(scene, built);
  for (Scene::System& system : alone.systems()) {
    for (std::size_t k = 0; k < system.rods.size(); ++k) {
      group_[system.rods[k]] = static_cast<int>(base_.size());
      place_[system.rods[k]] = static_cast<int>(k);
    }
    base_.push_back({std::move(system.problem), std::move(system.rods), std::move(system.branches)});
  }
  for (int b = 0; b < static_cast<int>(harness.branches.size()); ++b) {
    first_stretch_.push_back(size());
    std::vector<Vec3> held;  // places of clips and connections, NaN: a junction
    const auto end = [&](const HarnessEnd& e) { return e.junction ? Vec3(Vec3::Constant(NAN)) : harness.options.connections[e.number].at; };
    std::vector<double> at{0};
    held.push_back(end(harness.branches[b].from));
    for (const HarnessClip& clip : design.clips)
      if (clip.branch == b) at.push_back(clip.at), held.push_back(clip.frame.at);
    at.push_back(design.lengths[b]);
    held.push_back(end(harness.branches[b].to));
    for (int i = 0; i + 1 < static_cast<int>(at.size()); ++i) {
      const double length = at[i + 1] - at[i], chord = (held[i + 1] - held[i]).norm();
      const double lower = chord > shortest * length ? chord : shortest * length;  // no chord: not a number
      variables_.push_back({Kind::stretch, b, i, 0, 0, length, lower, longest * length, length_scale * length});
    }
  }
  for (int j = 0; j < static_cast<int>(harness.junctions.size()); ++j) {
    const std::vector<int>& meeting = harness.junctions[j].branches;
    first_tilt_.emplace_back(meeting.size(), -1);
    for (int k = 2; k < static_cast<int>(meeting.size()); ++k) {
      first_tilt_[j][k] = size();
      for (int axis = 0; axis < 2; ++axis)
        variables_.push_back({Kind::tilt, meeting[k], axis, j, k, 0, -most_tilt, most_tilt, tilt_scale});
    }
  }
}

Eigen::VectorXd HarnessVariables::start() const {
  Eigen::VectorXd x(size());
  for (int v = 0; v < size(); ++v) x[v] = std::clamp(variables_[v].start, variables_[v].lower, variables_[v].upper);
  return x;
}

std::vector<double> HarnessVariables::stops(int branch, const Eigen::VectorXd& x) const {
  std::vector<double> stops{0};
  for (int v = first_stretch_[branch]; v < size(); ++v) {
    if (variables_[v].kind != Kind::stretch || variables_[v].branch != branch) break;
    stops.push_back(stops.back() + x[v]);
  }
  return stops;
}

Vec3 HarnessVariables::tilt(int junction, int section, const Eigen::VectorXd& x) const {
  const int v = first_tilt_[junction][section];
  return v < 0 ? Vec3(Vec3::Zero()) : Vec3(x[v], x[v + 1], 0);
}

HarnessDesign HarnessVariables::design(const Eigen::VectorXd& x) const {
  HarnessDesign out = first_;
  std::size_t clip = 0;
  for (int b = 0; b < static_cast<int>(out.lengths.size()); ++b) {
    const std::vector<double> at = stops(b, x);
    for (std::size_t i = 1; i + 1 < at.size(); ++i) out.clips[clip++].at = at[i];
    out.lengths[b] = at.back();
  }
  for (std::size_t j = 0; j < out.sections.size(); ++j)
    for (std::size_t k = 0; k < out.sections[j].size(); ++k) {
      Quat& turn = out.sections[j][k].rotation;
      turn = (turn * exp_rotation(tilt(static_cast<int>(j), static_cast<int>(k), x))).normalized();
    }
  return out;
}

std::vector<HarnessVariables::Group> HarnessVariables::problems(const Eigen::VectorXd& x) const {
  std::vector<Group> groups = base_;
  const HarnessDesign now = design(x);
  for (Group& group : groups) {
    for (std::size_t k = 0; k < group.branches.size(); ++k) {
      RodProblem& rod = group.problem.rods[k];
      const int b = group.branches[k];
      const double before = first_.lengths[b], length = now.lengths[b];
      for (Hold& hold : rod.holds) {
        if (hold.at >= before) {
          hold.at = length;
          continue;
        }
        for (std::size_t c = 0; c < first_.clips.size(); ++c)
          if (first_.clips[c].branch == b && first_.clips[c].at == hold.at) {
            hold.cut_at = hold.at * length / before;  // the mesh stays: results are smooth in the lengths
            hold.at = now.clips[c].at;
            break;
          }
      }
      rod.rod.length = rod.rod.parts.back().upto = length;
    }
    for (std::size_t j = 0; j < group.junctions.size(); ++j) {
      std::vector<JoinedSection>& sections = group.problem.branches[j].sections;
      for (std::size_t k = 0; k < sections.size(); ++k) {
        const int b = group.branches[sections[k].rod];
        if (sections[k].at > 0) sections[k].at = now.lengths[b];
        sections[k].relative = now.sections[group.junctions[j]][k];
      }
    }
  }
  return groups;
}

std::vector<std::pair<Parameter, double>> HarnessVariables::direction(int variable, const Eigen::VectorXd& x) const {
  const Variable& v = variables_[variable];
  std::vector<std::pair<Parameter, double>> out;
  const Group& group = base_[group_[v.branch]];
  if (v.kind == Kind::stretch) {
    // What comes after the stretch moves along with its end.
    const int rod = place_[v.branch];
    out.push_back({{Parameter::Kind::length, rod}, 1.0});
    const std::vector<Hold>& holds = group.problem.rods[rod].holds;
    std::vector<double> at;
    for (const HarnessClip& clip : first_.clips)
      if (clip.branch == v.branch) at.push_back(clip.at);
    for (std::size_t h = 0; h < holds.size(); ++h) {
      const auto known = std::find(at.begin(), at.end(), holds[h].at);
      if (known != at.end() && known - at.begin() >= v.index) out.push_back({{Parameter::Kind::hold_place, rod, static_cast<int>(h)}, 1.0});
    }
    return out;
  }
  const auto junction = std::find(group.junctions.begin(), group.junctions.end(), v.junction) - group.junctions.begin();
  const Vec3 turn = own_turn(tilt(v.junction, v.section, x), Vec3::Unit(v.index));
  for (int c = 0; c < 3; ++c)
    out.push_back({{Parameter::Kind::joint_orientation, 0, static_cast<int>(junction), v.section, c}, turn[c]});
  return out;
}

std::vector<double> HarnessVariables::moves_along(int variable, int branch, const Eigen::VectorXd& x, const std::vector<double>& s) const {
  const Variable& v = variables_[variable];
  std::vector<double> moves(s.size(), 0.0);
  if (v.kind != Kind::stretch || v.branch != branch) return moves;
  const std::vector<double> at = stops(branch, x);
  const double begin = at[v.index], end = at[v.index + 1];
  for (std::size_t i = 0; i < s.size(); ++i) moves[i] = std::clamp((s[i] - begin) / (end - begin), 0.0, 1.0);
  return moves;
}

}  // namespace tendril::routing
