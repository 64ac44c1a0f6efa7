#include "view/render/shaders.h"

namespace tendril::render::shader {

const std::string_view surface_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 folded;
layout(location = 2) in float paint;
layout(location = 3) in float value;
uniform mat4 page;
uniform mat3 turn;
uniform float nearer;
out vec3 normal;
flat out float shade;
out float reading;
void main() {
  vec3 n = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  normal = turn * n;
  shade = paint;
  reading = value;
  gl_Position = page * vec4(position, 1.0);
  gl_Position.z -= nearer;
}
)";

// A normal is kept as its x and y: the sign that faces the eye is the right one on a surface without an outside. What is
// kept last tells of the value: up to 0.9 its share of the range, 0.95 that it breaks the limit, 1 that there is none.
const std::string_view surface_fragment = R"(
in vec3 normal;
flat in float shade;
in float reading;
uniform sampler2D cut;
uniform vec2 per_pixel;
uniform vec2 range;
uniform vec2 limit;
layout(location = 0) out vec4 kept;
float told() {
  if (reading > 1e30) return 1.0;
  if ((limit.y < 0.0 && reading < limit.x) || (limit.y > 0.0 && reading > limit.x)) return 0.95;
  return 0.9 * clamp((reading - range.x) / (range.y - range.x), 0.0, 1.0);
}
void main() {
#ifdef KEEP_BEHIND
  if (gl_FragCoord.z < texture(cut, gl_FragCoord.xy * per_pixel).r) discard;
#endif
#ifdef KEEP_BEFORE
  if (gl_FragCoord.z >= texture(cut, gl_FragCoord.xy * per_pixel).r) discard;
#endif
  vec3 n = normalize(normal);
  if (n.z < 0.0) n = -n;
  kept = vec4(0.5 * n.xy + 0.5, shade, told());
}
)";

const std::string_view edge_fragment = R"(
in vec3 normal;
flat in float shade;
uniform sampler2D cut;
uniform vec2 per_pixel;
layout(location = 0) out vec4 kept;
void main() {
#ifdef KEEP_BEHIND
  if (gl_FragCoord.z < texture(cut, gl_FragCoord.xy * per_pixel).r) discard;
#endif
#ifdef KEEP_BEFORE
  if (gl_FragCoord.z >= texture(cut, gl_FragCoord.xy * per_pixel).r) discard;
#endif
  kept = vec4(1.0);
}
)";

const std::string_view tube_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 outward;
layout(location = 2) in float radius;
layout(location = 3) in float value;
layout(location = 4) in vec2 along;
layout(location = 5) in vec4 own_colour;
uniform mat4 page;
uniform mat3 turn;
uniform float least_radius;
uniform float blow_up;
out vec3 normal;
out float reading;
out vec2 place;
out vec4 paint;
void main() {
  normal = turn * outward;
  reading = value;
  place = along;
  paint = own_colour;
  float grow = (radius > 0.0 ? max(least_radius - radius, 0.0) : 0.0) + blow_up;
  gl_Position = page * vec4(position + grow * outward, 1.0);
}
)";

const std::string_view tube_fragment = R"(
in vec3 normal;
in float reading;
in vec2 place;
in vec4 paint;
uniform sampler2D colours;
uniform vec2 range;
uniform vec2 limit;
uniform float stripe;
uniform vec3 broken;
uniform vec3 broken_stripe;
uniform vec4 flat_colour;
layout(location = 0) out vec4 kept;
layout(location = 1) out vec4 colour;
void main() {
  vec3 n = normalize(normal);
  if (n.z < 0.0) n = -n;
  float dash = fract(place.x / (1.3 * stripe)) < 0.55 ? 1.0 : 0.0;
  kept = vec4(0.5 * n.xy + 0.5, flat_colour.a > 0.0 ? 1.0 : 0.5, dash);
  if (flat_colour.a > 0.0) {
    colour = flat_colour;
    return;
  }
  vec3 c = paint.rgb;
  if (paint.a < 0.5) {
    c = texture(colours, vec2((reading - range.x) / (range.y - range.x), 0.5)).rgb;
    bool breaks = (limit.y < 0.0 && reading < limit.x) || (limit.y > 0.0 && reading > limit.x);
    if (breaks) c = fract(place.x / stripe + place.y) < 0.36 ? broken_stripe : broken;
  }
  colour = vec4(c, 1.0);
}
)";

const std::string_view page_vertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

