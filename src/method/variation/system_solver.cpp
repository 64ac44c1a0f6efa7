#include "method/variation/system_solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/parallel.h"
#include "statics/motion.h"
#include "statics/solve.h"

namespace tendril::variation {
namespace {

constexpr double small_share = 1e-3;     // of a deviation, for a batch's derivatives
constexpr double finite_share = 2e-2;    // ... for those from equilibria solved anew
constexpr double same_equilibrium = 1e-4;  // of the length
constexpr int rows_at_once = 8;          // that a thread takes
constexpr int following_steps = 4, most_following_solves = 100, most_following_iterations = 200;
constexpr int compared_intervals = 12;   // of a rod, between the vertices whose places are compared

SystemProblem without_surroundings(SystemProblem problem) {
  for (RodProblem& rod : problem.rods) rod.surroundings = nullptr;
  return problem;
}

Batch::Start start_of(const SystemEquilibrium& equilibrium) {
  Batch::Start start;
  for (const Equilibrium& rod : equilibrium.rods) {
    start.vertices.emplace_back();
    for (std::size_t i = 0; i < rod.points.size(); ++i) start.vertices.back().push_back({rod.points[i], rod.rotations[i]});
  }
  start.branches = equilibrium.branches;
  return start;
}

std::string description_of(const SnapThrough& snap, const std::vector<std::string>& rods) {
  char text[160];
  std::snprintf(text, sizeof text, "snaps at %.3g %% of the way from the nominal design: by %.4g mm at s = %.4g m of '",
                100 * snap.t, 1e3 * snap.move, snap.s);
  return text + rods[snap.rod] + "'";
}

OutcomeStatus outcome_status(Status status) {
  switch (status) {
    case Status::solved: return OutcomeStatus::solved;
    case Status::cancelled: case Status::timeout: return OutcomeStatus::unsolved;
    default: return OutcomeStatus::failed;
  }
}

}  // namespace

struct SystemSolver::Row {
  const SystemSolver& solver;
  const RunContext& context;
  const BatchResults* results;
  std::optional<RodReader> reader;  ///< of the results
  SystemProblem problem;
  Positions positions;
  // Of the row at hand.
  int index = 0;
  std::span<const double> values;
  OutcomeStatus status = OutcomeStatus::unsolved;
  std::unique_ptr<SystemEquilibrium> equilibrium;
  std::string message;

  Row(const SystemSolver& own, const RunContext& run, const BatchResults* batch) : solver(own), context(run), results(batch) {
    if (own.batch_) reader.emplace(*own.batch_);
  }
  void begin(int row, std::span<const double> of) {
    index = row;
    values = of;
    status = OutcomeStatus::unsolved;
    equilibrium.reset();
    message.clear();
    solver.make_problem(values, 1, problem);
    if (reader) reader->stand_at(*results, row, problem);
  }
};

SystemSolver::SystemSolver(const SceneEquilibrium& nominal, int system, const Variables& variables,
                           std::span<const double> deviations, const SolveOptions& options, const RunContext& context)
    : variables_(variables),
      number_(system),
      options_(options),
      problem_(nominal.systems[system].problem),
      free_problem_(without_surroundings(problem_)),
      nominal_(*nominal.part(nominal, nominal.systems[system].rods, nominal.systems[system].branches)),
      varies_(variables.reaches(system)) {
  options_.error = false;
  const SolvedSystem& solved = nominal.systems[system];
  for (std::size_t i = 0; i < solved.rods.size(); ++i) {
    rod_names_.push_back(nominal.rods[solved.rods[i]].name);
    shares_.push_back(nominal_.rods[i].s);
    for (double& share : shares_.back()) share /= nominal_.rods[i].s.back();
    const int last = static_cast<int>(shares_.back().size()) - 1, intervals = std::min(last, compared_intervals);
    compared_.emplace_back();
    for (int k = 0; k <= intervals; ++k) compared_.back().push_back(k * last / intervals);
  }
  for (const int b : solved.branches) nominal_.branch_supports.push_back(nominal.branches[b].support);
  if (!varies_) return;
  begin_batch(deviations);
  begin_check(deviations, context);
}

/// One problem for each column that varies.
std::vector<SystemProblem> SystemSolver::varied_problems(std::span<const double> deviations) const {
  std::vector<SystemProblem> problems;
  std::vector<double> row;
  for (const Column& column : variables_.columns()) row.push_back(column.nominal);
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (!(deviations[c] > 0)) continue;
    row[c] += small_share * deviations[c];
    make_problem(row, 1, problems.emplace_back());
    row[c] = variables_.columns()[c].nominal;
  }
  return problems;
}

