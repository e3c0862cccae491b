// A pin: a dot with a rim.
layout(location = 0) out vec4 color;

const vec3 HEAD = vec3(0.98, 0.80, 0.25), RIM = vec3(0.12, 0.11, 0.10);

void main() {
  float radius = 2.0 * length(gl_PointCoord - 0.5);
  float soft = 1.5 * fwidth(gl_PointCoord.x);
  float cover = 1.0 - smoothstep(1.0 - 2.0 * soft, 1.0, radius);
  vec3 dot = mix(HEAD, RIM, smoothstep(0.68 - soft, 0.68 + soft, radius));
  color = vec4(dot * cover, cover);
}
