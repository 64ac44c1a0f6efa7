// Scenes in files: everything that a scene holds, as JSON that people can read and change.
//
//   {"format": "tendril scene", "version": 1, "units": "m, kg, s, N, rad", "gravity": [x, y, z],
//    "obstacles": [{"name", "solid" or "mesh", "pose", "clearance", "prefer", "clip"}],
//    "robots":    [{"name", "robot", "checksum", "base", "joints", "clearance"}],
//    "rods":      [{"name", "length", "segments", "parts": [{"upto", "section"}], "shape", "holds", "loads"}],
//    "branches":  [{"name", "places": [{"rod", "at", "relative"}], "frame", "position", "orientation"}]}
//
//   solid    {"kind": "box", "size"}, {"kind": "sphere", "radius"}, {"kind": "cylinder", "radius", "length"}, {"kind": "plane"}
//   mesh     {"file", "unit": metres in one unit of the file, "checksum": FNV-1a of its bytes}, or {"vertices", "triangles"} in m,
//            triangles counting vertices from 1
//   section  {"outer", "inner", "material": {"young", "shear", "density"}, "EA", "GA", "EI", "GJ", "mass"}: from the material alone
//            the rest follows; with both they must agree
//   shape    {"kind": "polyline", "points"}, {"kind": "pcc", "points", "radii"}, {"kind": "spline", "points", "start", "finish"},
//            {"kind": "helix", "radius", "pitch", "turns", "left_handed"}, {"kind": "frames", "stations": [[s, x, y, z, qw, qx, qy,
//            qz], ...]}: the sections' frames at arc lengths from 0 to the rod's length
//   hold     {"at", "frame", "position", "orientation", "turns", "slide"}; with "robot" and "link" the hold goes with the link, and
//            the frame is in its axes
//   load     {"at", "force", "moment"}
//   frame    {"at": [x, y, z], "quaternion": [w, x, y, z]}; read as well: {"at", "along", "up"}
//
// What has a usual value may be left out. Files are named relative to the scene file where they lie in its folder, below it or up
// to two folders above, so that a study can be moved as a whole; others by their whole path.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/run_context.h"
#include "scene/scene.h"

namespace tendril {

/// 0: of drafts; a rod has one "section" in place of "parts". 1: this one.
inline constexpr int scene_file_version = 1;

struct SaveSceneOptions {
  bool embed = false;  ///< meshes stand in the file itself, not by their files' names
};

/// The content of a scene file at `path`: a pure function of the scene, the options, and the bytes of the files it names. Throws
/// UsageError, naming the rod, obstacle or robot, for what a file cannot hold: a shape that is no curve of a known kind, a robot that was
/// not loaded from a file, a mesh file that is gone.
std::string scene_text(const Scene& scene, const std::string& path, const SaveSceneOptions& options = {});

/// The same, written to the file whole or not at all.
void save_scene(const std::string& path, const Scene& scene, const SaveSceneOptions& options = {});

struct LoadedScene {
  std::shared_ptr<Scene> scene;
  std::vector<std::string> warnings;  ///< files that have changed since; sizes of meshes that are unlikely
};

/// What scene_text() wrote, bit by bit: the same scene solves to the same numbers. Reads files of older versions too. Throws UsageError
/// "scene.load: file: place: why" for what is no such file, is of a newer version, misses something or has something unknown,
/// contradicts itself, or names files that are missing.
LoadedScene parse_scene(std::string_view text, const std::string& path, const RunContext& context = {});
LoadedScene load_scene(const std::string& path, const RunContext& context = {});

/// Fowler, Noll, Vo's hash FNV-1a of 64 bits, as 16 hexadecimal digits: tells that a file has changed, not who changed it.
std::string checksum_of(std::string_view bytes);

}  // namespace tendril
