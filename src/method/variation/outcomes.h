// The outcomes of a variation study as a table: a row each, in order, with variables, measures and how it ended.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"

namespace tendril::variation {

/// How one outcome ended.
enum class OutcomeStatus : signed char {
  unsolved,  ///< cancelled or out of time before its turn
  solved,    ///< on the nominal equilibrium's branch
  jumped,    ///< an equilibrium, but the way there from the nominal design goes through a snap
  failed,    ///< no equilibrium; its measures are NaN
};

/// "unsolved", "solved", "jumped", "failed".
const char* name_of(OutcomeStatus status);

/// One column of the table: a component of a variable, or a measure.
struct Column {
  std::string name;    ///< "hose.length", "hose.from.at.x", "hose.from.tilt.1", "hose.from.twist"; or the measure's
  std::string unit;
  double nominal = 0;  ///< components of frames and of gravity's direction are counted from the nominal ones: 0
  int variable = -1;   ///< which of Options::vary
};

/// Rows first() ... first() + size() - 1 of a study.
class Outcomes {
 public:
  Outcomes() = default;
  /// `effects`: numbers that a row of total effects has.
  Outcomes(int first, int size, std::vector<Column> variables, std::vector<Column> measures, int effects);

  int first() const { return first_; }
  int size() const { return static_cast<int>(status_.size()); }
  int last() const { return first_ + size(); }  ///< one behind
  const std::vector<Column>& variables() const { return variables_; }
  const std::vector<Column>& measures() const { return measures_; }

  // By the outcome's number in the study.
  OutcomeStatus status(int outcome) const { return status_[outcome - first_]; }
  bool has_measures(int outcome) const;  ///< solved or jumped
  std::span<const double> variables_of(int outcome) const { return row(values_, outcome); }
  std::span<const double> measures_of(int outcome) const { return row(measured_, outcome); }
  /// By contributor, then by measure, last by measure for all drawn anew; empty where no total effects were asked for.
  std::span<const double> effects_of(int outcome) const { return row(effects_, outcome); }
  const std::string& message(int outcome) const;  ///< empty for solved ones

  /// Sets a row, as it was computed or as it was stored.
  void set(int outcome, OutcomeStatus status, std::span<const double> variables, std::span<const double> measures,
           std::span<const double> effects, std::string message);

  /// Rows of one study put together. Throws UsageError for parts that overlap, leave a hole or have other columns.
  static Outcomes merged(std::span<const Outcomes> parts);

  /// Counts of a status, and which outcomes those are.
  int count(OutcomeStatus status) const;
  std::vector<int> all(OutcomeStatus status) const;

  /// The values of one measure in all outcomes that have it, in order.
  std::vector<double> column(int measure) const;

  /// Comma-separated, a header line with units: outcome (counted from 1), status, variables, measures, message.
  std::string csv() const;

 private:
  std::span<const double> row(const std::vector<double>& of, int outcome) const {
    const std::size_t width = status_.empty() ? 0 : of.size() / status_.size();
    return {of.data() + (outcome - first_) * width, width};
  }

  int first_ = 0;
  std::vector<Column> variables_, measures_;
  std::vector<OutcomeStatus> status_;
  std::vector<double> values_, measured_, effects_;  ///< row by row
  std::map<int, std::string> messages_;
};

}  // namespace tendril::variation
