// Fibres that stand off the cloth, in one of the shells over it (src/render/fuzz.cpp): how much of what is behind they cover,
// and the light of fibres that lie every way round (J. Kajiya, T. Kay, "Rendering Fur", 1989). Single fibres fade into their
// mean before they are too fine for pixels.
#include "render/cloth_piece.glsl"
#include "render/environment_light.glsl"
#include "render/frame.glsl"
#include "render/fuzz_shell.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tangent_frame.glsl"
#include "render/tone.glsl"

layout(location = 0) in Surface surface;
layout(location = 7) in float side;  // that fibres stand off, also a little beyond the silhouette
layout(location = 0) out vec4 color;
#include "render/dye.glsl"

const float MOST_GRAZING = 0.06;   // the smallest cosine that lengthens the way through a shell
const float LEAST_COVER = 0.004;   // what covers less is not drawn
const float HOLLOW_SHADE = 1.7;
const float FIBRE_RADIUS = 3e-5;   // [m]
const float ROOTS = 6e-4;          // distance of the fibres of wool [m]
const float ROOTS_OF_PILE = 1.6e-4;
const float TUFTS = 2.4e-3;        // size of places where the fibres are longer or shorter [m]
const float LAYS = 7e-3;           // of places where a pile leans one way [m]
const float TIPS = 2.5e-4;         // of bundles of its fibres [m]
const float PILE_LEAN = 0.4;

uvec2 hashOf(ivec2 cell, uint seed) {
  uint h = uint(cell.x) * 0x9E3779B1u ^ uint(cell.y) * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12u)) * 0x297A2D39u;
  h ^= h >> 15u;
  return uvec2(h, h * 0x9E3779B1u);
}
vec4 randomOf(ivec2 cell, uint seed) {
  uvec2 h = hashOf(cell, seed);
  return vec4(h & 0xFFFFu, h >> 16u).xzyw / 65535.0;
}

// Smooth noise of that size, each -1/2 to 1/2, which fades where a pixel covers it.
vec2 noiseOf(vec2 metres, float size, float pixel) {
  float seen = 1.0 - smoothstep(0.25, 1.0, pixel / size);
  vec2 place = metres / size;
  ivec2 cell = ivec2(floor(place));
  vec2 t = fract(place);
  t = t * t * (3.0 - 2.0 * t);
  vec2 low = mix(randomOf(cell, 5u).xy, randomOf(cell + ivec2(1, 0), 5u).xy, t.x);
  vec2 high = mix(randomOf(cell + ivec2(0, 1), 5u).xy, randomOf(cell + ivec2(1, 1), 5u).xy, t.x);
  return seen * (mix(low, high, t.y) - 0.5);
}

// Part of the fibres that reach a height.
float reaching(float height) {
  float left = max(1.0 - height, 0.0);
  return frame.pile > 0.0 ? smoothstep(0.0, 0.35, left) : left * sqrt(left);
}
float meanReaching() { return frame.pile > 0.0 ? 0.825 : 0.4; }

// The distance from a point to the way from 0 to `to`.
float fromWay(vec2 point, vec2 to) {
  return length(point - to * clamp(dot(point, to) / max(dot(to, to), 1e-12), 0.0, 1.0));
}

// Whether a fibre of a cell covers `place` (both in distances of roots), 0 to 1, over the mean of that. Fibres lean and wind.
float fibreOver(vec2 place, vec2 way, float height, float pixel, float roots, uint seed) {
  ivec2 cell = ivec2(floor(place));
  vec4 random = randomOf(cell, seed), other = randomOf(cell, seed + 7u);
  float radius = FIBRE_RADIUS / roots, width = max(radius, 0.7 * pixel);
  float isLong = random.z < reaching(height) ? 1.0 : 0.0;
  float winding = 6.28 * (other.z + (0.6 + 0.7 * other.w) * height);
  float slack = 0.5 - width;
  vec2 lean = 0.55 * height * (2.0 * other.xy - 1.0) + 0.16 * height * vec2(cos(winding), sin(winding));
  vec2 root = 0.5 + 0.6 * slack * (2.0 * random.xy - 1.0) + slack * lean;
  float distance = fromWay(root - fract(place), clamp(way, -0.8, 0.8));
  float covered = (1.0 - smoothstep(0.6 * width, 1.4 * width, distance)) * min(radius / width, 1.0) * isLong;
  float meanCover = 2.0 * radius * (length(clamp(way, -0.8, 0.8)) + 1.57 * radius) * reaching(height);
  return covered / max(meanCover, 1e-3);
}

