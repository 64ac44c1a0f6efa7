#include "rod/section.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {
namespace {

void require(bool good, const char* who, const char* what, double got, const char* expected) {
  if (!good) throw UsageError(std::string(who) + ": '" + what + "' is " + number_text(got) + ", expected " + expected);
}

void require_positive(const char* who, const char* what, double value) {
  require(std::isfinite(value) && value > 0, who, what, value, "a finite number above 0");
}

}  // namespace

Material Material::from_poisson(double young, double poisson, double density) {
  require(std::isfinite(poisson) && poisson > -1 && poisson <= 0.5, "rod.material", "poisson", poisson,
          "above -1 and at most 0.5");
  return from_shear(young, young / (2 * (1 + poisson)), density);
}

Material Material::from_shear(double young, double shear, double density) {
  require_positive("rod.material", "young", young);
  require_positive("rod.material", "shear", shear);
  require(std::isfinite(density) && density >= 0, "rod.material", "density", density, "a finite number of at least 0");
  return {young, shear, density};
}

Section Section::round(double outer, double inner, const Material& material, double shear_factor) {
  require_positive("rod.section", "outer", outer);
  require(std::isfinite(inner) && inner >= 0 && inner < outer, "rod.section", "inner", inner,
          "at least 0 and less than 'outer'");
  const double ro = 0.5 * outer, ri = 0.5 * inner;
  const double area = units::pi * (ro * ro - ri * ri);
  const double second_moment = units::pi / 4 * (ro * ro * ro * ro - ri * ri * ri * ri);
  Section section;
  section.outer = outer;
  section.inner = inner;
  section.EA = material.young * area;
  section.GA1 = section.GA2 = shear_factor * material.shear * area;
  section.EI1 = section.EI2 = material.young * second_moment;
  section.GJ = material.shear * 2 * second_moment;
  section.mass = material.density * area;
  section.material = material;
  section.check();
  return section;
}

std::optional<Material> Section::made_of() const {
  if (!material || !(inner < outer)) return std::nullopt;
  const Section fresh = round(outer, inner, *material);
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); };
  const bool follows = same(EA, fresh.EA) && same(GA1, fresh.GA1) && same(GA2, fresh.GA2) && same(EI1, fresh.EI1) &&
                       same(EI2, fresh.EI2) && same(GJ, fresh.GJ) && same(mass, fresh.mass);
  return follows ? material : std::nullopt;
}

void Section::check() const {
  require_positive("rod.section", "outer", outer);
  require(std::isfinite(inner) && inner >= 0 && inner < outer, "rod.section", "inner", inner,
          "at least 0 and less than 'outer'");
  require_positive("rod.section", "EA", EA);
  require_positive("rod.section", "GA (about d1)", GA1);
  require_positive("rod.section", "GA (about d2)", GA2);
  require_positive("rod.section", "EI (about d1)", EI1);
  require_positive("rod.section", "EI (about d2)", EI2);
  require_positive("rod.section", "GJ", GJ);
  require(std::isfinite(mass) && mass >= 0, "rod.section", "mass", mass, "a finite number of at least 0");
}

}  // namespace tendril
