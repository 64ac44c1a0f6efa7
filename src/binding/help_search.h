// Finding what one does not know the name of.
#pragma once

#include <string>
#include <vector>

#include "binding/lua_registry.h"

namespace tendril::lua {

struct HelpMatch {
  std::string name;  ///< as help() takes it: "rod.section", "scene:solve", "equilibrium"
  std::string text;  ///< its line; of an option or property that matched: that one's
  double score = 0;
};

/// Everything bound whose name or text has the words of `query`, the best first, at most `most`: words whole, as beginnings, or
/// with a letter or two wrong; in a name they count more than in a text. Two words of three must be found.
std::vector<HelpMatch> search_help(const Registry& registry, const std::string& query, std::size_t most = 12);

}  // namespace tendril::lua
