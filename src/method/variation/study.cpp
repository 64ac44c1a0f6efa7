#include "method/variation/study.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "base/error.h"
#include "base/nearest_name.h"
#include "method/variation/attribution.h"
#include "method/variation/row_solver.h"
#include "method/variation/sampler.h"

namespace tendril::variation {
namespace {

const Options& checked(const Options& options) {
  if (options.outcomes < 1)
    throw UsageError("method.variation: got " + std::to_string(options.outcomes) + " outcomes, expected at least 1");
  if (options.effects < 0 || options.effects > options.outcomes)
    throw UsageError("method.variation: got total effects of " + std::to_string(options.effects) + " outcomes, expected 0 to " +
                     std::to_string(options.outcomes));
  return options;
}

SceneEquilibrium checked(SceneEquilibrium nominal) {
  if (!nominal.ok()) throw UsageError("method.variation: the nominal equilibrium was not found: " + nominal.message());
  if (!nominal.stable()) throw UsageError("method.variation: the nominal equilibrium is not stable; solve it with stable_only");
  return nominal;
}

}  // namespace

struct Study::Parts {
  Options options;
  SceneEquilibrium nominal;
  std::uint64_t seed;
  Variables variables;
  Measures measures;
  RowSolver solver;
  Sampler sampler;
  std::vector<Column> measure_columns;
  std::vector<std::string> contributors;
  std::vector<int> drawn;  ///< contributors that total effects know
  mutable std::mutex guard;
  mutable std::optional<Eigen::MatrixXd> gradient;  ///< measures x columns

  Parts(SceneEquilibrium solved, const Options& given, const RunContext& context)
      : options(checked(given)),
        nominal(checked(std::move(solved))),
        seed(context.seed),
        variables(nominal, options),
        measures(nominal, options),
        solver(nominal, variables, measures, options.solve, context),
        sampler(options.sampling, seed, variables.dimensions() * (options.effects > 0 ? 2 : 1), options.outcomes,
                options.replicates) {
    for (const Variables::Contributor& contributor : variables.contributors()) {
      if (contributor.drawn) drawn.push_back(static_cast<int>(contributors.size()));
      contributors.push_back(contributor.name);
    }
    measure_columns = measures.columns();
    const std::vector<double> row = nominal_row();
    RowAnswers answers;
    solver.solve(row, 1, true, answers, context);
    std::vector<double> values(answers.measured);
    if (answers.status.front() == OutcomeStatus::solved) measures.call(solver.equilibrium(row, answers, 0), values);
    for (std::size_t m = 0; m < values.size(); ++m) measure_columns[m].nominal = values[m];
  }

  std::vector<double> nominal_row() const {
    std::vector<double> row;
    for (const Column& column : variables.columns()) row.push_back(column.nominal);
    return row;
  }

  int columns() const { return variables.dimensions(); }
  int effect_rows() const { return options.effects > 0 ? static_cast<int>(drawn.size()) + 1 : 0; }
  int rows_of(int outcome) const { return 1 + (outcome < options.effects ? effect_rows() : 0); }
  int effect_numbers() const { return effect_rows() * measures.count(); }

  /// Variables of an outcome; `anew`: columns that are drawn again.
  void draw(int outcome, const std::vector<char>& anew, std::span<double> values) const {
    std::vector<double> u(columns());
    for (int c = 0; c < columns(); ++c) u[c] = sampler.at(outcome, anew.empty() || !anew[c] ? c : columns() + c);
    variables.draw(outcome, u, values);
  }

  /// Appends the rows of one outcome: its own, then one with each contributor drawn anew, then one with all of them.
  void draw_rows(int outcome, std::vector<double>& values) const {
    const auto append = [&](const std::vector<char>& anew) {
      values.resize(values.size() + columns());
      draw(outcome, anew, {values.data() + values.size() - columns(), static_cast<std::size_t>(columns())});
    };
    append({});
    if (rows_of(outcome) == 1) return;
    for (const int contributor : drawn) {
      std::vector<char> anew(columns(), 0);
      for (const int c : variables.contributors()[contributor].columns) anew[c] = 1;
      append(anew);
    }
    append(std::vector<char>(columns(), 1));
  }