void SystemSolver::begin_batch(std::span<const double> deviations) {
  if (const ContactField* field = problem_.rods.front().surroundings) way_.emplace(problem_, nominal_.rods, *field);
  if (way_ && !way_->nominal_is_clear()) return;
  if (!Batch::why_not(free_problem_, options_).empty()) return;
  try {
    batch_.emplace(free_problem_, start_of(nominal_), options_, varied_problems(deviations));
  } catch (const UsageError&) {
    batch_.reset();  // on another mesh, or too flat an equilibrium for it: one by one
  }
}

/// How far each column moves the vertices that are compared.
void SystemSolver::begin_check(std::span<const double> deviations, const RunContext& context) {
  const int columns = variables_.dimensions();
  std::vector<double> values(columns), lengths;
  for (int c = 0; c < columns; ++c) values[c] = variables_.columns()[c].nominal;
  Positions nominal;
  read_positions(nominal_, nominal);
  for (std::size_t k = 0; k < nominal_.rods.size(); ++k)
    lengths.insert(lengths.end(), compared_[k].size(), problem_.rods[k].rod.length);
  std::vector<Positions> by_unit(columns);
  std::atomic<int> next = 0;
  const auto work = [&](int) {
    SystemProblem problem;
    for (int c; (c = next.fetch_add(1)) < columns && !context.stop();) {
      const double step = (batch_ ? small_share : finite_share) * deviations[c];
      if (!(step > 0)) continue;
      std::vector<double> row = values;
      row[c] += step;
      make_problem(row, 1, problem);
      Positions moved;
      if (batch_) {
        const Batch::Start start = batch_->predicted(problem);
        for (std::size_t k = 0; k < start.vertices.size(); ++k)
          for (const int vertex : compared_[k]) moved.push_back(start.vertices[k][vertex].at);
      } else {
        try {
          put_surroundings(problem);
          const SystemEquilibrium found = tendril::solve(problem, options_, context, &nominal_);
          if (!found.ok()) continue;
          read_positions(found, moved);
        } catch (const UsageError&) {
          continue;
        }
      }
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = (moved[i] - nominal[i]) / step;
      by_unit[c] = std::move(moved);
    }
  };
  if (batch_) work(0);
  else run_workers(std::min(thread_count(context.threads), columns), work);
  check_ = BranchCheck(std::move(nominal), std::move(values), std::move(by_unit), std::move(lengths));
}

std::size_t SystemSolver::bytes_of_row() const {
  std::size_t frames = nominal_.branches.size();
  for (const std::vector<double>& rod : shares_) frames += rod.size();
  return 7 * sizeof(double) * frames;
}

void SystemSolver::make_problem(std::span<const double> row, double share, SystemProblem& problem) const {
  problem = free_problem_;
  variables_.apply(number_, row, share, problem);
}

/// Where something can be in the rods' way.
void SystemSolver::put_surroundings(SystemProblem& problem) const {
  for (RodProblem& rod : problem.rods) rod.surroundings = problem_.rods.front().surroundings;
}

