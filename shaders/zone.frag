#version 300 es
// Keeps the pixels whose zone differs from `base` in the bits of `mask`; the stencil operation flips those bits.
precision highp float;
precision highp int;
precision highp usampler2D;

uniform usampler2D zones;
uniform uint base;
uniform uint mask;

void main() {
  uint zone = texelFetch(zones, ivec2(gl_FragCoord.xy), 0).r;
  if (((zone ^ base) & mask) == 0u) discard;
}
