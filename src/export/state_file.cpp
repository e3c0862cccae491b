#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/fnv.h"
#include "export/formats.h"
#include "shared/implicit.h"

namespace clothsim {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file is little-endian, and is copied as it lies in memory");
static_assert(sizeof(Particle4) == 16 && sizeof(PairSlip) == 36);

struct Header {
  char magic[8];
  std::uint32_t version, integrator;
  std::uint64_t particleCount, step;
};
static_assert(sizeof(Header) == 32);

struct TimeBlock {  // behind the header since version 3; see StepClock
  double stepLength, originTime;
  std::uint64_t originStep;
};
static_assert(sizeof(TimeBlock) == 24);

constexpr char fileMagic[] = "clothsim";
// Version 2 added cuts and pins set during the run, version 3 the time, version 4 what contacts remember,
// version 5 what `bdf2` does. From version 3 on the first is written that holds all there is.
constexpr std::uint32_t plainVersion = 1, handledVersion = 2, timedVersion = 3, touchedVersion = 4,
                        secondOrderVersion = 5;

std::uint64_t checksum(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.value();
}

// Where positions and velocities begin, and where they end.
std::size_t particlesBegin(std::uint32_t version) {
  return sizeof(Header) + (version >= timedVersion ? sizeof(TimeBlock) : 0);
}
std::size_t particlesEnd(std::uint32_t version, std::uint64_t particleCount) {
  return particlesBegin(version) + 2 * sizeof(Particle4) * particleCount;
}

template <class T>
void append(std::string& bytes, const T* data, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

// A count, then so many elements.
template <class T>
void appendList(std::string& bytes, const std::vector<T>& list) {
  const std::uint64_t count = list.size();
  append(bytes, &count, 1);
  append(bytes, list.data(), list.size());
}

[[noreturn]] void refuse(const std::string& source, const std::string& found) {
  throw InputOutputError("cannot continue from '" + source + "': " + found);
}

// The header of a file of the right kind that fits the cloth.
Header checkedHeader(const std::string& bytes, std::size_t particleCount, const std::string& source) {
  Header header{};
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), fileMagic, sizeof header.magic) != 0)
    refuse(source, "it is no state file of clothsim (those are written by `clothsim run --save NAME.state`)");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version < plainVersion || header.version > secondOrderVersion)
    refuse(source, "it has version " + std::to_string(header.version) +
                       " of the format, this program reads versions 1 to 5");
  if (header.particleCount != particleCount)
    refuse(source, "it holds " + std::to_string(header.particleCount) + " particles, the scene has " +
                       std::to_string(particleCount) + " (was it saved at another --resolution?)");
  return header;
}

// The lists since version 2.
class Lists {
 public:
  Lists(const std::string& bytes, std::size_t place, const std::string& source)
      : bytes_(bytes), place_(place), source_(source) {}

  // Offset of the next byte to read.
  [[nodiscard]] std::size_t place() const { return place_; }

  template <class T>
  std::vector<T> next() {
    std::uint64_t count = 0;
    copy(&count, 1);
    if (count > (bytes_.size() - place_) / sizeof(T)) refuseLength(place_ + count * sizeof(T));
    std::vector<T> list(count);
    copy(list.data(), count);
    return list;
  }
  std::uint32_t nextNumber() {
    std::uint32_t number = 0;
    copy(&number, 1);
    return number;
  }
  [[noreturn]] void refuseLength(std::uint64_t expected) const {
    refuse(source_, "it has " + std::to_string(bytes_.size()) + " bytes where " + std::to_string(expected) +
                        " are expected: the file was cut off or added to");
  }

 private:
  template <class T>
  void copy(T* to, std::size_t count) {
    if (bytes_.size() - place_ < count * sizeof(T)) refuseLength(place_ + count * sizeof(T));
    if (count > 0) std::memcpy(to, bytes_.data() + place_, count * sizeof(T));
    place_ += count * sizeof(T);
  }

  const std::string& bytes_;
  std::size_t place_;
  const std::string& source_;
};

