// Writes states and pictures to files, whole or not at all. The extension of the name chooses the format.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

// .csv: header index,x,y,z,vx,vy,vz, values %.9g. .ply: binary little-endian, positions, normals, uv,
// triangles. .obj: text with uv and normals. .npz: arrays for NumPy (formats.h names them). .state: binary
// and exact, loadState reads it back. .glb: glTF, in the colours of the cloths of `looksOf`, or white.
// @throws UsageError for another extension, InputOutputError
void saveState(const State& state, const Cloth& cloth, const std::filesystem::path& path,
               const Scene* looksOf = nullptr);
[[nodiscard]] bool canSaveStateAs(const std::filesystem::path& path);
inline constexpr std::string_view STATE_EXTENSIONS = ".csv, .ply, .obj, .glb, .npz or .state";

// @throws InputOutputError for a missing, truncated or foreign file, or one with another particle count
[[nodiscard]] State loadState(const std::filesystem::path& path, const Cloth& cloth);
// Pins and masses are a part of a state. Says at how many particles they are other ones than at the start of
// the cloth's scene; "" where they are the same.
[[nodiscard]] std::string remarkOfState(const State& state, const Cloth& cloth);

// PNG from 8 bit RGB, top row first. @throws InputOutputError
void savePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

// Whether the name ends in .mp4 or .webp.
[[nodiscard]] bool isFilm(const std::string& name);

// MP4 (H.264, yuv420p), or an animated WebP, which pages of text show and which begins again at its end,
// through the ffmpeg program. Frames go to a temporary file that close() renames.
class VideoWriter {
 public:
  // @throws InputOutputError when ffmpeg is not installed (says how to get it) or does not start
  VideoWriter(const std::filesystem::path& path, int width, int height, double framesPerSecond);
  ~VideoWriter();  // Without close() it stops ffmpeg and removes the temporary file.
  void addFrame(std::span<const std::uint8_t> rgb);
  void close();  // @throws InputOutputError with ffmpeg's own last words when it failed

 private:
  struct Pipe;
  std::unique_ptr<Pipe> pipe_;
};

}  // namespace clothsim
