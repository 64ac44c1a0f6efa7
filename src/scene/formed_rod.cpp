#include "scene/formed_rod.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {

void form(Rod& rod, const Curve& curve) {
  rod.length = curve.length();
  rod.shape = CurveShape{curve};
  rod.shape_breaks = curve.breaks();
}

const Curve* curve_of(const Rod& rod) {
  const CurveShape* shape = rod.shape.target<CurveShape>();
  return shape ? &shape->curve : nullptr;
}

void check_bends(const Rod& rod, const Curve& curve, const std::string& who) {
  const double radius = curve.min_bend_radius(), at = curve.min_bend_radius_at();
  if (radius > rod.section_at(at).radius()) return;
  throw UsageError(who + ": 'shape' bends with a radius of " + number_text(radius / units::mm) + " mm at s = " +
                   number_text(at / units::mm) + " mm, expected more than the rod's own radius" +
                   (radius == 0 ? "; round its corners with curve.pcc" : ""));
}

}  // namespace tendril