void checkChecksum(const std::string& bytes, const std::string& source) {
  std::uint64_t stored = 0;
  std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
  if (stored != checksum(std::string_view(bytes).substr(0, bytes.size() - sizeof stored)))
    refuse(source, "its checksum does not fit its content: the file is damaged");
}

StepClock readClock(const Header& header, const std::string& bytes, const std::string& source) {
  StepClock clock;
  clock.step = header.step;
  if (header.version < timedVersion) return clock;
  TimeBlock block{};
  std::memcpy(&block, bytes.data() + sizeof header, sizeof block);
  const bool sound = std::isfinite(block.stepLength) && block.stepLength >= 0 &&
                     std::isfinite(block.originTime) && block.originTime >= 0 &&
                     block.originStep <= header.step;
  if (!sound)
    refuse(source, "its time is no time: the step length and the time must be finite and not negative");
  clock.stepLength = block.stepLength;
  clock.originTime = block.originTime;
  clock.originStep = block.originStep;
  return clock;
}

// Refuses values that no working program writes, though the checksum fits them.
void checkContent(const Header& header, const State& state, std::size_t meshTriangles,
                  const std::string& source) {
  if (header.integrator > static_cast<std::uint32_t>(Integrator::euler))
    refuse(source, "it names integrator number " + std::to_string(header.integrator) +
                       ", which this program does not know");
  const std::size_t particles = state.positions.size();
  if (const std::size_t size = state.cuts.size();
      size != 0 && size != particles && size != particles + meshTriangles)
    refuse(source, "it has cuts of " + std::to_string(size) +
                       " particles and triangles of meshes, expected " + std::to_string(particles) +
                       (meshTriangles > 0 ? " or " + std::to_string(particles + meshTriangles) : ""));
  for (std::size_t i = 0; i < particles; ++i) {
    const Particle4 &x = state.positions[i], &v = state.velocities[i];
    for (const float value : {x.x, x.y, x.z, v.x, v.y, v.z})
      if (!std::isfinite(value))
        refuse(source, "place or velocity of particle " + std::to_string(i) + " is " + std::to_string(value) +
                           ", expected finite numbers");
    if (const float w = x.w; !(w >= 0 && std::isfinite(w)))
      refuse(source, "the inverse mass of particle " + std::to_string(i) + " is " + std::to_string(w) +
                         " 1/kg, expected a finite number from 0");
  }
  if (const std::size_t size = state.elasticSlips.size(); size != 0 && size != particles)
    refuse(source, "it has elastic slips of " + std::to_string(size) + " particles, expected " +
                       std::to_string(particles));
  for (std::size_t i = 0; i < state.elasticSlips.size(); ++i)
    if (const Particle4& slip = state.elasticSlips[i]; !std::isfinite(slip.x + slip.y + slip.z + slip.w))
      refuse(source,
             "the elastic slip of particle " + std::to_string(i) + " is none, expected finite numbers");
  for (std::size_t i = 0; i < state.pairSlips.size(); ++i) {
    const PairSlip& slip = state.pairSlips[i];
    if (!std::isfinite(slip.x + slip.y + slip.z + slip.heldLimit))
      refuse(source, "the elastic slip of pair " + std::to_string(i) + " is none, expected finite numbers");
    if (i > 0 && slip.place < state.pairSlips[i - 1].place)
      refuse(source, "its pairs with elastic slips are not in ascending order of their places");
  }
  if (const std::size_t size = state.histories.size();
      header.version >= secondOrderVersion &&
      (size != 2 * particles || state.usualSteps == 0 || state.usualSteps > USUAL_STEPS))
    refuse(source, "it has " + std::to_string(size) + " changes of the last step and " +
                       std::to_string(state.usualSteps) + " usual steps, expected " +
                       std::to_string(2 * particles) + " and 1 to " + std::to_string(USUAL_STEPS));
  for (std::size_t i = 0; i < state.histories.size(); ++i)
    if (const Particle4& change = state.histories[i]; !std::isfinite(change.x + change.y + change.z))
      refuse(source, "what the last step changed of particle " + std::to_string(i / 2) +
                         " is none, expected finite numbers");
  for (std::size_t i = particles; i < state.cuts.size(); ++i)
    if (state.cuts[i] > 1)
      refuse(source, "whether triangle " + std::to_string(i - particles) + " of the meshes is lost is " +
                         std::to_string(state.cuts[i]) + ", expected 0 or 1");
  for (std::size_t i = 0; i < std::min(particles, state.cuts.size()); ++i)
    if (state.cuts[i] >> SPRING_SLOTS != 0)
      refuse(source, "the cuts of particle " + std::to_string(i) + " are " + std::to_string(state.cuts[i]) +
                         ", expected less than 64");
  for (std::size_t i = 0; i < state.offPath.size(); ++i)
    if (state.offPath[i] >= particles || (i > 0 && state.offPath[i] <= state.offPath[i - 1]))
      refuse(source,
             "its particles pinned by hand are not in ascending order below " + std::to_string(particles));
}

}  // namespace

