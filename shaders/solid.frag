#version 300 es
// Matt surfaces under a sky and a sun; what faces straight up has its picture's own colour.
precision highp float;

uniform sampler2D picture;
uniform sampler2D bumps;  // normals in tangent space, green up
uniform vec3 eye;
in vec3 world;
in vec3 world_normal;
in vec2 at;
in vec3 own_colour;
out vec4 colour;

const vec3 kSun = vec3(-0.36, 0.8, 0.48);  // towards it, of length 1

vec3 light_of(vec3 srgb) { return pow(srgb, vec3(2.2)); }

// The normal that the bumps make of `normal`. The tangents follow from how the picture lies on the surface here: a mesh
// has none.
vec3 bent(vec3 normal) {
  vec3 across = cross(dFdy(world), normal), down = cross(normal, dFdx(world));
  vec2 by_x = dFdx(at), by_y = dFdy(at);
  vec3 right = across * by_x.x + down * by_y.x, up = -(across * by_x.y + down * by_y.y);
  float scale = inversesqrt(max(max(dot(right, right), dot(up, up)), 1e-30));
  vec3 bump = 2.0 * texture(bumps, at).rgb - 1.0;
  return normalize(scale * (bump.x * right + bump.y * up) + bump.z * normal);
}

void main() {
  vec3 normal = world_normal;
  if (dot(normal, normal) == 0.0) normal = cross(dFdx(world), dFdy(world));
  normal = normalize(normal);
  if (dot(normal, eye - world) < 0.0) normal = -normal;
  normal = bent(normal);
  float sky = 0.5 + 0.5 * normal.y;
  float sun = max(dot(normal, kSun), 0.0);
  vec3 light = light_of(texture(picture, at).rgb) * light_of(own_colour) * (0.12 + 0.36 * sky + 0.65 * sun);
  colour = vec4(pow(min(light, 1.0), vec3(1.0 / 2.2)), 1.0);
}
