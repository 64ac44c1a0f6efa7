// "Did you mean": the known name nearest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tendril {

/// Smallest number of inserted, deleted, replaced or swapped neighbouring characters that turns `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// The name nearest to `wanted`, or an empty string when none is near enough to be a slip of the fingers (more than
/// a third of its characters differ, at least one edit is always allowed for).
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names);

/// "'hos'; did you mean 'hose'? (rods: hose, cable)": the tail of a message about an unknown name. `kind`: what the
/// names are, in the plural. Without any names: "'hos' (there are no rods)".
std::string unknown_name(std::string_view wanted, const char* kind, const std::vector<std::string>& names);

}  // namespace tendril
