// Colliders, one after the other in the scene's order. The twin of src/solver/cpu/collide.cpp, where the geometry is
// explained.
#include "sim/shapes.glsl"
#include "sim/collider_frames.glsl"

struct Contact {
  bool touches;
  vec3 outward;  // to the surface, where the particle goes without friction
  vec3 normal;   // of the collider there, outward
  float depth;   // how far that is along the normal [m]
};

// Inside the sphere: the nearest point of its surface; after a long way through it, the point where that entered.
Contact sphereContact(ColliderParams sphere, vec3 previous, vec3 x) {
  vec3 center = pointOf(sphere);
  precise vec3 d = x - center;
  precise float distanceSquared = sumOfProducts(d, d);
  precise float inverseDistance = inverseSquareRoot(distanceSquared);
  precise float distance = distanceSquared * inverseDistance;
  bool inside = distanceSquared < sphere.radiusSquared;
  precise vec3 normal = inverseDistance * d;
  precise float depth = sphere.radius - distance;
  precise vec3 outward = depth * normal;

  precise vec3 way = x - previous;
  precise vec3 from = previous - center;
  precise float waySquared = sumOfProducts(way, way);
  precise float along = sumOfProducts(from, way);
  if (!(sphere.sweepSquared < waySquared && along < 0.0)) return Contact(inside, outward, normal, depth);

  precise float fromSquared = sumOfProducts(from, from);
  precise float alongSquared = along * along;
  precise float beyond = along + waySquared;
  precise float deeper = waySquared * (fromSquared - sphere.grazeSquared);
  precise float discriminant = alongSquared - waySquared * (fromSquared - sphere.radiusSquared);
  precise float positiveRoot = discriminant * inverseSquareRoot(discriminant);
  float root = 0.0 < discriminant ? positiveRoot : 0.0;
  precise float inverseWay = inverseSquareRoot(waySquared);
  precise float t = ((-along) - root) * (inverseWay * inverseWay);
  precise vec3 entryNormal = sphere.inverseRadius * (from + t * way);
  precise vec3 toEntry = sphere.radius * entryNormal - d;
  precise float facing = sumOfProducts(entryNormal, d);
  precise float sameSide = 0.5 * distance;
  bool passed = !inside && 0.0 < beyond && deeper < alongSquared;
  bool otherSide = inside && facing < sameSide;
  precise float entryDepth = sphere.radius - facing;
  if (passed || otherSide) return Contact(true, toEntry, entryNormal, entryDepth);
  return Contact(inside, outward, normal, depth);
}

// CS184's plane, crossed since `previous`: the foot of the perpendicular, a little off on the side it came from.
Contact crossedPlane(ColliderParams plane, vec3 previous, vec3 x) {
  vec3 normal = vec3(plane.normalX, plane.normalY, plane.normalZ);
  precise vec3 fromPointBefore = previous - pointOf(plane);
  precise vec3 fromPoint = x - pointOf(plane);
  precise float heightBefore = sumOfProducts(fromPointBefore, normal);
  precise float height = sumOfProducts(fromPoint, normal);
  bool wasAbove = !(heightBefore < 0.0);
  bool isAbove = !(height < 0.0);
  precise float side = wasAbove ? step.planeOffset : -step.planeOffset;
  precise float lift = side - height;
  precise vec3 outward = lift * normal;
  return Contact(wasAbove != isAbove, outward, normal, lift);
}

// A plane that is solid behind its normal: the foot of the perpendicular.
Contact solidPlane(ColliderParams plane, vec3 x) {
  vec3 normal = vec3(plane.normalX, plane.normalY, plane.normalZ);
  precise vec3 fromPoint = x - pointOf(plane);
  precise float height = sumOfProducts(fromPoint, normal);
  precise vec3 outward = (-height) * normal;
  return Contact(height < 0.0, outward, normal, -height);
}

// A shape known by its signed distance: to the nearest point of its surface, or back to the side where it came in.
Contact shapeContact(ColliderParams shape, vec3 previous, vec3 x) {
  vec3 b = toOwnFrame(shape, x);
  Nearest end = nearestOnShape(shape, b);
  precise vec3 moved = x - previous;
  precise float movedSquared = sumOfProducts(moved, moved);
  precise float distanceSquared = end.distance * end.distance;
  if (0.0 < end.distance && movedSquared < distanceSquared) return Contact(false, vec3(0.0), end.normal, 0.0);

  vec3 a = toOwnFrame(shape, previous);
  precise vec3 way = b - a;
  precise float waySquared = sumOfProducts(way, way);
  precise float inverseWay = inverseSquareRoot(waySquared);
  precise float wayLength = waySquared * inverseWay;
  precise float t = 0.0;
  precise vec3 place = a;
  Nearest entry;
  for (int i = 0; i <= SWEEP_STEPS; ++i) {  // the first place is its beginning
    if (i > 0) {
      if (!(0.0 < entry.distance) || !(t < 1.0)) break;
      t = t + entry.distance * inverseWay;
      place = a + t * way;
    }
    entry = nearestOnShape(shape, place);
  }
  precise vec3 back = (place - entry.distance * entry.normal) - b;
  precise float lift = sumOfProducts(back, entry.normal);
  precise float facing = sumOfProducts(end.normal, entry.normal);
  precise float towards = sumOfProducts(way, entry.normal);
  precise float approach = -towards;
  precise float steep = 0.25 * wayLength;
  bool inside = end.distance < 0.0;
  bool otherSide = !(0.5 < facing) && 0.0 < approach && 0.0 < lift;
  bool passed = !inside && otherSide && t < 1.0 && (facing < -0.5 || steep < approach);

  vec3 normal = otherSide ? entry.normal : end.normal;
  float depth = otherSide ? lift : -end.distance;
  precise vec3 outward = depth * normal;
  vec3 offset = passed ? back : outward;
  return Contact(inside || passed, toWorld(shape, offset), toWorld(shape, normal), depth);
}

