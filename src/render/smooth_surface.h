// A smooth surface through the particles, for drawing alone: that of a grid is a bicubic B-spline that comes
// by its particles to the fourth order of their spacing, that of a mesh or a cut grid consists of curved
// triangles. Its points, normals and triangles are computed on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "render/cloth_mesh.h"
#include "render/cloth_rim.h"
#include "render/layer_shares.h"
#include "render/patches.h"
#include "render/quality.h"
#include "shared/render_layout.h"

namespace clothsim {

// Making them throws OpenGlError and InputOutputError.
struct SmoothPrograms {
  gl::Program control = gl::Program::makeCompute("render/smooth_control.comp");
  gl::Program points = gl::Program::makeCompute("render/smooth_points.comp");
  gl::Program leanPoints = gl::Program::makeCompute("render/smooth_points.comp", {{"LEAN", ""}});
  gl::Program chooseSides = gl::Program::makeCompute("render/smooth_choose.comp");
  gl::Program chooseCenters = gl::Program::makeCompute("render/smooth_choose.comp", {{"CENTERS", ""}});
  gl::Program count = gl::Program::makeCompute("render/smooth_triangles.comp", {{"COUNT", ""}});
  gl::Program patches = gl::Program::makeCompute("render/smooth_patches.comp");
  gl::Program cuts = gl::Program::makeCompute("render/smooth_cuts.comp");
  gl::Program triangles = gl::Program::makeCompute("render/smooth_triangles.comp");
};

// Into how many steps the sides of each piece's cells are to be divided where a metre measures so many
// pixels, so that the narrowest folds that a grid can have look round: 1, 2, 4 or 8.
[[nodiscard]] std::vector<std::uint32_t> smoothSteps(const Cloth& cloth, double pixelsAMetre,
                                                     const RenderOptions& options);

class SmoothSurface {
 public:
  // `steps` for each piece, 1 to 8; of a cloth with these cuts. A lean surface, of whole grids alone, of
  // pieces with two steps, has points beside the particles only where triangles without them would be seen to
  // lie beside the surface, and all but the places of its points from the particles. `thickness` is that of
  // each piece as it is drawn [m]; empty: without one, and without an edge. `layers`: how far contact keeps
  // layers apart [m], which then do not pass through each other; 0: they may.
  SmoothSurface(const Cloth& cloth, std::span<const std::uint32_t> steps, bool isLean,
                std::span<const float> thickness = {}, const Cuts& cuts = {}, double layers = 0);
  [[nodiscard]] const std::vector<std::uint32_t>& steps() const { return steps_; }
  [[nodiscard]] bool isLean() const { return isLean_; }

  // The surface of the particles at `positions`, one vec4 each, for which `particles` has computed normals;
  // its triangles for the RenderFrame that is bound. `layers`: where hasLayers().
  void compute(const SmoothPrograms& programs, GLuint positions, const ClothMesh& particles,
               const LayerPrograms* layers = nullptr);
  [[nodiscard]] bool hasLayers() const { return layers_.has_value(); }
  // The triangles of all pieces, with the program and its state bound by the caller.
  // `only`: one piece.
  void draw(std::optional<std::size_t> only = {});
  // The edge of cloth that is thick, of which draw() is the sides: after compute(), by rim.comp with LEAN
  // where isLean().
  void computeRim(const gl::Program& program);
  void drawRim(std::optional<std::size_t> only = {}) const;

  // A vec4 a point, piece by piece, row by row: place [m]; unit normal, hollow as in ClothMesh::normals().
  [[nodiscard]] const gl::Buffer<glm::vec4>& points() const { return points_; }
  [[nodiscard]] const gl::Buffer<glm::vec4>& normals() const { return normals_; }
  // Of points: those that draw() draws. Reads them back.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles() const;

 private:
  struct DrawCommand {  // of glDrawElementsIndirect, in its order
    std::uint32_t count = 0, instances = 1, firstIndex = 0, baseVertex = 0, baseInstance = 0;
  };
  struct PieceBuffers {
    gl::Buffer<shared::ClothPiece> block;
    GLuint columns = 0, rows = 0, layerTriangles = 0;
    gl::Buffer<std::uint32_t> triangles;     // all of them, unless the surface is lean
    gl::Buffer<PatchPoint> patches;          // of a mesh or a cut grid
    gl::Buffer<std::uint32_t> counts, kept;  // of a lean surface: those that are drawn
    gl::Buffer<DrawCommand> command;
    [[nodiscard]] bool isPatched() const { return patches.size() > 0; }
  };
  void makePoints(std::uint32_t count, std::span<const std::array<float, 2>> textureCoordinates);
  // What all pieces are put together from.
  struct Points {
    std::uint32_t count = 0, controls = 0;
    std::vector<std::uint32_t> sides, centers;
    std::vector<std::array<float, 2>> textureCoordinates;
    std::vector<ClothRim::Strip> rim;
    std::vector<glm::uvec4> cutCorners;
  };
  PieceBuffers makeGrid(const Piece& piece, const shared::ClothPiece& block, Points& all) const;
  PieceBuffers makePatches(const Cloth& cloth, const Piece& piece,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const shared::ClothPiece& block, Points& all) const;
  // A program over the particles of whole grids and so many more in each direction.
  void dispatchGrids(const gl::Program& program, GLuint more = 0) const;
  void computePatches(const SmoothPrograms& programs);
  void shareBetweenLayers(const LayerPrograms& programs, GLuint positions);
  void evenOutCuts(const SmoothPrograms& programs, GLuint positions);
  void chooseTriangles(const SmoothPrograms& programs);

  std::vector<std::uint32_t> steps_;
  bool isLean_;
  std::vector<PieceBuffers> pieces_;
  gl::Buffer<std::uint32_t> sides_, centers_, places_;
  gl::Buffer<glm::uvec4> cutCorners_;  // which evenOutCuts() moves
  gl::Buffer<glm::vec4> moved_;        // particles where it has them; empty without cuts
  gl::Buffer<glm::vec4> controls_, points_, normals_, tangents_;
  gl::Buffer<std::array<float, 2>> textureCoordinates_;
  gl::VertexArray vertices_;
  std::optional<ClothRim> rim_;
  std::optional<LayerShares> layers_;
};

}  // namespace clothsim
