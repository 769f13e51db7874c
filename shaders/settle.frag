#version 300 es
// Settles each pixel: measures exactly the site that the depth test chose and those its eight neighbours chose, and
// takes the nearest, of equals the first. What faceted roofs and rounded depths decide wrongly lies within a pixel of
// the cells' borders. The label leaves as four bytes, least significant first: the format every GL reads back.
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;

uniform usampler2D slots;  // chosen by the depth test
uniform usampler2D zones;
uniform sampler2D sites;   // two texels a slot: (x, y, cosine, sine), (extent_u, extent_v, zone, label)
uniform bool frustum;      // else Chebyshev
uniform float reach;

layout(location = 0) out vec4 label_bytes;

const uint kNone = 0xffffffffu;

// The distance, or its signed square where that is cheaper: both have the same order.
float key(vec2 uv, vec2 extent) {
  if (!frustum) return max(abs(uv.x) / extent.x, abs(uv.y) / extent.y);
  vec2 beyond = abs(uv) - extent;
  vec2 outside = max(beyond, 0.0);
  float inside = min(max(beyond.x, beyond.y), 0.0);
  return dot(outside, outside) - inside * inside;
}

uint best = kNone;
float best_key;
float best_label;
float zone;

void consider(uint slot) {
  if (slot == kNone || slot == best) return;
  int width = textureSize(sites, 0).x;
  ivec2 at = ivec2((2 * int(slot)) % width, (2 * int(slot)) / width);
  vec4 shape = texelFetch(sites, at + ivec2(1, 0), 0);
  if (shape.z != zone) return;
  vec4 frame = texelFetch(sites, at, 0);
  vec2 offset = gl_FragCoord.xy - frame.xy;
  vec2 uv = vec2(frame.z * offset.x + frame.w * offset.y, frame.z * offset.y - frame.w * offset.x);
  float k = key(uv, shape.xy);
  if (k > best_key || (k == best_key && slot > best)) return;
  best = slot;
  best_key = k;
  best_label = shape.w;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(slots, 0) - 1;
  zone = float(texelFetch(zones, pixel, 0).r);
  best_key = frustum ? reach * reach : reach;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) consider(texelFetch(slots, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).r);

  uint label = best == kNone ? kNone : uint(best_label);
  label_bytes = vec4((uvec4(label) >> uvec4(0u, 8u, 16u, 24u)) & 0xffu) / 255.0;
}
