// Contact of the cloth's surface with itself on the GPU: the twin of solver/cpu/surface_contact.h, passes
// under shaders/sim/surface/. Nothing is read back within a step: how many pairs there are, the GPU itself
// tells the dispatches that follow.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/mapped_buffer.h"
#include "gl/program.h"
#include "solver/executor.h"
#include "solver/gpu/arrays.h"
#include "solver/gpu/particle_array.h"
#include "solver/gpu/pass_programs.h"
#include "solver/gpu/pass_runner.h"
#include "solver/surface.h"

namespace clothsim {

class GpuSurfaceContact {
 public:
  // @throws OpenGlError when a buffer is larger than the driver allows, or a shader does not compile
  void setSurface(ClothSurface<float> surface, std::uint32_t particles, const PassFeatures& features);
  // No pairs from here on, nor what friction remembers of them.
  void switchOff();
  [[nodiscard]] bool isOn() const { return isOn_; }

  // What friction remembers of pairs of the last step (State::pairSlips).
  struct Slips {
    gl::Buffer<std::uint32_t> ids, slips;  // four numbers a pair; without names where there is no contact
    gl::Buffer<SurfaceState> state;

    [[nodiscard]] std::size_t bytes() const { return ids.bytes() + slips.bytes() + state.bytes(); }
    [[nodiscard]] std::vector<PairSlip> download() const;  // blocking
  };
  // A copy on the device, and back. It has room for all pairs that there may be, unless makeRoom() has just
  // seen how many there are.
  void copySlips(Slips& copy) const;
  void restoreSlips(const Slips& copy);
  void setSlips(const std::vector<PairSlip>& slips);

  // What the passes of the implicit step read.
  void bindTextures() const;
  // Does a pass of Domain::surface.
  void run(PassRunner& runner, PassCall call, GpuArrays& arrays);
  [[nodiscard]] ContactCounts counts() const;
  void forgetCounts();
  // Asks for a copy of what the steps so far have counted; a barrier for buffer updates stands before.
  void publish();
  // Makes room for twice as many pairs as any of those steps has had, once the copy is done. True if one has
  // had more than there was room for.
  bool makeRoom();
  // Counts of the steps so far, to go back to.
  void keepCounts();
  void restoreCounts();

 private:
  struct Variant {  // of a program
    bool touching = false, writes = false, lists = false, later = false, onlyBoxes = false, counts = false,
         stops = false;
    int gate = 0;
    friend auto operator<=>(const Variant&, const Variant&) = default;
  };
  struct alignas(256) RoundSlot {  // every driver takes uniform offsets in multiples of 256
    GuardRound round;
  };
  // A buffer of whole numbers and its view as texels.
  struct Numbers {
    Numbers() = default;
    Numbers(const std::string& label, std::size_t count, GLenum format = GL_R32UI);
    gl::Buffer<std::uint32_t> buffer;
    gl::BufferTexture texture;
  };

  // `pass` is a literal: programs_ keeps where it lies.
  const gl::Program& program(const char* pass, const Variant& variant);
  const gl::Program& program(const char* pass) { return program(pass, Variant()); }
  void compile();
  void allocatePairs(std::size_t pairs);
  void bindSlips() const;
  void forgetPairCount();
  void uploadParams();
  void runOn(PassRunner& runner, const gl::Program& program, std::size_t entries) const;
  void start(PassRunner& runner, const Variant& variant);
  void joinBoxes(PassRunner& runner, const Variant& variant);
  void scan(PassRunner& runner, Numbers& counts, Numbers& blocks, std::size_t size, bool lists);
  void findTouching(PassRunner& runner, bool later);
  void guard(PassRunner& runner, GpuArrays& arrays, std::uint32_t round);
  void meetColliders(PassRunner& runner);
  void pressOut(PassRunner& runner, GpuArrays& arrays, std::uint32_t round);
  // What the end of the step has come to, to be changed.
  void bindEnds(GpuArrays& arrays) const;
  void shorten(PassRunner& runner, GpuArrays& arrays);
  void settle(PassRunner& runner, GpuArrays& arrays);

  bool isOn_ = false;
  ClothSurface<float> surface_;
  std::uint32_t particles_ = 0;
  std::string name_;  // of the pass, for timings
  std::map<std::pair<std::string_view, Variant>, gl::Program> programs_;
  PassFeatures colliderFeatures_;  // what programs know of the scene

  gl::Buffer<SurfaceParams> params_;
  gl::Buffer<SurfaceState> state_, keptState_;
  gl::MappedBuffer<SurfaceState> stateCopy_;  // for the host
  bool hasCopy_ = false, isCopyCurrent_ = false;
  std::optional<std::size_t> knownPairs_;  // of the last step, while nothing has happened since
  gl::Buffer<Groups> dispatches_;          // over the pairs
  gl::Buffer<RoundSlot> rounds_;           // of the guard
  Numbers triangles_, rings_, counts_, blocks_, lists_, listBlocks_, entries_, flatBlocks_, flatFlags_;
  // Of the pairs of this step and of the one before: particles, and elastic slips with places.
  Numbers pairIds_, pairSlips_, newSlips_, keptIds_, keptSlips_;
  gl::Buffer<std::uint32_t> cursors_;
  gl::Buffer<std::uint32_t> kept_;  // of their motion by particles, then the same with what a round takes
  gl::Buffer<std::int32_t> corrections_;
  ParticleArray points_, boxes_, pairRows_, safePositions_, safeVelocities_, flatSides_;
  ParticleArray smallColliders_, pairCarries_;
};

}  // namespace clothsim