const std::string_view nearest_fragment = R"(
uniform sampler2D base, base_depth, tube, tube_depth;
uniform float depth_pixels;
out vec4 kept;
void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  float b = texelFetch(base_depth, at, 0).r, t = texelFetch(tube_depth, at, 0).r;
  vec4 tube_here = texelFetch(tube, at, 0);
  bool is_tube = t <= b && t < 1.0 && tube_here.b < 0.75;
  vec2 n = (is_tube ? tube_here.rg : texelFetch(base, at, 0).rg) * 2.0 - 1.0;
  float d = is_tube ? t : b;
  kept = vec4(n, d * depth_pixels, d < 1.0 ? 1.0 : 0.0);
}
)";

// Horizon samples on a spiral, each weighed by how far it rises over the tangent plane and how near it lies.
const std::string_view occlusion_fragment = R"(
uniform sampler2D nearest;
uniform float radius;
out float light;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 here = texelFetch(nearest, at, 0);
  if (here.a < 0.5) { light = 1.0; return; }
  vec3 n = vec3(here.rg, sqrt(max(1.0 - dot(here.rg, here.rg), 0.0)));
  int cell = (at.x & 3) * 4 + (at.y & 3);
  float turn = float((cell * 7) & 15) * 0.392699;
  ivec2 last = textureSize(nearest, 0) - 1;
  float sum = 0.0;
  const int count = 14;
  for (int i = 0; i < count; ++i) {
    float angle = float(i) * 2.3999632 + turn;
    float reach = radius * (float(i) + 0.7) / float(count);
    ivec2 to = clamp(at + ivec2(round(reach * vec2(cos(angle), sin(angle)))), ivec2(0), last);
    vec4 there = texelFetch(nearest, to, 0);
    vec3 v = vec3(vec2(to - at), here.b - there.b);
    float square = dot(v, v);
    float near = max(1.0 - square / (radius * radius), 0.0);
    sum += near * max(dot(v, n) * inversesqrt(square + 0.01) - 0.12, 0.0);
  }
  light = clamp(1.0 - 3.4 * sum / float(count), 0.0, 1.0);
}
)";

const std::string_view smooth_fragment = R"(
uniform sampler2D nearest, rough;
uniform float radius;
out float light;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(rough, 0) - 1;
  float depth = texelFetch(nearest, at, 0).b;
  float sum = 0.0, weight = 0.0;
  for (int y = -2; y < 2; ++y)
    for (int x = -2; x < 2; ++x) {
      ivec2 to = clamp(at + ivec2(x, y), ivec2(0), last);
      float w = abs(texelFetch(nearest, to, 0).b - depth) < 0.3 * radius ? 1.0 : 0.001;
      sum += w * texelFetch(rough, to, 0).r;
      weight += w;
    }
  light = sum / weight;
}
)";

const std::string_view compose_fragment = R"(
uniform sampler2D base, base_depth, base_edges, veil, veil_depth, veil_edges, tube, tube_colour, tube_depth, light, palette, cut, colours;
uniform vec3 broken;
uniform vec3 broken_stripe;
uniform float depth_pixels;
uniform float fade;
uniform vec3 paper;
uniform vec3 ink;
out vec4 result;

vec3 unfold(vec2 kept) {
  vec2 n = 2.0 * kept - 1.0;
  return vec3(n, sqrt(max(1.0 - dot(n, n), 0.0)));
}

// Soft clay under a lamp above the left shoulder, with a weak fill from the right.
float clay(vec3 n) {
  float key = 0.5 + 0.5 * dot(n, normalize(vec3(-0.45, 0.70, 0.62)));
  float fill = max(dot(n, normalize(vec3(0.80, -0.15, 0.50))), 0.0);
  return 0.36 + 0.72 * pow(key, 1.6) + 0.10 * fill;
}

float gloss(vec3 n) { return pow(max(dot(n, normalize(vec3(-0.26, 0.42, 0.87))), 0.0), 38.0); }

// 1 on both sides of a jump in depth; a plane, however steep, has none.
float jump(sampler2D depth, ivec2 at, float here) {
  ivec2 last = textureSize(depth, 0) - 1;
  float l = texelFetch(depth, ivec2(max(at.x - 1, 0), at.y), 0).r, r = texelFetch(depth, ivec2(min(at.x + 1, last.x), at.y), 0).r;
  float d = texelFetch(depth, ivec2(at.x, max(at.y - 1, 0)), 0).r, u = texelFetch(depth, ivec2(at.x, min(at.y + 1, last.y)), 0).r;
  float bend = max(abs(l + r - 2.0 * here), abs(d + u - 2.0 * here)) * depth_pixels;
  return smoothstep(7.0, 14.0, bend);
}

