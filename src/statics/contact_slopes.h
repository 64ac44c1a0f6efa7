// Contact forces and what the rod is made of: points of contact lie at shares of segments, stand for lengths of rod and
// touch at the rod's radius. The law and its shifts stay as they are.
#pragma once

#include "statics/contact_set.h"
#include "statics/rod_slopes.h"

namespace tendril {

/// Adds the derivatives of step . gradient of contact at the set's last positions. `s`: the vertices' arc lengths.
void add_contact_work(const ContactSet& set, std::span<const double> s, const VertexShape& shape, std::span<const Vec6> step,
                      RodSlopes& out);

/// Adds the first-order change of contact's gradient when the vertices' arc lengths change by `places` and the segments'
/// radii by `radii` (empty: not).
void add_contact_change(const ContactSet& set, std::span<const double> s, const VertexShape& shape,
                        std::span<const double> places, std::span<const double> radii, std::span<Vec6> gradient);

}  // namespace tendril
