// Where triangles meet small colliders; the twin is in src/solver/cpu/small_colliders.cpp. After sim/implicit/common.glsl.
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/surface/pairs.glsl"
#include "shared/surface_laws.h"
#include "shared/core_laws.h"
#include "shared/deepest_place.h"

layout(binding = SMALL_COLLIDERS_UNIT) uniform samplerBuffer smallColliders;
layout(binding = SURFACE_POINTS_UNIT) uniform samplerBuffer points;

SmallCollider smallColliderAt(uint s) {
  vec4 a = texelFetch(smallColliders, int(2u * s)), b = texelFetch(smallColliders, int(2u * s + 1u));
  return SmallCollider(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}

// How a point of the cloth that goes from `start` to `place` meets a collider.
struct Touch {
  vec3 normal;
  float depth;
  vec3 carry;
};
Touch touchAt(ColliderParams collider, vec3 start, vec3 place) {
  vec3 previous = carried(collider, start);
  precise vec3 carry = previous - start;
  Contact contact = findContact(collider, previous, place);
  if (!contact.touches) contact = nearContact(collider, contact, place);
  return Touch(contact.normal, contact.depth, carry);
}

// Where a triangle meets a collider, as a point of the cloth.
struct Met {
  vec3 weights;
  Touch touch;
  bool counts;  // particles do not see it alone, and it is not far
  bool passes;
};
// `keeps`: at the place with the weights `before`, if no tip or core says otherwise.
Met meet(SmallCollider small, ColliderParams collider, vec3 start[3], vec3 end[3], bool keeps, vec3 before) {
  vec3 from[3], to[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = startInFrame(collider, start[k]);
    to[k] = placeInFrame(collider, end[k]);
  }
  bool edged = hasEdges(collider);
  Meeting meeting;
  if (edged)
    meeting = meetingWithShape(collider, small, from, to, keeps, before.y, before.z);
  else
    meeting = meetingOf(small, from, to);
  precise float rest = (1.0 - meeting.u) - meeting.v;
  vec3 w = canonical(vec3(rest, meeting.u, meeting.v));
  precise vec3 startThere = (w.x * start[0] + w.y * start[1]) + w.z * start[2];
  precise vec3 endThere = (w.x * end[0] + w.y * end[1]) + w.z * end[2];
  Touch touch = touchAt(collider, startThere, endThere);
  if (edged) {
    WayOut way = wayOutOf(collider, small, from, to, meeting);
    if (way.counts) {
      touch.normal = toWorld(collider, way.normal);
      touch.depth = way.depth;
    }
  }
  bool isCorner = meeting.part != NEAREST_FACE && meeting.part < NEAREST_SIDE;
  bool counts = (meeting.passes || !isCorner) && -small.radius < touch.depth;
  return Met(w, touch, counts, meeting.passes);
}
