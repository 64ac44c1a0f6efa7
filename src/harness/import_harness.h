// From a harness file to a scene: a rod for every sound segment, branch points where they meet, connectors and fixings as holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "harness/centre_line.h"
#include "harness/harness_file.h"
#include "rod/bundle.h"
#include "scene/scene.h"

namespace tendril {

/// What a segment is without load: straight, as bundles come off the build board, or as the file draws it.
enum class HarnessShape { straight, drawn };

/// What a fixing holds of the rod through it: all, all but sliding, the place only, or nothing (the fixing is left out).
enum class HarnessClip { fixed, slide, swivel, none };

struct HarnessImportOptions {
  Vec3 gravity = Vec3::Zero();    ///< m/s^2
  HarnessShape shape = HarnessShape::drawn;
  HarnessClip clips = HarnessClip::fixed;
  std::optional<double> slip;     ///< of the wires in their bundle, see BundleOptions; unset: its default
  double element = 25e-3;         ///< m, longest element of a rod
};

/// What became of one segment of the file.
struct ImportedSegment {
  std::string rod;                ///< its name in the scene: the segment's id; empty: it was left out
  std::string left_out;           ///< why
  double length = 0;              ///< m, of the centre line
  double stated_length = 0;       ///< m; 0: not stated
  double cut_off = 0;             ///< m, see CentreLine
  double outer = 0;               ///< m, of the bundle of its wires
  double stated_outer = 0;        ///< m, from the cross-section that the file states; 0: none
  double min_bend_radius = 0;     ///< m, allowed; 0: not known
  double drawn_bend_radius = 0;   ///< m, the smallest of the drawn line; infinite: straight
  double EI = 0, EI_slipping = 0, EI_glued = 0;  ///< N m^2
  double mass = 0;                ///< kg
  int clips = 0;
  KnotReading reading = KnotReading::clamped;
};

struct ImportedHarness {
  HarnessFile file;
  std::vector<ImportedSegment> segments;  ///< one for each of the file's
  std::vector<std::string> notes;         ///< what was assumed, skipped or mended, one sentence each
  int held_ends = 0, branches = 0, clips = 0;

  /// Wires with the length of the segments they run through in the scene, m.
  std::vector<double> wire_lengths() const;
};

/// Adds the harness to `scene`. Rods are called as the segments' ids, branch points as the nodes'. Ends of the harness are held
/// where they are drawn. Throws UsageError for names that the scene has already, options that make no sense, and a file of which
/// no segment is sound, and when `context` ends it.
ImportedHarness import_harness(HarnessFile file, const HarnessImportOptions& options, Scene& scene, const RunContext& context = {});

/// Reads a file in the format of its suffix (.kbl), or "builtin:t_harness", which comes with the program. Throws UsageError as
/// the readers do, and for other suffixes.
HarnessFile read_harness(const std::string& name);

}  // namespace tendril
