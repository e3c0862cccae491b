#include "export/npz.h"

#include <zip.h>

#include <bit>
#include <cassert>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>

#include "cloth/cloth.h"
#include "core/error.h"
#include "export/formats.h"

namespace clothsim {
namespace {

static_assert(std::endian::native == std::endian::little, "the types of NamedArray say so");

constexpr std::size_t npyAlignment = 64;
constexpr std::time_t noDate = 315662400;  // 2 January 1980: the first day of zip archives in any time zone

std::string formatNpy(const NamedArray& array) {
  std::string shape;
  for (const std::size_t size : array.shape) shape += std::to_string(size) + ",";
  std::string header = "{'descr': '" + array.type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t before = 10;  // magic number, version, length of the header
  header.append(npyAlignment - (before + header.size() + 1) % npyAlignment, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
  return bytes + header + array.bytes;
}

void check(bool done) {
  if (!done) throw InputOutputError("An archive of arrays could not be put together in memory");
}

}  // namespace

std::string formatNpz(const std::vector<NamedArray>& arrays) {
  std::vector<std::string> files;  // libzip reads them when the archive is closed
  for (const NamedArray& array : arrays) files.push_back(formatNpy(array));

  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> buffer(
      zip_source_buffer_create(nullptr, 0, 0, nullptr), zip_source_free);
  check(buffer != nullptr);
  zip_source_keep(buffer.get());  // zip_close() gives back one hold, the destructor the other
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(
      zip_open_from_source(buffer.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr), zip_discard);
  if (archive == nullptr) zip_source_free(buffer.get());
  check(archive != nullptr);
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    zip_source_t* const content = zip_source_buffer(archive.get(), files[i].data(), files[i].size(), 0);
    const zip_int64_t index =
        zip_file_add(archive.get(), (arrays[i].name + ".npy").c_str(), content, ZIP_FL_ENC_UTF_8);
    if (index < 0) zip_source_free(content);
    check(index >= 0 &&
          zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) == 0 &&
          zip_file_set_mtime(archive.get(), static_cast<zip_uint64_t>(index), noDate, 0) == 0);
  }
  check(zip_close(archive.get()) == 0);
  static_cast<void>(archive.release());  // zip_close() has freed it

  zip_stat_t stat;
  check(zip_source_open(buffer.get()) == 0 && zip_source_stat(buffer.get(), &stat) == 0);
  std::string bytes(stat.size, '\0');
  check(zip_source_read(buffer.get(), bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(buffer.get());
  return bytes;
}

std::string formatNpz(const State& state, const Cloth& cloth) {
  const std::size_t count = state.positions.size();
  std::vector<float> positions, velocities, inverseMasses, coordinates;
  for (std::size_t i = 0; i < count; ++i) {
    const Particle4 &x = state.positions[i], &v = state.velocities[i];
    positions.insert(positions.end(), {x.x, x.y, x.z});
    velocities.insert(velocities.end(), {v.x, v.y, v.z});
    inverseMasses.push_back(x.w);
  }
  for (const auto& uv : pictureCoordinates(cloth))
    coordinates.insert(coordinates.end(), uv.begin(), uv.end());
  std::vector<std::uint32_t> faces;
  for (const auto& triangle : remainingTriangles(cloth, state.cuts))
    faces.insert(faces.end(), triangle.begin(), triangle.end());
  const std::int64_t step = static_cast<std::int64_t>(state.clock.step);
  return formatNpz({namedArray<float>("positions", {count, 3}, positions),
                    namedArray<float>("velocities", {count, 3}, velocities),
                    namedArray<float>("inverse_masses", {count}, inverseMasses),
                    namedArray<float>("texture_coordinates", {count, 2}, coordinates),
                    namedArray<std::uint32_t>("faces", {faces.size() / 3, 3}, faces),
                    namedArray<std::int64_t>("step", {}, std::span(&step, 1))});
}

}  // namespace clothsim
