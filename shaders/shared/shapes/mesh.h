// The cell, along one side of a grid of `count` samples, that a place within the grid is in.
LAW uint gridCell(real within, uint count) {
  uint truncated = uint(int(within));
  return truncated < count - 2u ? truncated : count - 2u;
}

// From 0 to the place of the last of `count` samples.
LAW real clampedToGrid(real x, uint count) {
  real last = real(int(count - 1u));
  real above = x < real(0.0) ? real(0.0) : x;
  return last < above ? last : above;
}

// A mesh by its sampled distance: trilinear inside the grid, with the gradient of that as normal. Outside, no
// more than what is known there: the mesh is at least a cell inside the grid.
LAW Nearest nearestInGrid(ColliderParams mesh, uint firstOfShape, vec3 p) {
  precise vec3 fromFirst = p - vec3(mesh.gridX, mesh.gridY, mesh.gridZ);
  precise vec3 q = mesh.inverseCell * fromFirst;
  vec3 within = vec3(clampedToGrid(q.x, mesh.gridColumns), clampedToGrid(q.y, mesh.gridRows),
                     clampedToGrid(q.z, mesh.gridLayers));
  precise vec3 outside = q - within;
  vec3 d = canonical(outside);
  precise real beyondSquared = sumOfProducts(d, d);
  uint cellX = gridCell(within.x, mesh.gridColumns), cellY = gridCell(within.y, mesh.gridRows),
       cellZ = gridCell(within.z, mesh.gridLayers);
  precise vec3 part = within - vec3(real(int(cellX)), real(int(cellY)), real(int(cellZ)));
  uint first = firstOfShape + (cellZ * mesh.gridRows + cellY) * mesh.gridColumns + cellX;
  uint row = first + mesh.gridColumns, layer = first + mesh.gridColumns * mesh.gridRows,
       both = layer + mesh.gridColumns;
  real s00 = distanceSample(first), s10 = distanceSample(row);
  real s01 = distanceSample(layer), s11 = distanceSample(both);
  precise real x00 = distanceSample(first + 1u) - s00;
  precise real x10 = distanceSample(row + 1u) - s10;
  precise real x01 = distanceSample(layer + 1u) - s01;
  precise real x11 = distanceSample(both + 1u) - s11;
  precise real v00 = s00 + part.x * x00;
  precise real v10 = s10 + part.x * x10;
  precise real v01 = s01 + part.x * x01;
  precise real v11 = s11 + part.x * x11;
  precise real y0 = v10 - v00;
  precise real y1 = v11 - v01;
  precise real v0 = v00 + part.y * y0;
  precise real v1 = v01 + part.y * y1;
  precise real z0 = v1 - v0;
  precise real x0 = x00 + part.y * (x10 - x00);
  precise real x1 = x01 + part.y * (x11 - x01);
  precise real gradientX = x0 + part.z * (x1 - x0);
  precise real gradientY = y0 + part.z * (y1 - y0);
  vec3 gradient = canonical(vec3(gradientX, gradientY, z0));
  bool beyond = real(0.0) < beyondSquared;
  vec3 direction = beyond ? d : gradient;
  precise real lengthSquared = sumOfProducts(direction, direction);
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise real away = mesh.radius * (lengthSquared * inverseLength + real(1.0));
  precise real interpolated = v0 + part.z * z0;
  precise vec3 normal = inverseLength * direction;
  return Nearest(beyond ? away : interpolated, normal);
}

LAW vec3 displacementSample(uint i) {
  return vec3(distanceSample(i), distanceSample(i + 1u), distanceSample(i + 2u));
}
LAW vec3 displacementAlongRow(uint first, real part) {
  vec3 a = displacementSample(first);
  vec3 b = displacementSample(first + 3u);
  precise vec3 result = a + part * (b - a);
  return result;
}

// How far the surface that is nearest to p goes on the way from one shape to the next: trilinear between
// samples that are two cells apart.
LAW vec3 displacementNear(ColliderParams mesh, uint firstOfWay, vec3 p) {
  precise vec3 fromFirst = p - vec3(mesh.gridX, mesh.gridY, mesh.gridZ);
  precise vec3 q = mesh.inverseCell * fromFirst;
  precise vec3 within =
      real(0.5) * vec3(clampedToGrid(q.x, mesh.gridColumns), clampedToGrid(q.y, mesh.gridRows),
                       clampedToGrid(q.z, mesh.gridLayers));
  uint columns = mesh.gridColumns / 2u + 1u, rows = mesh.gridRows / 2u + 1u,
       layers = mesh.gridLayers / 2u + 1u;
  uint cellX = gridCell(within.x, columns), cellY = gridCell(within.y, rows),
       cellZ = gridCell(within.z, layers);
  precise vec3 part = within - vec3(real(int(cellX)), real(int(cellY)), real(int(cellZ)));
  uint first = firstOfWay + 3u * ((cellZ * rows + cellY) * columns + cellX);
  uint row = 3u * columns, layer = 3u * columns * rows;
  vec3 v00 = displacementAlongRow(first, part.x);
  vec3 v10 = displacementAlongRow(first + row, part.x);
  vec3 v01 = displacementAlongRow(first + layer, part.x);
  vec3 v11 = displacementAlongRow(first + layer + row, part.x);
  precise vec3 v0 = v00 + part.y * (v10 - v00);
  precise vec3 v1 = v01 + part.y * (v11 - v01);
  precise vec3 result = v0 + part.z * (v1 - v0);
  return canonical(result);
}

// A body on the way from one shape to the next. What is near p then was near the place from which the surface
// takes it to p, and will be near the one to which it takes it: the distances in both shapes, at those
// places, are interpolated. Were both taken at p, a limb thinner than its way would vanish in the middle.
LAW Nearest nearestOnMesh(ColliderParams mesh, vec3 p) {
  if (!hasType(COLLIDER_DEFORMS) || mesh.way == 0u) return nearestInGrid(mesh, mesh.firstSample, p);
  vec3 way = displacementNear(mesh, mesh.way, p);
  precise real rest = real(1.0) - mesh.part;
  precise vec3 before = p - mesh.part * way;
  precise vec3 after = p + rest * way;
  Nearest a = nearestInGrid(mesh, mesh.firstSample, before);
  Nearest b = nearestInGrid(mesh, mesh.nextSample, after);
  precise real distance = rest * a.distance + mesh.part * b.distance;
  precise vec3 mean = rest * a.normal + mesh.part * b.normal;
  vec3 direction = canonical(mean);
  precise real lengthSquared = sumOfProducts(direction, direction);
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise vec3 normal = inverseLength * direction;
  return Nearest(distance, normal);
}

// How far the surface near p goes in the step, where p is at its start.
LAW vec3 deformationNear(ColliderParams mesh, vec3 p) {
  vec3 way = displacementNear(mesh, mesh.middleWay, p);
  precise vec3 result = mesh.share * way;
  return result;
}
