// What one Lua state carries besides its values: the cancel flag, how to talk to the user, the record of everything bound.
// It hangs in the state's extra space, which coroutines inherit; there are no globals.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <lua.hpp>

#include "base/run_context.h"

namespace tendril::lua {

struct Registry;

struct Context {
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const std::atomic<bool>* cancel = nullptr;  ///< set by Ctrl-C; null: nothing interrupts this state
  std::function<void(double share, const char* what)> progress;  ///< shown while something long runs; empty: not shown
  std::function<void()> computation_ended;  ///< a bound function that took a RunContext has returned; may be empty
  bool colour = false;        ///< escapes allowed on standard output
  std::string script_folder;  ///< of the running script, "" for none; ends without a slash
  std::size_t memory_used = 0;
  std::size_t memory_limit = 0;  ///< bytes that Lua's own values may take; 0: no limit

  std::atomic<lua_State*> running{nullptr};  ///< the coroutine that runs now: where an interrupt must strike
  bool grace_given = false;  ///< one interrupted computation may still hand its result to the script
  std::string struck_at;     ///< "file.lua:12: interrupted": where Lua code was struck first; "" when it was not
  bool cancel_polled = false;  ///< the bound function that runs now was given the cancel flag

  std::unique_ptr<Registry> registry;
};

/// A new state whose allocator keeps to the context's memory limit. Lua's standard libraries are open; `load`, `loadfile`,
/// `dofile` and `require` take source text only. Null when there is no memory. `context` must outlive the state.
lua_State* open_state(Context& context);

Context& context(lua_State* L);

/// For a long computation started from Lua: cancelled by Ctrl-C, with the shell's progress.
RunContext run_context(lua_State* L);

/// Call from the signal handler after the cancel flag is set: the running Lua code raises an error at its next
/// instruction, and again after every pcall that swallows it, until `rearm` is called. Async-signal-safe.
void interrupt(Context& context) noexcept;

/// The interrupt has been dealt with: Lua code may run again. The caller clears the cancel flag.
void rearm(lua_State* L);

bool interrupted(lua_State* L);

/// When the bound function that ends now was cancelled by an interrupt, its result may still be stored: a few
/// instructions are let through before the interrupt strikes. Once for each interrupt.
void give_grace(lua_State* L);

namespace detail {
void accept_source_only(lua_State* L);  ///< load, loadfile, dofile and require refuse binary chunks and native libraries
void track_coroutines(lua_State* L);    ///< keeps Context::running up to date
}  // namespace detail

}  // namespace tendril::lua
