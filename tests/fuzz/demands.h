// What every harness demands of a reader: bytes from outside become a value, or one of our errors with a
// message that a terminal can show. Whatever else happens (another exception, a sanitizer's finding, too much
// time or memory) is a finding of libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"
#include "scene/scene.h"

namespace clothsim::fuzz {

// Ends the program with the sentence unless the condition holds.
void demand(bool holds, const std::string& sentence);

// A message has lines, but no other control characters: those of a hostile file would reach the terminal.
void checkMessage(const Error& error);

// Calls `read`; whether it returned rather than throw an error that is fit for the user.
template <class Read>
bool isRead(Read&& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    checkMessage(error);
    return false;
  }
}

inline std::string_view textOf(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

// Saving and loading again gives the same scene, and saving that the same text.
void checkRoundTrip(const Scene& scene);

// The cloth of a small scene can be built, or the error says why not.
void checkCloth(const Scene& scene);

}  // namespace clothsim::fuzz
