// Which share of its way from the particles' triangles the smooth surface may take, so that layers that contact keeps apart do
// not pass through each other (src/render/layer_shares.h). Triangles go into buckets by the place of their centers (INSERT); then
// each that is bent so much that it matters looks for triangles of other layers near its center.
// Buckets: M. Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", 2003.
#include "shared/render_layout.h"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std140, binding = LAYER_SEARCH_BINDING) uniform LayerSearchBlock { LayerSearch search; };
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = LAYER_TRIANGLES_BINDING) readonly buffer Triangles { uint corners[]; };
struct Entry { vec3 center; uint next; };  // of a triangle; the next one of its bucket, its number + 1
layout(std430, binding = LAYER_ENTRIES_BINDING) buffer Entries { Entry entries[]; };
layout(std430, binding = LAYER_HEADS_BINDING) buffer Heads { uint heads[]; };        // of buckets: a triangle's number + 1

uint bucketOf(ivec3 cell) {
  uvec3 c = uvec3(cell) * uvec3(73856093u, 19349663u, 83492791u);
  return (c.x ^ c.y ^ c.z) & (search.buckets - 1u);
}
uvec3 cornersOf(uint triangle) {
  return uvec3(corners[3u * triangle], corners[3u * triangle + 1u], corners[3u * triangle + 2u]);
}

#ifdef INSERT
void main() {
  uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= search.triangles) return;
  uvec3 c = cornersOf(triangle);
  vec3 center = (positions[c.x].xyz + positions[c.y].xyz + positions[c.z].xyz) / 3.0;
  uint next = atomicExchange(heads[bucketOf(ivec3(floor(center * search.perBucket)))], triangle + 1u);
  entries[triangle] = Entry(center, next);
}
#else
layout(std430, binding = LAYER_BULGES_BINDING) readonly buffer Bulges { vec4 bulges[]; };  // at centers; its length
layout(std430, binding = LAYER_REST_BINDING) readonly buffer RestPlaces { vec4 restPlaces[]; };
layout(std430, binding = LAYER_BEFORE_BINDING) readonly buffer Before { float before[]; };  // shares after the last round
layout(std430, binding = LAYER_SHARES_BINDING) buffer Shares { uint shares[]; };            // bits of floats

// What the corners of a triangle count for its point that is nearest to p (C. Ericson, "Real-Time Collision Detection", 2005,
// section 5.1.5).
vec3 nearestOn(vec3 p, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  float d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0.0 && d2 <= 0.0) return vec3(1, 0, 0);
  if (d3 >= 0.0 && d4 <= d3) return vec3(0, 1, 0);
  if (d6 >= 0.0 && d5 <= d6) return vec3(0, 0, 1);
  float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return vec3(-d3, d1, 0) / (d1 - d3);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return vec3(-d6, 0, d2) / (d2 - d6);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return vec3(0, d5 - d6, d4 - d3) / ((d4 - d3) + (d5 - d6));
  return vec3(va, vb, vc) / (va + vb + vc);
}

float shareOf(uvec3 c) { return (before[c.x] + before[c.y] + before[c.z]) / 3.0; }
void limitShare(uvec3 c, float share) {
  uint bits = floatBitsToUint(max(share, 0.0));
  atomicMin(shares[c.x], bits);
  atomicMin(shares[c.y], bits);
  atomicMin(shares[c.z], bits);
}

const float MOST_APPROACH = 0.5;  // of their distance

// The ways of two triangles, each as its share allows it now, towards each other: those that go too far are shortened.
void keepApart(uvec3 own, vec3 here, vec3 bulge, uint other) {
  uvec3 c = cornersOf(other);
  vec3 a = positions[c.x].xyz, b = positions[c.y].xyz, d = positions[c.z].xyz;
  vec3 w = nearestOn(here, a, b, d), off = here - (w.x * a + w.y * b + w.z * d);
  float apart = length(off);
  if (apart < 1e-9) return;
  vec3 direction = off / apart;
  float ownShare = shareOf(own), otherShare = shareOf(c), least = MOST_APPROACH * apart;
  float rise = 3.0 * (w.x * w.y + w.y * w.z + w.z * w.x);  // of a bulge there: none at corners, all of it in the middle
  float ownWay = -ownShare * dot(bulge, direction), otherWay = otherShare * rise * dot(bulges[other].xyz, direction);
  if (ownWay + otherWay <= least) return;
  if (ownWay > 0.0) limitShare(own, ownShare * (otherWay > 0.0 ? least / (ownWay + otherWay) : (least - otherWay) / ownWay));
  if (otherWay > 0.0) limitShare(c, otherShare * (ownWay > 0.0 ? least / (ownWay + otherWay) : (least - ownWay) / otherWay));
}

void main() {
  uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= search.triangles) return;
  vec4 bulge = bulges[triangle];
  if (bulge.w < search.leastBulge) return;
  uvec3 own = cornersOf(triangle);
#ifdef AGAIN
  // What goes a part of its way may go less far out of the way of another. All others found nothing to share.
  if (before[own.x] >= 1.0 && before[own.y] >= 1.0 && before[own.z] >= 1.0) return;
#endif
  vec3 here = entries[triangle].center, restHere = restPlaces[own.x].xyz;
  ivec3 first = ivec3(floor(here * search.perBucket - 0.5));
  for (int k = 0; k < 8; ++k) {
    uint next = heads[bucketOf(first + ivec3(k & 1, k >> 1 & 1, k >> 2))];
    while (next != 0u) {
      uint other = next - 1u;
      Entry entry = entries[other];
      next = entry.next;
      vec3 off = entry.center - here;
      if (dot(off, off) > search.radius * search.radius) continue;
      vec3 restOff = restPlaces[corners[3u * other]].xyz - restHere;
      if (dot(restOff, restOff) < LAYERS_APART * LAYERS_APART) continue;
      float both = bulge.w + bulges[other].w;
      if (both < 2.0 * search.leastBulge || length(off) > search.centerToCorner + both / MOST_APPROACH) continue;
      keepApart(own, here, bulge.xyz, other);
    }
  }
}
#endif