  void solve_portion(int first, int last, const OnOutcome& on_outcome, Outcomes& out, const RunContext& context) const;
  void pass(int outcome, int row, const std::vector<double>& values, RowAnswers& answers, const OnOutcome& on_outcome,
            Outcomes& out) const;
};

Study::Study(const Scene& scene, Options options, const RunContext& context)
    : Study(scene.solve(checked(options).solve, context), options, context) {}
Study::Study(const SceneEquilibrium& nominal, Options options, const RunContext& context)
    : parts_(std::make_unique<Parts>(nominal, options, context)) {}
Study::Study(Study&&) noexcept = default;
Study::~Study() = default;

const Options& Study::options() const { return parts_->options; }
const SceneEquilibrium& Study::nominal() const { return parts_->nominal; }
const std::vector<Column>& Study::variables() const { return parts_->variables.columns(); }
const std::vector<Column>& Study::measures() const { return parts_->measure_columns; }
const std::vector<std::string>& Study::contributors() const { return parts_->contributors; }
std::uint64_t Study::seed() const { return parts_->seed; }
int Study::effect_numbers() const { return parts_->effect_numbers(); }

// ---------------------------------------------------------------- outcomes

/// Hands out one outcome whose rows begin at `row`.
void Study::Parts::pass(int outcome, int row, const std::vector<double>& values, RowAnswers& answers, const OnOutcome& on_outcome,
                        Outcomes& out) const {
  const std::size_t count = measures.count(), width = columns();
  const auto variables_of = [&](int r) { return std::span<const double>(values).subspan(r * width, width); };
  const auto measured = [&](int r) { return std::span<double>(answers.measured).subspan(r * count, count); };
  OutcomeStatus status = answers.status[row];
  for (int r = row; r < row + rows_of(outcome); ++r) {
    if (answers.status[r] == OutcomeStatus::unsolved) status = OutcomeStatus::unsolved;  // stopped before the last of its rows
    const bool there = answers.status[r] == OutcomeStatus::solved || answers.status[r] == OutcomeStatus::jumped;
    if (there && measures.has_functions()) measures.call(solver.equilibrium(variables_of(r), answers, r), measured(r));
  }
  if (status == OutcomeStatus::unsolved) return;
  std::vector<double> effects(effect_numbers(), std::nan(""));
  for (int r = 1; r < rows_of(outcome); ++r)
    std::copy_n(measured(row + r).begin(), count, effects.begin() + (r - 1) * static_cast<std::ptrdiff_t>(count));
  const std::string message = solver.message(answers, row);
  out.set(outcome, status, variables_of(row), measured(row), effects, message);
  if (!on_outcome) return;
  std::vector<std::vector<double>> scratch(nominal.rods.size());
  std::vector<std::span<const double>> frames;
  for (std::size_t k = 0; status != OutcomeStatus::failed && k < nominal.rods.size(); ++k)
    frames.push_back(solver.frames(answers, row, static_cast<int>(k), scratch[k]));
  on_outcome({outcome, status, out.variables_of(outcome), out.measures_of(outcome), out.effects_of(outcome), message, frames});
}

void Study::Parts::solve_portion(int first, int last, const OnOutcome& on_outcome, Outcomes& out,
                                 const RunContext& context) const {
  std::vector<double> values;
  int rows = 0;
  for (int k = first; k < last; ++k) {
    draw_rows(k, values);
    rows += rows_of(k);
  }
  RowAnswers answers;
  solver.solve(values, rows, false, answers, context);
  for (int k = first, row = 0; k < last; row += rows_of(k), ++k) pass(k, row, values, answers, on_outcome, out);
}

Outcomes Study::run(int first, int last, const OnOutcome& on_outcome, const RunContext& context) const {
  const Parts& parts = *parts_;
  if (first < 0 || last > parts.options.outcomes || first > last)
    throw UsageError("method.variation: got outcomes " + std::to_string(first) + " to " + std::to_string(last - 1) + " of " +
                     std::to_string(parts.options.outcomes));
  Outcomes out(first, last - first, variables(), measures(), parts.effect_numbers());
  const int portion = parts.solver.portion(context);
  for (int begin = first; begin < last && !context.stop();) {
    int end = begin;
    for (int rows = 0; end < last && (end == begin || rows + parts.rows_of(end) <= portion); ++end) rows += parts.rows_of(end);
    parts.solve_portion(begin, end, on_outcome, out, context);
    begin = end;
    if (context.progress) context.progress(static_cast<double>(end - first) / (last - first), "variation");
  }
  return out;
}

std::vector<double> Study::variables_of(int outcome) const {
  if (outcome < 0 || outcome >= parts_->options.outcomes)
    throw UsageError("method.variation: got outcome " + std::to_string(outcome) + ", expected 0 to " +
                     std::to_string(parts_->options.outcomes - 1));
  std::vector<double> values(parts_->columns());
  parts_->draw(outcome, {}, values);
  return values;
}

SceneEquilibrium Study::equilibrium(int outcome, const RunContext& context) const {
  const std::vector<double> row = variables_of(outcome);
  RowAnswers answers;
  parts_->solver.solve(row, 1, true, answers, context);
  return parts_->solver.equilibrium(row, answers, 0);
}

// ---------------------------------------------------------------- statistics

int Study::measure(std::string_view name) const {
  std::vector<std::string> names;
  for (const Column& column : measures()) {
    if (column.name == name) return static_cast<int>(names.size());
    names.push_back(column.name);
  }
  throw UsageError("method.variation: unknown measure " + unknown_name(name, "measures", names));
}

Sample Study::sample(const Outcomes& outcomes, int measure) const {
  return Sample(outcomes, measure, parts_->sampler.replicates());
}

Contributions Study::contributions(const Outcomes& outcomes, int measure, const RunContext& context) const {
  const Parts& parts = *parts_;
  const Eigen::MatrixXd covariance = parts.variables.covariance();
  {
    const std::lock_guard lock(parts.guard);
    if (!parts.gradient && !context.stop())
      parts.gradient = gradient_of(parts.nominal_row(), covariance.diagonal(), parts.measures, parts.solver, context);
  }
  Attribution attribution(parts.variables.contributors(), parts.sampler.replicates() == 1);
  if (parts.gradient) attribution.add_linear(parts.gradient->row(measure), covariance);
  attribution.add_regression(outcomes, measure);
  attribution.add_effects(outcomes, measure, parts.drawn);
  return attribution.finish();
}

}  // namespace tendril::variation
