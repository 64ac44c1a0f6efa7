#include "method/variation/outcomes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tendril::variation {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void append_number(std::string& text, double value) {
  char number[40];
  std::snprintf(number, sizeof number, "%.17g", value);
  text += number;
}

/// Quoted where it holds what means something in a table.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool same_columns(const std::vector<Column>& a, const std::vector<Column>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Column& x, const Column& y) { return x.name == y.name && x.unit == y.unit; });
}

}  // namespace

const char* name_of(OutcomeStatus status) {
  switch (status) {
    case OutcomeStatus::unsolved: return "unsolved";
    case OutcomeStatus::solved: return "solved";
    case OutcomeStatus::jumped: return "jumped";
    case OutcomeStatus::failed: return "failed";
  }
  return "";
}

Outcomes::Outcomes(int first, int size, std::vector<Column> variables, std::vector<Column> measures, int effects)
    : first_(first),
      variables_(std::move(variables)),
      measures_(std::move(measures)),
      status_(size, OutcomeStatus::unsolved),
      values_(size * variables_.size(), nothing),
      measured_(size * measures_.size(), nothing),
      effects_(static_cast<std::size_t>(size) * effects, nothing) {}

bool Outcomes::has_measures(int outcome) const {
  return status(outcome) == OutcomeStatus::solved || status(outcome) == OutcomeStatus::jumped;
}

const std::string& Outcomes::message(int outcome) const {
  static const std::string none;
  const auto found = messages_.find(outcome);
  return found == messages_.end() ? none : found->second;
}

void Outcomes::set(int outcome, OutcomeStatus status, std::span<const double> variables, std::span<const double> measures,
                   std::span<const double> effects, std::string message) {
  if (outcome < first() || outcome >= last())
    throw UsageError("method.variation: got outcome " + std::to_string(outcome) + ", expected " + std::to_string(first()) +
                     " to " + std::to_string(last() - 1));
  const auto put = [&](std::vector<double>& table, std::span<const double> row, const char* what) {
    const std::size_t width = table.size() / status_.size();
    if (row.size() != width)
      throw UsageError("method.variation: outcome " + std::to_string(outcome) + " has " + std::to_string(row.size()) + " " +
                       what + ", expected " + std::to_string(width));
    std::copy(row.begin(), row.end(), table.begin() + (outcome - first_) * static_cast<std::ptrdiff_t>(width));
  };
  put(values_, variables, "variables");
  put(measured_, measures, "measures");
  put(effects_, effects, "total effects");
  status_[outcome - first_] = status;
  if (message.empty()) messages_.erase(outcome);
  else messages_[outcome] = std::move(message);
}

Outcomes Outcomes::merged(std::span<const Outcomes> parts) {
  if (parts.empty()) throw UsageError("method.variation: there are no outcomes to put together");
  std::vector<const Outcomes*> sorted;
  for (const Outcomes& part : parts)
    if (part.size() > 0) sorted.push_back(&part);
  if (sorted.empty()) return parts.front();
  std::sort(sorted.begin(), sorted.end(), [](const Outcomes* a, const Outcomes* b) { return a->first() < b->first(); });
  const auto width = [](const Outcomes& o) { return o.effects_.size() / o.status_.size(); };
  Outcomes all(sorted.front()->first(), 0, sorted.front()->variables_, sorted.front()->measures_, 0);
  for (const Outcomes* part : sorted) {
    if (!same_columns(part->variables_, all.variables_) || !same_columns(part->measures_, all.measures_) ||
        width(*part) != width(*sorted.front()))
      throw UsageError("method.variation: these outcomes belong to different studies: their columns differ");
    if (part->first() != all.last())
      throw UsageError("method.variation: outcomes " + std::to_string(part->first()) + " and on " +
                       (part->first() < all.last()
                            ? "are there twice"
                            : "do not follow those before, which end at " + std::to_string(all.last() - 1)));
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.status_, part->status_);
    append(all.values_, part->values_);
    append(all.measured_, part->measured_);
    append(all.effects_, part->effects_);
    all.messages_.insert(part->messages_.begin(), part->messages_.end());
  }
  return all;
}

int Outcomes::count(OutcomeStatus status) const { return static_cast<int>(std::count(status_.begin(), status_.end(), status)); }

std::vector<int> Outcomes::all(OutcomeStatus status) const {
  std::vector<int> found;
  for (int k = first(); k < last(); ++k)
    if (this->status(k) == status) found.push_back(k);
  return found;
}

std::vector<double> Outcomes::column(int measure) const {
  std::vector<double> values;
  for (int k = first(); k < last(); ++k)
    if (has_measures(k)) values.push_back(measures_of(k)[measure]);
  return values;
}

std::string Outcomes::csv() const {
  std::string text = "outcome,status";
  for (const std::vector<Column>* columns : {&variables_, &measures_})
    for (const Column& column : *columns)
      text += "," + cell(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  text += ",message\n";
  for (int k = first(); k < last(); ++k) {
    text += std::to_string(k + 1) + "," + name_of(status(k));
    for (const std::span<const double> row : {variables_of(k), measures_of(k)})
      for (const double value : row) {
        text += ",";
        if (!std::isnan(value)) append_number(text, value);
      }
    text += "," + cell(message(k)) + "\n";
  }
  return text;
}

}  // namespace tendril::variation
