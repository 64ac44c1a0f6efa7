// What a rod is made of: the material and the cross-section's stiffnesses.
#pragma once

#include <optional>

namespace tendril {

/// An isotropic linear-elastic material. SI: young, shear in Pa; density in kg/m^3.
struct Material {
  double young = 0;
  double shear = 0;
  double density = 0;

  /// From Young's modulus and Poisson's ratio. Throws UsageError unless young > 0, -1 < poisson <= 0.5, density >= 0.
  static Material from_poisson(double young, double poisson, double density);
  static Material from_shear(double young, double shear, double density);
};

/// A cross-section. EI1 is the bending stiffness ABOUT d1, EI2 about d2; GA1, GA2 shear along d1, d2.
/// SI: EA, GA in N; EI, GJ in N m^2; outer, inner are diameters in m; mass in kg per m of unstressed length.
struct Section {
  double outer = 0, inner = 0;
  double EA = 0, GA1 = 0, GA2 = 0;
  double EI1 = 0, EI2 = 0, GJ = 0;
  double mass = 0;

  std::optional<Material> material = std::nullopt;  ///< that round() was given; see made_of()

  /// The material, where the stiffnesses and the mass are still those that follow from it: then it says all that they say.
  std::optional<Material> made_of() const;

  double radius() const { return 0.5 * outer; }

  /// Solid or hollow round section with shear factor `shear_factor` on GA. Throws UsageError unless
  /// outer > inner >= 0 and all are finite.
  static Section round(double outer, double inner, const Material& material, double shear_factor = 1);

  /// Throws UsageError naming the first entry that is not a finite positive number (mass and inner may be zero).
  void check() const;
};

}  // namespace tendril
