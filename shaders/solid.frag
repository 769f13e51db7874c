#version 300 es
// Matt surfaces under a sky and a sun; what faces straight up has its picture's own colour.
precision highp float;

uniform sampler2D picture;
uniform vec3 eye;
in vec3 world;
in vec3 world_normal;
in vec2 at;
in vec3 own_colour;
out vec4 colour;

const vec3 kSun = vec3(-0.36, 0.8, 0.48);  // towards it, of length 1

vec3 light_of(vec3 srgb) { return pow(srgb, vec3(2.2)); }

void main() {
  vec3 normal = world_normal;
  if (dot(normal, normal) == 0.0) normal = cross(dFdx(world), dFdy(world));
  normal = normalize(normal);
  if (dot(normal, eye - world) < 0.0) normal = -normal;
  float sky = 0.5 + 0.5 * normal.y;
  float sun = max(dot(normal, kSun), 0.0);
  vec3 light = light_of(texture(picture, at).rgb) * light_of(own_colour) * (0.12 + 0.36 * sky + 0.65 * sun);
  colour = vec4(pow(min(light, 1.0), vec3(1.0 / 2.2)), 1.0);
}
