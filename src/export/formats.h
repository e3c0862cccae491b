// The bytes of each format that saveState writes.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

[[nodiscard]] std::string formatCsv(const State& state);
// Of several cloths the faces tell whose they are: the integer property `cloth`, counted from 0.
[[nodiscard]] std::string formatPly(const State& state, const Cloth& cloth);
// A mesh in the OBJ format. Of several cloths each is an object, unless all are asked for as one, as a point
// cache moves them.
enum class ObjObjects { byCloth, one };
[[nodiscard]] std::string formatObj(const State& state, const Cloth& cloth,
                                    ObjObjects objects = ObjObjects::byCloth);
// Arrays positions [m], velocities [m/s], inverse_masses [1/kg] (0: pinned), texture_coordinates, faces,
// step.
[[nodiscard]] std::string formatNpz(const State& state, const Cloth& cloth);

// glTF 2.0 in one binary file: a node with a mesh and a material for each cloth, with normals and texture
// coordinates. `looksOf` has colours and gloss; none: white. @throws InputOutputError
[[nodiscard]] std::string formatGlb(const State& state, const Cloth& cloth, const Scene* looksOf = nullptr);

// The `.state` file, little-endian throughout:
//   offset  0  8 bytes  "clothsim"
//           8  u32      version of this layout, 3, 4 or 5
//          12  u32      integrator: 0 verlet, 1 euler
//          16  u64      particle count n
//          24  u64      step
//          32  binary64 step length [s]
//          40  binary64 time [s] when the step length became that one,
//          48  u64      after so many steps (solver/step_clock.h)
//          56  n times  binary32 x, y, z [m], inverse mass [1/kg]
//    56 + 16n  n times  binary32 vx, vy, vz [m/s], 0 (older versions wrote a number that is not used)
//    56 + 32n  u64      number c of bytes of cuts: 0, n, or n and one for each triangle of meshes
//    64 + 32n  c times  u8  the springs of a particle that are cut, and the triangles that are lost
//                       (cloth/cuts.h)
//   64+32n+c   u64      number p of particles pinned or freed during the run
//   72+32n+c   p times  u32  those particles, ascending
//              u64      from version 4 on: number of elastic slips (solver/state.h), 0 or n
//                       so many times  binary32 x, y, z [m], what held [N]
//              u64      from version 4 on: number of pairs with elastic slips
//                       so many times  u32  place, four particles; binary32 x, y, z [m],
//                       what held [N]
//              u64      version 5 alone: number of changes in the last step (solver/state.h), 2n
//                       n times  binary32 x, y, z [m], 0; then x, y, z [m/s], 0
//              u32      version 5 alone: how many steps were usual (solver/state.h), 1 or 2
//              u64      FNV-1a of all bytes before
// Version 5 is written where the next step of `bdf2` looks back, version 4 where friction of implicit steps
// holds something, else version 3. Older files are read. Version 2 has no offsets 32 to
// 55: the time is then step times the step length of the scene that it is loaded into. Version 1 has no cuts
// and pins by hand either.
[[nodiscard]] std::string formatStateFile(const State& state);
// Of a cloth with so many particles, and triangles of meshes. `source` names the file in messages.
// @throws InputOutputError
[[nodiscard]] State parseStateFile(const std::string& bytes, std::size_t particleCount,
                                   const std::string& source, std::size_t meshTriangles = 0);

// Texture coordinates as OBJ, PLY and USD define them, with v counted from the lower edge of a picture. The
// cloth counts its own from the upper edge.
[[nodiscard]] std::vector<std::array<float, 2>> pictureCoordinates(const Cloth& cloth);

// Unit normals from the triangles around each particle, weighted by their areas; +y where those cancel out.
[[nodiscard]] std::vector<Vec3f> vertexNormals(const State& state, const Cloth& cloth);
[[nodiscard]] std::vector<Vec3f> vertexNormals(std::span<const Vec3f> points,
                                               std::span<const std::array<std::uint32_t, 3>> triangles);

// "cloth", or of several "cloth0", "cloth1" ...
[[nodiscard]] std::string clothName(const Cloth& cloth, std::size_t piece);

}  // namespace clothsim
