// What a person has typed so far: the shell looks at text that is no program yet, and offers what could follow.
#include "binding/open.h"
#include "fuzz_target.h"
#include "shell/completion.h"
#include "shell/source_scan.h"

using namespace tendril;

namespace {

/// A state with everything of tendril and a few variables to complete.
class State {
 public:
  State() : L(lua::open_state(context_)) {
    lua::open_tendril(L);
    luaL_dostring(L, "s = scene.new{} eq = {points = {vec(1, 2, 3)}, rod = rod} parts = {bay = s, [1] = s}");
  }
  ~State() { lua_close(L); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

 private:
  lua::Context context_;

 public:
  lua_State* const L;
};

void expect_scan(std::string_view text) {
  const shell::Scan scan = shell::scan(text);
  std::size_t last = 0;
  for (const auto& open : scan.open) {
    fuzz::expect(open.at < text.size() && text[open.at] == open.bracket, "an open bracket stands where the scan says");
    fuzz::expect(open.at >= last, "open brackets come outermost first");
    last = open.at;
  }
  for (const auto& [behind, start] : scan.group_start) fuzz::expect(start < behind && behind <= text.size(), "groups begin before they end");
  if (scan.string_at) fuzz::expect(*scan.string_at < text.size(), "an open string begins within the text");
  for (const auto& link : shell::chain_before(text, scan, text.size()))
    fuzz::expect(link.name.empty() || (link.name.data() >= text.data() && link.name.data() + link.name.size() <= text.data() + text.size()),
                 "names are parts of the text");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static State state;
  const std::string text(fuzz::text_of(data, size));
  expect_scan(text);
  const int top = lua_gettop(state.L);
  const shell::Completion offered = shell::complete(state.L, text);
  fuzz::expect(lua_gettop(state.L) == top, "completion leaves the stack as it was");
  fuzz::expect(offered.typed <= text.size(), "what is replaced is part of the text");
  for (const std::string& candidate : offered.candidates) fuzz::expect(!candidate.empty(), "a candidate is something");
  return 0;
}
