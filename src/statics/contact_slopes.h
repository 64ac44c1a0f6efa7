// Contact forces and what the rod is made of: points of contact lie at shares of segments, stand for lengths of rod and
// touch at the rod's radius. The law and its shifts stay as they are.
//
// A sliding point stands where its energy e(xi) along the segment has an extremum: its mixed derivatives are those of a
// point fixed at xi less e_q,xi e_xi,p / e_xi,xi. For the radius, what a sliding point stands for in the terms of the fixed
// points beside it is not taken out.
#pragma once

#include "statics/contact_terms.h"
#include "statics/rod_slopes.h"

namespace tendril {

/// Adds the derivatives of step . gradient of contact where it stands. `s`: the vertices' arc lengths.
void add_contact_work(const ContactTerms& contacts, std::span<const double> s, const VertexShape& shape,
                      std::span<const Vec6> step, RodSlopes& out);

/// Adds the first-order change of contact's gradient when the vertices' arc lengths change by `places` and the segments'
/// radii by `radii`.
void add_contact_change(const ContactTerms& contacts, std::span<const double> s, const VertexShape& shape,
                        std::span<const double> places, std::span<const double> radii, std::span<Vec6> gradient);

}  // namespace tendril
