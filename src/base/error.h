// How tendril speaks of failure: a broken precondition throws UsageError; a numerical outcome is a result with a Status.
#pragma once

#include <stdexcept>
#include <string>

namespace tendril {

/// The caller asked for something that cannot be: a wrong number, name, file or combination. The message names who,
/// what was got, what was expected and, where one helps, a hint.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How a computation ended. Never an exception.
enum class Status { solved, stalled, cancelled, timeout, infeasible };

/// "solved", "stalled", "cancelled", "timeout", "infeasible".
const char* name_of(Status status);

}  // namespace tendril