// Two lots of fibres, turned against each other so that no rows are seen; and where they lie denser.
float unevenness(vec2 place, vec2 way, float height, float pixel) {
  float roots = frame.pile > 0.0 ? ROOTS_OF_PILE : ROOTS, inRoots = 1.0 / roots;
  float seen = 1.0 - smoothstep(0.3, 1.0, pixel * inRoots);
  if (seen <= 0.0) return 1.0;
  const mat2 TURN = mat2(0.8, 0.6, -0.6, 0.8);
  float fibres = 0.5 * fibreOver(place * inRoots, way * inRoots, height, pixel * inRoots, roots, 1u) +
                 0.5 * fibreOver(TURN * place * inRoots * 0.83, TURN * way * inRoots * 0.83, height, pixel * inRoots * 0.83, roots / 0.83, 2u);
  return mix(1.0, fibres, seen);
}

// How wide a pixel is on the cloth [m].
float pixelOn(vec2 metres) {
  vec2 right = dFdx(metres), up = dFdy(metres);
  float longer = max(max(length(right), length(up)), 1e-9);
  return max(abs(right.x * up.y - right.y * up.x) / longer, 0.15 * longer);
}

float coverOf(TangentFrame t, vec3 toEye, vec2 metres, float pixel) {
  float across = max(dot(t.normal, toEye), MOST_GRAZING);
  vec2 way = vec2(dot(t.u, toEye), dot(t.v, toEye)) * (shell.y * frame.fuzz / across);
  // Wool that has been worn is uneven.
  float height = frame.pile > 0.0 ? shell.x : shell.x / (1.0 + noiseOf(metres, TUFTS, pixel).x);
  float depth = frame.fuzzCover * shell.y * reaching(height) / meanReaching() / across;
  return (1.0 - exp(-depth * unevenness(metres, way, height, pixel))) * shell.z;
}

vec3 lightOf(TangentFrame t, vec3 toEye, vec3 dye, vec2 metres, float pixel) {
  vec3 toLight = frame.toKeyLight.xyz;
  float facing = dot(t.normal, toLight), between = dot(toEye, toLight);
  // Fibres lean every way around the normal: the mean of the sines to the light. Light goes on through them.
  float along2 = 0.5 * facing * facing;
  // Those of a pile stand upright, but that they lean a little one way here and another there.
  if (frame.pile > 0.0) {
    vec2 lean = PILE_LEAN * noiseOf(metres, LAYS, pixel);
    float along = dot(normalize(t.normal + lean.x * t.u + lean.y * t.v), toLight);
    along2 = along * along;
  }
  float across = sqrt(max(1.0 - along2, 0.04)), behind = max(-between, 0.0);
  float key = across * (0.50 + 0.16 * between + 0.7 * behind * behind * behind) * smoothstep(-0.3, 0.35, facing);
  float open = openness(clamp(1.0 - HOLLOW_SHADE * surface.hollow * side, 0.3, 1.12));
  float share = open * skyShare(surface.position, t.normal);
  float fill = max(0.5 + 0.5 * dot(t.normal, frame.toFillLight.xyz), 0.0);
  // Deeper ones lie in the shade of those above, but for a pile, whose depth is dark.
  float depth = mix(0.85, 1.1, shell.x);
  if (frame.pile > 0.0) depth = mix(0.05, 1.5, shell.x * shell.x * shell.x) * (1.0 + 1.4 * noiseOf(metres, TIPS, pixel).y);
  vec3 tint = mix(dye, sqrt(dye), 0.35);
  return tint * depth * (key * sunlit(surface.shadowPlace) * frame.keyColor.rgb + share * (skyIrradiance(t.normal) + fill * fill * frame.fillColor.rgb));
}

void main() {
  TangentFrame t = tangentFrame(surface, side < 0.0 ? -1.0 : 1.0);
  if (frame.pile > 0.0 && side < 0.0) discard;
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  vec2 metres = surface.uv * vec2(piece.width, piece.height);
  float pixel = pixelOn(metres), cover = coverOf(t, toEye, metres, pixel);
  if (cover < LEAST_COVER) discard;
  color = vec4(canvasFromLight(lightOf(t, toEye, dyeAt(surface.uv, side), metres, pixel)) * cover, cover);
}
