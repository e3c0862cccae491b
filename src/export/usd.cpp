// USD (openusd.org): a mesh prim with time samples for each cloth, and the scene around. The stage's own
// settings are written, too: metres, y up, frames a second. USD writes all samples of an attribute together,
// so that positions wait in a spool until the run is over. It is written as text; Pixar's library makes the
// binary form of that.
#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/files.h"
#include "export/formats.h"
#include "export/sequence_formats.h"
#include "export/spool.h"
#include "export/texture_points.h"
#include "export/usd_binary.h"
#include "export/usd_parts.h"

namespace clothsim {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

UsdBox boxAround(std::span<const Vec3f> points) {
  UsdBox box{points.front(), points.front()};
  for (const Vec3f& x : points) {
    box.low = {std::min(box.low.x, x.x), std::min(box.low.y, x.y), std::min(box.low.z, x.z)};
    box.high = {std::max(box.high.x, x.x), std::max(box.high.y, x.y), std::max(box.high.z, x.z)};
  }
  return box;
}

void appendPoints(std::string& text, std::span<const Vec3f> points) {
  appendUsdArray(text, points, [&](const Vec3f& x) { appendUsdVector(text, x); });
}

// A list of what `cornersOf` has for the corners of each triangle.
template <class CornersOf>
void appendCorners(std::string& text, const Triangles& triangles, CornersOf cornersOf) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : triangles) {
    const std::array<std::uint32_t, 3> found = cornersOf(triangle);
    corners.insert(corners.end(), found.begin(), found.end());
  }
  appendUsdArray(text, corners, [&](std::uint32_t corner) { appendIndex(text, corner); });
}

class UsdWriter final : public SequenceWriter {
 public:
  UsdWriter(const std::filesystem::path& path, const Cloth& cloth, const Scene& scene,
            const FrameTimes& times)
      : cloth_(cloth),
        scene_(scene),
        path_(path),
        times_(times),
        spool_(path),
        file_(path),
        colliders_(scene.colliders),
        solids_(scene) {
    if (isUsdBinary(path)) {
      checkUsdLibrary(path);
      text_.emplace(path);
    }
  }

