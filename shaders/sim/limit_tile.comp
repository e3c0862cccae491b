// Limit on grids, for devices with fast shared memory: all colours in one dispatch. A work group takes a tile of grid
// points with so wide a halo about it that what it does not see cannot reach the tile. Neighbours limit the springs of the
// halo again, so the new positions go into another buffer.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/limit.glsl"
#include "sim/watch.glsl"

const int SIDE = LIMIT_TILE + 2 * LIMIT_HALO;
shared float regionX[SIDE * SIDE], regionY[SIDE * SIDE], regionZ[SIDE * SIDE];
shared float speedX[LIMIT_TILE * LIMIT_TILE], speedY[LIMIT_TILE * LIMIT_TILE], speedZ[LIMIT_TILE * LIMIT_TILE];

// Places count from the corner of the halo.
ivec2 cornerOfHalo() { return ivec2(gl_WorkGroupID.xy) * LIMIT_TILE - LIMIT_HALO; }
bool isInGrid(ivec2 place) {
  ivec2 inGrid = place + cornerOfHalo();
  return uint(inGrid.x) < step.columns && uint(inGrid.y) < step.rows;  // before the grid: beyond it
}
uint particleAt(ivec2 place) {
  ivec2 inGrid = place + cornerOfHalo();
  return step.firstParticle + uint(inGrid.y) * step.columns + uint(inGrid.x);
}
uint inRegion(ivec2 place) { return uint(place.y * SIDE + place.x); }
bool isInTile(ivec2 place) {
  ivec2 inTile = place - LIMIT_HALO;
  return inTile.x >= 0 && inTile.y >= 0 && inTile.x < LIMIT_TILE && inTile.y < LIMIT_TILE;
}
uint inTile(ivec2 place) { return uint((place.y - LIMIT_HALO) * LIMIT_TILE + place.x - LIMIT_HALO); }

vec3 positionIn(ivec2 place) {
  uint i = inRegion(place);
  return vec3(regionX[i], regionY[i], regionZ[i]);
}
vec3 velocityIn(ivec2 place) {
  uint i = inTile(place);
  return vec3(speedX[i], speedY[i], speedZ[i]);
}
void storePosition(ivec2 place, vec3 x) {
  uint i = inRegion(place);
  regionX[i] = x.x;
  regionY[i] = x.y;
  regionZ[i] = x.z;
}
void storeVelocity(ivec2 place, vec3 v) {
  uint i = inTile(place);
  speedX[i] = v.x;
  speedY[i] = v.y;
  speedZ[i] = v.z;
}

void load() {
  for (uint n = gl_LocalInvocationIndex; n < uint(SIDE * SIDE); n += WORK_GROUP_COLUMNS) {
    ivec2 place = ivec2(n % SIDE, n / SIDE);
    if (!isInGrid(place)) continue;
    storePosition(place, texelFetch(positionsSoFar, int(particleAt(place))).xyz);
    if (isInTile(place)) storeVelocity(place, texelFetch(velocitiesSoFar, int(particleAt(place))).xyz);
  }
}

SpringEnd endIn(ivec2 place) {
  float inverseMass = texelFetch(positionsSoFar, int(particleAt(place))).w;
  vec3 velocity = isInTile(place) ? velocityIn(place) : vec3(0.0);
  return SpringEnd(vec4(positionIn(place), inverseMass), velocity, false);
}
void store(ivec2 place, SpringEnd end) {
  if (!end.moved) return;
  storePosition(place, end.position.xyz);
  if (isInTile(place)) storeVelocity(place, end.velocity);
}

void limit(uint slot, ivec2 owner, ivec2 other) {
  uint particle = particleAt(owner);
  float longest = longestOf(slot, particle);
  if (!isIntact(cutMaskOf(particle), slot) || !isTooLong(positionIn(owner), positionIn(other), longest)) return;
  SpringEnd a = endIn(owner), b = endIn(other);
  limitSpring(a, b, longest);
  store(owner, a);
  store(other, b);
}

// Which points later slots still need: those so far from the border of the halo.
const int inset[6] = int[6](0, 0, 2, 4, 6, 6);

// Which line across the springs a number is of the owners of a colour: they come in runs of `reach`, one of two of them its
// (makeLimitColors() of src/solver/step_params.cpp). reach: 1 or 2.
int lineOf(int number, int reach, int color) {
  int run = number >> (reach - 1), inRun = number & (reach - 1);
  return reach * (2 * run + 1 + color) + inRun;
}

// Each invocation goes on by as many owners as there are invocations, in rows; it divides once.
void limitColor(uint slot, int color) {
  ivec2 toOther = toOtherEnd[slot];
  bool isAlongRow = toOther.y == 0;
  int side = SIDE - 2 * inset[slot], lines = side / 2;
  int reach = max(abs(toOther.x), abs(toOther.y)), width = isAlongRow ? lines : side, height = isAlongRow ? side : lines;
  int column = int(gl_LocalInvocationIndex) % width, row = int(gl_LocalInvocationIndex) / width;
  int columnsOn = WORK_GROUP_COLUMNS % width, rowsOn = WORK_GROUP_COLUMNS / width;
  while (row < height) {
    int line = lineOf(isAlongRow ? column : row, reach, color);
    ivec2 owner = isAlongRow ? ivec2(line, row) : ivec2(column, line), other = owner + toOther;
    if (line < side && other.x >= 0 && other.x < side && other.y >= 0) {
      owner += inset[slot];
      other += inset[slot];
      if (isInGrid(owner) && isInGrid(other)) limit(slot, owner, other);
    }
    column += columnsOn;
    row += rowsOn;
    if (column >= width) {
      column -= width;
      ++row;
    }
  }
}

void storeTile() {
  for (uint n = gl_LocalInvocationIndex; n < uint(LIMIT_TILE * LIMIT_TILE); n += WORK_GROUP_COLUMNS) {
    ivec2 place = ivec2(n % LIMIT_TILE, n / LIMIT_TILE) + LIMIT_HALO;
    if (!isInGrid(place)) continue;
    uint particle = particleAt(place);
    vec3 velocity = velocityIn(place);
    newPositions[particle] = vec4(positionIn(place), texelFetch(positionsSoFar, int(particle)).w);
    newVelocities[particle] = vec4(velocity, 0.0);
    watchVelocity(step.limitPass, particle, velocity);
  }
}

void main() {
  load();
  for (uint slot = 0u; slot < 6u; ++slot)
    for (int color = 0; color < 2; ++color) {
      barrier();
      if ((enabledSlots >> slot & 1u) != 0u) limitColor(slot, color);
    }
  barrier();
  storeTile();
  reportDivergence();
}
