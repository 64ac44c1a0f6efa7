#include "method/route/design_space.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "method/route/straight_finish.h"
#include "scene/formed_rod.h"

namespace tendril::routing {
namespace {

using Kind = DesignSpace::Variable::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const std::string& what) { throw UsageError("refine: " + what); }

void check_number(const char* name, double value, double least, bool may_be_infinite = false) {
  if (value >= least && (std::isfinite(value) || may_be_infinite)) return;
  refuse("'" + std::string(name) + "' is " + number_text(value) + ", expected " +
         (least > 0 ? "a number above 0" : "a number of at least 0"));
}

void check_options(const RefinementOptions& o) {
  check_number("length_weight", o.length_weight, 0);
  check_number("clearance_weight", o.clearance_weight, 0);
  check_number("preference_weight", o.preference_weight, 0);
  check_number("range", o.range, std::numeric_limits<double>::min());
  check_number("min_bend_radius", o.min_bend_radius, 0);
  check_number("clearance", o.clearance, 0);
  check_number("max_tension", o.max_tension, std::numeric_limits<double>::min(), true);
  check_number("max_strain", o.max_strain, std::numeric_limits<double>::min(), true);
  check_number("free_ends", o.free_ends, 0);
  check_number("free_clips", o.free_clips, 0);
  check_number("max_turn", o.max_turn, 0);
  check_number("max_tilt", o.max_tilt, 0);
  check_number("max_shift", o.max_shift, 0);
  check_number("tolerance", o.tolerance, std::numeric_limits<double>::min());
  check_number("clip_reach", o.clip_reach, 0);
  if (o.min_length) check_number("min_length", *o.min_length, std::numeric_limits<double>::min());
  if (o.max_length) check_number("max_length", *o.max_length, std::numeric_limits<double>::min());
  if (o.min_length && o.max_length && *o.min_length > *o.max_length)
    refuse("'min_length' is " + number_text(*o.min_length) + " m, above 'max_length' of " + number_text(*o.max_length) + " m");
  if (o.length_weight + o.clearance_weight + o.preference_weight == 0) refuse("all weights are 0; one above 0 expected");
  if (o.max_turn > 3.1) refuse("'max_turn' is " + number_text(o.max_turn) + " rad, expected less than half a turn");
  if (o.max_tilt > 1.5) refuse("'max_tilt' is " + number_text(o.max_tilt) + " rad, expected less than a right angle");
  if (o.max_evaluations < 0 || o.most_clips < 0) refuse("'max_evaluations' and 'most_clips' must not be negative");
  if (o.solve.element != Element::se3) refuse("the rod must be one of se3 elements: staggered ones have no sensitivities");
}

Vec3 tilt_vector(const Frame& frame, double about_d1, double about_d2) { return about_d1 * frame.d1() + about_d2 * frame.d2(); }

/// d/da of exp(v + a w) exp(v)^-1 at a = 0: the rotation (rad, world axes) that a change of the rotation vector is.
Vec3 turn_by_vector(const Vec3& v, const Vec3& w) {
  const double angle = v.norm();
  const Vec3 c = v.cross(w), cc = v.cross(c);
  if (angle < 1e-4) return w + 0.5 * c + cc / 6;
  const double half = std::sin(0.5 * angle);
  return w + 2 * half * half / (angle * angle) * c + (angle - std::sin(angle)) / (angle * angle * angle) * cc;
}

}  // namespace

DesignSpace::DesignSpace(const Design& design, const RefinementOptions& options) : first_(design), options_(options) {
  std::stable_sort(first_.clips.begin(), first_.clips.end(), [](const Hold& a, const Hold& b) { return a.at < b.at; });
  check();
  list_spans();
  list_variables();
}

void DesignSpace::check() const {
  check_options(options_);
  first_.rod.check();
  for (const Hold& clip : first_.clips) {
    if (!(clip.at > 0 && clip.at < first_.rod.length))
      refuse("a clip at " + number_text(clip.at) + " m is not inside the rod, which is " + number_text(first_.rod.length) + " m long");
    if (!clip.position) refuse("a clip must hold the position of its section");
  }
  if (!std::isfinite(first_.turns)) refuse("'turns' is not a finite number");
  problem(first_, Vec3::Zero()).check();
  if (options_.adjust.length && first_.rod.shape) check_straight_finish(first_.rod);
}

