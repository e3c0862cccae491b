#include "render/picking.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

struct PickedPixel {
  GLuint identity = 0;  // PICK_* below, the number above
  float u = 0, v = 0;   // texture coordinates
  float distance = 0;   // from the eye [m]
};
static_assert(sizeof(PickedPixel) == 16);

// The viewing ray's direction, unit.
glm::dvec3 rayThrough(const glm::mat4& clipFromWorld, glm::vec2 ndc, glm::dvec3 eye) {
  const glm::dvec4 far = glm::inverse(glm::dmat4(clipFromWorld)) * glm::dvec4(ndc, 0.9, 1);
  return glm::normalize(glm::dvec3(far) / far.w - eye);
}

// The corner of the triangle around `place` that is nearest to it: of the cell's four corners, the one across
// the diagonal belongs to the other triangle.
GridPoint nearestCorner(const Piece& piece, LatticePoint place) {
  const int column = std::clamp(static_cast<int>(std::floor(place.column)), 0, piece.columns - 2);
  const int row = std::clamp(static_cast<int>(std::floor(place.row)), 0, piece.rows - 2);
  const double x = place.column - column, y = place.row - row;
  const bool upperTriangle = x + y <= 1;  // (A, C, B), else (B, C, D)
  GridPoint nearest{column + 1, row};     // B, a corner of both
  double least = std::hypot(1 - x, y);
  const auto consider = [&](int right, int down) {
    const double distance = std::hypot(right - x, down - y);
    if (distance >= least) return;
    least = distance;
    nearest = {column + right, row + down};
  };
  consider(0, 1);
  upperTriangle ? consider(0, 0) : consider(1, 1);
  return nearest;
}

void describeCloth(std::span<const Piece> pieces, std::uint32_t particle, const PickedPixel& pixel,
                   Pick& pick) {
  const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& each) {
    return particle >= each.firstParticle && particle - each.firstParticle < each.particleCount();
  });
  if (piece == pieces.end()) return;
  pick.kind = Pick::Kind::cloth;
  pick.piece = static_cast<std::size_t>(piece - pieces.begin());
  if (piece->isMesh) {
    pick.particle = particle;
    return;
  }
  const double v = piece->rowsGoUp ? 1 - static_cast<double>(pixel.v) : static_cast<double>(pixel.v);
  pick.lattice = {static_cast<double>(pixel.u) * (piece->columns - 1), v * (piece->rows - 1)};
  const GridPoint corner = nearestCorner(*piece, pick.lattice);
  pick.particle = piece->particle(corner.column, corner.row);
}

}  // namespace

glm::mat4 PickTarget::clipFromPicture(int width, int height, double x, double y) {
  const double ndcX = 2 * x / width - 1, ndcY = 1 - 2 * y / height;
  const glm::dmat4 toMiddle = glm::translate(glm::dmat4(1), glm::dvec3(-ndcX, -ndcY, 0));
  return glm::mat4(glm::scale(glm::dmat4(1), glm::dvec3(width, height, 1)) * toMiddle);
}

void PickTarget::begin() const {
  pixel_.bind();
  const std::array<GLuint, 4> nothing{PICK_NOTHING, 0, 0, 0};
  const float farthest = 1;
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferuiv(pixel_.name(), GL_COLOR, 0, nothing.data());
  glClearNamedFramebufferfv(pixel_.name(), GL_DEPTH, 0, &farthest);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
}

void PickTarget::end() const { glDisable(GL_DEPTH_TEST); }

Pick PickTarget::read(std::span<const Piece> pieces, const glm::mat4& clipFromWorld, glm::vec2 ndc,
                      glm::vec3 eye) const {
  std::array<GLuint, 4> words{};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, pixel_.name());
  glReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words.data());
  const auto pixel = std::bit_cast<PickedPixel>(words);
  const GLuint kind = pixel.identity & PICK_KIND_MASK, number = pixel.identity >> PICK_KIND_BITS;
  Pick pick;
  if (kind == PICK_CLOTH) describeCloth(pieces, number, pixel, pick);
  if (kind == PICK_COLLIDER) {
    pick.kind = Pick::Kind::collider;
    pick.collider = number;
  }
  if (pick.kind != Pick::Kind::nothing) {
    const glm::dvec3 from(eye);
    pick.point = glm::vec3(from + static_cast<double>(pixel.distance) * rayThrough(clipFromWorld, ndc, from));
  }
  return pick;
}

}  // namespace clothsim