void SystemSolver::read_positions(const SystemEquilibrium& equilibrium, Positions& out) const {
  out.clear();
  for (std::size_t k = 0; k < equilibrium.rods.size(); ++k) {
    const Equilibrium& rod = equilibrium.rods[k];
    const bool same_mesh = rod.points.size() == shares_[k].size();
    for (const int vertex : compared_[k])
      out.push_back(same_mesh ? rod.points[vertex] : rod.frame_at(shares_[k][vertex] * rod.s.back()).at);
  }
}

void SystemSolver::read_positions(const Row& row, Positions& out) const {
  if (row.equilibrium) return read_positions(*row.equilibrium, out);
  out.clear();
  for (int k = 0; k < row.results->rods(); ++k) {
    const std::span<const double> frames = row.results->frames(row.index, k);
    for (const int vertex : compared_[k]) out.push_back(Vec3(frames[7 * vertex], frames[7 * vertex + 1], frames[7 * vertex + 2]));
  }
}

// ---------------------------------------------------------------- outcomes

void SystemSolver::solve(std::span<const double> values, int rows, bool whole, SystemAnswers& answers,
                         const RunContext& context) const {
  const std::size_t columns = variables_.dimensions();
  const auto row_of = [&](int k) { return values.subspan(k * columns, columns); };
  answers.status.assign(rows, OutcomeStatus::unsolved);
  answers.messages.assign(rows, {});
  answers.equilibria.clear();
  answers.equilibria.resize(rows);
  if (!varies_) {
    for (int k = 0; k < rows; ++k) {
      answers.status[k] = OutcomeStatus::solved;
      answers.equilibria[k] = std::make_unique<SystemEquilibrium>(nominal_);
    }
    return;
  }
  if (batch_) {
    const auto fill = [&](int k, SystemProblem& problem) { make_problem(row_of(k), 1, problem); };
    batch_->solve(rows, fill, answers.batch, context);
  }
  std::atomic<int> next = 0;
  const int at_once = batch_ ? rows_at_once : 1;
  run_workers(std::min(thread_count(context.threads), (rows + at_once - 1) / at_once), [&](int) {
    Row row(*this, context, &answers.batch);
    for (int first; (first = next.fetch_add(at_once)) < rows;)
      for (int k = first; k < std::min(rows, first + at_once); ++k) {
        row.begin(k, row_of(k));
        settle(row);
        if (whole && (row.status == OutcomeStatus::solved || row.status == OutcomeStatus::jumped)) make_whole(row);
        answers.status[k] = row.status;
        answers.equilibria[k] = std::move(row.equilibrium);
        answers.messages[k] = std::move(row.message);
      }
  });
}

void SystemSolver::settle(Row& row) const {
  if (batch_) settle_batched(row);
  else if (!row.context.stop()) solve_alone(row);
}

void SystemSolver::settle_batched(Row& row) const {
  const BatchOutcome& outcome = (*row.results)[row.index];
  row.status = outcome_status(outcome.status);
  if (row.status == OutcomeStatus::unsolved) return;
  if (way_ && (!outcome.ok() || !clear(row))) return solve_alone(row);
  if (outcome.ok()) return judge(row);
  row.message = row.results->message(row.index);
  follow_from_nominal(row);
}

bool SystemSolver::clear(Row& row) const {
  for (int k = 0; k < row.results->rods(); ++k)
    if (!way_->clear(k, row.problem.rods[k].rod, row.reader->rod(k, false))) return false;
  return true;
}

void SystemSolver::solve_alone(Row& row) const {
  try {
    SystemProblem problem = row.problem;
    put_surroundings(problem);
    row.equilibrium = std::make_unique<SystemEquilibrium>(tendril::solve(problem, options_, row.context, &nominal_));
  } catch (const UsageError& error) {
    row.status = OutcomeStatus::failed;
    row.message = error.what();
    return;
  }
  const Equilibrium& first = row.equilibrium->rods.front();
  row.status = outcome_status(first.status);
  if (row.status == OutcomeStatus::solved) judge(row);
  if (row.status != OutcomeStatus::failed) return;
  row.message = first.message;
  follow_from_nominal(row);
}