  void addFrame(const State& state, const Cloth& cloth, const Scene& scene) override {
    checkIsSameMesh(cloth, cloth_, path_);
    follow(scene);
    std::vector<Vec3f> points;
    points.reserve(state.positions.size());
    for (const Particle4& x : state.positions) points.push_back({x.x, x.y, x.z});
    spool_.append({reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3f)});
    if (frames_.empty()) start_ = boxAround(points);
    if (meshes_.empty() || cuts_ != state.cuts) {
      cuts_ = state.cuts;
      meshes_.emplace_back(frames_.size(), remainingTriangles(cloth_, cuts_));
    }
    const int code = times_.first + static_cast<int>(frames_.size()) * times_.every;
    const double time = state.clock.time();
    frames_.push_back({code, time, usdMatrices(solids_, time)});
  }

  [[nodiscard]] std::vector<std::string> losses() const override {
    std::vector<std::string> losses;
    if (hasOtherSolids_)
      losses.push_back(path_.string() +
                       " shows the colliders of the start alone, but some were added, removed or changed");
    if (hasOtherPace_)
      losses.push_back(path_.string() + " plays " + usdNumber(times_.framesPerSecond) +
                       " frames a second throughout, but solver.frames_per_sec was changed");
    return losses;
  }

  void close() override {
    const std::string rate = usdNumber(times_.framesPerSecond);
    write("#usda 1.0\n(\n    defaultPrim = \"clothsim\"\n    doc = \"Made by clothsim\"\n" +
          std::string("    metersPerUnit = 1\n    upAxis = \"Y\"\n    startTimeCode = ") +
          std::to_string(times_.first) +
          "\n    endTimeCode = " + std::to_string(frames_.empty() ? times_.first : frames_.back().code) +
          "\n    timeCodesPerSecond = " + rate + "\n    framesPerSecond = " + rate +
          "\n)\n\ndef Xform \"clothsim\"\n{\n");
    for (std::size_t piece = 0; piece < cloth_.pieces().size(); ++piece) writeCloth(piece);
    write(usdSurroundings(scene_, start_, frames_) + "}\n");
    if (text_) makeUsdBinary(path_, text_->descriptor(), file_);
    file_.close();
  }

 private:
  // Colliders may be moved and turned between frames.
  void follow(const Scene& scene) {
    hasOtherPace_ = hasOtherPace_ || scene.solver.framesPerSec != times_.framesPerSecond;
    if (scene.colliders == colliders_) return;
    colliders_ = scene.colliders;
    const std::size_t count = scene_.colliders.size();
    const bool areThere = std::ranges::equal(std::span(colliders_).first(std::min(count, colliders_.size())),
                                             scene_.colliders, {}, shapeAlone, shapeAlone);
    if (areThere) solids_ = ColliderSet(scene);
    hasOtherSolids_ = hasOtherSolids_ || !areThere || colliders_.size() > count;
  }

  // Of the same colliders at other places these are equal.
  static Collider shapeAlone(Collider collider) {
    placeOf(collider) = {};
    std::visit(
        [](auto& shape) {
          shape.motion.reset();
          shape.render = {};
          shape.friction = 0;
          if constexpr (requires { shape.rotation; }) shape.rotation = {};
          if constexpr (requires { shape.axis; }) shape.axis = {};
          if constexpr (requires { shape.normal; }) shape.normal = {};
        },
        collider);
    return collider;
  }

  void write(const std::string& text) {
    if (text_)
      text_->append(text);
    else
      file_.append(text);
  }

  void writeCloth(std::size_t number) {
    const Piece& piece = cloth_.pieces()[number];
    std::string text = "    def Mesh \"" + clothName(cloth_, number) +
                       "\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {\n"
                       "        uniform bool doubleSided = 1\n"
                       "        uniform token subdivisionScheme = \"none\"\n        rel material:binding = " +
                       "</clothsim/materials/" + usdClothMaterial(scene_, number) +
                       ">\n        texCoord2f[] primvars:st = ";
    const TexturePoints texture(cloth_, piece);
    appendUsdArray(text, texture.points(), [&](const TexturePoints::Point& point) {
      text += '(';
      appendNumber(text, point.coordinates[0]);
      text += ", ";
      appendNumber(text, point.coordinates[1]);
      text += ')';
    });
    write(text + " (\n            interpolation = \"" + (texture.hasSeams() ? "faceVarying" : "vertex") +
          "\"\n        )\n");
    if (texture.hasSeams())
      writeTriangles("primvars:st:indices", piece, [&](std::string& out, const Triangles& triangles) {
        appendCorners(out, triangles, [&](const Triangles::value_type& t) {
          const std::uint32_t first = piece.firstParticle;
          return texture.of({first + t[0], first + t[1], first + t[2]});
        });
      });
    writeSamples("point3f[] points", piece, appendPoints);
    writeSamples("float3[] extent", piece, [](std::string& out, std::span<const Vec3f> points) {
      const UsdBox box = boxAround(points);
      appendPoints(out, std::array{box.low, box.high});
    });
    write("        normal3f[] normals (\n            interpolation = \"vertex\"\n        )\n");
    writeNormals(piece);
    writeTriangles("faceVertexCounts", piece, [](std::string& out, const Triangles& triangles) {
      appendUsdArray(out, triangles, [&](const auto&) { out += '3'; });
    });
    writeTriangles("faceVertexIndices", piece, [](std::string& out, const Triangles& triangles) {
      appendCorners(out, triangles, [](const Triangles::value_type& triangle) { return triangle; });
    });
    write("    }\n");
  }

  [[nodiscard]] std::vector<Vec3f> pointsOf(const Piece& piece, std::size_t frame) {
    std::vector<Vec3f> points(piece.particleCount());
    const std::uint64_t first = std::uint64_t{frame} * cloth_.particleCount() + piece.firstParticle;
    const std::string bytes = spool_.read(first * sizeof(Vec3f), points.size() * sizeof(Vec3f));
    std::memcpy(points.data(), bytes.data(), bytes.size());
    return points;
  }

  [[nodiscard]] static Triangles trianglesOf(const Piece& piece, const Triangles& all) {
    Triangles own;
    for (const auto& [a, b, c] : all)
      if (a - piece.firstParticle < piece.particleCount())
        own.push_back({a - piece.firstParticle, b - piece.firstParticle, c - piece.firstParticle});
    return own;
  }

  [[nodiscard]] std::string timeOf(std::size_t frame) const {
    return "            " + std::to_string(frames_[frame].code) + ": ";
  }

  // An attribute that follows from the points of a frame.
  template <class Append>
  void writeSamples(const std::string& name, const Piece& piece, Append append) {
    write("        " + name + ".timeSamples = {\n");
    for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
      std::string text = timeOf(frame);
      append(text, pointsOf(piece, frame));
      write(text + ",\n");
    }
    write("        }\n");
  }

  void writeNormals(const Piece& piece) {
    std::size_t frame = 0, mesh = 0;
    Triangles triangles;
    writeSamples("normal3f[] normals", piece, [&](std::string& out, std::span<const Vec3f> points) {
      if (mesh < meshes_.size() && meshes_[mesh].first == frame)
        triangles = trianglesOf(piece, meshes_[mesh++].second);
      appendPoints(out, vertexNormals(points, triangles));
      ++frame;
    });
  }

  // An attribute of the triangles: one value, or time samples where the cloth was cut on the way.
  template <class Append>
  void writeTriangles(const std::string& name, const Piece& piece, Append append) {
    std::string out = "        int[] " + name;
    if (meshes_.size() == 1) {
      out += " = ";
      append(out, trianglesOf(piece, meshes_.front().second));
    } else {
      out += ".timeSamples = {\n";
      for (const auto& [frame, triangles] : meshes_) {
        out += timeOf(frame);
        append(out, trianglesOf(piece, triangles));
        out += ",\n";
      }
      out += "        }";
    }
    write(out + "\n");
  }

  Cloth cloth_;
  Scene scene_;
  std::filesystem::path path_;
  FrameTimes times_;
  Spool spool_;  // the positions of all frames
  GrowingFile file_;
  std::optional<Spool> text_;        // of which the binary form is made
  std::vector<Collider> colliders_;  // in the frame before, and as they are placed
  ColliderSet solids_;
  bool hasOtherSolids_ = false, hasOtherPace_ = false;  // than at the start
  UsdBox start_;
  std::vector<UsdFrame> frames_;
  Cuts cuts_;                                              // in the frame before
  std::vector<std::pair<std::size_t, Triangles>> meshes_;  // from each frame on, counted from 0
};

}  // namespace

std::unique_ptr<SequenceWriter> makeUsdWriter(const std::filesystem::path& path, const Cloth& cloth,
                                              const Scene& scene, const FrameTimes& times) {
  return std::make_unique<UsdWriter>(path, cloth, scene, times);
}

}  // namespace clothsim
