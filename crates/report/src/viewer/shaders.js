// What the graphics card does: places and values come as codes, colours from the map.

const COMMON = `#version 300 es
precision highp float;
uniform vec3 low, pace, middle;    // position = low + pace * code
uniform mat3 axes;                 // columns: right, up, toward the eye
uniform vec4 frame;                // pixels per metre, shift in pixels, metres of depth
uniform vec2 size;                 // of the picture [pixels]
uniform vec2 paint;                // place in the map = x + y * code
in vec3 place;
in float code;
out float shade, known;
vec3 toEye() {
  known = code < 65534.5 ? 1.0 : 0.0;
  shade = paint.x + paint.y * code;
  return transpose(axes) * (low + pace * place - middle);
}
vec4 onScreen(vec3 eye) {
  return vec4(2.0 * (frame.x * eye.xy + frame.yz) / size, -eye.z / frame.w, 1.0);
}
`;

const PAINT = `#version 300 es
precision highp float;
uniform sampler2D map;
uniform float colored;             // 0 where nothing colours the body
in float shade, known;
out vec4 color;
vec3 painted() {
  if (colored < 0.5 || known < 0.999) return vec3(0.52, 0.533, 0.553);
  return texture(map, vec2((255.0 * clamp(shade, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb;
}
float light(vec3 normal) {
  float lamp = max(dot(normal, normalize(vec3(-0.35, 0.55, 0.76))), 0.0);
  return 0.62 + 0.38 * lamp - 0.16 * pow(1.0 - max(normal.z, 0.0), 3.0);
}
`;

const SURFACE = {
  vertex: `${COMMON}
in vec3 normal;
out vec3 eye, facing;
void main() {
  eye = toEye();
  facing = transpose(axes) * normal;
  gl_Position = onScreen(eye);
}`,
  fragment: `${PAINT}
uniform float cut;                 // what is nearer to the eye is left out [m]
uniform float ghost;               // 1 draws only a breath of the surface
in vec3 eye, facing;
void main() {
  vec3 normal = normalize(facing + vec3(0.0, 0.0, 1e-6));
  if (ghost > 0.5) {
    float rim = 1.0 - abs(normal.z);
    float alpha = 0.05 + 0.30 * rim * rim;
    color = vec4(vec3(0.55, 0.58, 0.63) * alpha, alpha);
    return;
  }
  if (eye.z > cut) discard;
  // Through a cut or an open end the inner side is seen.
  bool inner = normal.z < 0.0;
  color = vec4(painted() * light(inner ? -normal : normal) * (inner ? 0.86 : 1.0), 1.0);
}`,
};

const SPHERES = {
  vertex: `${COMMON}
uniform float diameter, cut;
out float radius;
void main() {
  vec3 eye = toEye();
  gl_Position = eye.z > cut ? vec4(2.0, 2.0, 2.0, 1.0) : onScreen(eye);
  gl_PointSize = max(diameter * frame.x, 1.5);
  radius = 0.5 * diameter / frame.w;
}`,
  fragment: `${PAINT}
in float radius;
void main() {
  vec2 off = 2.0 * gl_PointCoord - 1.0;
  float rest = 1.0 - dot(off, off);
  if (rest < 0.0) discard;
  vec3 normal = vec3(off.x, -off.y, sqrt(rest));
  gl_FragDepth = gl_FragCoord.z - 0.5 * radius * normal.z;
  color = vec4(painted() * light(normal), 1.0);
}`,
};
