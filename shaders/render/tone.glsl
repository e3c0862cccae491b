// Linear light to what a screen can show: linear up to a knee, then a soft shoulder that keeps highlights from clipping.
const float KNEE = 0.65;

vec3 toneMapped(vec3 light) {
  vec3 above = max(light - KNEE, 0.0);
  return min(light, KNEE) + above / (1.0 + above / (1.0 - KNEE));
}
