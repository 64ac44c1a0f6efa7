#include "binding/compose_assembly.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "binding/card.h"
#include "binding/compose_tubes.h"

namespace tendril {
namespace {

constexpr Rgb pale{0.80f, 0.84f, 0.88f}, full{0.20f, 0.42f, 0.65f}, red{0.80f, 0.10f, 0.10f};

constexpr double shortest_labelled = 0.08;  // of the board

Rgb mixed(double share) {
  const float s = static_cast<float>(share);
  return {pale.r + s * (full.r - pale.r), pale.g + s * (full.g - pale.g), pale.b + s * (full.b - pale.b)};
}

/// "6.45 %".
std::string percent_text(double share) { return plain_number(std::round(1e4 * share) / 100) + " %"; }

/// "523.4 mm".
std::string length_text(double metres) { return plain_number(std::round(1e4 * metres) / 10) + " mm"; }

}  // namespace

PictureExtras extras_of(const assembly::Result& result, int frames) {
  PictureExtras extras;
  const std::vector<assembly::KeyFrame>& play = result.play;
  for (int i = 0; i + 1 < frames && !play.empty(); ++i) {
    const double t = static_cast<double>(i) / (frames - 1);
    const auto nearest = std::min_element(play.begin(), play.end(), [t](const auto& a, const auto& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
    PictureWish plain;
    plain.colour = RodColour::plain;
    plain.plain = mixed(t);
    std::vector<PictureTube> tubes = compose_tubes(*nearest->equilibrium, plain);
    if (tubes.empty()) continue;
    extras.labels.push_back({tubes.front().points.front(), std::nullopt, "t = " + plain_number(std::round(1e3 * nearest->t) / 1e3), false});
    for (PictureTube& tube : tubes) {
      tube.name += " at t = " + plain_number(nearest->t);
      extras.tubes.push_back(std::move(tube));
    }
  }
  if (result.handle_path.size() > 1) extras.paths.push_back({"handle", result.handle_path, red, 3, false});
  if (result.stopped_at) extras.labels.push_back({*result.stopped_at, std::nullopt, "stopped here", true});
  if (!result.ok) return extras;
  extras.rows = {{"hands", std::to_string(result.hands), false},
                 {"deviation", quantity(result.proof.deviation, "m"), false},
                 {"largest strain", percent_text(result.proof.strain), false},
                 {"min. bend radius on the way", quantity(result.proof.bend_radius, "m"), false}};
  return extras;
}

PictureExtras extras_of(const assembly::FlattenResult& board) {
  PictureExtras extras;
  for (const assembly::BoardPoint& point : board.points) extras.labels.push_back({point.at, std::nullopt, point.name, false});
  for (const assembly::BoardLine& line : board.lines) {
    // A label beside a line that is shorter than itself would say more about its place than about the line.
    if (line.points.empty() || line.length < shortest_labelled * std::max(board.width, board.height)) continue;
    extras.labels.push_back({line.points[line.points.size() / 2], std::nullopt, length_text(line.length), false});
  }
  extras.rows = {{"board", length_text(board.width) + " x " + length_text(board.height), false},
                 {"crossings", std::to_string(board.crossings), board.crossings > 0},
                 {"largest strain", percent_text(board.worst_strain), false}};
  return extras;
}

}  // namespace tendril
