// From a scene and its equilibrium to a picture's plain data. Knows no Lua and draws nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "binding/compose_designs.h"
#include "scene/scene.h"
#include "view/picture.h"

namespace tendril {

/// What the colour of a rod says. plain: PictureWish::plain. moves: PictureWish::moves.
enum class RodColour { clearance, curvature, tension, twist, plain, moves };

/// Drawn beside the scene and its equilibrium, and rows for the card.
struct PictureExtras {
  std::vector<PictureTube> tubes;
  std::vector<PicturePath> paths;
  std::vector<PictureLabel> labels;
  std::vector<PictureCard::Row> rows;
};

struct PictureWish {
  RodColour colour = RodColour::clearance;
  Rgb plain{0.20f, 0.42f, 0.65f};
  std::vector<std::vector<double>> moves;         ///< m, by rod and vertex: how far tolerances move them
  std::optional<std::vector<std::string>> ghost;  ///< these obstacles are ghosted, the others solid; default: all
  std::string title;
  std::vector<std::string> views{"iso", "front", "top", "card"};
  int width = 1600, height = 1200;
  std::vector<std::string> fit;                   ///< rods and obstacles to fill the views; default: rods and envelope
  /// A transparent shell around the rods. With RodColour::clearance it is the shell that the colours speak of: how far its
  /// vertices are from the obstacles, negative inside. The rods are plain then.
  std::shared_ptr<const TriangleSurface> envelope;
  std::vector<PictureDesign> designs;     ///< drawn besides; without an equilibrium the card speaks of them
  std::optional<ColourScale> gap_scale;   ///< of the designs' gaps
  PictureExtras extras;
};

/// Throws UsageError for obstacles to ghost that are not there.
void compose_check(const Scene& scene, const SceneEquilibrium* equilibrium, const PictureWish& wish);

/// `equilibrium` null: the scene as it stands, its obstacles and holds without any rod. Throws UsageError for names that
/// neither the equilibrium nor the scene knows.
Picture compose_picture(const Scene& scene, const SceneEquilibrium* equilibrium, const PictureWish& wish);

}  // namespace tendril
