#include "method/variation/row_solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"

namespace tendril::variation {
namespace {

constexpr int rows_at_once = 8;  // that a thread takes
constexpr int batch_portion = 1024, near_obstacles = 256, alone = 16, least_portion = 64;
constexpr std::size_t most_bytes = 16 << 20;  // of a portion's frames

int severity(OutcomeStatus status) {
  switch (status) {
    case OutcomeStatus::solved: return 0;
    case OutcomeStatus::jumped: return 1;
    case OutcomeStatus::failed: return 2;
    case OutcomeStatus::unsolved: return 3;
  }
  return 3;
}

bool is_equilibrium(OutcomeStatus status) { return status == OutcomeStatus::solved || status == OutcomeStatus::jumped; }

/// One thread's view of one system's answers.
struct SystemReader {
  SystemProblem problem;
  std::optional<RodReader> reader;
};

}  // namespace

RowSolver::RowSolver(const SceneEquilibrium& nominal, const Variables& variables, const Measures& measures,
                     const SolveOptions& options, const RunContext& context)
    : nominal_(nominal), variables_(variables), measures_(measures), place_of_rod_(nominal.rods.size()) {
  const Eigen::VectorXd variances = variables.covariance().diagonal();
  std::vector<double> deviations;
  for (const double variance : variances) deviations.push_back(std::sqrt(variance));
  for (int k = 0; k < static_cast<int>(nominal.systems.size()); ++k) {
    systems_.push_back(std::make_unique<SystemSolver>(nominal, k, variables, deviations, options, context));
    const std::vector<int>& rods = nominal.systems[k].rods;
    for (int i = 0; i < static_cast<int>(rods.size()); ++i) place_of_rod_[rods[i]] = {k, i};
  }
}

int RowSolver::portion(const RunContext& context) const {
  std::size_t bytes = 1;
  for (const auto& system : systems_) bytes += system->bytes_of_row();
  int rows = std::clamp(static_cast<int>(most_bytes / bytes), least_portion, batch_portion);
  for (const auto& system : systems_)
    if (system->one_by_one()) rows = std::min(rows, alone * thread_count(context.threads));
  return nominal_.surroundings ? std::min(rows, near_obstacles) : rows;
}

void RowSolver::solve(std::span<const double> values, int rows, bool whole, RowAnswers& answers,
                      const RunContext& context) const {
  answers.systems.resize(systems_.size());
  answers.status.assign(rows, OutcomeStatus::solved);
  answers.measured.assign(static_cast<std::size_t>(rows) * measures_.count(), std::nan(""));
  for (std::size_t k = 0; k < systems_.size(); ++k) {
    SystemAnswers& own = answers.systems[k];
    systems_[k]->solve(values, rows, whole || measures_.needs_equilibrium(static_cast<int>(k)), own, context);
    for (int r = 0; r < rows; ++r)
      if (severity(own.status[r]) > severity(answers.status[r])) answers.status[r] = own.status[r];
  }
  read_measures(values, answers, context);
}

void RowSolver::read_measures(std::span<const double> values, RowAnswers& answers, const RunContext& context) const {
  const int rows = static_cast<int>(answers.status.size()), count = measures_.count();
  const std::size_t columns = variables_.dimensions();
  std::vector<int> read;
  for (int k = 0; k < static_cast<int>(systems_.size()); ++k)
    if (measures_.reads(k)) read.push_back(k);
  if (read.empty()) return;
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), (rows + rows_at_once - 1) / rows_at_once), [&](int) {
    std::vector<SystemReader> readers(systems_.size());
    for (const int k : read)
      if (systems_[k]->batch()) readers[k].reader.emplace(*systems_[k]->batch());
    for (int first; (first = next.fetch_add(rows_at_once)) < rows;)
      for (int r = first; r < std::min(rows, first + rows_at_once); ++r) {
        if (!is_equilibrium(answers.status[r])) continue;
        for (const int k : read) {
          SystemReader& own = readers[k];
          systems_[k]->make_problem(values.subspan(r * columns, columns), 1, own.problem);
          SystemOutcome outcome{&own.problem, answers.systems[k].equilibria[r].get(), nullptr, &answers.systems[k].batch, r};
          if (!outcome.equilibrium) {
            own.reader->stand_at(answers.systems[k].batch, r, own.problem);
            outcome.reader = &*own.reader;
          }
          measures_.read(k, outcome, {&answers.measured[static_cast<std::size_t>(r) * count], static_cast<std::size_t>(count)});
        }
      }
  });
}

std::string RowSolver::message(const RowAnswers& answers, int row) const {
  std::string text;
  for (std::size_t k = 0; k < systems_.size(); ++k) {
    const SystemAnswers& own = answers.systems[k];
    if (own.messages[row].empty() || own.status[row] != answers.status[row]) continue;
    text += (text.empty() ? "" : "; ") +
            (systems_.size() > 1 ? nominal_.rods[nominal_.systems[k].rods.front()].name + ": " : "") + own.messages[row];
  }
  return text;
}

SceneEquilibrium RowSolver::equilibrium(std::span<const double> row, const RowAnswers& answers, int number) const {
  SceneEquilibrium out = nominal_;
  out.modes.reset();
  for (std::size_t k = 0; k < systems_.size(); ++k) {
    if (!systems_[k]->varies()) continue;
    SolvedSystem& system = out.systems[k];
    variables_.apply(static_cast<int>(k), row, 1, system.problem);
    for (std::size_t i = 0; i < system.rods.size(); ++i) out.rods[system.rods[i]].problem = system.problem.rods[i];
    const SystemAnswers& own = answers.systems[k];
    SystemEquilibrium found = own.equilibria[number] ? *own.equilibria[number] : systems_[k]->nominal();
    if (!is_equilibrium(own.status[number])) {
      const bool failed = own.status[number] == OutcomeStatus::failed;
      for (Equilibrium& rod : found.rods) {
        if (rod.ok()) rod.status = failed ? Status::stalled : Status::cancelled;
        rod.message = failed ? own.messages[number] : "interrupted before this outcome was solved";
      }
    }
    out.take(std::move(found), system.rods, system.branches);
  }
  return out;
}

std::span<const double> RowSolver::frames(const RowAnswers& answers, int row, int rod, std::vector<double>& scratch) const {
  const auto [system, index] = place_of_rod_[rod];
  const SystemAnswers& own = answers.systems[system];
  if (!own.equilibria[row]) return own.batch.frames(row, index);
  const Equilibrium &found = own.equilibria[row]->rods[index], &nominal = systems_[system]->nominal().rods[index];
  scratch.clear();
  for (std::size_t i = 0; i < nominal.s.size(); ++i) {
    const Frame frame = found.s.size() == nominal.s.size() ? Frame{found.points[i], found.rotations[i]}
                                                           : found.frame_at(nominal.s[i] / nominal.s.back() * found.s.back());
    const Quat& q = frame.rotation;
    for (const double n : {frame.at.x(), frame.at.y(), frame.at.z(), q.w(), q.x(), q.y(), q.z()}) scratch.push_back(n);
  }
  return scratch;
}

}  // namespace tendril::variation
