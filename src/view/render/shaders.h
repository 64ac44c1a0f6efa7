// The GLSL sources. Depth is linear everywhere (orthographic): 0 nearest the eye, 1 farthest.
#pragma once

#include <string_view>

namespace tendril::render::shader {

/// Surfaces: `positions` (m, relative to the origin) and octahedral normals to page axes.
///   -D KEEP_ALL   every fragment
///   -D KEEP_BEHIND / KEEP_BEFORE   only those behind / before the cut
extern const std::string_view surface_vertex, surface_fragment;
/// Feature edges of surfaces, with the same cut.
extern const std::string_view edge_fragment;
/// Tubes, holds, arrows, paths: coloured by value or by themselves; blown up by some pixels for outlines.
extern const std::string_view tube_vertex, tube_fragment;
/// One triangle that covers the page.
extern const std::string_view page_vertex;
/// Nearest of surroundings and tubes: normal and depth in pixels, at the picture's resolution.
extern const std::string_view nearest_fragment;
/// Ambient occlusion from that, and the blur that takes its grain away.
extern const std::string_view occlusion_fragment, smooth_fragment;
/// Everything put together.
extern const std::string_view compose_fragment;

}  // namespace tendril::render::shader