// Edges at a place, paler where they crowd (fins, threads, bolts far away): detail must not outweigh form.
float edges_at(sampler2D edges, ivec2 at, vec2 uv) {
  float here = texelFetch(edges, at, 0).r;
  return here * clamp(1.25 - 2.6 * textureLod(edges, uv, 5.0).r, 0.22, 1.0);
}

// What a surface of the surroundings looks like; `open`: the share of the sky it sees.
vec3 surroundings(vec4 kept, float open, float edge, out float share) {
  int paint = int(kept.b * 65535.0 + 0.5);
  vec4 own = texelFetch(palette, ivec2(paint, 0), 0);
  float strength = texelFetch(palette, ivec2(paint, 1), 0).r;
  share = own.a;
  if (kept.a < 0.975) strength = max(strength, 0.9);  // colours that speak are not to fade into the paper
  if (kept.a < 0.925) {
    own.rgb = texture(colours, vec2(kept.a / 0.9, 0.5)).rgb;
  } else if (kept.a < 0.975) {
    own.rgb = fract((gl_FragCoord.x + gl_FragCoord.y) / 22.0) < 0.36 ? broken_stripe : broken;
  }
  vec3 lit = own.rgb * clay(unfold(kept.rg));
  vec3 colour = mix(paper, lit, strength) * mix(vec3(1.0), vec3(0.45, 0.46, 0.50), 1.0 - open);
  return mix(colour, ink, 0.55 * edge);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 uv = gl_FragCoord.xy / vec2(textureSize(base_depth, 0));
  float base_at = texelFetch(base_depth, at, 0).r;
  float tube_at = texelFetch(tube_depth, at, 0).r;
  float veil_at = texelFetch(veil_depth, at, 0).r;
  float open = texture(light, uv).r;
  float cut_at = texture(cut, uv).r;
  float mask = 0.0, share;

  vec3 colour = paper;
  float edge = 0.0;
  if (base_at < 1.0) {
    edge = edges_at(base_edges, at, uv);
    colour = surroundings(texelFetch(base, at, 0), open, edge, share);
  }
  // The cut's own border is no edge of the part.
  float beyond_cut = cut_at > 0.0 ? smoothstep(2.0, 10.0, (base_at - cut_at) * depth_pixels) : 1.0;
  colour = mix(colour, ink, 0.60 * jump(base_depth, at, base_at) * beyond_cut);

  if (tube_at < 1.0) {
    vec4 kept = texelFetch(tube, at, 0);
    vec3 own = texelFetch(tube_colour, at, 0).rgb;
    bool plain = kept.b > 0.75;
    vec3 n = unfold(kept.rg);
    vec3 lit = plain ? own : own * (0.26 + 0.84 * clay(n)) * mix(1.0, open, 0.45) + 0.16 * gloss(n);
    if (tube_at <= base_at) {
      colour = lit;
      mask = 1.0;
    } else if (!plain) {
      colour = mix(colour, lit, kept.a > 0.5 ? 0.62 : 0.16);
      mask = 0.5;
    }
  }

  if (veil_at < 1.0 && veil_at < min(base_at, tube_at)) {
    vec4 kept = texelFetch(veil, at, 0);
    vec3 n = unfold(kept.rg);
    vec3 own = surroundings(kept, 1.0, 0.0, share);
    // Close to the cut the part is still whole, and fades towards the tube.
    float before_cut = (cut_at - veil_at) * depth_pixels;
    bool veiled = texelFetch(palette, ivec2(int(kept.b * 65535.0 + 0.5), 1), 0).g > 0.5;  // not for the cut's sake
    float whole = cut_at > 0.0 && !veiled ? 1.0 - smoothstep(0.0, fade, before_cut) : 0.0;
    float over_tube = mask > 0.75 ? 0.5 : 1.0;
    bool valued = kept.a < 0.975, breaks = valued && kept.a > 0.925;
    share = clamp(share * over_tube * ((valued ? 0.95 : 0.65) + 0.9 * pow(1.0 - n.z, 2.0)), 0.0, 0.85);
    if (breaks) share = max(share, 0.85 * over_tube);
    share = mix(share, over_tube, whole);
    colour = mix(colour, own, share);
    float line = max(edges_at(veil_edges, at, uv), jump(veil_depth, at, veil_at) * (veiled ? 1.0 : smoothstep(4.0, 16.0, before_cut)));
    colour = mix(colour, ink, line * mix(0.28, 0.55, whole) * over_tube);
  }
  result = vec4(colour, mask);
}
)";

}  // namespace tendril::render::shader