Contact findContact(ColliderParams collider, vec3 previous, vec3 x) {
  if (hasType(COLLIDER_SPHERE) && collider.type == COLLIDER_SPHERE) return sphereContact(collider, previous, x);
  if (hasType(COLLIDER_PLANE) && collider.type == COLLIDER_PLANE) {
    if (hasCoulombFriction) return solidPlane(collider, x);
    return crossedPlane(collider, previous, x);
  }
  return shapeContact(collider, previous, x);
}

// Of a place that touches nothing: how it would if the surface were there.
Contact nearContact(ColliderParams collider, Contact contact, vec3 place) {
  if (hasType(COLLIDER_SPHERE) && collider.type == COLLIDER_SPHERE) return contact;
  if (!hasShapes || collider.type == COLLIDER_PLANE) {
    if (!hasCoulombFriction && contact.depth > 0.0) contact.normal = -contact.normal;  // CS184's plane has two sides
    return contact;
  }
  Nearest nearest = nearestOnShape(collider, toOwnFrame(collider, place));
  vec3 normal = toWorld(collider, nearest.normal);
  precise vec3 outward = (-nearest.distance) * normal;
  return Contact(false, outward, normal, -nearest.distance);
}

// What friction takes of the way to the surface. CS184: a share. Coulomb: of the way along the surface, friction times the
// depth that the contact pushed the particle out.
vec3 takenByFriction(ColliderParams collider, Contact contact, vec3 way) {
  if (!hasCoulombFriction) {
    precise vec3 share = collider.friction * way;
    return share;
  }
  precise float through = sumOfProducts(way, contact.normal);
  precise vec3 slide = way - through * contact.normal;
  precise float slideSquared = sumOfProducts(slide, slide);
  precise float taken = (collider.friction * contact.depth) * inverseSquareRoot(slideSquared);
  precise vec3 result = (taken < 1.0 ? taken : 1.0) * slide;
  return result;
}

// Friction may leave a particle a little inside a curved surface, or where it was inside before.
vec3 furtherOut(ColliderParams collider, vec3 x) {
  if (hasType(COLLIDER_SPHERE) && collider.type == COLLIDER_SPHERE) {
    precise vec3 d = x - pointOf(collider);
    precise float distanceSquared = sumOfProducts(d, d);
    precise float inverseDistance = inverseSquareRoot(distanceSquared);
    precise float depth = collider.radius - distanceSquared * inverseDistance;
    precise vec3 outward = depth * (inverseDistance * d);
    return distanceSquared < collider.radiusSquared ? outward : vec3(0.0);
  }
  if (!hasShapes || collider.type == COLLIDER_PLANE) return vec3(0.0);
  Nearest nearest = nearestOnShape(collider, toOwnFrame(collider, x));
  float depth = nearest.distance < 0.0 ? -nearest.distance : 0.0;
  precise vec3 outward = depth * nearest.normal;
  return toWorld(collider, outward);
}

Particle collideParticle(uint i, Particle particle) {
  if (!hasColliders || particle.position.w == 0.0) return particle;
  vec3 start = positionAt(i).xyz;
  precise vec3 x = particle.position.xyz;
  precise vec3 v = particle.velocity;
  for (uint k = 0u; k < step.colliderCount; ++k) {
    ColliderParams collider = loadCollider(step.firstCollider + k);
    vec3 previous = carried(collider, start);
    Contact contact = findContact(collider, previous, x);
    if (!contact.touches) continue;
    precise vec3 way = (x - previous) + contact.outward;
    vec3 taken = takenByFriction(collider, contact, way);
    precise vec3 slid = previous + (way - taken);
    vec3 further = furtherOut(collider, slid);
    precise vec3 corrected = slid + further;
    precise vec3 push = (contact.outward - taken) + further;  // not a difference of positions, which holds their rounding
    precise vec3 kicked = v + step.inverseTimeStep * push;
    x = canonical(corrected);
    v = canonical(kicked);
  }
  watchVelocity(PASS_COLLIDE, i, v);
  return Particle(vec4(x, particle.position.w), v);
}
