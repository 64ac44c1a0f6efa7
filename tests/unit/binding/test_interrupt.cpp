// Interrupts without signals: the flag is set from inside the script's own functions.
#include <atomic>
#include <catch2/catch.hpp>

#include "binding/lua_class.h"
#include "unit/binding/script.h"

using namespace tendril::lua;

namespace {

/// A script that can press Ctrl-C itself, and start a computation that is cancelled by it.
struct Interruptible : Script {
  Interruptible() {
    context.cancel = &flag;
    Module(L, "test", "For tests")
        .function("press", {.does = "Ctrl-C."},
                  [this] {
                    flag = true;
                    interrupt(context);
                  })
        .function("compute", {.does = "A computation that Ctrl-C ends."}, [this](lua_State* state) {
          const tendril::RunContext run = run_context(state);
          if (!run.stop()) {
            flag = true;
            interrupt(context);
          }
          ++computed;
          return std::string(run.stop() ? "cancelled" : "solved");
        });
  }

  /// Runs `code` and says where it was struck; "" when it was not.
  std::string struck(const std::string& code) {
    (*this)(code);
    return context.struck_at;
  }

  void clear() {
    flag = false;
    rearm(L);
  }

  std::atomic<bool> flag{false};
  int computed = 0;
};

}  // namespace

TEST_CASE("the instruction after an interrupt raises the error") {
  Interruptible lua;
  CHECK(lua.struck("test.press()\nreached = true") == "code:2: interrupted");
  lua.clear();
  CHECK(lua("return reached") == "nil");
}

TEST_CASE("no pcall, coroutine or handler swallows an interrupt") {
  Interruptible lua;
  const auto code = GENERATE(
      as<std::string>(), "while true do pcall(test.press) end", "while true do pcall(function() test.press() while true do end end) end",
      "coroutine.wrap(function() test.press() while true do end end)()",
      "while true do coroutine.resume(coroutine.create(test.press)) end",
      "while true do pcall(coroutine.wrap(function() pcall(coroutine.wrap(function() test.press() end)) end)) end",
      "local c = coroutine.create(function() test.press() coroutine.yield() end) coroutine.resume(c) while true do end",
      "while true do xpcall(test.press, function() while true do end end) end",
      "do local x <close> = setmetatable({}, {__close = function() test.press() end}) end while true do end",
      "table.sort({5, 4, 3, 2, 1}, function(a, b) test.press() return a < b end) while true do end");
  INFO(code);
  CHECK(lua.struck(code) == "code:1: interrupted");
  lua.clear();
  CHECK(lua("local n = 0 for i = 1, 1e5 do n = n + 1 end return n") == "100000");
}

TEST_CASE("a cancelled computation hands its result to the script before the interrupt strikes") {
  Interruptible lua;
  CHECK(lua.struck("result = test.compute()\nwhile true do end") != "");
  lua.clear();
  CHECK(lua("return result") == "cancelled");
}

TEST_CASE("a loop of computations is interrupted, each being given up at once") {
  Interruptible lua;
  CHECK(lua.struck("n = 0 while true do local r = test.compute() n = n + 1 end") != "");
  CHECK(lua.computed < 10);
}

TEST_CASE("only one computation of an interrupt is given the grace") {
  Interruptible lua;
  CHECK(lua.struck("while true do pcall(function() while true do test.compute() end end) end") != "");
  lua.clear();
  CHECK(lua.struck("again = test.compute() while true do end") != "");
  lua.clear();
  CHECK(lua("return again") == "cancelled");
}

TEST_CASE("a suspended coroutine that had been struck runs again later") {
  Interruptible lua;
  lua("c = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i) end end) c()");
  CHECK(lua.struck("coroutine.wrap(function() test.press() end)() ") != "");
  lua.clear();
  CHECK(lua("return c(), c()") == "2, 3");
}

TEST_CASE("coroutines behave as the library's own") {
  Script lua;
  CHECK(lua("local f = coroutine.wrap(function(a) local b = coroutine.yield(a + 1) return b * 2, 'end' end) return f(1), f(5)") ==
        "2, 10, end");
  CHECK(lua("local c = coroutine.create(function(...) return select('#', ...) end) return coroutine.resume(c, 1, nil, nil)") ==
        "true, 3");
  CHECK(lua("local c = coroutine.create(function() error({code = 5}) end) local ok, e = coroutine.resume(c) return ok, e.code") ==
        "false, 5");
  CHECK(lua("local f = coroutine.wrap(function() error('inside') end) return pcall(f)") == "false, code:1: inside");
  CHECK(lua("coroutine.resume(5)") == "code:1: bad argument #1 to 'resume' (thread expected, got number)");
  CHECK(lua("local f = coroutine.wrap(function() end) f() f()") == "code:1: cannot resume dead coroutine");
  CHECK(lua("local c c = coroutine.create(function() return coroutine.status(c), coroutine.isyieldable() end)"
            " return coroutine.resume(c)") == "true, running, true");
}
