#include "solver/gpu/mesh_lists.h"

#include <cstring>
#include <span>
#include <vector>

#include "cloth/seam_neighbours.h"
#include "shared/seams.h"
#include "solver/gpu/particle_array.h"

namespace clothsim {

namespace {

using Words = std::array<std::uint32_t, 4>;

// Hinges, then membranes, in whole texels.
std::vector<Words> elementsOf(const MeshLists<float>& lists) {
  std::vector<Words> words(HINGE_ROWS * lists.hinges.size() + MEMBRANE_ROWS * lists.membranes.size());
  if (!lists.hinges.empty())
    std::memcpy(words.data(), lists.hinges.data(), lists.hinges.size() * sizeof(lists.hinges[0]));
  if (!lists.membranes.empty())
    std::memcpy(words.data() + HINGE_ROWS * lists.hinges.size(), lists.membranes.data(),
                lists.membranes.size() * sizeof(lists.membranes[0]));
  return words;
}

// A membrane is named by its first texel there.
std::vector<std::uint32_t> numbersOf(const MeshLists<float>& lists) {
  std::vector<std::uint32_t> numbers = lists.numbers;
  const auto hingeRows = static_cast<std::uint32_t>(HINGE_ROWS * lists.hinges.size());
  for (std::size_t n = lists.starts.front().membranes; n < numbers.size(); ++n)
    numbers[n] = 4 * (hingeRows + MEMBRANE_ROWS * (numbers[n] / 4)) + numbers[n] % 4;
  return numbers;
}

}  // namespace

template <class Element>
GpuMeshLists::Texels GpuMeshLists::texels(const char* label, const std::vector<Element>& elements) {
  static_assert(sizeof(Element) % sizeof(Words) == 0, "elements are whole texels");
  // A cloth without hinges, or without springs, still has something to bind.
  std::vector<Words> words(std::max<std::size_t>(1, elements.size() * sizeof(Element) / sizeof(Words)));
  checkTexelsFit(words.size(), label);
  if (!elements.empty()) std::memcpy(words.data(), elements.data(), elements.size() * sizeof(Element));
  Texels result;
  result.buffer = gl::Buffer<Words>(label, std::span<const Words>(words));
  result.texture = gl::BufferTexture(label, result.buffer.name(), GL_RGBA32UI);
  return result;
}

void GpuMeshLists::addSeams(const Cloth& cloth, const MeshLists<float>& lists) {
  const SeamNeighbours near = seamNeighbours(cloth);
  std::vector<MeshLists<float>::SeamSpringAt> entries;
  for (std::size_t i = 0; i < lists.seamStarts.size(); ++i)
    entries.push_back({lists.seamStarts[i], near.starts[i], 0, 0});
  entries.insert(entries.end(), lists.seamSprings.begin(), lists.seamSprings.end());
  for (const std::uint32_t other : near.entries) entries.push_back({other, 0, 0, 0});
  seams_ = texels("seams", entries);
}

GpuMeshLists::GpuMeshLists(const Cloth& cloth, const Cuts& cuts)
    : any_(cloth.hasMesh()), anySeams_(!cloth.seams().empty()) {
  if (!any_ && !anySeams_) return;
  const MeshLists<float> lists = makeMeshLists<float>(cloth, cuts);
  if (anySeams_) addSeams(cloth, lists);
  if (!any_) return;
  starts_ = texels("starts of lists", lists.starts);
  springs_ = texels("springs at particles", lists.springs);
  hinges_ = texels("hinges and membranes", elementsOf(lists));
  triangles_ = texels("triangles of meshes", lists.triangles);
  limited_ = texels("springs of meshes", lists.limited);
  checkTexelsFit(lists.numbers.size(), "numbers in lists");
  numbers_ = gl::Buffer<std::uint32_t>("numbers in lists", std::span<const std::uint32_t>(numbersOf(lists)));
  numbersTexture_ = gl::BufferTexture("numbers in lists", numbers_.name(), GL_R32UI);
  places_ =
      gl::Buffer<std::array<float, 4>>("places at rest", std::span<const std::array<float, 4>>(lists.places));
  placesTexture_ = gl::BufferTexture("places at rest", places_.name(), GL_RGBA32F);
}

void GpuMeshLists::bind() const {
  if (anySeams_) seams_.texture.bind(SEAMS_UNIT);
  if (!any_) return;
  starts_.texture.bind(LIST_STARTS_UNIT);
  springs_.texture.bind(MESH_SPRINGS_UNIT);
  numbersTexture_.bind(MESH_NUMBERS_UNIT);
  hinges_.texture.bind(HINGES_UNIT);
  triangles_.texture.bind(MESH_TRIANGLES_UNIT);
  limited_.texture.bind(LIMITED_SPRINGS_UNIT);
  placesTexture_.bind(REST_PLACES_UNIT);
}

}  // namespace clothsim
