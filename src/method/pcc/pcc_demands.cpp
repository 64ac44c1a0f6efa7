#include "method/pcc/pcc_demands.h"

namespace tendril::routing {

const char* name_of(Violation::Kind kind) {
  switch (kind) {
    case Violation::Kind::clearance: return "clearance";
    case Violation::Kind::keep_in: return "keep_in";
    case Violation::Kind::keep_out: return "keep_out";
    case Violation::Kind::straight: return "straight";
    case Violation::Kind::end_straight: return "end_straight";
    case Violation::Kind::length: return "length";
    case Violation::Kind::turn: return "turn";
    case Violation::Kind::cone: return "cone";
    case Violation::Kind::radius: return "radius";
    case Violation::Kind::crossing: return "crossing";
  }
  return "";
}

}  // namespace tendril::routing
