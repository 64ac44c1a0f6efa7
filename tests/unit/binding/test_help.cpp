// Help, examples and editor annotations, for everything that is bound.
#include <catch2/catch.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "base/write_file.h"
#include "binding/help_search.h"
#include "binding/help_text.h"
#include "unit/binding/script.h"

using namespace tendril::lua;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {
/// Without regard to how the words are spaced.
std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Makes a new folder the current one for a while.
class TemporaryFolder {
 public:
  TemporaryFolder() : before_(std::filesystem::current_path()) {
    std::string pattern = (std::filesystem::temp_directory_path() / "tendril_examples_XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    folder_ = pattern;
    std::filesystem::current_path(folder_);
  }
  ~TemporaryFolder() {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  std::filesystem::path before_, folder_;
};
}  // namespace

TEST_CASE("everything bound has a text, and every function an example") {
  Script lua;
  for (const auto& function : lua.context.registry->functions) {
    INFO(function->name);
    CHECK_FALSE(function->text.empty());
    CHECK_FALSE(function->example.empty());
    for (const Option& option : function->options.entries()) {
      INFO(option.name);
      CHECK_FALSE(option.text.empty());
    }
  }
  for (const auto& record : lua.context.registry->classes) {
    INFO(record->name);
    CHECK_FALSE(record->text.empty());
    for (const auto& [name, property] : record->properties) {
      INFO(name);
      CHECK_FALSE(property.text.empty());
    }
  }
  for (const auto& module : lua.context.registry->modules) CHECK_FALSE(module->text.empty());
}

TEST_CASE("names are bound once") {
  Script lua;
  std::set<std::string> names;
  for (const auto& function : lua.context.registry->functions) {
    INFO(function->name);
    CHECK(names.insert(function->name).second);
    std::set<std::string> options;
    for (const Option& option : function->options.entries()) {
      INFO(option.name);
      CHECK(options.insert(option.name).second);
    }
  }
}

TEST_CASE("every example of help runs and prints what it says") {
  std::vector<std::pair<std::string, std::string>> examples;
  {
    Script lua;
    for (const auto& function : lua.context.registry->functions) examples.emplace_back(function->name, function->example);
  }
  const TemporaryFolder files;  // some of them save pictures
  for (const auto& [name, example] : examples) {
    Script lua;  // examples do not lean on each other
    INFO(name << ":\n" << example);
    luaL_dostring(lua.L, "printed = '' function print(...) local t = table.pack(...) for i = 1, t.n do t[i] = tostring(t[i]) end "
                         "printed = printed .. table.concat(t, '  ') .. '\\n' end");
    const std::string failure = lua(example);
    CHECK(failure.empty());
    if (const auto mark = example.find("--> "); mark != std::string::npos)
      CHECK(words(lua("return printed")) == words(example.substr(mark + 4)));
  }
}

TEST_CASE("help finds functions, classes, modules and objects") {
  Script lua;
  const Registry& registry = *lua.context.registry;
  CHECK_THAT(help_named(registry, "frame"), StartsWith("frame{at=, along=, [up=]} -> frame\n  A place and orientation"));
  CHECK_THAT(help_named(registry, "frame"), Contains("option  unit  meaning") && Contains("required") && Contains("Example\n"));
  CHECK_THAT(help_named(registry, "vec:dot"), StartsWith("vec:dot(other) -> number"));
  CHECK(help_named(registry, "vec.dot") == help_named(registry, "vec:dot"));
  CHECK_THAT(help_named(registry, "units"), StartsWith("units\n  Factors to SI") && Contains("units.mm   millimetre"));
  CHECK(help_named(registry, "nothing").empty());
  CHECK_THAT(help_overview(registry), Contains("units") && Contains("frame") && Contains("help"));
}

TEST_CASE("help in Lua") {
  Script lua;
  luaL_dostring(lua.L, "function print(text) printed = text end");
  CHECK_THAT(lua("help() return printed"), StartsWith("tendril: "));
  CHECK_THAT(lua("help(vec) return printed"), StartsWith("vec(x, y, z) -> vec") && Contains(":cross"));
  CHECK_THAT(lua("help(vec(1, 2, 3)) return printed"), StartsWith("vec\n"));
  CHECK_THAT(lua("help(units) return printed"), StartsWith("units\n"));
  CHECK_THAT(lua("place = frame{at = {0, 0, 0}, along = {1, 0, 0}} help 'place' return printed"), StartsWith("frame\n"));
  CHECK(lua("help(print) return printed") == "no help about a function");
  CHECK(lua("parts = {place = place} help 'parts.place' return printed") == lua("help(place) return printed"));
  CHECK(lua("x = 5 help 'x' return printed") == "x is a number (5); there is no help about it");
  CHECK(lua("help 'vec:dto'") == "code:1: help: nothing is called 'vec:dto'; did you mean 'vec:dot'?");
  CHECK_THAT(lua("help 'frmae' return printed"), StartsWith("nothing is called 'frmae'; did you mean 'frame'?\n  frame "));
  CHECK_THAT(lua("help 'bend rad' return printed"), StartsWith("nothing is called 'bend rad'; what comes near it:\n  "));
  CHECK(lua("help 'os.exit(1)'") == "code:1: help: nothing is called 'os.exit(1)'");
}

TEST_CASE("help finds what one does not know the name of") {
  Script lua;
  const Registry& registry = *lua.context.registry;
  const auto first = [&](const std::string& query) {
    const auto found = search_help(registry, query);
    return found.empty() ? std::string() : found.front().name;
  };
  // Slips in a name, words of a text, beginnings, several words.
  CHECK(first("secton") == "rod.section");
  CHECK(first("scene:slove") == "scene:solve");
  CHECK(first("Section") == "rod.section");
  CHECK(first("accurcy") == "study.accuracy");
  CHECK(first("dress pack") == "method.dress_pack");
  CHECK(first("envelop").ends_with(":envelope"));
  CHECK(first("preformed hose") == "hose");
  CHECK(search_help(registry, "preformed hose")[1].name == "method.preform");
  const auto contains = [&](const std::string& query, const std::string& name) {
    const auto found = search_help(registry, query, 1000);
    return std::any_of(found.begin(), found.end(), [&](const HelpMatch& m) { return m.name == name; });
  };
  CHECK(contains("tolernce", "scene:solve"));            // an option of it
  CHECK(contains("bend rad", "solved_rod"));             // a property: min_bend_radius
  CHECK(contains("negative eigenvalue", "equilibrium"));
  CHECK(contains("megapascal", "units"));
  for (const char* nothing : {"", " ", "...", "qqqq", "xylophone zebra", "os.exit(1)"}) {
    INFO(nothing);
    CHECK(search_help(registry, nothing).empty());
  }
}

TEST_CASE("every name is found by itself, with a slip of the pen, too") {
  Script lua;
  const Registry& registry = *lua.context.registry;
  for (const auto& function : registry.functions) {
    const std::string own = function->own_name();
    std::string slip = own;
    if (slip.size() >= 5) std::swap(slip[2], slip[3]);
    INFO(function->name << " by '" << slip << "'");
    const auto found = search_help(registry, function->name, 1000), slipped = search_help(registry, slip, 1000);
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().score >= slipped.front().score);
    const auto is_it = [&](const HelpMatch& match) { return match.name == function->name; };
    CHECK(std::any_of(found.begin(), found.end(), is_it));
    CHECK(std::any_of(slipped.begin(), slipped.end(), is_it));
  }
}

TEST_CASE("the best match comes first, and each name once") {
  Script lua;
  for (const char* query : {"rod", "gap", "tolerance", "save picture", "mesh"}) {
    const auto found = search_help(*lua.context.registry, query);
    INFO(query);
    REQUIRE_FALSE(found.empty());
    CHECK(found.size() <= 12);
    std::set<std::string> names;
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(names.insert(found[i].name).second);
      CHECK_FALSE(help_named(*lua.context.registry, found[i].name).empty());
      if (i > 0) CHECK(found[i - 1].score >= found[i].score);
    }
  }
}

TEST_CASE("the editor annotations in the tree are those of what is bound") {
  Script lua;
  const std::string bound = annotations(*lua.context.registry);
  CHECK_THAT(bound, StartsWith("---@meta tendril\n") && Contains("function frame(options) end") &&
                        Contains("---@operator mul(number|vec|number[]): vec\n"));
  INFO("after a change: build/tendril --annotations > lua/meta/tendril.lua");
  CHECK((bound == tendril::read_file("lua/meta/tendril.lua")));
}

TEST_CASE("the editor annotations are a Lua module without an effect") {
  Script lua;
  CHECK(luaL_loadstring(lua.L, annotations(*lua.context.registry).c_str()) == LUA_OK);
}
