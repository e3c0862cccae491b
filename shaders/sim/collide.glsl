// Spheres and planes, one after the other in the scene's order, with CS184's friction: a particle that touches goes to
// previous + (1 - friction) (surface - previous).

// Row by row as shared/step_params.h lays it out; the rows of the motion only when some collider moves.
ColliderParams loadCollider(uint k) {
  int row = int(k) * COLLIDER_ROWS;
  ColliderParams c;
  vec4 r = texelFetch(colliderRows, row);
  c.pointX = r.x, c.pointY = r.y, c.pointZ = r.z, c.radius = r.w;
  r = texelFetch(colliderRows, row + 1);
  c.normalX = r.x, c.normalY = r.y, c.normalZ = r.z, c.radiusSquared = r.w;
  r = texelFetch(colliderRows, row + 2);
  c.type = floatBitsToUint(r.x), c.moving = floatBitsToUint(r.y), c.motionKept = r.z;
  if (!hasMovingColliders) return c;
  r = texelFetch(colliderRows, row + 3);
  c.turnXX = r.x, c.turnXY = r.y, c.turnXZ = r.z, c.shiftX = r.w;
  r = texelFetch(colliderRows, row + 4);
  c.turnYX = r.x, c.turnYY = r.y, c.turnYZ = r.z, c.shiftY = r.w;
  r = texelFetch(colliderRows, row + 5);
  c.turnZX = r.x, c.turnZY = r.y, c.turnZZ = r.z, c.shiftZ = r.w;
  r = texelFetch(colliderRows, row + 6);
  c.pivotX = r.x, c.pivotY = r.y, c.pivotZ = r.z;
  return c;
}

// Where the particle was at the start of the step, carried along with a moving collider.
vec3 carried(ColliderParams collider, vec3 x) {
  if (!hasMovingColliders || collider.moving == 0u) return x;
  precise vec3 d = x - vec3(collider.pivotX, collider.pivotY, collider.pivotZ);
  precise float turnX = sumOfProducts(vec3(collider.turnXX, collider.turnXY, collider.turnXZ), d);
  precise float turnY = sumOfProducts(vec3(collider.turnYX, collider.turnYY, collider.turnYZ), d);
  precise float turnZ = sumOfProducts(vec3(collider.turnZX, collider.turnZY, collider.turnZZ), d);
  precise vec3 move = vec3(turnX, turnY, turnZ) + vec3(collider.shiftX, collider.shiftY, collider.shiftZ);
  precise vec3 result = x + move;
  return result;
}

struct Contact {
  bool touches;
  vec3 surface;  // where CS184 puts a particle without friction
};

// Inside the sphere: the nearest point of its surface.
Contact sphereContact(ColliderParams sphere, vec3 x) {
  vec3 center = vec3(sphere.pointX, sphere.pointY, sphere.pointZ);
  precise vec3 d = x - center;
  precise float distanceSquared = sumOfProducts(d, d);
  precise float scale = sphere.radius * inverseSquareRoot(distanceSquared);
  precise vec3 surface = center + scale * d;
  return Contact(distanceSquared < sphere.radiusSquared, surface);
}

// Crossed since `previous`: the foot of the perpendicular, a little off on the side it came from.
Contact planeContact(ColliderParams plane, vec3 previous, vec3 x) {
  vec3 point = vec3(plane.pointX, plane.pointY, plane.pointZ);
  vec3 normal = vec3(plane.normalX, plane.normalY, plane.normalZ);
  precise vec3 fromPointBefore = previous - point;
  precise vec3 fromPoint = x - point;
  precise float heightBefore = sumOfProducts(fromPointBefore, normal);
  precise float height = sumOfProducts(fromPoint, normal);
  bool wasAbove = !(heightBefore < 0.0);
  bool isAbove = !(height < 0.0);
  precise float side = wasAbove ? step.planeOffset : -step.planeOffset;
  precise float lift = side - height;
  precise vec3 surface = x + lift * normal;
  return Contact(wasAbove != isAbove, surface);
}

Particle collideParticle(uint i, Particle particle) {
  if (!hasColliders || particle.position.w == 0.0) return particle;
  vec3 start = positionAt(i).xyz;
  precise vec3 x = particle.position.xyz;
  precise vec3 v = particle.velocity;
  for (uint k = 0u; k < step.colliderCount; ++k) {
    ColliderParams collider = loadCollider(step.firstCollider + k);
    vec3 previous = carried(collider, start);
    Contact contact;
    if (collider.type == COLLIDER_SPHERE)
      contact = sphereContact(collider, x);
    else
      contact = planeContact(collider, previous, x);
    if (!contact.touches) continue;
    precise vec3 corrected = previous + collider.motionKept * (contact.surface - previous);
    precise vec3 kicked = v + step.inverseTimeStep * (corrected - x);
    x = canonical(corrected);
    v = canonical(kicked);
  }
  return Particle(vec4(x, particle.position.w), v);
}
