#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/units.h"
#include "rod/rod.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Material rubber = Material::from_poisson(5e6, 0.5, 1100);

}  // namespace

TEST_CASE("section: solid and hollow round sections") {
  const Section solid = Section::round(0.016, 0, rubber);
  CHECK(solid.EA == Approx(1005.3096491487337));
  CHECK(solid.EI1 == Approx(0.016084954386379746));
  CHECK(solid.EI2 == solid.EI1);
  CHECK(solid.GJ == Approx(0.010723302924253164));
  CHECK(solid.GA1 == Approx(335.1032163829113));
  CHECK(solid.mass == Approx(0.2211681228127214));
  CHECK(solid.radius() == Approx(0.008));
  const Section hollow = Section::round(0.016, 0.010, rubber, 0.5);
  const double ratio = 1 - std::pow(10.0 / 16, 4);
  CHECK(hollow.EI1 == Approx(solid.EI1 * ratio));
  CHECK(hollow.EA == Approx(solid.EA * (1 - 100.0 / 256)));
  CHECK(hollow.GA1 == Approx(0.5 * solid.GA1 * (1 - 100.0 / 256)));
}

TEST_CASE("material: both ways to give the shear modulus") {
  CHECK(Material::from_poisson(2e9, 0.35, 0).shear == Approx(2e9 / 2.7));
  CHECK(Material::from_shear(2e9, 1e9, 7).density == 7);
}

TEST_CASE("material and section: what makes no sense is refused by name") {
  CHECK_THROWS_WITH(Material::from_poisson(0, 0.3, 0), Contains("'young' is 0"));
  CHECK_THROWS_WITH(Material::from_poisson(-1, 0.3, 0), Contains("'young' is -1"));
  CHECK_THROWS_WITH(Material::from_poisson(not_a_number, 0.3, 0), Contains("'young'"));
  CHECK_THROWS_WITH(Material::from_poisson(1, 0.51, 0), Contains("'poisson' is 0.51"));
  CHECK_THROWS_WITH(Material::from_poisson(1, -1, 0), Contains("'poisson' is -1"));
  CHECK_THROWS_WITH(Material::from_poisson(1, not_a_number, 0), Contains("'poisson'"));
  CHECK_THROWS_WITH(Material::from_shear(1, 0, 0), Contains("'shear' is 0"));
  CHECK_THROWS_WITH(Material::from_shear(1, 1, -2), Contains("'density' is -2"));
  CHECK_THROWS_WITH(Material::from_shear(1, 1, INFINITY), Contains("'density' is inf"));
  CHECK_THROWS_WITH(Section::round(0, 0, rubber), Contains("'outer' is 0"));
  CHECK_THROWS_WITH(Section::round(0.01, 0.01, rubber), Contains("'inner' is 0.01") && Contains("less than 'outer'"));
  CHECK_THROWS_WITH(Section::round(0.01, -0.01, rubber), Contains("'inner' is -0.01"));
  CHECK_THROWS_WITH(Section::round(0.01, 0, rubber, 0), Contains("'GA (about d1)' is 0"));
  Section section = Section::round(0.01, 0, rubber);
  double* entries[] = {&section.EA, &section.GA1, &section.GA2, &section.EI1, &section.EI2, &section.GJ};
  const char* names[] = {"'EA'", "'GA (about d1)'", "'GA (about d2)'", "'EI (about d1)'", "'EI (about d2)'", "'GJ'"};
  for (int k = 0; k < 6; ++k)
    for (const double bad : {0.0, -1.0, not_a_number, double(INFINITY)}) {
      const double good = *entries[k];
      *entries[k] = bad;
      CHECK_THROWS_WITH(section.check(), Contains(names[k]));
      *entries[k] = good;
    }
  section.mass = -1;
  CHECK_THROWS_WITH(section.check(), Contains("'mass' is -1"));
}

TEST_CASE("rod: parts, places and what is refused") {
  const Section thick = Section::round(0.02, 0, rubber), thin = Section::round(0.01, 0, rubber);
  Rod rod;
  rod.length = 2;
  rod.parts = {{0.5, thick}, {2, thin}};
  rod.check();
  CHECK(rod.section_at(0.49).outer == 0.02);
  CHECK(rod.section_at(0.5).outer == 0.01);
  CHECK(rod.section_at(2).outer == 0.01);
  CHECK(rod.largest_radius() == 0.01);
  CHECK(rod.mass() == Approx(0.5 * thick.mass + 1.5 * thin.mass));
  rod.parts[1].upto = 1.9;
  CHECK_THROWS_WITH(rod.check(), Contains("the last part ends at 1.9"));
  rod.parts = {{0.5, thick}, {0.5, thin}};
  CHECK_THROWS_WITH(rod.check(), Contains("beyond the part before"));
  rod.parts.clear();
  CHECK_THROWS_WITH(rod.check(), Contains("'section' is missing"));
  CHECK_THROWS_WITH(Rod::uniform(0, thin), Contains("'length'"));
  CHECK_THROWS_WITH(Rod::uniform(not_a_number, thin), Contains("'length'"));
  CHECK_THROWS_WITH(Rod::uniform(1, thin, 0), Contains("'segments' is 0"));
  CHECK_THROWS_WITH(Rod::uniform(1, thin, 1'000'001), Contains("'segments' is 1000001"));
}
