#version 300 es
precision highp float;

uniform mat4 view_projection;
uniform mat4 place;  // of the mesh in the world: turned, moved, scaled alike in every direction
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;  // zero: none is known
layout(location = 2) in vec2 texture_coordinate;
layout(location = 3) in vec4 tint;
out vec3 world;
out vec3 world_normal;
out vec2 at;
out vec3 own_colour;

void main() {
  vec4 where = place * vec4(position, 1.0);
  world = where.xyz;
  world_normal = mat3(place) * normal;
  at = texture_coordinate;
  own_colour = tint.rgb;
  gl_Position = view_projection * where;
}
