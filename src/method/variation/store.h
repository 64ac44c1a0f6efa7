// A study's outcomes in a file, as they come: a study that was stopped, or killed, goes on where it was.
//
// The file is an SQLite database with two tables: `study` (what it is: version, fingerprint, seed, variables, measures) and
// `outcome` (a row each: outcome from 1, status, message, a column for each variable and measure). Outcomes are committed
// several times a second in the order in which they come; what a kill takes away is computed again, with the same bits.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "method/variation/database.h"
#include "method/variation/study.h"

namespace tendril::variation {

class Store {
 public:
  /// Opens the file, or makes it. Throws UsageError, naming the file, for one that cannot be opened or is no database, that
  /// another process works on, or that holds another study (another fingerprint, seed, sampling, other variables or measures; of
  /// functions only the names are compared).
  Store(const std::string& path, const Study& study);
  ~Store();
  Store(const Store&) = delete;  // one writer

  /// What is there: parts of the study, in order. Rows that are not solved, jumped or failed are not kept.
  std::vector<Outcomes> parts();

  void add(const OutcomeView& outcome);
  /// Everything added is in the file when it returns.
  void commit();

 private:
  using Clock = std::chrono::steady_clock;
  void run(const std::string& statement, std::span<const Cell> values = {}, const Database::OnRow& on_row = {});
  void prepare(const Study& study);
  void compare(const Study& study);

  std::string path_;
  std::unique_ptr<Database> database_;
  std::vector<Column> variables_, measures_;
  int effects_ = 0;
  std::string insert_;
  bool open_ = false;          ///< a transaction
  Clock::time_point began_{};
};

}  // namespace tendril::variation
