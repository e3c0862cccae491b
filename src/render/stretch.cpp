#include "render/stretch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace clothsim {
namespace {

constexpr std::size_t CHANNELS = 4;
constexpr std::uint16_t WHOLE = 256, HALF = 128;  // the sum of both weights; for rounding

// Which two pixels of a row or column a pixel is mixed from.
struct Pair {
  std::size_t first, second;
  std::uint16_t ofSecond;  // 0 to WHOLE
};

Pair pairAt(int pixel, int size, int fromSize) {
  const double place = std::clamp((pixel + 0.5) * fromSize / size - 0.5, 0.0, fromSize - 1.0);
  const auto first = static_cast<std::size_t>(place);
  const std::size_t last = static_cast<std::size_t>(fromSize) - 1;
  return {first, std::min(first + 1, last),
          static_cast<std::uint16_t>(std::lround((place - static_cast<double>(first)) * WHOLE))};
}

std::vector<Pair> pairsOf(int from, int to, int size, int fromSize) {
  std::vector<Pair> pairs;
  for (int pixel = from; pixel < to; ++pixel) pairs.push_back(pairAt(pixel, size, fromSize));
  return pairs;
}

using Channels [[gnu::vector_size(8)]] = std::uint16_t;  // of a pixel

Channels channelsOf(const std::uint8_t* pixel) {
  using Bytes [[gnu::vector_size(4)]] = std::uint8_t;
  Bytes bytes;
  std::memcpy(&bytes, pixel, sizeof bytes);
  return __builtin_convertvector(bytes, Channels);
}

// A row with the columns of the larger picture.
void mixColumns(const std::uint8_t* row, std::span<const Pair> columns, std::uint8_t* into) {
  for (const Pair& pair : columns) {
    const auto b = static_cast<std::uint16_t>(pair.ofSecond), a = static_cast<std::uint16_t>(WHOLE - b);
    const Channels mixed =
        (channelsOf(row + CHANNELS * pair.first) * a + channelsOf(row + CHANNELS * pair.second) * b + HALF) /
        WHOLE;
    for (std::size_t c = 0; c < CHANNELS; ++c) into[c] = static_cast<std::uint8_t>(mixed[c]);
    into += CHANNELS;
  }
}

void mixRows(const std::vector<std::uint8_t>& first, const std::vector<std::uint8_t>& second,
             std::uint16_t ofSecond, std::uint8_t* into) {
  const auto b = static_cast<std::uint16_t>(ofSecond), a = static_cast<std::uint16_t>(WHOLE - b);
  for (std::size_t i = 0; i < first.size(); ++i)
    into[i] =
        static_cast<std::uint8_t>(static_cast<std::uint16_t>(a * first[i] + b * second[i] + HALF) / WHOLE);
}

}  // namespace

void stretchPixels(std::span<const std::uint8_t> from, PictureSize fromSize, PictureSize toSize,
                   const PixelRect& part, bool topFirst, std::span<std::uint8_t> into) {
  const std::vector<Pair> columns = pairsOf(part.left, part.right, toSize.width, fromSize.width);
  const std::size_t rowBytes = CHANNELS * static_cast<std::size_t>(fromSize.width);
  const std::size_t wideBytes = CHANNELS * columns.size();
  // The two rows that were looked at last: most are looked at again.
  std::vector<std::uint8_t> first(wideBytes), second(wideBytes);
  std::size_t ofFirst = SIZE_MAX, ofSecond = SIZE_MAX;
  for (int y = part.bottom; y < part.top; ++y) {
    std::uint8_t* const row =
        into.data() + static_cast<std::size_t>(topFirst ? part.top - 1 - y : y - part.bottom) * wideBytes;
    if (fromSize == toSize) {
      std::memcpy(row,
                  from.data() + static_cast<std::size_t>(y) * rowBytes +
                      CHANNELS * static_cast<std::size_t>(part.left),
                  wideBytes);
      continue;
    }
    const Pair rows = pairAt(y, toSize.height, fromSize.height);
    if (rows.first == ofSecond) {
      std::swap(first, second);
      std::swap(ofFirst, ofSecond);
    }
    if (rows.first != std::exchange(ofFirst, rows.first))
      mixColumns(from.data() + rows.first * rowBytes, columns, first.data());
    if (rows.second != std::exchange(ofSecond, rows.second))
      mixColumns(from.data() + rows.second * rowBytes, columns, second.data());
    mixRows(first, second, rows.ofSecond, row);
  }
}

void Stretch::run(const gl::Framebuffer& from, GLuint to, PictureSize toSize, const PixelRect& part,
                  bool topFirst) {
  const PictureSize fromSize{from.format().width, from.format().height};
  const auto bytes = [](int width, int height) {
    return CHANNELS * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  };
  if (part.width() == 0 || part.height() == 0) return;
  small_.resize(bytes(fromSize.width, fromSize.height));
  large_.resize(bytes(part.width(), part.height()));
  // Only the rows that are looked at.
  const auto lowest = pairAt(part.bottom, toSize.height, fromSize.height).first,
             highest = pairAt(part.top - 1, toSize.height, fromSize.height).second;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, static_cast<GLint>(lowest), fromSize.width, static_cast<GLsizei>(highest - lowest + 1),
               GL_BGRA, GL_UNSIGNED_BYTE, small_.data() + bytes(fromSize.width, static_cast<int>(lowest)));
  stretchPixels(small_, fromSize, toSize, part, topFirst, large_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(to, 0, part.left, topFirst ? toSize.height - part.top : part.bottom, part.width(),
                      part.height(), GL_BGRA, GL_UNSIGNED_BYTE, large_.data());
}

}  // namespace clothsim
