// A system of rods laid out on a plane build board: without gravity and surroundings, lengths kept, branches apart (thesis 3.4).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "method/step.h"
#include "scene/scene.h"

namespace tendril::assembly {

struct FlattenOptions {
  std::vector<std::string> rods;  ///< names; empty: all of the scene, which must hang together
  double spacing = 0;             ///< m, least distance between the axes of rods that do not meet; 0: four times the thickest radius
};

/// A branch point or a free end on the board.
struct BoardPoint {
  std::string name;   ///< "junction 1", "hose.finish"
  Vec3 at = Vec3::Zero();  ///< m, board axes: z = 0
};

struct BoardLine {
  std::string rod;
  double length = 0;             ///< m, on the board
  double design_length = 0;      ///< m, unstressed
  std::vector<Vec3> points;      ///< m, board axes
};

struct FlattenResult {
  bool ok = false;
  Status status = Status::stalled;
  std::string message;           ///< where it is not ok: which rods cross or are strained, and by how much
  double seconds = 0;
  std::vector<MethodStep> steps;
  std::vector<BoardPoint> points;
  std::vector<BoardLine> lines;
  double width = 0, height = 0;  ///< m, of the board
  double worst_strain = 0;       ///< of lying flat
  int crossings = 0;
  std::shared_ptr<const SceneEquilibrium> equilibrium;  ///< on the board
};

/// Throws UsageError for unknown names and for rods that do not hang together.
FlattenResult flatten(const Scene& scene, const FlattenOptions& options = {}, const RunContext& context = {});

/// Board layout as CSV: a row for each point and each line's points; mm.
std::string board_csv(const FlattenResult& result);

}  // namespace tendril::assembly
