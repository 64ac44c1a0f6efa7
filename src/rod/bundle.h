// The section of a bundle of wires: size, mass and stiffness between "the wires slip" and "the wires are glued".
#pragma once

#include <optional>
#include <vector>

#include "rod/section.h"

namespace tendril {

/// One kind of round insulated wire in a bundle, and how many there are of it.
struct BundleWire {
  double outer = 0;              ///< m, across the insulation
  double conductor = 0;          ///< m, across the conductor (the circle around its strands); 0: no metal (a filler, a tube)
  double young = 0;              ///< Pa, of the conductor's metal
  double insulation_young = 0;   ///< Pa
  double mass = 0;               ///< kg/m, one wire
  double min_bend_radius = 0;    ///< m, of the wire's own centre line; 0: not stated
  int count = 1;
  int strands = 1;               ///< in the conductor; 1: solid
  double fill = 1;               ///< metal in the conductor's circle, 0 ... 1; about 0.7 for bunched strands
};

struct BundleOptions {
  /// How freely wires and strands slip: 1 freely, 0 not at all. Unset: 0.85, and 0.7 with tape. No law predicts it: with
  /// these values a bundle of thirty 0.5 mm^2 wires bends like a solid rod of 10 to 100 MPa. Measure a harness and set it
  /// where the stiffness matters.
  std::optional<double> slip = std::nullopt;
  bool taped = false;
  double tape_thickness = 0.26e-3;  ///< m, on the radius; 0.13 mm tape wound with half overlap lies in two layers
  double tape_young = 30e6;         ///< Pa; soft PVC
  double tape_density = 1300;       ///< kg/m^3
  /// Wires' area (with insulation) over the area of the circle around them. Unset: the exact packings for up to seven
  /// equal wires, otherwise 0.694, which is the shop rule "outer = 1.2 sqrt(count) wire diameters".
  std::optional<double> packing = std::nullopt;
};

/// What bundle_of finds. EI in N m^2, GJ in N m^2, lengths in m.
struct Bundle {
  Section section;               ///< its EI and GJ lie between the bounds below as `slip` says
  double min_bend_radius = 0;    ///< of the bundle's centre line, so that no wire inside bends below its own; 0: none stated
  double EI_slipping = 0, EI_glued = 0;  ///< lower and upper bound
  double GJ_slipping = 0, GJ_glued = 0;
  double outer = 0;              ///< with tape
  double slip = 0;               ///< what was used
};

/// The section of a bundle. With D a wire's outer diameter, d its conductor's, n its strands of diameter
/// s = d sqrt(fill / n), C the diameter of the circle around all wires, sums over all wires:
///
///   C             up to seven equal wires: k D with k = 1, 2, 1 + 2/sqrt(3), 1 + sqrt(2), 1 + 1/sin(36 deg), 3, 3
///                 (Graham, Sets of points with given minimum separation, 1968; Kravitz, Packing cylinders into
///                 cylindrical containers, 1967); otherwise sqrt(sum D^2 / packing), at least the two widest wires side by side
///   EA            sum of E fill pi d^2/4 + E_ins pi (D^2 - d^2)/4; GA likewise with G
///   EI_slipping   sum of n E pi s^4/64 + E_ins pi (D^4 - d^4)/64: every strand bends about its own axis
///                 (EI_min of Papailiou, On the bending stiffness of transmission line conductors, 1997, without lay;
///                 Costello, Theory of wire rope, 1997, ch. 3, for lay angles near 90 deg)
///   EI_glued      sum of fill E pi d^4/64 + E_ins pi (D^4 - d^4)/64 + EA_wire y^2, and the tape as a tube: plane sections
///                 stay plane (EI_max of Papailiou 1997). y^2, the mean square distance from the neutral axis, comes from
///                 the places of the exact packings, otherwise (C^2 - D^2)/16: wires spread evenly over the circle
///   GJ            likewise with G, twice the second moments, n G pi s^4/32 ...
///   EI, GJ        EI_slipping^slip EI_glued^(1 - slip): the bounds lie orders of magnitude apart, so the mean is taken of
///                 their logarithms. That both bounds are met in practice, measured stiffness in between, is the finding of
///                 Spak, Agnes, Inman, Cable parameters for homogenous cable-beam models for space structures, 2014
///   min bend      largest of min_bend_radius + (C - D)/2: the wire on the inner side of the bend
///
/// Poisson's ratio: 0.34 for the conductor (copper), 0.45 for insulation and tape. Wires run parallel; lay, friction that
/// grows with curvature, and hysteresis are left out. Throws UsageError ("rod.bundle: ...") on numbers that make no sense.
Bundle bundle_of(const std::vector<BundleWire>& wires, const BundleOptions& options = {});

/// A PVC-insulated stranded copper wire from what harness files state: outside diameter (m), conductor area (m^2) and mass
/// (kg/m; 0: from copper 8960 and PVC 1400 kg/m^3). Assumed: strands of 0.21 mm up to 1 mm^2, 0.26 mm up to 2.5 mm^2, 0.31 mm
/// up to 6 mm^2, 0.41 mm up to 50 mm^2, 0.51 mm above (as flexible
/// conductors of ISO 6722 are made up); metal in 0.7 of the conductor's circle, which then stays below the largest conductor
/// diameters of ISO 6722; copper 115 GPa, PVC 30 MPa (a factor of 2 either way, of little weight); min_bend_radius three
/// outside diameters, the static value that car makers' harness files state. Throws UsageError when the conductor
/// does not fit into the outside diameter.
BundleWire copper_wire(double outer, double conductor_area, double mass = 0, int count = 1);

}  // namespace tendril
