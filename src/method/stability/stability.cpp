#include "method/stability/stability.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::stability {
namespace {

std::string after(const std::string& text, const char* begin) {
  const std::size_t at = text.find(begin);
  return at == std::string::npos ? text : text.substr(at);
}

/// Lengths, frames of holds and branch points, gravity: what an assembly varies in.
std::vector<Variable> usual_variables(const SceneEquilibrium& equilibrium) {
  std::vector<Variable> all;
  for (const SceneParameter& p : parameters_of(equilibrium)) switch (p.parameter.kind) {
      case Parameter::Kind::length: case Parameter::Kind::gravity: case Parameter::Kind::hold_position:
      case Parameter::Kind::hold_orientation: case Parameter::Kind::hold_place: case Parameter::Kind::branch_position:
      case Parameter::Kind::branch_orientation:
        all.push_back({p.name, 0});
        break;
      default: break;
    }
  return all;
}

std::vector<SceneParameter> resolve(const SceneEquilibrium& equilibrium, const std::vector<Variable>& vary, Result& result) {
  std::vector<SceneParameter> all;
  for (const Variable& variable : vary) {
    if (!(variable.tolerance >= 0 && std::isfinite(variable.tolerance)))
      throw UsageError("method.stability: '" + variable.name + "' has the tolerance " + number_text(variable.tolerance) +
                       ", expected a number from 0 up");
    std::vector<SceneParameter> found;
    try {
      found = named_parameters(equilibrium, {variable.name});
    } catch (const UsageError& error) {
      throw UsageError("method.stability: " + after(error.what(), "unknown"));
    }
    for (const SceneParameter& p : found) {
      const std::string unit = unit_of(p.parameter.kind), first = unit_of(found.front().parameter.kind);
      if (variable.tolerance > 0 && unit != first)
        throw UsageError("method.stability: '" + variable.name + "' is numbers in '" + first + "' and in '" + unit +
                         "', which no tolerance fits; name some of them: '" + found.front().name + "', '" + p.name + "'");
      const auto taken = [&](const Result::Column& column) { return column.name == p.name; };
      if (std::any_of(result.variables.begin(), result.variables.end(), taken))
        throw UsageError("method.stability: '" + p.name + "' is given twice");
      result.variables.push_back({p.name, unit, variable.tolerance});
      all.push_back(p);
    }
  }
  return all;
}

SceneMeasure measure_named(const SceneEquilibrium& equilibrium, const std::string& name) {
  try {
    return named_measure(equilibrium, name);
  } catch (const UsageError& error) {
    throw UsageError("method.stability: " + after(after(error.what(), "unknown"), "there is"));
  }
}

}  // namespace

std::vector<double> Result::colour(int rod) const {
  std::vector<double> out;
  if (moves.empty()) return out;
  const bool given = std::any_of(variables.begin(), variables.end(), [](const Column& c) { return c.tolerance > 0; });
  out.assign(moves.front()[rod].size(), 0.0);
  for (std::size_t c = 0; c < moves.size(); ++c)
    for (std::size_t v = 0; v < out.size(); ++v) {
      const double move = moves[c][rod][v].norm();
      out[v] = given ? std::max(out[v], move * variables[c].tolerance) : std::hypot(out[v], move);
    }
  return out;
}

Result run(const SceneEquilibrium& equilibrium, const Options& options, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  Result result;
  const std::vector<SceneParameter> parameters =
      resolve(equilibrium, options.vary.empty() ? usual_variables(equilibrium) : options.vary, result);
  const std::vector<std::string> names = options.measures.empty() ? usual_measures(equilibrium) : options.measures;
  std::vector<SceneMeasure> measures;
  for (const std::string& name : names) measures.push_back(measure_named(equilibrium, name));
  const Eigen::Index rows = static_cast<Eigen::Index>(measures.size()), columns = static_cast<Eigen::Index>(parameters.size());
  result.matrix = Eigen::MatrixXd::Constant(rows, columns, std::nan(""));
  result.scaled = result.matrix;
  result.status = equilibrium.status();
  result.message = equilibrium.message();
  SceneSensitivity sensitivity(equilibrium);
  for (Eigen::Index m = 0; m < rows; ++m) {
    if (const auto stop = context.stop()) {
      result.status = *stop;
      result.message = "interrupted";
      return result;
    }
    const SceneGradient gradient = sensitivity.gradient(measures[m], parameters, context);
    result.measures.push_back({gradient.measure, gradient.unit, gradient.value, gradient.ok, gradient.message});
    for (Eigen::Index c = 0; gradient.ok && c < columns; ++c) {
      result.matrix(m, c) = gradient.entries[c].derivative;
      result.scaled(m, c) = gradient.entries[c].derivative * result.variables[c].tolerance;
    }
    if (!gradient.ok && result.message == "solved") result.message = gradient.measure + ": " + gradient.message;
  }
  result.ok = std::all_of(result.measures.begin(), result.measures.end(), [](const Result::Row& row) { return row.ok; });
  if (result.ok)
    for (const SceneParameter& p : parameters) result.moves.push_back(sensitivity.motion(p, context));
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace tendril::stability
