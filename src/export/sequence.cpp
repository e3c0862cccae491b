#include "export/sequence.h"

#include <algorithm>

#include "core/error.h"
#include "export/sequence_formats.h"
#include "export/usd_binary.h"

namespace clothsim {

bool isSequence(const std::filesystem::path& path) {
  return isPointCache(path) || path.extension() == ".usda" || isUsdBinary(path);
}

bool isPointCache(const std::filesystem::path& path) { return path.extension() == ".pc2"; }

std::filesystem::path restMeshBeside(const std::filesystem::path& pointCache) {
  std::filesystem::path mesh = pointCache;
  return mesh.replace_filename(pointCache.stem().string() + "_rest.obj");
}

std::unique_ptr<SequenceWriter> makeSequenceWriter(const std::filesystem::path& path, const Cloth& cloth,
                                                   const Scene& scene, const FrameTimes& times) {
  if (isPointCache(path)) return makePointCacheWriter(path, cloth, times);
  if (isSequence(path)) return makeUsdWriter(path, cloth, scene, times);
  throw UsageError("cannot save frames to '" + path.string() + "': its extension is '" +
                   path.extension().string() + "', expected .pc2, .usda, .usdc or .usd");
}

void checkIsSameMesh(const Cloth& now, const Cloth& start, const std::filesystem::path& path) {
  const auto isSame = [](const Piece& a, const Piece& b) {
    return a.columns == b.columns && a.rows == b.rows && a.isMesh == b.isMesh;
  };
  if (std::ranges::equal(now.pieces(), start.pieces(), isSame) &&
      now.lists().triangles == start.lists().triangles)
    return;
  throw InputOutputError(path.string() + ": holds a mesh of " + std::to_string(start.particleCount()) +
                         " points, but the cloth was rebuilt as another one with " +
                         std::to_string(now.particleCount()) +
                         ". Save numbered files instead (cloth_%04d.obj).");
}

}  // namespace clothsim
