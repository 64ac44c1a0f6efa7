#include "method/route/derivative_free.h"

#include <exception>

#include "base/load_module.h"

namespace tendril::routing {

SearchOutcome search(const SearchTask& task) {
  static const auto entry =
      reinterpret_cast<SearchEntry>(module_entry("refine: solver 'gradient_free'", "tendril_search.so", search_entry));
  // NLopt is C: an exception may not pass through it.
  std::exception_ptr thrown;
  SearchTask guarded = task;
  guarded.value = [&](const Eigen::VectorXd& x) {
    try {
      return task.value(x);
    } catch (...) {
      thrown = std::current_exception();
      return 0.0;
    }
  };
  guarded.stop = [&] { return thrown || task.stop(); };
  SearchOutcome out;
  entry(guarded, out);
  if (thrown) std::rethrow_exception(thrown);
  return out;
}

}  // namespace tendril::routing