std::string formatStateFile(const State& state) {
  Header header{};
  std::memcpy(header.magic, fileMagic, sizeof header.magic);
  header.version = !state.histories.empty()                                ? secondOrderVersion
                   : state.elasticSlips.empty() && state.pairSlips.empty() ? timedVersion
                                                                           : touchedVersion;
  header.integrator = static_cast<std::uint32_t>(state.integrator);
  header.particleCount = state.positions.size();
  header.step = state.clock.step;
  const TimeBlock time{state.clock.stepLength, state.clock.originTime, state.clock.originStep};

  std::string bytes;
  bytes.reserve(particlesEnd(timedVersion, header.particleCount) + 3 * sizeof(std::uint64_t));
  append(bytes, &header, 1);
  append(bytes, &time, 1);
  append(bytes, state.positions.data(), state.positions.size());
  append(bytes, state.velocities.data(), state.velocities.size());
  appendList(bytes, state.cuts);
  appendList(bytes, state.offPath);
  if (header.version >= touchedVersion) {
    appendList(bytes, state.elasticSlips);
    appendList(bytes, state.pairSlips);
  }
  if (header.version >= secondOrderVersion) {
    appendList(bytes, state.histories);
    append(bytes, &state.usualSteps, 1);
  }
  const std::uint64_t sum = checksum(bytes);
  append(bytes, &sum, 1);
  return bytes;
}

State parseStateFile(const std::string& bytes, std::size_t particleCount, const std::string& source,
                     std::size_t meshTriangles) {
  const Header header = checkedHeader(bytes, particleCount, source);
  Lists lists(bytes, particlesEnd(header.version, particleCount), source);
  if (bytes.size() < lists.place()) lists.refuseLength(lists.place() + sizeof(std::uint64_t));
  State state;
  if (header.version >= handledVersion) {
    state.cuts = lists.next<std::uint8_t>();
    state.offPath = lists.next<std::uint32_t>();
  }
  if (header.version >= touchedVersion) {
    state.elasticSlips = lists.next<Particle4>();
    state.pairSlips = lists.next<PairSlip>();
  }
  if (header.version >= secondOrderVersion) {
    state.histories = lists.next<Particle4>();
    state.usualSteps = lists.nextNumber();
  }
  if (bytes.size() != lists.place() + sizeof(std::uint64_t))
    lists.refuseLength(lists.place() + sizeof(std::uint64_t));
  checkChecksum(bytes, source);
  state.clock = readClock(header, bytes, source);
  state.integrator = static_cast<Integrator>(header.integrator);
  state.positions.resize(particleCount);
  state.velocities.resize(particleCount);
  const std::size_t size = particleCount * sizeof(Particle4);
  if (size > 0) {
    const char* begin = bytes.data() + particlesBegin(header.version);
    std::memcpy(state.positions.data(), begin, size);
    std::memcpy(state.velocities.data(), begin + size, size);
  }
  checkContent(header, state, meshTriangles, source);
  return state;
}

}  // namespace clothsim
