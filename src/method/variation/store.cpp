#include "method/variation/store.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/file_access.h"
#include "base/load_module.h"
#include "method/variation/fingerprint.h"

namespace tendril::variation {
namespace {

constexpr int version = 1;
constexpr double most_seconds = 0.25;  // between two commits

std::unique_ptr<Database> open(const std::string& name) {
  const std::string path = writable_path(name);
  static const auto entry = reinterpret_cast<OpenDatabase>(module_entry("method.variation: store", "tendril_store.so", database_entry));
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  std::string why;
  std::unique_ptr<Database> database(entry(path.c_str(), why));
  if (!database) throw UsageError("method.variation: store: '" + path + "' cannot be opened: " + why);
  return database;
}

/// A name as SQL writes it.
std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string names_of(const std::vector<Column>& columns) {
  std::string out;
  for (const Column& column : columns) out += (out.empty() ? "" : ", ") + column.name;
  return out;
}

double number_in(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::nan("");
}

Blob bytes_of(std::span<const double> numbers) {
  Blob out(numbers.size_bytes());
  if (!out.empty()) std::memcpy(out.data(), numbers.data(), out.size());
  return out;
}

/// The columns that the variables and measures have in the table: a measure may be called as a variable is.
std::vector<std::string> column_names(const std::vector<Column>& variables, const std::vector<Column>& measures) {
  std::vector<std::string> out;
  for (const Column& column : variables) out.push_back(quoted("variable " + column.name));
  for (const Column& column : measures) out.push_back(quoted("measure " + column.name));
  return out;
}

}  // namespace

Store::Store(const std::string& path, const Study& study)
    : path_(path), database_(open(path)), variables_(study.variables()), measures_(study.measures()),
      effects_(study.effect_numbers()) {
  run("PRAGMA busy_timeout = 2000");
  run("PRAGMA locking_mode = EXCLUSIVE");
  run("PRAGMA journal_mode = WAL");
  run("PRAGMA synchronous = NORMAL");
  prepare(study);
  compare(study);
}

Store::~Store() {
  try {
    commit();
  } catch (const UsageError&) {
    // The rows of the last quarter of a second are lost with the disk that refused them; commit() says so where it can.
  }
}

void Store::run(const std::string& statement, std::span<const Cell> values, const Database::OnRow& on_row) {
  const std::string error = database_->run(statement, values, on_row);
  if (error.empty()) return;
  const bool busy = error.find("locked") != std::string::npos;
  throw UsageError("method.variation: store: '" + path_ + "': " + error +
                   (busy ? "; does another process work on it?" : "; is it a study's file? Give another name or remove it"));
}

void Store::prepare(const Study& study) {
  run("CREATE TABLE IF NOT EXISTS study (name TEXT PRIMARY KEY, value TEXT)");
  std::string columns = "outcome INTEGER PRIMARY KEY, status TEXT NOT NULL, message TEXT, effects BLOB";
  std::string marks = "?, ?, ?, ?";
  for (const std::string& name : column_names(variables_, measures_)) {
    columns += ", " + name + " REAL";
    marks += ", ?";
  }
  insert_ = "INSERT OR REPLACE INTO outcome VALUES (" + marks + ")";
  bool fresh = true;
  run("SELECT 1 FROM study LIMIT 1", {}, [&](auto) { fresh = false; });
  if (!fresh) return;
  run("BEGIN IMMEDIATE");
  run("CREATE TABLE outcome (" + columns + ")");
  const auto note = [&](const char* name, const std::string& value) {
    const Cell cells[] = {std::string(name), value};
    run("INSERT INTO study VALUES (?, ?)", cells);
  };
  note("version", std::to_string(version));
  note("seed", std::to_string(study.seed()));
  note("sampling", name_of(study.options().sampling));
  note("variables", names_of(variables_));
  note("measures", names_of(measures_));
  note("fingerprint", fingerprint(study));
  run("COMMIT");
}

void Store::compare(const Study& study) {
  const auto same = [&](const char* name, const std::string& here) {
    std::string there;
    const Cell key[] = {std::string(name)};
    run("SELECT value FROM study WHERE name = ?", key, [&](std::span<const Cell> row) {
      if (const auto* text = std::get_if<std::string>(&row[0])) there = *text;
    });
    if (there != here)
      throw UsageError("method.variation: store: '" + path_ + "' holds another study: its " + name + " is " +
                       (there.empty() ? "missing" : there) + ", here it is " + here + "; give another file name or remove it");
  };
  same("version", std::to_string(version));
  same("seed", std::to_string(study.seed()));
  same("sampling", name_of(study.options().sampling));
  same("variables", names_of(variables_));
  same("measures", names_of(measures_));
  same("fingerprint", fingerprint(study));
}

std::vector<Outcomes> Store::parts() {
  std::vector<Outcomes> out;
  int expected = -1;
  struct Row {
    int outcome;
    OutcomeStatus status;
    std::string message;
    std::vector<double> variables, measures, effects;
  };
  std::vector<Row> rows;
  const auto flush = [&] {
    if (rows.empty()) return;
    Outcomes& part = out.emplace_back(rows.front().outcome, static_cast<int>(rows.size()), variables_, measures_, effects_);
    for (Row& row : rows) part.set(row.outcome, row.status, row.variables, row.measures, row.effects, std::move(row.message));
    rows.clear();
  };
  run("SELECT * FROM outcome ORDER BY outcome", {}, [&](std::span<const Cell> cells) {
    const std::size_t width = 4 + variables_.size() + measures_.size();
    const auto* number = std::get_if<std::int64_t>(&cells[0]);
    const auto* status = std::get_if<std::string>(&cells[1]);
    if (!number || !status || cells.size() != width) return;
    Row row{static_cast<int>(*number) - 1, OutcomeStatus::unsolved, {}, {}, {}, {}};
    for (const OutcomeStatus one : {OutcomeStatus::solved, OutcomeStatus::jumped, OutcomeStatus::failed})
      if (*status == name_of(one)) row.status = one;
    if (row.status == OutcomeStatus::unsolved) return;
    if (const auto* text = std::get_if<std::string>(&cells[2])) row.message = *text;
    row.effects.resize(effects_);
    const auto* blob = std::get_if<Blob>(&cells[3]);
    if (effects_ > 0 && blob && blob->size() == effects_ * sizeof(double)) std::memcpy(row.effects.data(), blob->data(), blob->size());
    for (std::size_t k = 0; k < variables_.size(); ++k) row.variables.push_back(number_in(cells[4 + k]));
    for (std::size_t k = 0; k < measures_.size(); ++k) row.measures.push_back(number_in(cells[4 + variables_.size() + k]));
    if (row.outcome != expected) flush();
    expected = row.outcome + 1;
    rows.push_back(std::move(row));
  });
  flush();
  return out;
}

void Store::add(const OutcomeView& outcome) {
  if (outcome.status == OutcomeStatus::unsolved) return;
  if (!open_) {
    run("BEGIN IMMEDIATE");
    open_ = true;
    began_ = Clock::now();
  }
  std::vector<Cell> cells{std::int64_t{outcome.outcome + 1}, std::string(name_of(outcome.status)), std::string(outcome.message),
                          bytes_of(outcome.effects)};
  for (const double value : outcome.variables) cells.emplace_back(value);
  for (const double value : outcome.measures) cells.emplace_back(value);
  run(insert_, cells);
  if (std::chrono::duration<double>(Clock::now() - began_).count() > most_seconds) commit();
}

void Store::commit() {
  if (!open_) return;
  run("COMMIT");
  open_ = false;
}

}  // namespace tendril::variation
