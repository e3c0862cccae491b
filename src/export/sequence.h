// Files that hold all saved frames of a run: a point cache and an animated mesh. They grow frame by frame
// under a temporary name and take their own when they are complete.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

struct FrameTimes {
  double framesPerSecond = 90;
  int every = 1;  // frames first, first + every, first + 2 every ...
  int first = 0;
};

class SequenceWriter {
 public:
  virtual ~SequenceWriter() = default;  // Without close() it leaves no file.
  // Adds the next frame, with the cloth and the scene as they are then: a replay may have edited them.
  // @throws InputOutputError, also for cloth with other points or triangles than that of the start
  virtual void addFrame(const State& state, const Cloth& cloth, const Scene& scene) = 0;
  // What the file shows otherwise than the frames were, since its kind cannot do better: a sentence each.
  [[nodiscard]] virtual std::vector<std::string> losses() const = 0;
  // The file is complete with the frames that were added. @throws InputOutputError
  virtual void close() = 0;
};

// .pc2: PC2 point cache, positions of the particles [m], little-endian; and beside cloth.pc2 the mesh that it
// moves, cloth_rest.obj, the first frame with uv. .usda: USD as text, a mesh with animated points for each
// cloth, the solids, materials and the camera, in metres, y up, with the frame rate; .usdc and .usd: the same
// in binary, by Pixar's library (export/usd_binary.h). Solids are where they are in each frame. A mesh that
// is cut on the way changes its triangles in .usda, and keeps them in .pc2. The PC2 header says that a sample
// stands for `every` frames. Blender takes each sample for one frame, so that its modifier's Frame Scale must
// be 1 / every.
[[nodiscard]] bool isSequence(const std::filesystem::path& path);
[[nodiscard]] bool isPointCache(const std::filesystem::path& path);
// The mesh that a point cache of that name moves.
[[nodiscard]] std::filesystem::path restMeshBeside(const std::filesystem::path& pointCache);

// @throws UsageError for another extension, InputOutputError
[[nodiscard]] std::unique_ptr<SequenceWriter> makeSequenceWriter(const std::filesystem::path& path,
                                                                 const Cloth& cloth, const Scene& scene,
                                                                 const FrameTimes& times);

}  // namespace clothsim
