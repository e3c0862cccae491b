#include "cloth/seam_neighbours.h"

#include <algorithm>
#include <numeric>

namespace clothsim {
namespace {

// A particle and those around it: of a grid up to eight, of a mesh those that springs along edges join it to.
std::vector<std::uint32_t> around(const Cloth& cloth, std::uint32_t particle) {
  const Piece& piece = cloth.pieces()[cloth.pieceOf(particle)];
  std::vector<std::uint32_t> result{particle};
  if (piece.isMesh) {
    const SpringLists& lists = cloth.lists();
    for (std::uint32_t n = lists.springsOf.starts[particle]; n < lists.springsOf.starts[particle + 1]; ++n) {
      const MeshSpring& spring = lists.springs[lists.springsOf.entries[n]];
      if (spring.kind == SpringKind::structural) result.push_back(spring.a == particle ? spring.b : spring.a);
    }
    return result;
  }
  const int place = static_cast<int>(particle - piece.firstParticle);
  const int column = place % piece.columns, row = place / piece.columns;
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = column - 1; c <= column + 1; ++c)
      if ((r != row || c != column) && piece.contains(c, r)) result.push_back(piece.particle(c, r));
  return result;
}

}  // namespace

bool SeamNeighbours::areNear(std::uint32_t i, std::uint32_t j) const {
  if (starts.empty()) return false;
  return std::binary_search(entries.begin() + starts[i], entries.begin() + starts[i + 1], j);
}

SeamNeighbours seamNeighbours(const Cloth& cloth) {
  SeamNeighbours result;
  if (cloth.seams().empty()) return result;
  std::vector<std::vector<std::uint32_t>> near(cloth.particleCount());
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    if (i == j) return;
    near[i].push_back(j);
    near[j].push_back(i);
  };
  for (const SeamSpring& spring : cloth.seams()) {
    for (const std::uint32_t other : around(cloth, spring.b)) add(spring.a, other);
    for (const std::uint32_t other : around(cloth, spring.a)) add(spring.b, other);
  }
  for (std::vector<std::uint32_t>& own : near) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    result.starts.push_back(static_cast<std::uint32_t>(result.entries.size()));
    result.entries.insert(result.entries.end(), own.begin(), own.end());
  }
  result.starts.push_back(static_cast<std::uint32_t>(result.entries.size()));
  return result;
}

std::vector<std::uint32_t> seamJoints(const Cloth& cloth) {
  std::vector<std::uint32_t> joints(cloth.particleCount());
  std::iota(joints.begin(), joints.end(), 0u);
  const auto firstOf = [&](std::uint32_t i) {
    while (joints[i] != i) i = joints[i] = joints[joints[i]];
    return i;
  };
  for (const SeamSpring& spring : cloth.seams()) {
    const auto [low, high] = std::minmax({firstOf(spring.a), firstOf(spring.b)});
    joints[high] = low;
  }
  for (std::uint32_t& joint : joints) joint = firstOf(joint);
  return joints;
}

}  // namespace clothsim
