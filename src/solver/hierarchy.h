// The coarse levels of the implicit integrator's preconditioner (solver/implicit.h): smoothed aggregates of
// the graph of springs, for grids, meshes and cut cloth alike (Vanek, Mandel and Brezina 1996, "Algebraic
// multigrid by smoothed aggregation").
//
// On each level, a vertex that no aggregate has reached yet and its neighbours become an aggregate, in
// ascending order; what is left joins a neighbour. An aggregate is a vertex of the next level. A vertex hangs
// on its aggregate by the weight 1/3, and on those of its neighbours by 2/3 of the mean, so that the weights
// of a vertex add up to 1. Springs that are cut are no edges of the graph: no weight crosses a cut.
//
// Levels end when no connected part of the coarsest one has more than COARSEST_VERTICES vertices; each part
// is a dense matrix, which is inverted.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "shared/implicit.h"

namespace clothsim {

using LevelParams = shared::LevelParams;
using DensePart = shared::DensePart;
using LevelsInARow = shared::LevelsInARow;

// Numbers of vertices go over all levels and pieces: the particles come first. Those of coarse vertices alone
// begin with 0 behind them.
template <class Real>
struct Hierarchy {
  // The layouts are those of the buffers on the GPU.
  struct Weight {
    std::uint32_t vertex;
    Real weight;
  };
  // A block of a level's matrix that is not 0, and what it is summed up from: entries
  // [firstSource, endSource) of `sources`. On the first level those are particles, of which some element
  // (springs, bending, inertia) touches both aggregates; beyond, blocks of the finer level, twice the number,
  // + 1 for the transposed block.
  //
  // The last block of a row has the column ALL_VERTICES: what the row of the matrix makes of a rigid motion
  // of all vertices about that of the row. It is the sum of the row's blocks, but what springs add to those
  // is left out where it cancels. In binary32 the sum itself would lose the inertia, which is so much less.
  struct Block {
    std::uint32_t row, column;  // coarse vertices, row <= column; or ALL_VERTICES
    std::uint32_t firstSource, endSource;
  };

  std::uint32_t particles = 0;
  std::uint32_t coarseVertices = 0;              // of all levels
  std::vector<std::vector<LevelParams>> pieces;  // by piece, finest first; at least one each
  std::vector<std::vector<DensePart>> parts;     // of the coarsest level, by piece
  std::uint32_t denseEntries = 0;                // of the matrices of all parts

  std::vector<std::uint32_t> prolongationStarts;  // of a vertex, one more than there are
  std::vector<Weight> prolongation;               // the coarse vertices it hangs on, ascending
  std::vector<std::uint32_t> restrictionStarts;   // of a coarse vertex, one more than there are
  std::vector<Weight> restriction;                // the vertices that hang on it, ascending
  std::vector<std::uint32_t> blockStarts;         // of a coarse vertex, one more: blocks of its row
  std::vector<Block> blocks;                      // by row, ascending columns; the diagonal block comes first
  std::vector<std::uint32_t> sources;
  // Of each particle the aggregates that its elements touch, ascending, and the blocks of all pairs of them,
  // each row's with that of all vertices.
  std::vector<std::uint32_t> touchedStarts{0}, touched, elementBlockStarts{0}, elementBlocks;

  [[nodiscard]] bool empty() const { return pieces.empty(); }
};

// Of a cloth with these cuts.
template <class Real>
[[nodiscard]] Hierarchy<Real> makeHierarchy(const Cloth& cloth, const Cuts& cuts);

}  // namespace clothsim
