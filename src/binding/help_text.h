// What help says, from the record of everything bound.
#pragma once

#include <string>

#include "binding/lua_registry.h"

namespace tendril::lua {

std::string help_overview(const Registry& registry);
std::string help_text(const FunctionRecord& function);
std::string help_text(const ClassRecord& record);
std::string help_text(const ModuleRecord& module);

/// By name: "rod.section", "scene:solve" or "scene.solve", "vec", "rod"; "" when nothing bound has that name.
std::string help_named(const Registry& registry, const std::string& name);

/// What there is for words that are no name, the best first: "" for nothing.
std::string help_search_text(const Registry& registry, const std::string& query);

}  // namespace tendril::lua