/// A solved outcome: is it on the nominal equilibrium's branch?
void SystemSolver::judge(Row& row) const {
  if (row.equilibrium && !row.equilibrium->rods.front().stable) {
    row.status = OutcomeStatus::jumped;
    row.message = "the equilibrium is not stable";
    return;
  }
  read_positions(row, row.positions);
  if (!check_.suspicious(row.values, row.positions)) return;
  Positions half_way;
  if (solve_half_way(row, half_way) && !check_.suspicious(row.values, row.positions, &half_way)) return;
  follow_from_nominal(row);
}

bool SystemSolver::solve_half_way(const Row& row, Positions& out) const {
  SystemProblem problem;
  make_problem(row.values, 0.5, problem);
  put_surroundings(problem);
  try {
    const SystemEquilibrium found = tendril::solve(problem, options_, row.context, &nominal_);
    if (found.ok()) read_positions(found, out);
    return found.ok();
  } catch (const UsageError&) {
    return false;
  }
}

/// In small steps from the nominal design: what the way leads to counts, also where nothing was found before.
void SystemSolver::follow_from_nominal(Row& row) const {
  const bool found = row.status != OutcomeStatus::failed;
  const auto path = [&](double t, SystemProblem& problem) {
    make_problem(row.values, t, problem);
    put_surroundings(problem);
  };
  MotionOptions motion;
  motion.steps = following_steps;
  motion.most_solves = most_following_solves;
  SolveOptions options = options_;
  options.max_iterations = std::min(options.max_iterations, most_following_iterations);
  Motion way;
  try {
    way = follow(problem_, path, motion, options, row.context, &nominal_);
  } catch (const UsageError& error) {
    way.message = error.what();
  }
  if (row.context.stop()) {
    row.status = OutcomeStatus::unsolved;
    return;
  }
  if (!way.ok()) {
    if (!found) return;
    row.status = OutcomeStatus::jumped;
    row.message = "not reached from the nominal design in small steps: " + way.message;
    return;
  }
  row.status = way.snaps.empty() ? OutcomeStatus::solved : OutcomeStatus::jumped;
  row.message = way.snaps.empty() ? "" : description_of(way.snaps.front(), rod_names_);
  SystemEquilibrium& reached = way.steps.back().equilibrium;
  if (!found || farthest_apart(row, reached) > same_equilibrium)
    row.equilibrium = std::make_unique<SystemEquilibrium>(std::move(reached));
}

/// Of the longest rod's length.
double SystemSolver::farthest_apart(const Row& row, const SystemEquilibrium& other) const {
  Positions there;
  read_positions(other, there);
  double farthest = 0, length = 0;
  for (std::size_t i = 0; i < there.size(); ++i) farthest = std::max(farthest, (there[i] - row.positions[i]).norm());
  for (const RodProblem& rod : problem_.rods) length = std::max(length, rod.rod.length);
  return farthest / length;
}

/// All that is known of an equilibrium, where a batch left but its frames.
void SystemSolver::make_whole(Row& row) const {
  if (row.equilibrium) return;
  SystemEquilibrium from;
  for (int k = 0; k < row.results->rods(); ++k) from.rods.push_back(row.reader->rod(k, false));
  for (int b = 0; b < row.results->branches(); ++b) from.branches.push_back(row.results->branch(row.index, b));
  const auto whole = [&] { return tendril::solve(row.problem, options_, {}, &from); };
  row.equilibrium = std::make_unique<SystemEquilibrium>(whole());
  if (row.equilibrium->ok()) return;
  row.status = OutcomeStatus::failed;
  row.message = row.equilibrium->rods.front().message;
}

}  // namespace tendril::variation
