#version 300 es
// A picture in a rectangle of the window: a strip of four vertices without attributes.
precision highp float;

uniform vec4 place;  // left, top, right, bottom in clip coordinates
out vec2 at;         // in the picture, (0, 0) its top left corner

void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(place.xy, place.zw, at), 0.0, 1.0);
}
