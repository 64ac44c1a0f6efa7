// A class of the tests' own, bound with everything the layer offers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "binding/lua_class.h"

struct Probe {
  static inline int alive = 0;
  explicit Probe(std::string n) : name(std::move(n)) { ++alive; }
  Probe(const Probe& other) : name(other.name), values(other.values) { ++alive; }
  Probe(Probe&& other) noexcept : name(std::move(other.name)), values(std::move(other.values)) { ++alive; }
  ~Probe() { --alive; }

  std::string name;
  std::vector<double> values{10, 20, 30};
};

namespace tendril::lua {
template <>
inline constexpr const char* class_name<Probe> = "probe";
}

/// Adds the module `probe` to a state.
void bind_probe(lua_State* L);
