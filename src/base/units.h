// SI inside. These are plain numbers: 60 * units::mm is 0.06 (m).
#pragma once

namespace tendril::units {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double m = 1, cm = 1e-2, mm = 1e-3;
inline constexpr double rad = 1, deg = pi / 180;
inline constexpr double N = 1, kN = 1e3;
inline constexpr double Pa = 1, kPa = 1e3, MPa = 1e6, GPa = 1e9;
inline constexpr double kg = 1, g = 1e-3;

}  // namespace tendril::units
