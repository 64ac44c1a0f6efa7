// What a scene's solve will do and what it leaves out, before or after it is done.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "statics/problem.h"

namespace tendril {

/// One term, method or structure of the model, used or left out, and the reason.
struct ExplainedItem {
  std::string subject;  ///< the name of a rod or branch point, or "scene"
  std::string name;     ///< "gravity", "contact", "solver", ...
  bool used = false;
  std::string why;
};

struct Explanation {
  std::vector<ExplainedItem> items;

  /// True when the scene or some rod uses what has this name. Throws UsageError for a name that no item has.
  bool uses(std::string_view name) const;

  /// Lines of text: the scene first, then each rod and branch point; "-" marks what is left out.
  std::string text() const;
};

/// Reads the scene without building or solving anything.
Explanation explain(const Scene& scene, const SolveOptions& options = {});

}  // namespace tendril
