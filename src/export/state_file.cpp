#include <bit>
#include <cstring>

#include "core/error.h"
#include "core/fnv.h"
#include "export/formats.h"

namespace clothsim {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file is little-endian, and is copied as it lies in memory");
static_assert(sizeof(Particle4) == 16);

struct Header {
  char magic[8];
  std::uint32_t version, integrator;
  std::uint64_t particleCount, step;
};
static_assert(sizeof(Header) == 32);

constexpr char fileMagic[] = "clothsim";
constexpr std::uint32_t fileVersion = 1;

std::uint64_t checksum(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.value();
}

std::size_t fileSize(std::uint64_t particleCount) {
  return sizeof(Header) + 2 * sizeof(Particle4) * particleCount + sizeof(std::uint64_t);
}

template <class T>
void append(std::string& bytes, const T* data, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

[[noreturn]] void refuse(const std::string& source, const std::string& found) {
  throw InputOutputError("cannot continue from '" + source + "': " + found);
}

// The header of a file that is whole and fits the cloth.
Header checkedHeader(const std::string& bytes, std::size_t particleCount, const std::string& source) {
  Header header{};
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), fileMagic, sizeof header.magic) != 0)
    refuse(source, "it is no state file of clothsim (those are written by `clothsim run --save NAME.state`)");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != fileVersion)
    refuse(source, "it has version " + std::to_string(header.version) +
                       " of the format, this program reads version " + std::to_string(fileVersion));
  if (header.particleCount != particleCount)
    refuse(source, "it holds " + std::to_string(header.particleCount) + " particles, the scene has " +
                       std::to_string(particleCount) + " (was it saved at another --resolution?)");
  if (bytes.size() != fileSize(particleCount))
    refuse(source, "it has " + std::to_string(bytes.size()) + " bytes where " +
                       std::to_string(fileSize(particleCount)) +
                       " are expected: the file was cut off or added to");
  std::uint64_t stored = 0;
  std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
  if (stored != checksum(std::string_view(bytes).substr(0, bytes.size() - sizeof stored)))
    refuse(source, "its checksum does not fit its content: the file is damaged");
  if (header.integrator > static_cast<std::uint32_t>(Integrator::euler))
    refuse(source, "it names integrator number " + std::to_string(header.integrator) +
                       ", which this program does not know");
  return header;
}

}  // namespace

std::string formatStateFile(const State& state) {
  Header header{};
  std::memcpy(header.magic, fileMagic, sizeof header.magic);
  header.version = fileVersion;
  header.integrator = static_cast<std::uint32_t>(state.integrator);
  header.particleCount = state.positions.size();
  header.step = state.step;

  std::string bytes;
  bytes.reserve(fileSize(header.particleCount));
  append(bytes, &header, 1);
  append(bytes, state.positions.data(), state.positions.size());
  append(bytes, state.velocities.data(), state.velocities.size());
  const std::uint64_t sum = checksum(bytes);
  append(bytes, &sum, 1);
  return bytes;
}

State parseStateFile(const std::string& bytes, std::size_t particleCount, const std::string& source) {
  const Header header = checkedHeader(bytes, particleCount, source);
  State state;
  state.step = header.step;
  state.integrator = static_cast<Integrator>(header.integrator);
  state.positions.resize(particleCount);
  state.velocities.resize(particleCount);
  const std::size_t size = particleCount * sizeof(Particle4);
  if (size > 0) {
    std::memcpy(state.positions.data(), bytes.data() + sizeof(Header), size);
    std::memcpy(state.velocities.data(), bytes.data() + sizeof(Header) + size, size);
  }
  return state;
}

}  // namespace clothsim
