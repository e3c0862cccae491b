// Edges of a canvas that has one sample a pixel. Before the include: `canvas`.
#include "render/edge_contrast.glsl"

// Along an edge, by one pixel, then by two, then by four.
const int STEPS = 10, SINGLE_STEPS = 4, DOUBLE_STEPS = 3;
const float MOST_BLUR = 0.6;  // of a pixel that stands alone
// Of the pixels before and after it along the edge: lines that are a pixel wide are rows of steps, too.
const float ALONG_SHARE = 0.35;

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

// What part of the pixel belongs to the neighbour beyond its edge, which is a level one or an upright one, and whether that is
// the neighbour after it, 1, or before it, -1. An edge is a row of steps, each some pixels long: seen from the middle of one, the
// nearer end says which side the true edge lies on, and how far off (the idea of T. Lottes, "FXAA", 2009, in its form that
// looks for the ends).
vec2 shareBeyond(ivec2 at, float here, vec4 sides, bool isEdge, float contrast, out bool isLevel) {
  float right = sides.x, left = sides.y, up = sides.z, down = sides.w;
  float upperLeft = brightnessAt(at + ivec2(-1, 1)), upperRight = brightnessAt(at + ivec2(1, 1));
  float lowerLeft = brightnessAt(at + ivec2(-1, -1)), lowerRight = brightnessAt(at + ivec2(1, -1));
  float level = 2.0 * abs(up + down - 2.0 * here) + abs(upperLeft + lowerLeft - 2.0 * left) + abs(upperRight + lowerRight - 2.0 * right);
  float upright = 2.0 * abs(left + right - 2.0 * here) + abs(upperLeft + upperRight - 2.0 * up) + abs(lowerLeft + lowerRight - 2.0 * down);
  isLevel = level >= upright;
  float after = isLevel ? up : right, before = isLevel ? down : left;
  bool isAfter = abs(after - here) >= abs(before - here);
  ivec2 along = isLevel ? ivec2(1, 0) : ivec2(0, 1), across = (ivec2(1) - along) * (isAfter ? 1 : -1);
  float beyond = isAfter ? after : before, middle = 0.5 * (here + beyond);
  float leastDifference = isEdge ? 0.25 * abs(beyond - here) : -1.0;  // or the search ends at once

  vec2 end = nearerEnd(at, along, across, middle, leastDifference);
  bool isWhole = (end.x < 0.0) == (here < middle);  // the true edge goes through the neighbour
  float share = isWhole ? 0.0 : 0.5 - end.y;

  float around = (2.0 * (left + right + up + down) + upperLeft + upperRight + lowerLeft + lowerRight) / 12.0;
  float alone = clamp(abs(around - here) / max(contrast, 1e-4), 0.0, 1.0);
  alone *= alone * (3.0 - 2.0 * alone);
  return vec2(max(share, MOST_BLUR * alone * alone), isAfter ? 1.0 : -1.0);
}

// Mixed in linear light. Where there is no contrast, and on the stage, nothing changes.
vec4 smoothedCanvas(ivec2 at) {
  vec4 color = canvasAt(at), right = canvasAt(at + ivec2(1, 0)), left = canvasAt(at - ivec2(1, 0)), up = canvasAt(at + ivec2(0, 1)), down = canvasAt(at - ivec2(0, 1));
  float here = brightness(color.rgb);
  vec4 sides = vec4(brightness(right.rgb), brightness(left.rgb), brightness(up.rgb), brightness(down.rgb));
  float least = min(min(sides.x, sides.y), min(sides.z, sides.w)), most = max(max(sides.x, sides.y), max(sides.z, sides.w));
  least = min(least, here);
  most = max(most, here);
  bool isEdge = isContrast(least, most) && isBeforeStage(max(max(color, max(right, left)), max(up, down)));
  bool isLevel;
  vec2 share = shareBeyond(at, here, sides, isEdge, most - least, isLevel);
  vec3 light = srgbDecoded(color.rgb), across = srgbDecoded(share.y > 0.0 ? (isLevel ? up : right).rgb : (isLevel ? down : left).rgb);
  vec3 along = 0.5 * (srgbDecoded((isLevel ? right : up).rgb) + srgbDecoded((isLevel ? left : down).rgb));
  return isEdge ? vec4(srgbEncoded(mix(mix(light, across, share.x), along, ALONG_SHARE)), 1.0) : color;
}
