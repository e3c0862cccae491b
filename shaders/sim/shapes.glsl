// Signed distances of the colliders' shapes in their own frames; the twins of src/solver/cpu/shapes.h, where the formulas
// have their sources.

bool hasType(uint type) { return (colliderTypes >> type & 1u) != 0u; }

// The nearest place of a surface, seen from a point.
struct Nearest {
  float distance;  // [m], negative inside
  vec3 normal;     // outward there
};

Nearest nearestOnCapsule(ColliderParams capsule, vec3 p) {
  float halfLength = capsule.sizeY;
  float above = halfLength < p.y ? halfLength : p.y;
  float y = above < -halfLength ? -halfLength : above;
  precise float beyond = p.y - y;
  vec3 d = vec3(p.x, beyond, p.z);
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float distance = lengthSquared * inverseLength - capsule.radius;
  precise vec3 normal = inverseLength * d;
  return Nearest(distance, normal);
}

Nearest nearestOnBox(ColliderParams box, vec3 p) {
  vec3 magnitude = vec3(p.x < 0.0 ? -p.x : p.x, p.y < 0.0 ? -p.y : p.y, p.z < 0.0 ? -p.z : p.z);
  precise vec3 beyond = magnitude - vec3(box.sizeX, box.sizeY, box.sizeZ);
  bool beyondX = 0.0 < beyond.x, beyondY = 0.0 < beyond.y, beyondZ = 0.0 < beyond.z;
  bool outside = beyondX || beyondY || beyondZ;
  vec3 d = vec3(beyondX ? beyond.x : 0.0, beyondY ? beyond.y : 0.0, beyondZ ? beyond.z : 0.0);
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise vec3 outward = inverseLength * d;
  bool faceX = !(beyond.x < beyond.y) && !(beyond.x < beyond.z);
  bool faceY = !faceX && !(beyond.y < beyond.z);
  bool faceZ = !faceX && !faceY;
  float toFace = faceX ? beyond.x : faceY ? beyond.y : beyond.z;
  precise float len = lengthSquared * inverseLength;
  precise float distance = (outside ? len : toFace) - box.radius;
  vec3 normal = outside ? outward : vec3(faceX ? 1.0 : 0.0, faceY ? 1.0 : 0.0, faceZ ? 1.0 : 0.0);
  return Nearest(distance, vec3(p.x < 0.0 ? -normal.x : normal.x, p.y < 0.0 ? -normal.y : normal.y,
                                p.z < 0.0 ? -normal.z : normal.z));
}

Nearest nearestOnTorus(ColliderParams torus, vec3 p) {
  precise float axisSquared = p.x * p.x + p.z * p.z;
  precise float inverseAxis = inverseSquareRoot(axisSquared);
  precise float beyond = axisSquared * inverseAxis - torus.sizeX;
  precise float lengthSquared = beyond * beyond + p.y * p.y;
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float radial = (beyond * inverseLength) * inverseAxis;
  precise float distance = lengthSquared * inverseLength - torus.radius;
  precise vec3 normal = vec3(radial * p.x, inverseLength * p.y, radial * p.z);
  return Nearest(distance, normal);
}

// One coordinate in a grid of `count` samples: the cell, and the place in it from 0 to 1.
struct GridPlace {
  uint cell;
  float part;
};
GridPlace gridPlace(float within, uint count) {
  uint truncated = uint(int(within));
  uint cell = truncated < count - 2u ? truncated : count - 2u;
  precise float part = within - float(int(cell));
  return GridPlace(cell, part);
}

float clampedTo(float x, float high) {
  float above = x < 0.0 ? 0.0 : x;
  return high < above ? high : above;
}

float distanceSample(uint i) { return texelFetch(distances, int(i)).x; }

Nearest nearestOnMesh(ColliderParams mesh, vec3 p) {
  precise vec3 fromFirst = p - vec3(mesh.gridX, mesh.gridY, mesh.gridZ);
  precise vec3 q = mesh.inverseCell * fromFirst;
  vec3 within = vec3(clampedTo(q.x, float(int(mesh.gridColumns - 1u))), clampedTo(q.y, float(int(mesh.gridRows - 1u))),
                     clampedTo(q.z, float(int(mesh.gridLayers - 1u))));
  precise vec3 outside = q - within;
  vec3 d = canonical(outside);
  precise float beyondSquared = sumOfProducts(d, d);
  GridPlace x = gridPlace(within.x, mesh.gridColumns), y = gridPlace(within.y, mesh.gridRows),
            z = gridPlace(within.z, mesh.gridLayers);
  uint first = mesh.firstSample + (z.cell * mesh.gridRows + y.cell) * mesh.gridColumns + x.cell;
  uint row = first + mesh.gridColumns, layer = first + mesh.gridColumns * mesh.gridRows, both = layer + mesh.gridColumns;
  float s00 = distanceSample(first), s10 = distanceSample(row), s01 = distanceSample(layer), s11 = distanceSample(both);
  precise float x00 = distanceSample(first + 1u) - s00;
  precise float x10 = distanceSample(row + 1u) - s10;
  precise float x01 = distanceSample(layer + 1u) - s01;
  precise float x11 = distanceSample(both + 1u) - s11;
  precise float v00 = s00 + x.part * x00;
  precise float v10 = s10 + x.part * x10;
  precise float v01 = s01 + x.part * x01;
  precise float v11 = s11 + x.part * x11;
  precise float y0 = v10 - v00;
  precise float y1 = v11 - v01;
  precise float v0 = v00 + y.part * y0;
  precise float v1 = v01 + y.part * y1;
  precise float z0 = v1 - v0;
  precise float x0 = x00 + y.part * (x10 - x00);
  precise float x1 = x01 + y.part * (x11 - x01);
  precise float gradientX = x0 + z.part * (x1 - x0);
  precise float gradientY = y0 + z.part * (y1 - y0);
  vec3 gradient = canonical(vec3(gradientX, gradientY, z0));
  bool beyond = 0.0 < beyondSquared;
  vec3 direction = beyond ? d : gradient;
  precise float lengthSquared = sumOfProducts(direction, direction);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float away = mesh.radius * (lengthSquared * inverseLength + 1.0);
  precise float interpolated = v0 + z.part * z0;
  precise vec3 normal = inverseLength * direction;
  return Nearest(beyond ? away : interpolated, normal);
}

Nearest nearestOnShape(ColliderParams shape, vec3 p) {
  if (hasType(COLLIDER_CAPSULE) && shape.type == COLLIDER_CAPSULE) return nearestOnCapsule(shape, p);
  if (hasType(COLLIDER_BOX) && shape.type == COLLIDER_BOX) return nearestOnBox(shape, p);
  if (hasType(COLLIDER_MESH) && shape.type == COLLIDER_MESH) return nearestOnMesh(shape, p);
  return nearestOnTorus(shape, p);
}
