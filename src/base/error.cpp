#include "base/error.h"

namespace tendril {

const char* name_of(Status status) {
  switch (status) {
    case Status::solved: return "solved";
    case Status::stalled: return "stalled";
    case Status::cancelled: return "cancelled";
    case Status::timeout: return "timeout";
    case Status::infeasible: return "infeasible";
  }
  return "unknown";
}

}  // namespace tendril
