#include "export/sequence.h"

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

void checkParticleCount(const State& state, const Cloth& cloth, const std::filesystem::path& path) {
  if (state.positions.size() == cloth.particleCount()) return;
  throw InputOutputError(path.string() + ": holds a mesh of " + std::to_string(cloth.particleCount()) +
                         " points, but the cloth was rebuilt with " + std::to_string(state.positions.size()) +
                         ". Save numbered files instead (cloth_%04d.obj).");
}

}  // namespace clothsim
