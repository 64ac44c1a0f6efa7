// From the names of variables to what they change.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "method/variation/variables.h"

namespace tendril::variation {
namespace {

using Kind = Parameter::Kind;

[[noreturn]] void refuse(const Variable& variable, const std::string& what) {
  throw UsageError("method.variation: '" + variable.name + "' " + what);
}

std::vector<SceneParameter> parameters_named(const SceneEquilibrium& nominal, const std::string& name) {
  try {
    return named_parameters(nominal, {name});
  } catch (const UsageError& error) {
    const std::string text = error.what(), begin = "unknown parameter";
    const std::size_t at = text.find(begin);
    throw UsageError("method.variation: " +
                     (at == std::string::npos ? text : "unknown variable" + text.substr(at + begin.size())));
  }
}

/// The section that a parameter belongs to, if there is only one.
double section_number(const RodProblem& rod, const Parameter& p, const Variable& variable) {
  double value = NAN;
  for (std::size_t k = 0; k < rod.rod.parts.size(); ++k) {
    if (p.part >= 0 && p.part != static_cast<int>(k)) continue;
    const Section& s = rod.rod.parts[k].section;
    double own = 1, other = 1;
    switch (p.kind) {
      case Kind::EA: own = other = s.EA; break;
      case Kind::GA: own = s.GA1; other = s.GA2; break;
      case Kind::GA1: own = other = s.GA1; break;
      case Kind::GA2: own = other = s.GA2; break;
      case Kind::EI: own = s.EI1; other = s.EI2; break;
      case Kind::EI1: own = other = s.EI1; break;
      case Kind::EI2: own = other = s.EI2; break;
      case Kind::GJ: own = other = s.GJ; break;
      case Kind::mass: own = other = s.mass; break;
      case Kind::outer: own = other = s.outer; break;
      case Kind::inner: own = other = s.inner; break;
      case Kind::young: own = other = young_of(s, "young"); break;
      default: break;  // factors
    }
    if (variable.relative && (own != other || (!std::isnan(value) && own != value)))
      refuse(variable,
             "has more than one nominal value, so it cannot vary by a share of it; name its parts or directions one by one, "
             "or vary the factor 'stiffness' or 'density'");
    if (std::isnan(value)) value = own;
  }
  return value;
}

double nominal_value(const SystemProblem& problem, const Parameter& p, const Variable& variable) {
  switch (p.kind) {
    case Kind::length: return problem.rods[p.rod].rod.length;
    case Kind::gravity:
      for (const RodProblem& rod : problem.rods)
        if (!rod.gravity.isZero(0)) return rod.gravity[p.component];
      return 0;
    case Kind::hold_position: return problem.rods[p.rod].holds[p.index].frame.at[p.component];
    case Kind::hold_place: return problem.rods[p.rod].holds[p.index].at;
    case Kind::load_force: return problem.rods[p.rod].loads[p.index].force[p.component];
    case Kind::load_moment: return problem.rods[p.rod].loads[p.index].moment[p.component];
    case Kind::load_place: return problem.rods[p.rod].loads[p.index].at;
    case Kind::branch_position: return problem.branches[p.index].frame.at[p.component];
    case Kind::joint_position: return problem.branches[p.index].sections[p.section].relative.at[p.component];
    case Kind::joint_place: return problem.branches[p.index].sections[p.section].at;
    case Kind::hold_orientation: case Kind::branch_orientation: case Kind::joint_orientation: return 0;
    default: return section_number(problem.rods[p.rod], p, variable);
  }
}

/// Numbers that must stay above zero.
bool positive(Kind kind) {
  switch (kind) {
    case Kind::length:
    case Kind::EA:
    case Kind::GA:
    case Kind::GA1:
    case Kind::GA2:
    case Kind::EI:
    case Kind::EI1:
    case Kind::EI2:
    case Kind::GJ: case Kind::stiffness: case Kind::young: case Kind::outer: return true;
    default: return false;
  }
}

void check_width(const Variable& variable, const char* what, double value, double most = INFINITY) {
  if (!(value >= 0 && value <= most && std::isfinite(value)))
    refuse(variable, std::string("has ") + what + " = " + number_text(value) + ", expected a number from 0" +
                         (std::isfinite(most) ? " to " + number_text(most) : " up"));
}

/// How one component spreads. `zone`: a ball or a cone.
ComponentSpread spread_of(const Variable& variable, double tolerance, bool given, double nominal, bool zone, bool uniform) {
  ComponentSpread spread;
  spread.name = variable.name;
  spread.kind = variable.spread    ? *variable.spread
                : variable.inverse ? Spread::function
                : zone             ? Spread::uniform
                                   : Spread::normal;
  if (spread.kind == Spread::function && !variable.inverse) refuse(variable, "has no inverse distribution to draw from");
  if (spread.kind != Spread::function && variable.inverse)
    refuse(variable, "has a spread and an inverse distribution; give one of them");
  if (zone && (spread.kind == Spread::triangular || spread.kind == Spread::function))
    refuse(variable, "varies within a ball or cone, whose spread is 'uniform' or 'normal'");
  if (variable.sigma && spread.kind != Spread::normal) refuse(variable, "has a sigma, which only the normal spread has");
  if (variable.sigma) check_width(variable, "sigma", *variable.sigma);
  if (variable.relative && nominal == 0) refuse(variable, "has the nominal value 0, of which there is no share");
  const double scale = variable.relative ? std::abs(nominal) : 1;
  spread.scale = variable.relative ? nominal : 1;
  spread.inverse = &variable.inverse;
  spread.sigma = scale * (variable.sigma ? *variable.sigma : tolerance / 3);
  spread.tolerance = scale * (given ? tolerance : variable.sigma ? 3 * *variable.sigma : 0);
  if (uniform && (spread.kind != Spread::function || given)) spread.kind = Spread::uniform;
  return spread;
}

bool has_zone(const Variable& v) { return v.ball || v.box || v.cone || v.twist; }

void check_once(const Variable& variable, bool numbers) {
  const int ways = numbers + has_zone(variable) + !variable.numbers.empty() + !variable.frames.empty();
  if (ways == 0)
    refuse(variable, "has nothing that varies; give tolerance, or for a frame ball, box, cone or twist");
  if (ways > 1) refuse(variable, "varies in more than one way; give a tolerance, or ball, box, cone and twist, or a table");
  if (variable.ball && variable.box) refuse(variable, "has a ball and a box; give one of them");
  if (variable.ball) check_width(variable, "ball", *variable.ball);
  if (variable.cone) check_width(variable, "cone", *variable.cone, 3.141592653589793);
  if (variable.twist) check_width(variable, "twist", *variable.twist);
  for (int c = 0; variable.box && c < 3; ++c) check_width(variable, "box", (*variable.box)[c]);
  if (variable.relative && !numbers)
    refuse(variable, "is a frame or a table; only a number varies by a share of its nominal value");
}

void check_table(const Variable& variable, std::size_t size, int outcomes) {
  if (static_cast<int>(size) != outcomes)
    refuse(variable, "has a table of " + std::to_string(size) + " entries, expected one for each of " + std::to_string(outcomes) +
                         " outcomes");
}

std::string sections_of_branch(const std::vector<SceneParameter>& all, const std::string& name) {
  std::string text;
  for (int k = 1;; ++k) {
    const std::string section = name + "." + std::to_string(k);
    if (std::none_of(all.begin(), all.end(), [&](const SceneParameter& p) { return p.name == section + ".at.x"; })) return text;
    text += (k > 1 ? ", " : "") + section;
  }
}

}  // namespace

Variables::Variables(const SceneEquilibrium& nominal, const Options& options) {
  if (options.vary.empty())
    throw UsageError("method.variation: nothing varies; give vary = {[\"hose.length\"] = {tolerance = 5*mm}, ...}");
  for (int v = 0; v < static_cast<int>(options.vary.size()); ++v) {
    const Variable& variable = options.vary[v];
    for (int other = 0; other < v; ++other)
      if (options.vary[other].name == variable.name) refuse(variable, "is given twice");
    const bool numbers = variable.tolerance || ((variable.sigma || variable.inverse) && !has_zone(variable));
    check_once(variable, numbers);
    if (variable.name == "gravity" && has_zone(variable)) add_gravity_cone(nominal, options, v);
    else if (numbers || !variable.numbers.empty()) add_numbers(nominal, options, v);
    else add_place(nominal, options, v);
    first_column_.push_back(dimensions());
  }
  for (int a = 0; a < dimensions(); ++a)
    for (int b = 0; b < a; ++b)
      if (columns_[a].name == columns_[b].name)
        throw UsageError("method.variation: '" + columns_[a].name + "' varies twice: by '" +
                         options.vary[columns_[b].variable].name + "' and by '" + options.vary[columns_[a].variable].name + "'");
  add_groups(options);
  add_contributors(options);
}

void Variables::add_piece(Piece piece, const std::vector<std::string>& names, const char* unit, int variable, double nominal) {
  piece.column = dimensions();
  for (const std::string& name : names) columns_.push_back({name, unit, nominal, variable});
  tables_.resize(columns_.size());
  pieces_.push_back(std::move(piece));
}

void Variables::add_numbers(const SceneEquilibrium& nominal, const Options& options, int v) {
  const Variable& variable = options.vary[v];
  const std::vector<SceneParameter> found = parameters_named(nominal, variable.name);
  for (const SceneParameter& p : found)
    if (p.parameter.kind != found.front().parameter.kind || p.parameter.part != found.front().parameter.part)
      refuse(variable, "is more than one kind of number ('" + found.front().name + "', '" + p.name +
                           "'); name one of them, or for a frame give ball, box, cone or twist");
  if (!variable.numbers.empty()) {
    check_table(variable, variable.numbers.size(), options.outcomes);
    if (found.size() > 1)
      refuse(variable, "is " + std::to_string(found.size()) + " numbers, but its table has one for each outcome");
    for (const double number : variable.numbers)
      if (!std::isfinite(number)) refuse(variable, "has a table with a number that is not finite");
  }
  if (variable.tolerance) check_width(variable, "tolerance", *variable.tolerance);
  for (const SceneParameter& p : found) {
    const SystemProblem& problem = nominal.systems[std::max(p.system, 0)].problem;
    const double value = nominal_value(problem, p.parameter, variable);
    Piece piece;
    piece.number = p;
    if (variable.numbers.empty())
      piece.spread =
          spread_of(variable, variable.tolerance.value_or(0), variable.tolerance.has_value(), value, false, options.uniform);
    if (positive(p.parameter.kind) && variable.numbers.empty() && piece.spread.kind != Spread::function &&
        std::max(piece.spread.tolerance, 3 * piece.spread.sigma) >= value)
      refuse(variable, "varies by " + number_text(std::max(piece.spread.tolerance, 3 * piece.spread.sigma)) + " about " +
                           number_text(value) + ", which leaves nothing of it");
    add_piece(piece, {p.name}, unit_of(p.parameter.kind), v, value);
    if (!variable.numbers.empty()) tables_.back() = variable.numbers;
  }
}

void Variables::add_gravity_cone(const SceneEquilibrium& nominal, const Options& options, int v) {
  const Variable& variable = options.vary[v];
  if (variable.ball || variable.box || variable.twist)
    refuse(variable, "is a direction: it varies within a cone, or its numbers by a tolerance");
  const auto heavy = [](const SolvedSystem& system) {
    return std::any_of(system.problem.rods.begin(), system.problem.rods.end(),
                       [](const RodProblem& r) { return !r.gravity.isZero(0); });
  };
  if (std::none_of(nominal.systems.begin(), nominal.systems.end(), heavy))
    refuse(variable, "is zero, so it has no direction that varies");
  Piece piece;
  piece.kind = Piece::Kind::gravity_cone;
  piece.place.system = -1;
  piece.spread = spread_of(variable, *variable.cone, true, 1, true, options.uniform);
  add_piece(piece, {"gravity.tilt.1", "gravity.tilt.2"}, "rad", v);
}

void Variables::add_place(const SceneEquilibrium& nominal, const Options& options, int v) {
  const Variable& variable = options.vary[v];
  const std::vector<SceneParameter> all = parameters_of(nominal);
  Piece piece;
  bool found = false;
  for (const SceneParameter& p : all) {
    const bool at = p.name == variable.name + ".at.x", turn = p.name == variable.name + ".turn.x";
    if (!at && !turn) continue;
    found = true;
    piece.place.system = p.system;
    piece.place.rod = p.parameter.rod;
    piece.place.index = p.parameter.index;
    piece.place.section = p.parameter.section;
    const Kind kind = p.parameter.kind;
    piece.place.kind = kind == Kind::hold_orientation     ? Kind::hold_position
                       : kind == Kind::branch_orientation ? Kind::branch_position
                       : kind == Kind::joint_orientation  ? Kind::joint_position
                                                          : kind;
    (at ? piece.place.position : piece.place.orientation) = true;
  }
  if (!found) {
    const std::string sections = sections_of_branch(all, variable.name);
    if (!sections.empty()) refuse(variable, "is a branch point that nothing holds; its sections are " + sections);
    parameters_named(nominal, variable.name);  // throws for an unknown name
    refuse(variable, "is no frame; give a tolerance");
  }
  if ((variable.ball || variable.box) && !piece.place.position) refuse(variable, "does not hold the position");
  if ((variable.cone || variable.twist) && !piece.place.orientation) refuse(variable, "does not hold the orientation");
  if (!variable.frames.empty()) {
    check_table(variable, variable.frames.size(), options.outcomes);
    return add_table_frames(nominal, variable, piece, v);
  }
  static const char* axes[] = {".at.x", ".at.y", ".at.z"};
  const auto spread = [&](double tolerance, bool zone) { return spread_of(variable, tolerance, true, 1, zone, options.uniform); };
  if (variable.ball) {
    piece.kind = Piece::Kind::ball;
    piece.spread = spread(*variable.ball, true);
    add_piece(piece, {variable.name + axes[0], variable.name + axes[1], variable.name + axes[2]}, "m", v);
  }
  for (piece.axis = 0; variable.box && piece.axis < 3; ++piece.axis) {
    piece.kind = Piece::Kind::shift;
    piece.spread = spread((*variable.box)[piece.axis], false);
    if ((*variable.box)[piece.axis] > 0) add_piece(piece, {variable.name + axes[piece.axis]}, "m", v);
  }
  if (variable.cone) {
    piece.kind = Piece::Kind::cone;
    piece.spread = spread(*variable.cone, true);
    add_piece(piece, {variable.name + ".tilt.1", variable.name + ".tilt.2"}, "rad", v);
  }
  if (variable.twist) {
    piece.kind = Piece::Kind::twist;
    piece.spread = spread(*variable.twist, false);
    add_piece(piece, {variable.name + ".twist"}, "rad", v);
  }
}

/// As moves from the nominal frame.
void Variables::add_table_frames(const SceneEquilibrium& nominal, const Variable& variable, Piece piece, int v) {
  piece.kind = Piece::Kind::table_frame;
  SystemProblem problem = nominal.systems[piece.place.system].problem;
  const Frame from = frame_at(problem, piece.place);
  const std::string& name = variable.name;
  add_piece(piece, {name + ".at.x", name + ".at.y", name + ".at.z"}, "m", v);
  for (const char* axis : {".turn.x", ".turn.y", ".turn.z"}) columns_.push_back({name + axis, "rad", 0, v});
  tables_.resize(columns_.size());
  const int first = pieces_.back().column;
  for (const Frame& frame : variable.frames) {
    if (!all_finite(frame.at) || !all_finite(frame.rotation.coeffs()))
      refuse(variable, "has a table with a frame that is not finite");
    const Vec3 shift = frame.at - from.at, turn = log_rotation(frame.rotation * from.rotation.conjugate());
    for (int c = 0; c < 3; ++c) {
      tables_[first + c].push_back(shift[c]);
      tables_[first + 3 + c].push_back(turn[c]);
    }
  }
}

void Variables::add_groups(const Options& options) {
  std::vector<int> group_of(options.vary.size(), -1);
  for (std::size_t g = 0; g < options.groups.size(); ++g) {
    const Group& group = options.groups[g];
    const std::string who = "method.variation: group " + std::to_string(g + 1);
    if (group.variables.size() < 2)
      throw UsageError(who + ": got " + std::to_string(group.variables.size()) + " variables, expected at least 2");
    std::vector<int> members;
    for (const std::string& name : group.variables) {
      int v = 0;
      while (v < static_cast<int>(options.vary.size()) && options.vary[v].name != name) ++v;
      if (v == static_cast<int>(options.vary.size()))
        throw UsageError(who + ": '" + name + "' is not among the variables that vary");
      if (group_of[v] >= 0)
        throw UsageError(who + ": '" + name + "' belongs to group " + std::to_string(group_of[v] + 1) + " already");
      if (!tables_[first_column_[v]].empty())
        throw UsageError(who + ": '" + name + "' comes from a table, so it cannot be correlated");
      group_of[v] = static_cast<int>(g);
      members.push_back(v);
    }
    const auto width = [&](int v) { return first_column_[v + 1] - first_column_[v]; };
    for (const int v : members)
      if (width(v) != width(members.front()))
        throw UsageError(who + ": '" + options.vary[v].name + "' has " + std::to_string(width(v)) + " components, '" +
                         options.vary[members.front()].name + "' has " + std::to_string(width(members.front())) +
                         "; expected as many");
    Correlated correlated{{}, Copula(group.correlation, static_cast<int>(members.size()), who)};
    for (int c = 0; c < width(members.front()); ++c) {
      correlated.columns.emplace_back();
      for (const int v : members) correlated.columns.back().push_back(first_column_[v] + c);
    }
    groups_.push_back(std::move(correlated));
  }
}

void Variables::add_contributors(const Options& options) {
  std::vector<char> done(options.vary.size(), 0);
  const auto add = [&](Contributor& contributor, int v) {
    done[v] = 1;
    contributor.name += (contributor.name.empty() ? "" : " + ") + options.vary[v].name;
    for (int c = first_column_[v]; c < first_column_[v + 1]; ++c) contributor.columns.push_back(c);
    if (!contributor.columns.empty()) contributor.drawn = tables_[contributor.columns.back()].empty();
  };
  for (int v = 0; v < static_cast<int>(options.vary.size()); ++v) {
    if (done[v]) continue;
    Contributor contributor;
    add(contributor, v);
    for (const Group& group : options.groups) {
      const auto& names = group.variables;
      if (std::find(names.begin(), names.end(), options.vary[v].name) == names.end()) continue;
      for (int w = v + 1; w < static_cast<int>(options.vary.size()); ++w)
        if (std::find(names.begin(), names.end(), options.vary[w].name) != names.end()) add(contributor, w);
    }
    contributors_.push_back(std::move(contributor));
  }
}

}  // namespace tendril::variation
