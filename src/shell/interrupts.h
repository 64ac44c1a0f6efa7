// Ctrl-C: from the signal to the running Lua code or computation.
#pragma once

#include <atomic>

#include "binding/lua_context.h"

namespace tendril::shell {

/// While it lives, SIGINT sets `flag()` and strikes the Lua state of `context`. One at a time in a process. Three presses
/// over two seconds that nothing answers end the process, as the signal would have done.
class Interrupts {
 public:
  explicit Interrupts(lua::Context& context);
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  static const std::atomic<bool>& flag();

  /// The interrupt has been dealt with.
  static void clear();

  /// Does what SIGINT does. Async-signal-safe.
  static void strike() noexcept;
};

}  // namespace tendril::shell
