#include "method/variation/whole_study.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include "base/error.h"
#include "base/processes.h"
#include "method/variation/rows_as_bytes.h"
#include "method/variation/store.h"

namespace tendril::variation {
namespace {

constexpr int block_of_process = 512;  // outcomes between two exchanges, so that a file fills up as a study goes on

/// Every process's bytes. Where one of them fails all of them do, so that none waits for ever.
std::vector<std::string> gathered_from(const std::function<std::string()>& mine) {
  std::string bytes = "+";
  std::exception_ptr failure;
  try {
    bytes += mine();
  } catch (...) {
    failure = std::current_exception();
    bytes = "-";
  }
  std::vector<std::string> all = gathered(bytes);
  if (failure) std::rethrow_exception(failure);
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].empty() || all[rank].front() != '+')
      throw UsageError("method.variation: process " + std::to_string(rank) + " has failed; its message tells why");
    all[rank].erase(0, 1);
  }
  return all;
}

/// Outcomes first ... last - 1 by all processes together.
Outcomes run_block(const Study& study, int first, int last, const OnOutcome& on_outcome, const RunContext& context) {
  const int count = process_count(), rank = process_rank();
  if (count == 1) return study.run(first, last, on_outcome, context);
  const auto bound = [&](int k) { return first + static_cast<int>((static_cast<long long>(last - first) * k) / count); };
  std::vector<Outcomes> parts;
  for (const std::string& bytes :
       gathered_from([&] { return bytes_of(study.run(bound(rank), bound(rank + 1), on_outcome, context)); }))
    parts.push_back(rows_of(bytes, study));
  return Outcomes::merged(parts);
}

/// What is computed, and what was in the file.
class Collected {
 public:
  Collected(const Study& study, Store* store, bool stored, const OnOutcome& on_outcome, const RunContext& context)
      : study_(study), store_(store), block_(stored ? block_of_process * process_count() : study.options().outcomes),
        on_outcome_(on_outcome), context_(context) {}

  void take(Outcomes done) {
    fill_up_to(done.first());
    next_ = done.last();
    parts_.push_back(std::move(done));
  }

  void fill_up_to(int last) {
    // Also after a stop, so that the parts make a whole: those rows come back unsolved at once.
    while (next_ < last) {
      const int end = std::min(last, next_ + block_);
      parts_.push_back(run_block(study_, next_, end, [&](const OutcomeView& outcome) { pass(outcome); }, context_));
      if (store_ && process_count() > 1) keep(parts_.back());
      next_ = end;
    }
  }

  Outcomes merged() const { return Outcomes::merged(parts_); }

 private:
  void pass(const OutcomeView& outcome) {
    if (store_ && process_count() == 1) store_->add(outcome);
    if (on_outcome_) on_outcome_(outcome);
  }

  void keep(const Outcomes& rows) {
    for (int k = rows.first(); k < rows.last(); ++k)
      store_->add({k, rows.status(k), rows.variables_of(k), rows.measures_of(k), rows.effects_of(k), rows.message(k), {}});
    store_->commit();
  }

  const Study& study_;
  Store* store_;  ///< null: no file, or another process keeps it
  int block_;     ///< outcomes between two exchanges; all processes must agree on it
  const OnOutcome& on_outcome_;
  const RunContext& context_;
  std::vector<Outcomes> parts_;
  int next_ = 0;
};

/// Opens the file in the first process. What it holds, all processes must know.
std::vector<Outcomes> opened(const std::string& path, const Study& study, std::unique_ptr<Store>& store) {
  if (process_count() == 1) {
    store = std::make_unique<Store>(path, study);
    return store->parts();
  }
  const std::vector<std::string> all = gathered_from([&] {
    std::string bytes;
    if (!is_first_process()) return bytes;
    store = std::make_unique<Store>(path, study);
    for (const Outcomes& part : store->parts()) append_part(bytes_of(part), bytes);
    return bytes;
  });
  std::vector<Outcomes> parts;
  for (const std::string& part : parts_of(all.front())) parts.push_back(rows_of(part, study));
  return parts;
}

}  // namespace

Result run(const Scene& scene, const Options& options, const OnOutcome& on_outcome, const RunContext& context,
           const std::string& store_path) {
  const auto start = std::chrono::steady_clock::now();
  Result result;
  const auto study = std::make_shared<const Study>(scene, options, context);
  std::unique_ptr<Store> store;
  std::vector<Outcomes> done;
  if (!store_path.empty()) done = opened(store_path, *study, store);
  Collected collected(*study, store.get(), !store_path.empty(), on_outcome, context);
  for (Outcomes& part : done) collected.take(std::move(part));
  collected.fill_up_to(options.outcomes);
  if (store) store->commit();
  result.study = study;
  result.outcomes = collected.merged();
  const bool whole = result.outcomes.count(OutcomeStatus::unsolved) == 0;
  result.status = whole ? Status::solved : context.stop().value_or(Status::stalled);
  result.ok = whole && result.outcomes.count(OutcomeStatus::failed) == 0;
  result.message = summary(result.outcomes);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string summary(const Outcomes& outcomes) {
  std::string text = std::to_string(outcomes.size()) + (outcomes.size() == 1 ? " outcome" : " outcomes");
  for (const OutcomeStatus status : {OutcomeStatus::failed, OutcomeStatus::jumped, OutcomeStatus::unsolved}) {
    const std::vector<int> all = outcomes.all(status);
    if (all.empty()) continue;
    constexpr std::size_t most = 8;
    text += ", " + std::to_string(all.size()) + " " + name_of(status) + " (";
    for (std::size_t i = 0; i < std::min(most, all.size()); ++i) text += (i ? ", " : "") + std::to_string(all[i] + 1);
    text += all.size() > most ? ", ...)" : ")";
  }
  return text;
}

}  // namespace tendril::variation
