#include "binding/lua_context.h"

#include <cstdlib>
#include <cstring>

#include "binding/lua_registry.h"

namespace tendril::lua {
namespace {

void* allocate(void* user, void* block, std::size_t old_size, std::size_t size) {
  Context& c = *static_cast<Context*>(user);
  const std::size_t before = block ? old_size : 0;  // without a block, old_size is the kind of object
  if (size == 0) {
    std::free(block);
    c.memory_used -= before;
    return nullptr;
  }
  if (c.memory_limit && size > before && c.memory_used - before + size > c.memory_limit) return nullptr;
  void* moved = std::realloc(block, size);
  if (moved) c.memory_used += size - before;
  return moved;
}

}  // namespace

Context::Context() : registry(std::make_unique<Registry>()) {}
Context::~Context() = default;

lua_State* open_state(Context& context) {
  lua_State* L = lua_newstate(allocate, &context);
  if (!L) return nullptr;
  Context* here = &context;
  std::memcpy(lua_getextraspace(L), &here, sizeof here);
  context.running = L;
  luaL_openlibs(L);
  detail::accept_source_only(L);
  detail::track_coroutines(L);
  return L;
}

Context& context(lua_State* L) {
  Context* here = nullptr;
  std::memcpy(&here, lua_getextraspace(L), sizeof here);
  return *here;
}

RunContext run_context(lua_State* L) {
  Context& c = context(L);
  c.cancel_polled = true;
  RunContext run;
  run.cancel = c.cancel;
  run.progress = c.progress;
  return run;
}

}  // namespace tendril::lua
