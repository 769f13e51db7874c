#version 300 es
// One vertex of a site's roof: the graph of its distance function, drawn as geometry and seen from below, so that the
// depth test keeps the nearest site of each pixel.
precision highp float;
precision highp int;

layout(location = 0) in vec2 corner;     // of the template: signs of u and v
layout(location = 1) in vec2 direction;  // from the corner outwards; 0 on the rectangle itself
layout(location = 2) in float level;     // -1 on the ridge inside, 0 on the border, 1 at the end of the reach
layout(location = 3) in vec4 frame;      // of the site: x, y relative to the tile, cosine, sine
layout(location = 4) in vec2 extent;

uniform bool frustum;      // else the Chebyshev pyramid
uniform float reach;       // how far the roof is drawn
uniform vec2 depth_scale;  // depth = x * distance + y
uniform float viewport;    // side of the square viewport, px
uniform uint first_slot;   // of this draw

flat out uint slot;

void main() {
  float inset = level < 0.0 ? min(extent.x, extent.y) : 0.0;
  float distance = level < 0.0 ? -inset : level * reach;
  vec2 uv = frustum ? corner * (extent - inset) + direction * reach : corner * extent * reach;
  vec2 position = frame.xy + vec2(frame.z * uv.x - frame.w * uv.y, frame.w * uv.x + frame.z * uv.y);
  gl_Position = vec4(position * (2.0 / viewport) - 1.0, depth_scale.x * distance + depth_scale.y, 1.0);
  slot = first_slot + uint(gl_InstanceID);
}
