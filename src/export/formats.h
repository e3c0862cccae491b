// The bytes of each format that saveState writes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

[[nodiscard]] std::string formatCsv(const State& state);
[[nodiscard]] std::string formatPly(const State& state, const Cloth& cloth);
[[nodiscard]] std::string formatObj(const State& state, const Cloth& cloth);

// The `.state` file, little-endian throughout:
//   offset  0  8 bytes  "clothsim"
//           8  u32      version of this layout, 1 or 2
//          12  u32      integrator: 0 verlet, 1 euler
//          16  u64      particle count n
//          24  u64      step
//          32  n times  binary32 x, y, z [m], inverse mass [1/kg]
//    32 + 16n  n times  binary32 vx, vy, vz [m/s], 0
//    in version 2, which is written for a cloth that hands have cut, pinned or freed:
//    32 + 32n  u64      number c of bytes of cuts, n or 0
//    40 + 32n  c times  u8  the springs of a particle that are cut (cloth/cuts.h)
//   40+32n+c   u64      number p of particles that hands have pinned or freed
//   48+32n+c   p times  u32  those particles, ascending
//    and in both, at the end:
//              u64      FNV-1a of all bytes before
[[nodiscard]] std::string formatStateFile(const State& state);
// `source` names the file in messages. @throws InputOutputError
[[nodiscard]] State parseStateFile(const std::string& bytes, std::size_t particleCount,
                                   const std::string& source);

// As OBJ, PLY and USD have them: v begins at the lower edge of a picture. The cloth's own begin at the upper
// one.
[[nodiscard]] std::vector<std::array<float, 2>> pictureCoordinates(const Cloth& cloth);

// Unit normals from the triangles around each particle, weighted by their areas; +y where those cancel out.
[[nodiscard]] std::vector<Vec3f> vertexNormals(const State& state, const Cloth& cloth);

}  // namespace clothsim
