// `.state` files. No fuzzer guesses a checksum, so that each input is read as it is and once more with the
// right checksum at its end.
#include <cstring>

#include "core/fnv.h"
#include "demands.h"
#include "export/formats.h"

using namespace clothsim;

namespace {

constexpr std::size_t countOffset = 16, mostParticles = 1000;  // as export/formats.h lays it out

// The count that the file claims, as far as a cloth of that size is quickly made.
std::size_t particlesIn(const std::string& file) {
  std::uint64_t count = 0;
  if (file.size() < countOffset + sizeof count) return 6;
  std::memcpy(&count, file.data() + countOffset, sizeof count);
  return count <= mostParticles ? static_cast<std::size_t>(count) : 6;
}

void check(const std::string& file) {
  const std::size_t particles = particlesIn(file);
  State state;
  if (!fuzz::isRead([&] { state = parseStateFile(file, particles, "fuzzed.state"); })) return;
  fuzz::demand(state.positions.size() == particles && state.velocities.size() == particles,
               "a state without its particles");
  const std::string saved = formatStateFile(state);
  State back;
  fuzz::demand(fuzz::isRead([&] { back = parseStateFile(saved, particles, "saved"); }),
               "a saved state is refused");
  fuzz::demand(formatStateFile(back) == saved, "a saved state is read as another");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string file(fuzz::textOf(bytes, size));
  check(file);
  Fnv1a hash;
  hash.add(file);
  const std::uint64_t sum = hash.value();
  file.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  check(file);
  return 0;
}
