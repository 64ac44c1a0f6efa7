// KBL files with the settled centre lines in place of the drawn ones.
#pragma once

#include <string>

#include "harness/import_harness.h"
#include "scene/scene_equilibrium.h"

namespace tendril {

/// The harness's file as it was, byte for byte, but for what settling changes: of every segment that is a rod in `settled` the
/// centre curves (cubics within 0.01 mm of the rod's centre line, in the file's own reading of B-splines), start and end vectors
/// and virtual length; the places of the nodes; where sliding clips have come to. Control points that only the old curves used
/// are taken out. Throws UsageError for a harness that was no KBL file, and an equilibrium without its rods.
std::string settled_kbl(const ImportedHarness& harness, const SceneEquilibrium& settled);

/// The same, written to the file whole or not at all.
void save_kbl(const std::string& path, const ImportedHarness& harness, const SceneEquilibrium& settled);

}  // namespace tendril