void DesignSpace::list_spans() {
  const RodProblem problem = this->problem(first_, Vec3::Zero());
  Span span;
  for (int k = 1; k < static_cast<int>(problem.holds.size()); ++k) {
    span.chord += (problem.holds[k].frame.at - problem.holds[k - 1].frame.at).norm();
    span.end = k;
    if (problem.holds[k].slide) continue;
    spans_.push_back(span);
    span = {k, k, 0};
  }
}

void DesignSpace::add_tilts(const std::string& name, Kind kind) {
  for (int axis = 0; axis < 2; ++axis)
    variables_.push_back({kind, axis, name + ".tilt." + std::to_string(axis + 1), "rad", 0, -options_.max_tilt, options_.max_tilt,
                          0.2});
}

void DesignSpace::list_variables() {
  const double length = first_.rod.length;
  if (options_.adjust.length) {
    double chords = 0;
    for (const Span& span : spans_) chords += span.chord;
    const double shortest = first_.rod.shape ? length - 0.95 * straight_finish(*curve_of(first_.rod)) : 1e-3 * length;
    const double past_clips = first_.clips.empty() ? 0 : first_.clips.back().at + 1e-3 * length;
    const double lower = std::max({options_.min_length.value_or(chords), shortest, past_clips});
    const double upper = options_.max_length.value_or(std::max(2 * length, 1.2 * lower));
    if (lower > upper)
      refuse("no length is possible: at most " + number_text(upper) + " m are asked for, at least " + number_text(lower) +
             " m are needed from hold to hold" + (first_.rod.shape ? " and for the shape's bends" : ""));
    variables_.push_back({Kind::length, 0, "length", "m", length, lower, upper, 0.2 * length});
  }
  if (options_.adjust.from_turn)
    variables_.push_back({Kind::from_turn, 0, "from.turn", "rad", 0, -options_.max_turn, options_.max_turn, 1});
  if (options_.adjust.to_turn)
    variables_.push_back({Kind::to_turn, 0, "to.turn", "rad", 0, -options_.max_turn, options_.max_turn, 1});
  if (options_.adjust.from_tilt) add_tilts("from", Kind::from_tilt);
  if (options_.adjust.to_tilt) add_tilts("to", Kind::to_tilt);
  for (int k = 0; options_.adjust.clips && k < static_cast<int>(first_.clips.size()); ++k) {
    const double at = first_.clips[k].at, room = 1e-3 * length;
    if (first_.clips[k].slide) continue;
    variables_.push_back({Kind::clip, k, "clip." + std::to_string(k + 1), "m", at, std::max(room, at - options_.max_shift),
                          at + options_.max_shift, 0.1 * length});
  }
}

double DesignSpace::value(const Eigen::VectorXd& x, Kind kind, int index, double otherwise) const {
  for (int j = 0; j < size(); ++j)
    if (variables_[j].kind == kind && variables_[j].index == index) return x[j];
  return otherwise;
}

Frame DesignSpace::turned(const Frame& frame, const Eigen::VectorXd& x, Kind turn, Kind tilt) const {
  const Vec3 lean = tilt_vector(frame, value(x, tilt, 0, 0), value(x, tilt, 1, 0));
  return {frame.at, (exp_rotation(lean) * frame.rotation * exp_rotation(value(x, turn, 0, 0) * Vec3::UnitZ())).normalized()};
}

bool DesignSpace::in_order(const Eigen::VectorXd& x) const {
  const double length = value(x, Kind::length, 0, first_.rod.length), apart = 1e-4 * first_.rod.length;
  double last = 0;
  for (std::size_t k = 0; k < first_.clips.size(); ++k) {
    const double at = value(x, Kind::clip, static_cast<int>(k), first_.clips[k].at);
    if (!(at >= last + apart)) return false;
    last = at;
  }
  return length >= last + apart;
}

