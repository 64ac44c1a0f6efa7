// A picture as plain data, and the one call that draws it into a PNG file.
//
// Nothing here knows of scenes, solvers or OpenGL. Lengths are metres in world axes (z up in the named views); values
// on tubes are numbers in the unit that the colour bar names. Drawing happens in a module that is loaded on the first
// call of save_picture: a program that saves no picture pays nothing for it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/frame.h"
#include "base/run_context.h"

namespace tendril {

/// sRGB, each 0 ... 1.
struct Rgb {
  float r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// How a surface is drawn.
///   ghost  surroundings: pale clay with edges; what lies between the eye and a tube is cut away and left as a veil
///   solid  always opaque, never cut; a tube behind it shows as a pale dashed hint
///   veil   always a transparent shell around what it holds (an envelope)
enum class SurfaceStyle { ghost, solid, veil };

/// A triangle mesh. The arrays are not copied: keep them alive until save_picture returns, or hand over `owner`.
/// Vertices need not be shared between triangles: equal positions are joined before edges are looked for.
/// Triangles that name a missing or non-finite vertex are left out, and counted in the report.
struct PictureSurface {
  std::string name;
  std::span<const Vec3> vertices;                          ///< m, in the mesh's own axes
  std::span<const std::array<std::int32_t, 3>> triangles;  ///< 0-based
  std::shared_ptr<const void> owner;
  Frame pose;  ///< mesh axes to world
  SurfaceStyle style = SurfaceStyle::ghost;
  double share = 0.2;  ///< opacity where it is a veil, 0.05 ... 0.6
  Rgb colour{0.76f, 0.75f, 0.73f};
  bool edges = true;  ///< draw creases above 30 degrees and open borders
  /// One per vertex, in ColourScale::unit, coloured by Picture::scale; NaN where unknown (drawn in `colour`). Empty: all
  /// in `colour`.
  std::vector<double> values;
};

/// A rod at its true radius with round ends. `values`, one per point, are coloured by Picture::scale; empty: `colour`.
struct PictureTube {
  std::string name;
  std::vector<Vec3> points;    ///< centre line, m, at least 2; consecutive equal points are joined
  double radius = 0;           ///< m
  std::vector<double> radii;   ///< m, one per point, for a section that varies; empty: `radius`
  std::vector<double> values;  ///< in ColourScale::unit; NaN where unknown (drawn grey)
  Rgb colour{0.20f, 0.42f, 0.65f};
};

/// What the values of tubes and surfaces mean, hence their colours.
///   magnitude   lightness grows from dark blue to light yellow
///   diverging   blue below 0, red above, pale at 0, the same span on both sides
///   clearance   light near the required value (`limit`), dark far from it; below it the hard break to red stripes
enum class ColourMeaning { magnitude, diverging, clearance };

/// Which values break the limit: they are drawn red and striped.
enum class LimitSide { none, below, above };

struct ColourScale {
  ColourMeaning meaning = ColourMeaning::magnitude;
  std::string name;                    ///< "curvature"
  std::string unit;                    ///< "1/m"; the values are in this unit already
  std::optional<double> low, high;     ///< default: the smallest and largest value (diverging: symmetric about 0)
  std::optional<double> limit;         ///< marked on the bar
  LimitSide broken = LimitSide::none;  ///< clearance with a limit: always `below`
};

/// Where and how a tube is held, drawn as a small collar (clamp), ball (pin) or open ring (guide).
struct PictureHold {
  enum class Kind { clamp, pin, guide };
  Frame frame;        ///< d3 along the tube
  double radius = 0;  ///< of the tube there, m
  Kind kind = Kind::clamp;
  std::string label;  ///< empty: none
};

/// A force or direction, drawn with a constant size on the page.
struct PictureArrow {
  Vec3 at = Vec3::Zero();          ///< where it acts: the tip with `pushes`, else the tail
  Vec3 direction = Vec3::UnitZ();  ///< any length but zero
  bool pushes = false;
  Rgb colour{0.70f, 0.25f, 0.10f};
  std::string label;
};

/// A note with a leader line. With `to`, the segment at - to is drawn as a measured gap and the note names it.
struct PictureLabel {
  Vec3 at = Vec3::Zero();
  std::optional<Vec3> to;
  std::string text;    ///< "gap 6.2 mm"
  bool alarm = false;  ///< red
};

/// A thin line of constant width on the page: a path, a design before it settled.
struct PicturePath {
  std::string name;
  std::vector<Vec3> points;  ///< m
  Rgb colour{0.25f, 0.25f, 0.25f};
  double width = 1.5;  ///< pixels
  bool dashed = false;
};

struct PictureCard {
  struct Row {
    std::string label, value;
    bool alarm = false;  ///< value in red
  };
  std::string title;
  std::vector<Row> rows;
};

struct PictureBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m
};

/// All that one picture shows.
struct Picture {
  std::vector<PictureSurface> surfaces;
  std::vector<PictureTube> tubes;
  std::vector<PictureHold> holds;
  std::vector<PictureArrow> arrows;
  std::vector<PictureLabel> labels;
  std::vector<PicturePath> paths;
  ColourScale scale;  ///< the bar is drawn when a tube or surface has values
  PictureCard card;

  /// "iso", "front", "top", "side", "card": one to six, laid out in rows of two (one alone fills the picture).
  std::vector<std::string> views{"iso", "front", "top", "card"};
  int width = 1600, height = 1200;  ///< pixels
  /// What every view shows, with 10 % to spare on each side. Default: the tubes; without tubes, everything.
  std::optional<PictureBox> fit;

  /// Pictures that the page shows instead, in cells in reading order: views of one state each, as of a motion. Their own sizes
  /// and panels do not count.
  std::vector<Picture> panels;
  int columns = 0;  ///< of panels; 0: all in one row
};

/// How the drawing went.
struct PictureReport {
  Status status = Status::solved;  ///< solved, cancelled or timeout; the file is written only when solved
  double seconds = 0;              ///< with loading the module, if this was the first picture
  std::size_t triangles = 0;       ///< in the picture
  std::size_t edges = 0;           ///< feature edges found
  std::size_t left_out = 0;        ///< triangles that name a missing or non-finite vertex
  struct Step {
    std::string name;
    double seconds;
  };
  std::vector<Step> steps;
};

/// Throws UsageError unless `picture` can be drawn: sizes 16 ... 16384 pixels and at most 64 million of them, known
/// views, something to show, finite numbers, as many values as points. The message says who, what was got and what was
/// expected.
void check_picture(const Picture& picture);

/// Draws and writes a PNG, whole or not at all; a missing folder is created. The same picture gives the same bytes.
/// Throws UsageError for a name that does not end in .png, for what check_picture refuses, and when the drawing module,
/// its font or the file cannot be had. Polls `context` between steps (each well below a second).
PictureReport save_picture(const Picture& picture, const std::string& path, const RunContext& context = {});

/// The PNG's bytes instead of a file, for a terminal that can show pictures. Empty when stopped.
std::string picture_png(const Picture& picture, const RunContext& context, PictureReport* report = nullptr);

}  // namespace tendril
