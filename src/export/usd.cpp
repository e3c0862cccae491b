// USD in its text form (.usda, openusd.org): one mesh with time samples. The stage's
// own settings are written, too: metres, y up, frames a second.
#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "core/files.h"
#include "export/formats.h"
#include "export/sequence_formats.h"
#include "export/text_numbers.h"

namespace clothsim {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::string text(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

void appendVector(std::string& text, float x, float y, float z) {
  text += '(';
  appendNumber(text, x);
  text += ", ";
  appendNumber(text, y);
  text += ", ";
  appendNumber(text, z);
  text += ')';
}

// "[a, b, c]", each element by `append`.
template <class Range, class Append>
void appendArray(std::string& text, const Range& range, Append append) {
  text += '[';
  bool first = true;
  for (const auto& element : range) {
    if (!std::exchange(first, false)) text += ", ";
    append(element);
  }
  text += ']';
}

void appendPoints(std::string& text, const std::vector<Particle4>& points) {
  appendArray(text, points, [&](const Particle4& x) { appendVector(text, x.x, x.y, x.z); });
}

// The smallest and the largest corner of a box around all points.
void appendExtent(std::string& text, const std::vector<Particle4>& points) {
  Particle4 low = points.front(), high = points.front();
  for (const Particle4& x : points) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  appendArray(text, std::array{low, high}, [&](const Particle4& x) { appendVector(text, x.x, x.y, x.z); });
}

class UsdWriter final : public SequenceWriter {
 public:
  UsdWriter(const std::filesystem::path& path, const Cloth& cloth, const FrameTimes& times)
      : cloth_(cloth), path_(path), file_(path), times_(times) {
    file_.append(
        "#usda 1.0\n(\n    defaultPrim = \"Cloth\"\n    doc = \"Made by clothsim\"\n    metersPerUnit = 1\n"
        "    upAxis = \"Y\"\n    startTimeCode = 0\n    endTimeCode = " +
        std::to_string(times.last) + "\n    timeCodesPerSecond = " + text(times.framesPerSecond) +
        "\n    framesPerSecond = " + text(times.framesPerSecond) +
        "\n)\n\ndef Mesh \"Cloth\"\n{\n    uniform bool doubleSided = 1\n"
        "    uniform token subdivisionScheme = \"none\"\n    texCoord2f[] primvars:st = ");
    std::string uvs;
    appendArray(uvs, pictureCoordinates(cloth), [&](const std::array<float, 2>& uv) {
      uvs += '(';
      appendNumber(uvs, uv[0]);
      uvs += ", ";
      appendNumber(uvs, uv[1]);
      uvs += ')';
    });
    file_.append(uvs +
                 " (\n        interpolation = \"vertex\"\n    )\n    point3f[] points.timeSamples = {\n");
  }

  void addFrame(const State& state) override {
    checkParticleCount(state, cloth_, path_);
    const std::string time = "        " + std::to_string(frame_) + ": ";
    std::string points = time;
    appendPoints(points, state.positions);
    file_.append(points + ",\n");
    extents_ += time;
    appendExtent(extents_, state.positions);
    extents_ += ",\n";
    Triangles triangles = remainingTriangles(cloth_, state.cuts);
    if (meshes_.empty() || meshes_.back().second != triangles)
      meshes_.emplace_back(frame_, std::move(triangles));
    frame_ += times_.every;
  }

  void close() override {
    file_.append("    }\n    float3[] extent.timeSamples = {\n" + extents_ + "    }\n");
    appendMeshes("faceVertexCounts", [](std::string& out, const Triangles& triangles) {
      appendArray(out, triangles, [&](const auto&) { out += '3'; });
    });
    appendMeshes("faceVertexIndices", [](std::string& out, const Triangles& triangles) {
      std::vector<std::uint32_t> corners;
      for (const auto& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
      appendArray(out, corners, [&](std::uint32_t corner) { appendIndex(out, corner); });
    });
    file_.append("}\n");
    file_.close();
  }

 private:
  // An attribute of the triangles: one value, or time samples where the cloth was cut on the way.
  template <class Append>
  void appendMeshes(const std::string& name, Append append) {
    std::string out = "    int[] " + name;
    if (meshes_.size() == 1) {
      out += " = ";
      append(out, meshes_.front().second);
    } else {
      out += ".timeSamples = {\n";
      for (const auto& [frame, triangles] : meshes_) {
        out += "        " + std::to_string(frame) + ": ";
        append(out, triangles);
        out += ",\n";
      }
      out += "    }";
    }
    file_.append(out + "\n");
  }

  Cloth cloth_;
  std::filesystem::path path_;
  GrowingFile file_;
  FrameTimes times_;
  int frame_ = 0;
  std::string extents_;                            // their time samples
  std::vector<std::pair<int, Triangles>> meshes_;  // from each frame on
};

}  // namespace

std::unique_ptr<SequenceWriter> makeUsdWriter(const std::filesystem::path& path, const Cloth& cloth,
                                              const FrameTimes& times) {
  return std::make_unique<UsdWriter>(path, cloth, times);
}

}  // namespace clothsim