Design DesignSpace::design(const Eigen::VectorXd& x) const {
  Design out = first_;
  const double length = value(x, Kind::length, 0, first_.rod.length);
  if (length != first_.rod.length) {
    if (first_.rod.shape) form(out.rod, with_finish_moved(*curve_of(first_.rod), length - first_.rod.length));
    for (RodPart& part : out.rod.parts) part.upto *= length / first_.rod.length;
    out.rod.parts.back().upto = out.rod.length = length;
  }
  out.from = turned(first_.from, x, Kind::from_turn, Kind::from_tilt);
  out.to = turned(first_.to, x, Kind::to_turn, Kind::to_tilt);
  for (int k = 0; k < static_cast<int>(out.clips.size()); ++k) out.clips[k].at = value(x, Kind::clip, k, out.clips[k].at);
  return out;
}

RodProblem DesignSpace::problem(const Design& design, const Vec3& gravity) const {
  RodProblem problem;
  problem.rod = design.rod;
  problem.gravity = design.rod.mass() > 0 ? gravity : Vec3(Vec3::Zero());
  problem.holds.push_back({0, design.from});
  for (std::size_t k = 0; k < design.clips.size(); ++k) {
    Hold hold = design.clips[k];
    hold.cut_at = first_.clips[k].at * design.rod.length / first_.rod.length;
    problem.holds.push_back(hold);
  }
  problem.holds.push_back({design.rod.length, design.to, true, true, design.turns});
  return problem;
}

std::vector<std::pair<Parameter, double>> DesignSpace::direction(int variable, const Eigen::VectorXd& x) const {
  const Variable& v = variables_[variable];
  const int last = static_cast<int>(first_.clips.size()) + 1;
  const bool from = v.kind == Kind::from_turn || v.kind == Kind::from_tilt;
  if (v.kind == Kind::length) return {{{Parameter::Kind::length, 0}, 1.0}};
  if (v.kind == Kind::clip) return {{{Parameter::Kind::hold_place, 0, 1 + v.index}, 1.0}};
  const Frame& first = from ? first_.from : first_.to;
  const Kind tilt = from ? Kind::from_tilt : Kind::to_tilt;
  const Vec3 lean = tilt_vector(first, value(x, tilt, 0, 0), value(x, tilt, 1, 0));
  const bool turns = v.kind == Kind::from_turn || v.kind == Kind::to_turn;
  const Vec3 axis = turns ? Vec3(exp_rotation(lean) * first.d3()) : turn_by_vector(lean, v.index == 0 ? first.d1() : first.d2());
  std::vector<std::pair<Parameter, double>> out;
  for (int c = 0; c < 3; ++c) out.push_back({{Parameter::Kind::hold_orientation, 0, from ? 0 : last, 0, c}, axis[c]});
  return out;
}

std::vector<double> DesignSpace::moves_along(int variable, const RodProblem& problem, const std::vector<double>& s) const {
  const Variable& v = variables_[variable];
  std::vector<double> moves(s.size(), 0.0);
  if (v.kind != Kind::length && v.kind != Kind::clip) return moves;
  const double length = problem.rod.length;
  // Places that vertices stand at, and how they move.
  std::vector<std::pair<double, double>> breaks;
  for (int k = 0; k < static_cast<int>(problem.holds.size()); ++k) {
    const bool finish = k + 1 == static_cast<int>(problem.holds.size());
    breaks.push_back({problem.holds[k].at, v.kind == Kind::length ? double(finish) : double(k == 1 + v.index)});
  }
  const auto add = [&](double at, double move) {
    for (const auto& known : breaks)
      if (std::abs(known.first - at) <= 1e-9 * length) return;
    breaks.push_back({at, move});
  };
  for (const RodPart& part : problem.rod.parts) add(part.upto, v.kind == Kind::length ? part.upto / length : 0);
  for (const double at : problem.rod.shape_breaks) add(at, 0);
  std::sort(breaks.begin(), breaks.end());
  std::size_t next = 1;
  for (std::size_t i = 0; i < s.size(); ++i) {
    while (next + 1 < breaks.size() && s[i] > breaks[next].first) ++next;
    const auto& [a, move_a] = breaks[next - 1];
    const auto& [b, move_b] = breaks[next];
    moves[i] = move_a + (move_b - move_a) * std::clamp((s[i] - a) / (b - a), 0.0, 1.0);
  }
  return moves;
}

}  // namespace tendril::routing
