#include "export/texture_points.h"

#include <span>

#include "export/formats.h"

namespace clothsim {

TexturePoints::TexturePoints(const Cloth& cloth, const Piece& piece) : firstParticle_(piece.firstParticle) {
  const std::vector<std::array<float, 2>> ofAll = pictureCoordinates(cloth);
  const std::uint32_t end = firstParticle_ + piece.particleCount();
  for (std::uint32_t i = firstParticle_; i < end; ++i) points_.push_back({i, ofAll[i]});
  std::map<std::pair<std::uint32_t, std::array<float, 2>>, std::uint32_t> places;
  const TextureSeams& seams = cloth.textureSeams();
  for (auto seam = seams.lower_bound({firstParticle_, 0, 0}); seam != seams.end(); ++seam) {
    const auto& [triangle, corners] = *seam;
    if (triangle[0] >= end) break;
    std::array<std::uint32_t, 3>& found = ofTriangles_[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array coordinates{corners[k][0], 1 - corners[k][1]};
      found[k] = triangle[k] - firstParticle_;
      if (coordinates == ofAll[triangle[k]]) continue;
      const auto next = static_cast<std::uint32_t>(points_.size());
      const auto [place, isNew] = places.try_emplace({triangle[k], coordinates}, next);
      found[k] = place->second;
      if (isNew) points_.push_back({triangle[k], coordinates});
    }
  }
}

std::array<std::uint32_t, 3> TexturePoints::of(const std::array<std::uint32_t, 3>& triangle) const {
  if (const auto seam = ofTriangles_.find(triangle); seam != ofTriangles_.end()) return seam->second;
  return {triangle[0] - firstParticle_, triangle[1] - firstParticle_, triangle[2] - firstParticle_};
}

}  // namespace clothsim
