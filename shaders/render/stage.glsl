// The stage that the scene stands on (src/render/stage_look.h): its ground, and what is behind it, in linear light.
#include "render/lights.glsl"
#ifdef WINDOW
#include "render/window.glsl"
#endif
#if defined(TABLE) || defined(WINDOW) || defined(DARK)
#define BOARDS
layout(binding = GROUND_UNIT) uniform sampler2D groundPicture;
#endif

const float POOL_SHARPNESS = 14.0 / (STAGE_SIZES * STAGE_SIZES);

// Places on the ground are [sizes of the scene] from its middle.
vec2 fromMiddle(vec3 position) { return (position.xz - frame.stagePlace.xz) * (STAGE_SIZES / frame.stagePlace.w); }

vec3 groundAlbedo(vec3 position) {
#ifdef BOARDS
  vec3 picture = texture(groundPicture, position.xz * frame.ground.x * vec2(0.5, 1.0)).rgb;
  return frame.floorColor.rgb * mix(vec3(1), picture, frame.ground.y);
#else
  return frame.floorColor.rgb;
#endif
}

// The part of the key light that falls on the ground there, but for shadows.
float poolAt(vec2 at) {
  float distance2 = dot(at, at);
#if defined(DARK)
  return 1.0 - smoothstep(0.30, 1.45, distance2);
#elif defined(WINDOW)
  return 1.0;
#elif defined(TABLE)
  return 0.30 + 0.70 / (1.0 + 0.35 * distance2);
#else
  return 0.25 + 0.75 / (1.0 + POOL_SHARPNESS * distance2);
#endif
}

#if defined(TABLE)
const vec2 HALF_TABLE = vec2(HALF_TABLE_LENGTH, HALF_TABLE_DEPTH);
const float EDGE = 0.014;

// To the table's edge, negative on it.
float beyondEdge(vec2 at) {
  vec2 q = abs(at) - (HALF_TABLE - TABLE_CORNER);
  return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - TABLE_CORNER;
}
// How much of a pixel so wide the ground covers; and how its rounded edge catches light.
float groundCovers(vec2 at, float width) { return clamp(0.5 - beyondEdge(at) / max(width, 1e-5), 0.0, 1.0); }
float edgeLight(vec2 at) { return 1.0 + 0.55 * smoothstep(-EDGE, -0.4 * EDGE, beyondEdge(at)); }
#elif defined(WINDOW) || defined(DARK)
// ROOM_RADIUS is that of the round wall.
float groundCovers(vec2 at, float width) { return clamp(0.5 - (length(at) - ROOM_RADIUS) / max(width, 1e-5), 0.0, 1.0); }
float edgeLight(vec2 at) { return 1.0 - 0.45 * exp(6.0 * min(length(at) - ROOM_RADIUS, 0.0)); }
#else
float groundFade(vec2 at) {
  float fade = clamp(1.0 - dot(at, at) / (STAGE_SIZES * STAGE_SIZES), 0.0, 1.0);
  return fade * fade;
}
#ifdef GROUND_BEHIND
float groundCovers(vec2 at, float width) { return 1.0; }
#else
float groundCovers(vec2 at, float width) { return groundFade(at); }
#endif
float edgeLight(vec2 at) { return 1.0; }
#endif

// What is behind the ground is darker in the corners of the picture.
float cornerShade() {
  vec2 place = gl_FragCoord.xy * frame.pixels.zw - 0.5;
  return 1.0 - frame.backgroundGlow.a * dot(place, place);
}

// The ground's light as its stage lets it go over into what is behind it.
#if defined(BOARDS)
vec3 groundInto(vec3 light, vec2 at, vec3 ray) { return light; }
#else
// Paper that goes up behind the scene without an edge.
const float RISES = 1.2;  // where it begins to
vec3 paperLight(vec3 ray) { return cornerShade() * frame.floorColor.rgb * mix(frame.backgroundBottom.rgb, frame.backgroundTop.rgb, smoothstep(-0.12, 0.62, ray.y)); }
vec3 groundInto(vec3 light, vec2 at, vec3 ray) {
  return mix(light, paperLight(ray), smoothstep(RISES, STAGE_SIZES, length(at)) * (1.0 - groundFade(at)));
}
#endif

// What a polished ground reflects: the key light, blurred, and the walls at grazing angles.
vec3 groundShine(vec3 position, vec3 normal, float lit) {
#ifdef BOARDS
  vec3 toEye = normalize(frame.eye.xyz - position);
  float gloss = frame.ground.z, away = 1.0 - clamp(dot(normal, toEye), 0.0, 1.0), away2 = away * away;
  vec3 walls = (0.02 + 0.5 * away2 * away2 * away) * frame.skyColor.rgb;
  return gloss * (walls + 0.22 * highlight(normal, toEye, 26.0, lit));
#else
  return vec3(0);
#endif
}
