// Leaves out the calls that would bind what is bound already: a step asks for the same buffers again and
// again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "gl/api.h"

namespace clothsim::gl {

// While one lives, the classes of gl/ bind only what changes. Until its end nothing else binds, and nothing
// that is bound is deleted. One at a time in a thread.
class KeptBindings {
 public:
  KeptBindings() { kept_ = this; }
  ~KeptBindings() { kept_ = nullptr; }
  KeptBindings(const KeptBindings&) = delete;
  KeptBindings& operator=(const KeptBindings&) = delete;

  // What is bound to a place: an object, and for a range of a buffer its first byte and bytes, else 0.
  struct Bound {
    GLuint name = 0;
    std::size_t first = 0, bytes = 0;
    friend bool operator==(const Bound&, const Bound&) = default;
  };
  enum class Kind : std::uint8_t { storage, uniforms, texture, program, dispatches };

  // Whether binding this there changes anything; it is taken for bound from now on. Without one always.
  [[nodiscard]] static bool changes(Kind kind, GLuint place, const Bound& bound) {
    if (kept_ == nullptr || place >= PLACES) return true;
    Place& own = kept_->places_[static_cast<std::size_t>(kind)][place];
    if (own.isKnown && own.bound == bound) return false;
    own = {bound, true};
    return true;
  }

 private:
  static constexpr GLuint PLACES = 128;  // more are bound each time
  struct Place {
    Bound bound;
    bool isKnown = false;
  };

  std::array<std::array<Place, PLACES>, 5> places_ = {};
  static inline thread_local KeptBindings* kept_ = nullptr;
};

}  // namespace clothsim::gl
