// Colliders as they are in this step, and their own frames. Needs sim/shapes.glsl.

// Row by row as shared/step_params.h lays it out, as far as this scene's colliders need it.
ColliderParams loadCollider(uint k) {
  int row = int(k) * COLLIDER_ROWS;
  ColliderParams c;
  vec4 r = texelFetch(colliderRows, row);
  c.pointX = r.x, c.pointY = r.y, c.pointZ = r.z, c.radius = r.w;
  r = texelFetch(colliderRows, row + 1);
  c.normalX = r.x, c.normalY = r.y, c.normalZ = r.z, c.radiusSquared = r.w;
  r = texelFetch(colliderRows, row + 2);
  c.type = floatBitsToUint(r.x), c.moving = floatBitsToUint(r.y), c.friction = r.w;
  if (hasType(COLLIDER_SPHERE)) {
    r = texelFetch(colliderRows, row + COLLIDER_SWEEP_ROW);
    c.sweepSquared = r.x, c.grazeSquared = r.y, c.inverseRadius = r.z;
  }
  if (hasShapes) {
    r = texelFetch(colliderRows, row + COLLIDER_AXES_ROW);
    c.axisXX = r.x, c.axisXY = r.y, c.axisXZ = r.z, c.sizeX = r.w;
    r = texelFetch(colliderRows, row + COLLIDER_AXES_ROW + 1);
    c.axisYX = r.x, c.axisYY = r.y, c.axisYZ = r.z, c.sizeY = r.w;
    r = texelFetch(colliderRows, row + COLLIDER_AXES_ROW + 2);
    c.axisZX = r.x, c.axisZY = r.y, c.axisZZ = r.z, c.sizeZ = r.w;
  }
  if (hasType(COLLIDER_MESH)) {
    r = texelFetch(colliderRows, row + COLLIDER_GRID_ROW);
    c.gridX = r.x, c.gridY = r.y, c.gridZ = r.z, c.inverseCell = r.w;
    uvec4 n = floatBitsToUint(texelFetch(colliderRows, row + COLLIDER_GRID_ROW + 1));
    c.gridColumns = n.x, c.gridRows = n.y, c.gridLayers = n.z, c.firstSample = n.w;
  }
  if (hasMovingColliders) {
    r = texelFetch(colliderRows, row + COLLIDER_MOTION_ROW);
    c.rotationXX = r.x, c.rotationXY = r.y, c.rotationXZ = r.z, c.translationX = r.w;
    r = texelFetch(colliderRows, row + COLLIDER_MOTION_ROW + 1);
    c.rotationYX = r.x, c.rotationYY = r.y, c.rotationYZ = r.z, c.translationY = r.w;
    r = texelFetch(colliderRows, row + COLLIDER_MOTION_ROW + 2);
    c.rotationZX = r.x, c.rotationZY = r.y, c.rotationZZ = r.z, c.translationZ = r.w;
    r = texelFetch(colliderRows, row + COLLIDER_MOTION_ROW + 3);
    c.pivotX = r.x, c.pivotY = r.y, c.pivotZ = r.z, c.nextSample = floatBitsToUint(r.w);
  }
  if (hasType(COLLIDER_DEFORMS)) {
    r = texelFetch(colliderRows, row + COLLIDER_WAY_ROW);
    c.part = r.x, c.share = r.y, c.way = floatBitsToUint(r.z), c.middleWay = floatBitsToUint(r.w);
  }
  return c;
}

vec3 pointOf(ColliderParams collider) { return vec3(collider.pointX, collider.pointY, collider.pointZ); }

vec3 toOwnFrame(ColliderParams shape, vec3 x) {
  precise vec3 d = x - pointOf(shape);
  precise float alongX = sumOfProducts(vec3(shape.axisXX, shape.axisXY, shape.axisXZ), d);
  precise float alongY = sumOfProducts(vec3(shape.axisYX, shape.axisYY, shape.axisYZ), d);
  precise float alongZ = sumOfProducts(vec3(shape.axisZX, shape.axisZY, shape.axisZZ), d);
  return canonical(vec3(alongX, alongY, alongZ));
}
vec3 toWorld(ColliderParams shape, vec3 v) {
  vec3 x = vec3(shape.axisXX, shape.axisXY, shape.axisXZ);
  vec3 y = vec3(shape.axisYX, shape.axisYY, shape.axisYZ);
  vec3 z = vec3(shape.axisZX, shape.axisZY, shape.axisZZ);
  precise vec3 result = (v.x * x + v.y * y) + v.z * z;
  return result;
}

// Where the particle was at the start of the step, carried along with a moving collider.
vec3 carriedRigidly(ColliderParams collider, vec3 x) {
  if (!hasMovingColliders || collider.moving == 0u) return x;
  precise vec3 d = x - vec3(collider.pivotX, collider.pivotY, collider.pivotZ);
  precise float rotatedX = sumOfProducts(vec3(collider.rotationXX, collider.rotationXY, collider.rotationXZ), d);
  precise float rotatedY = sumOfProducts(vec3(collider.rotationYX, collider.rotationYY, collider.rotationYZ), d);
  precise float rotatedZ = sumOfProducts(vec3(collider.rotationZX, collider.rotationZY, collider.rotationZZ), d);
  precise vec3 move = vec3(rotatedX, rotatedY, rotatedZ) +
                      vec3(collider.translationX, collider.translationY, collider.translationZ);
  precise vec3 result = x + move;
  return result;
}
vec3 carried(ColliderParams collider, vec3 x) {
  vec3 result = carriedRigidly(collider, x);
  if (!hasType(COLLIDER_DEFORMS) || collider.way == 0u) return result;
  precise vec3 deformed = result + toWorld(collider, deformationNear(collider, toOwnFrame(collider, result)));
  return deformed;
}

// A place in the own frame at the end of the step: one of then, or one of the start of the step, carried along.
vec3 placeInFrame(ColliderParams collider, vec3 x) {
  precise vec3 fromPoint = x - pointOf(collider);
  return hasType(COLLIDER_SPHERE) && collider.type == COLLIDER_SPHERE ? fromPoint : toOwnFrame(collider, x);
}
vec3 startInFrame(ColliderParams collider, vec3 x) { return placeInFrame(collider, carried(collider, x)); }

// Others than round ones have edges, or may have.
bool hasEdges(ColliderParams collider) {
  const uint round = 1u << COLLIDER_SPHERE | 1u << COLLIDER_PLANE | 1u << COLLIDER_CAPSULE;
  return (colliderTypes & ~round) != 0u && (round >> collider.type & 1u) == 0u;
}
