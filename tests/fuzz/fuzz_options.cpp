// The options layer: the bytes choose a bound function and build its arguments and options. Whatever they are, the call gives a result
// or a Lua error with words; a computation that takes long is cancelled.
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "binding/lua_context.h"
#include "binding/open.h"
#include "empty_folder.h"
#include "fuzz_target.h"
#include "option_bytes.h"

using namespace tendril;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto patience = std::chrono::milliseconds(50);

/// Sets the cancel flag of a call that takes long.
class Impatience {
 public:
  Impatience() : watch_([this](std::stop_token stop) {
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const std::lock_guard lock(guard_);  // the call may end just now: the next one is not to pay for it
      if (since_ && Clock::now() - *since_ > patience) cancel = true;
    }
  }) {}
  void begin() { set(Clock::now()); }
  void end() { set({}); }

  std::atomic<bool> cancel{false};

 private:
  void set(std::optional<Clock::time_point> since) {
    const std::lock_guard lock(guard_);
    since_ = since;
    cancel = false;
  }

  std::mutex guard_;
  std::optional<Clock::time_point> since_;
  std::jthread watch_;
};

/// One small object of each class, made anew for every input: a call may change the scene.
const char* const samples =
    "local material = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
    "local section = rod.section{outer = 0.02, inner = 0.01, material = material}\n"
    "local place, other = frame{at = {0, 0, 0}, along = {1, 0, 0}}, frame{at = {0.8, 0, 0}, along = {1, 0, 0}}\n"
    "local hose = rod.new{length = 1, segments = 6, section = section}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:obstacle('box', scene.box{size = {0.1, 0.1, 0.1}}, {pose = frame{at = {0.4, 0, -0.6}, along = {0, 0, 1}}})\n"
    "local placed = s:rod('hose', hose, {from = place, to = other})\n"
    "local eq = s:solve{}\n"
    "return {vec = vec(1, 2, 3), frame = place, material = material, section = section, rod = hose, scene = s, placed_rod = placed,\n"
    "        equilibrium = eq, curve = curve.polyline{{0, 0, 0}, {1, 0, 0}}, solid = scene.sphere{radius = 0.1},\n"
    "        mesh = scene.mesh{points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles = {{1, 2, 3}}}, rod_equilibrium = eq:rod('hose'),\n"
    "        robot = arm, view = view.new{s, eq}, ['function'] = function(x) return x end}\n";

/// What draws is slow, and has tests of its own.
bool is_left_out(const std::string& name) {
  return name.find(":save") != name.npos || name == "study.accuracy" || name == "time" || name == "help";
}

class State {
 public:
  State() {
    fuzz::EmptyFolder::enter();
    context_.cancel = &impatience.cancel;
    context_.memory_limit = 256 << 20;
    L = lua::open_state(context_);
    lua::open_tendril(L);
    lua_register(L, "print", [](lua_State*) { return 0; });
    fuzz::expect(luaL_loadstring(L, samples) == LUA_OK, "the samples compile");
    make_samples_ = luaL_ref(L, LUA_REGISTRYINDEX);
    for (const auto& function : context_.registry->functions)
      if (!is_left_out(function->name)) functions.push_back(function.get());
  }
  ~State() { lua_close(L); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void push_samples() {
    lua_rawgeti(L, LUA_REGISTRYINDEX, make_samples_);
    const bool made = lua_pcall(L, 0, 1, 0) == LUA_OK;
    fuzz::expect(made, made ? "" : std::string("the samples can be made after ") + last + ", with " + std::to_string(context_.memory_used) +
                                       " bytes in use: " + lua_tostring(L, -1));
  }

  /// The function itself, and for a method its object above it; false where no sample has it.
  bool push_callee(const lua::FunctionRecord& function, int samples_at) {
    const std::string own = function.own_name(), owner = function.name.substr(0, function.name.size() - own.size() - (function.name == own ? 0 : 1));
    if (function.call == lua::FunctionRecord::Call::method) {
      if (lua_getfield(L, samples_at, owner.c_str()) == LUA_TNIL) return false;
      lua_getfield(L, -1, own.c_str());
      lua_insert(L, -2);
      return true;
    }
    if (owner.empty()) return lua_getglobal(L, own.c_str()) == LUA_TFUNCTION;
    lua_getglobal(L, owner.c_str());
    return lua_getfield(L, -1, own.c_str()) == LUA_TFUNCTION;
  }

  lua_State* L = nullptr;
  Impatience impatience;
  std::vector<const lua::FunctionRecord*> functions;
  std::string last = "nothing";  ///< what was called before

 private:
  lua::Context context_;
  int make_samples_ = 0;
};

void expect_words(lua_State* L) {
  fuzz::expect(lua_type(L, -1) == LUA_TSTRING && lua_rawlen(L, -1) > 0, "an error has words");
  const std::string words = lua_tostring(L, -1);
  for (const char* mistake : {"the schema has no option", "neither a value nor a preset", "of another type in the schema", "vector::", "basic_string::",
                              "bad optional access", "map::at", "bad_variant_access"})
    fuzz::expect(words.find(mistake) == words.npos, "no mistake of the binding's own: " + words);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static State state;
  if (size < 3) return 0;
  lua_State* L = state.L;
  lua_settop(L, 0);
  const lua::FunctionRecord& function = *state.functions[(data[0] | data[1] << 8) % state.functions.size()];
  state.push_samples();
  if (state.push_callee(function, 1)) {
    const int callee = lua_gettop(L) - (function.call == lua::FunctionRecord::Call::method ? 1 : 0);
    fuzz::OptionBytes bytes(L, data + 2, size - 2, 1);
    for (const lua::Parameter& parameter : function.parameters) bytes.argument(parameter);
    if (function.takes_options) bytes.options(function.options);
    state.impatience.begin();
    const int status = lua_pcall(L, lua_gettop(L) - callee, 0, 0);
    state.impatience.end();
    lua::rearm(L);
    if (status != LUA_OK) expect_words(L);
    state.last = function.name;
  }
  lua_settop(L, 0);
  lua_gc(L, LUA_GCCOLLECT);
  return 0;
}
