// Skins over closed loops: sweeps, pipes and turned bodies are all lofts.
#pragma once

#include "engine_bay/path.h"

namespace tendril::engine_bay {

using Loop = std::vector<Vec3>;
using Section = std::vector<Vec2>;  ///< closed, anticlockwise seen against the path's direction

enum class Ends {
  open,    ///< a sheet
  capped,  ///< a body
  joined,  ///< the last loop meets the first: a ring
};

/// Skin over loops of equal point counts, anticlockwise about the direction from one to the next.
Mesh loft(const std::vector<Loop>& loops, Ends ends, const Detail& detail);

Section circle(double radius, const Detail& detail);
Section rounded_rectangle(double width, double height, double radius, const Detail& detail);

/// What the section is multiplied by at the arc length s (mm) of a path of length `total`.
using Scale = std::function<double(double s, double total)>;

/// The section swept along the path, its y along `up` made normal to the path; a zero `up` carries it along without
/// twist. A joined sweep expects a path whose last point is not its first.
Mesh sweep(const Path& path, const Section& section, Ends ends, const Detail& detail, const Vec3& up = Vec3::Zero(),
           const Scale& scale = {});

/// A solid rod or cable.
Mesh round_bar(const Path& path, double radius, const Detail& detail);

/// A pipe with its bore, open at both ends; a closed body.
Mesh pipe(const Path& path, double outer_radius, double inner_radius, const Detail& detail);

/// A bellows or convoluted conduit: `depth` and `pitch` of its waves (mm); smooth where texture is left out.
Mesh corrugated(const Path& path, double radius, double depth, double pitch, const Detail& detail);

/// The profile (radius, height) turned about local z, its outside to the right of its direction of travel seen with
/// the axis on the left: upwards on the outside. Both ends on the axis make a body, equal ends a ring, else a sheet.
Mesh turned(const std::vector<Vec2>& profile, const Detail& detail, double fillet = 0);

/// A cylinder of height `height` from local z = 0 with rounded rims.
Mesh cylinder(double radius, double height, double fillet, const Detail& detail);

}  // namespace tendril::engine_bay
