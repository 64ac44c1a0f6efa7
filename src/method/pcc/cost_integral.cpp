#include "method/pcc/cost_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::routing {
namespace {

/// Of the mean over a part of a piece: what halving it may still change. A part without a kink keeps a fifteenth of that.
constexpr double accuracy = 5e-5;
constexpr int deepest = 10;
/// The first parts, in ranges of preference: what is narrower than that might be missed.
constexpr double first_part = 0.2;

/// Over one piece, by shares of it.
class PieceIntegral {
 public:
  PieceIntegral(const FreeSpace& space, const PccPiece& piece) : space_(space), piece_(piece) {}

  /// Per metre, the mean of the piece.
  double mean() const {
    const int parts = std::clamp(static_cast<int>(std::ceil(piece_.length / (first_part * space_.demands().preference_range))), 1, 100000);
    double sum = 0, at_a = cost(0);
    for (int i = 0; i < parts; ++i) {
      const double a = double(i) / parts, b = double(i + 1) / parts, middle = cost(0.5 * (a + b)), at_b = cost(b);
      sum += part(a, b, at_a, middle, at_b, simpson(at_a, middle, at_b), deepest);
      at_a = at_b;
    }
    return sum / parts;
  }

 private:
  double cost(double share) const { return space_.cost(piece_.at(share)); }
  static double simpson(double a, double middle, double b) { return (a + 4 * middle + b) / 6; }

  double part(double a, double b, double at_a, double middle, double at_b, double whole, int depth) const {
    const double half = 0.5 * (a + b), low = cost(0.5 * (a + half)), high = cost(0.5 * (half + b));
    const double left = simpson(at_a, low, middle), right = simpson(middle, high, at_b), halves = 0.5 * (left + right);
    if (depth == 0 || !(std::abs(halves - whole) > accuracy * halves)) return halves + (halves - whole) / 15;
    return 0.5 * (part(a, half, at_a, low, middle, left, depth - 1) + part(half, b, middle, high, at_b, right, depth - 1));
  }

  const FreeSpace& space_;
  const PccPiece& piece_;
};

}  // namespace

double cost_integral(const FreeSpace& space, const PccPoints& curve) {
  const double length = curve.length();
  if (!std::isfinite(length)) return std::numeric_limits<double>::infinity();
  if (!space.has_preferences()) return length;
  double sum = length;
  for (const PccPiece& piece : pieces_of(curve)) sum += (PieceIntegral(space, piece).mean() - 1) * piece.length;
  return sum;
}

}  // namespace tendril::routing
