// What method.assembly found, as scripts see it: handles on parts of one result.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "method/assembly/options.h"

namespace tendril::lua {

struct AssemblyHandle {
  std::shared_ptr<const assembly::Result> result;
  std::shared_ptr<Scene> scene;
  std::vector<assembly::Connector> connectors;
};

/// The paths of all grips.
struct GripPathsHandle {
  std::shared_ptr<const assembly::Result> result;
};

/// One of them.
struct GripPathHandle {
  std::shared_ptr<const assembly::Result> result;
  int index = 0;
  const assembly::Grip& grip() const { return result->manipulation.grips[index]; }
};

/// The worst of all states that were played.
struct AssemblyWorstHandle {
  std::shared_ptr<const assembly::Result> result;
};

struct AssemblyProofHandle {
  std::shared_ptr<const assembly::Result> result;
};

template <> inline constexpr const char* class_name<AssemblyHandle> = "assembly";
template <> inline constexpr const char* class_name<GripPathsHandle> = "grip_paths";
template <> inline constexpr const char* class_name<GripPathHandle> = "grip_path";
template <> inline constexpr const char* class_name<AssemblyWorstHandle> = "assembly_worst";
template <> inline constexpr const char* class_name<assembly::Attempt> = "assembly_attempt";
template <> inline constexpr const char* class_name<AssemblyProofHandle> = "assembly_proof";

}  // namespace tendril::lua
