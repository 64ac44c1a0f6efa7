#include "binding/method_options.h"

namespace tendril::lua {

Schema method_schema() {
  return Schema{
             option<int>("seed", "", "Of all random numbers: the same seed gives the same bits").at_least(0).preset(1),
             option<int>("threads", "", "At most; default: all that the machine has").at_least(1).at_most(4096),
             option<Function>("progress", "", "function(share, what), called now and then"),
         } +
         timeout_schema();
}

lua_State* running_state(lua_State* L) { return context(L).running.load(); }

RunContext method_context(lua_State* L, const Options& o) {
  RunContext run = run_context(L, o);
  run.seed = static_cast<std::uint64_t>(o.get<int>("seed"));
  run.threads = o.maybe<int>("threads").value_or(0);
  if (o.has("progress"))
    run.progress = [L, function = o.get<Function>("progress")](double share, const char* what) {
      function.call<void>(L, "progress", share, std::string(what ? what : ""));
    };
  return run;
}

}  // namespace tendril::lua
