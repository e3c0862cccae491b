// What is behind the scene on its stage, by the ray to it: the ground out to where it ends, and beyond it a sweep of paper, a
// room out of focus, a wall, or curtains.
#include "render/stage.glsl"

const float FAR = 1e6;

// Where the ray meets the ground [m along the ray]; FAR: nowhere.
float toGround(vec3 eye, vec3 ray) {
  float height = eye.y - frame.stagePlace.y;
  return frame.ground.w > 0.0 && height > 0.0 && ray.y < -1e-5 ? height / -ray.y : FAR;
}

// The ground without shadows, as plane.frag draws it.
vec3 groundBehind(vec3 position) {
  const vec3 UP = vec3(0, 1, 0);
  vec2 at = fromMiddle(position);
  float lit = poolAt(at);
#ifdef WINDOW
  lit *= windowLight((frame.shadowFromWorld * vec4(position, 1.0)).xy);
#endif
  return groundAlbedo(position) * edgeLight(at) * diffuseLight(UP, lit, 1.0) + groundShine(position, UP, lit);
}

#if defined(WINDOW) || defined(DARK)
// Where the ray meets the far side of the round wall.
float toWall(vec3 eye, vec3 ray) {
  vec2 from = fromMiddle(eye), along = ray.xz * (STAGE_SIZES / frame.stagePlace.w);
  float a = max(dot(along, along), 1e-9), b = dot(from, along), c = dot(from, from) - ROOM_RADIUS * ROOM_RADIUS;
  return (sqrt(max(b * b - a * c, 0.0)) - b) / a;
}

#ifdef WINDOW
// Plaster above a skirting board.
const vec3 PLASTER = vec3(0.60, 0.54, 0.455), BOARD = vec3(0.70, 0.68, 0.63);
const float BOARD_HEIGHT = 0.085;

vec3 wallLight(vec3 position, vec3 normal, float height) {
  float pixel = max(fwidth(height), 1e-4), isBoard = 1.0 - smoothstep(-pixel, pixel, height - BOARD_HEIGHT);
  isBoard *= frame.ground.w;
  float groove = isBoard * (1.0 - smoothstep(0.0, 0.006 + pixel, abs(height - 0.8 * BOARD_HEIGHT)));
  float corner = 1.0 - 0.45 * exp(-5.0 * max(height, 0.0)) - 0.35 * groove;
  float lit = windowLight((frame.shadowFromWorld * vec4(position, 1.0)).xy);
  return mix(PLASTER, BOARD, isBoard) * corner * (diffuseLight(normal, 0.8 * lit, 0.9) + 0.24);  // and what the floor throws back
}
#else
// Curtains, whose folds hang down to the ground.
vec3 wallLight(vec3 position, vec3 normal, float height) {
  float around = atan(normal.z, normal.x);
  float fold = sin(46.0 * around + 1.4 * sin(9.0 * around) + 0.7 * sin(23.0 * around + 2.0));
  float shade = 0.30 + 0.70 * pow(0.5 + 0.5 * fold, 1.6);
  float low = exp(-1.3 * max(height, 0.0));
  return shade * mix(vec3(0.006, 0.007, 0.010), vec3(0.060, 0.052, 0.050), low) * (1.0 - 0.5 * exp(-14.0 * max(height, 0.0)));
}
#endif

vec3 beyondGround(vec3 eye, vec3 ray) {
  vec3 position = eye + min(toWall(eye, ray), FAR) * ray;
  float height = (position.y - frame.stagePlace.y) * STAGE_SIZES / frame.stagePlace.w;
  return cornerShade() * wallLight(position, vec3(-normalize(fromMiddle(position)), 0.0).xzy, height);
}
float groundShare(vec3 eye, vec3 ray) {
  float ground = toGround(eye, ray), wall = toWall(eye, ray);
  float before = wall - min(ground, 2.0 * wall);  // the ground lies before the wall
  return clamp(0.5 + before / max(fwidth(before), 1e-6), 0.0, 1.0);
}
#elif defined(TABLE)
// A warm room far out of focus: a dark floor, a wall that light falls on in places, and the glow of lamps.
vec3 beyondGround(vec3 eye, vec3 ray) {
  vec3 wall = mix(vec3(0.034, 0.024, 0.018), vec3(0.125, 0.094, 0.070), smoothstep(-0.55, 0.15, ray.y));
  float around = atan(ray.x, ray.z);
  float patches = 0.85 + 0.22 * sin(3.0 * around + 0.6) + 0.14 * sin(7.0 * around + 2.1);
  float lamp = exp(-3.5 * (1.0 - sin(3.0 * around - 0.9)) - 7.0 * (ray.y - 0.10) * (ray.y - 0.10));
  return cornerShade() * (wall * patches + lamp * vec3(0.46, 0.30, 0.15));
}
float groundShare(vec3 eye, vec3 ray) {
  float ground = toGround(eye, ray);
  vec2 at = fromMiddle(eye + ground * ray);
  bool isNear = ground < FAR && length(at) < STAGE_SIZES;  // at the horizon pixels are endlessly wide
  return groundCovers(at, max(fwidth(at.x), fwidth(at.y))) * float(isNear);
}
#else
vec3 beyondGround(vec3 eye, vec3 ray) { return paperLight(ray); }
float groundShare(vec3 eye, vec3 ray) { return float(toGround(eye, ray) < FAR); }
#endif

// Whole, or of parts of a picture that show but one of both (src/render/backdrop_parts.h).
vec3 stageBehind(vec3 eye, vec3 ray) {
#ifdef BEYOND_ALONE
  return beyondGround(eye, ray);
#else
  vec3 position = eye + toGround(eye, ray) * ray;
  vec3 ground = groundInto(groundBehind(position), fromMiddle(position), ray);
#ifdef GROUND_ALONE
  return ground;
#else
  return mix(beyondGround(eye, ray), ground, groundShare(eye, ray));
#endif
#endif
}
