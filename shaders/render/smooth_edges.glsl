// Edges of a canvas that has one sample a pixel. Before the include: `canvas`.
#include "render/frame.glsl"

const float LEAST_CONTRAST = 0.04, LEAST_SHARE = 0.1;  // of an edge, and as a part of what is brightest there
const int STEPS = 10, SINGLE_STEPS = 4, DOUBLE_STEPS = 3;  // along an edge: by one pixel, then by two, then by four
const float MOST_BLUR = 0.6;                           // of a pixel that stands alone
const float ALONG_SHARE = 0.35;                        // of the pixels before and after it along the edge: lines a pixel wide are rows of steps, too

float brightness(vec3 canvasColor) { return dot(canvasColor, vec3(0.3, 0.6, 0.1)); }
vec3 canvasAt(ivec2 pixel) { return texelFetch(canvas, clamp(pixel, ivec2(0), ivec2(frame.pixels.xy) - 1), 0).rgb; }
float brightnessAt(ivec2 pixel) { return brightness(canvasAt(pixel)); }

// Where an edge ends that goes along a pixel on both ways, whose own brightness and that beyond the edge have this middle: what
// the middle differs by at the nearer end, and how much of the edge lies before it.
vec2 nearerEnd(ivec2 at, ivec2 along, ivec2 across, float middle, float leastDifference) {
  ivec2 ways = ivec2(0);
  vec2 differences = vec2(0);
  // As many as a uniform says: what is unrolled, llvmpipe runs to the end for every pixel.
  int steps = min(STEPS, int(frame.pixels.x));
  for (int i = 0; i < steps; ++i) {
    bvec2 goesOn = lessThan(abs(differences), vec2(leastDifference));
    if (!any(goesOn)) break;
    ways += ivec2(goesOn) * (i < SINGLE_STEPS ? 1 : i < SINGLE_STEPS + DOUBLE_STEPS ? 2 : 4);
    ivec2 first = at + ways.x * along, second = at - ways.y * along;
    differences = 0.5 * vec2(brightnessAt(first) + brightnessAt(first + across), brightnessAt(second) + brightnessAt(second + across)) - middle;
  }
  bool isFirst = ways.x < ways.y;
  return vec2(isFirst ? differences.x : differences.y, float(min(ways.x, ways.y)) / float(ways.x + ways.y));
}

// What part of the pixel belongs to the neighbour beyond its edge, and which neighbour that is. An edge is a row of steps, each
// some pixels long: seen from the middle of one, the nearer end says which side the true edge lies on, and how far off (the
// idea of T. Lottes, "FXAA", 2009, in its form that looks for the ends).
float shareBeyond(ivec2 at, float here, vec4 sides, float least, float most, out ivec2 across, out ivec2 along) {
  float right = sides.x, left = sides.y, up = sides.z, down = sides.w;
  float upperLeft = brightnessAt(at + ivec2(-1, 1)), upperRight = brightnessAt(at + ivec2(1, 1));
  float lowerLeft = brightnessAt(at + ivec2(-1, -1)), lowerRight = brightnessAt(at + ivec2(1, -1));
  float level = 2.0 * abs(up + down - 2.0 * here) + abs(upperLeft + lowerLeft - 2.0 * left) + abs(upperRight + lowerRight - 2.0 * right);
  float upright = 2.0 * abs(left + right - 2.0 * here) + abs(upperLeft + upperRight - 2.0 * up) + abs(lowerLeft + lowerRight - 2.0 * down);
  bool isLevel = level >= upright;
  float after = isLevel ? up : right, before = isLevel ? down : left;
  bool isAfter = abs(after - here) >= abs(before - here);
  across = (isLevel ? ivec2(0, 1) : ivec2(1, 0)) * (isAfter ? 1 : -1);
  along = isLevel ? ivec2(1, 0) : ivec2(0, 1);
  float beyond = isAfter ? after : before, middle = 0.5 * (here + beyond), leastDifference = most - least < max(LEAST_CONTRAST, LEAST_SHARE * most) ? -1.0 : 0.25 * abs(beyond - here);

  vec2 end = nearerEnd(at, along, across, middle, leastDifference);
  bool isWhole = (end.x < 0.0) == (here < middle);  // the true edge goes through the neighbour
  float share = isWhole ? 0.0 : 0.5 - end.y;

  float around = (2.0 * (left + right + up + down) + upperLeft + upperRight + lowerLeft + lowerRight) / 12.0;
  float alone = clamp(abs(around - here) / max(most - least, 1e-4), 0.0, 1.0);
  alone *= alone * (3.0 - 2.0 * alone);
  return max(share, MOST_BLUR * alone * alone);
}

// In linear light. Where there is no contrast, nothing changes.
vec3 smoothedLight(ivec2 at) {
  vec3 color = canvasAt(at), light = decodedLight(color);
  float here = brightness(color);
  vec4 sides = vec4(brightnessAt(at + ivec2(1, 0)), brightnessAt(at - ivec2(1, 0)), brightnessAt(at + ivec2(0, 1)), brightnessAt(at - ivec2(0, 1)));
  float least = min(min(sides.x, sides.y), min(sides.z, sides.w)), most = max(max(sides.x, sides.y), max(sides.z, sides.w));
  least = min(least, here);
  most = max(most, here);
  ivec2 across, along;
  float share = shareBeyond(at, here, sides, least, most, across, along);
  bool isEdge = most - least >= max(LEAST_CONTRAST, LEAST_SHARE * most);
  vec3 ofNeighbours = 0.5 * (decodedLight(canvasAt(at + along)) + decodedLight(canvasAt(at - along)));
  vec3 smoothed = mix(mix(light, decodedLight(canvasAt(at + across)), share), ofNeighbours, ALONG_SHARE);
  return isEdge ? smoothed : light;
}
