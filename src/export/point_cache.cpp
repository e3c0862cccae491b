// PC2, the point cache of 3ds Max, which Blender's Mesh Cache modifier, Cinema 4D and others read: 32 bytes
// of header and the frames, all little-endian.
#include <array>
#include <bit>
#include <cstring>

#include "core/error.h"
#include "core/files.h"
#include "export/formats.h"
#include "export/sequence_formats.h"

namespace clothsim {
namespace {

static_assert(std::endian::native == std::endian::little, "a PC2 file is little-endian");

struct CacheHeader {
  char signature[12] = {'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};
  std::int32_t version = 1, pointCount = 0;
  float startFrame = 0, sampleRate = 1;  // frames from one sample to the next
  std::int32_t sampleCount = 0;
};
static_assert(sizeof(CacheHeader) == 32);

template <class T>
std::string_view bytesOf(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

class PointCacheWriter final : public SequenceWriter {
 public:
  PointCacheWriter(const std::filesystem::path& path, const Cloth& cloth, const FrameTimes& times)
      : cloth_(cloth), path_(path), file_(path) {
    header_.pointCount = static_cast<std::int32_t>(cloth.particleCount());
    header_.sampleRate = static_cast<float>(times.every);
    file_.append(bytesOf(header_));
  }

  void addFrame(const State& state, const Cloth& cloth, const Scene& /*scene*/) override {
    checkIsSameMesh(cloth, cloth_, path_);
    if (header_.sampleCount == 0) rest_ = state;
    isCut_ = isCut_ || state.cuts != rest_.cuts;
    std::string frame;
    frame.reserve(12 * state.positions.size());
    for (const Particle4& x : state.positions) frame.append(bytesOf(std::array<float, 3>{x.x, x.y, x.z}));
    file_.append(frame);
    ++header_.sampleCount;
  }

  [[nodiscard]] std::vector<std::string> losses() const override {
    if (!isCut_) return {};
    return {path_.string() +
            " keeps the triangles of the start, but cloth was cut or tore; save .usda, .usdc or .usd"};
  }

  void close() override {
    file_.overwrite(0, bytesOf(header_));
    writeFileAtomically(restMeshBeside(path_), formatObj(rest_, cloth_, ObjObjects::one));
    file_.close();
  }

 private:
  Cloth cloth_;
  std::filesystem::path path_;
  GrowingFile file_;
  CacheHeader header_;
  State rest_;          // the first frame
  bool isCut_ = false;  // in some frame otherwise than in the first
};

}  // namespace

std::unique_ptr<SequenceWriter> makePointCacheWriter(const std::filesystem::path& path, const Cloth& cloth,
                                                     const FrameTimes& times) {
  return std::make_unique<PointCacheWriter>(path, cloth, times);
}

}  // namespace clothsim
