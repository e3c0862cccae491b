// Recordings of what was done by hand.
#include "demands.h"
#include "session/recording.h"

using namespace clothsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  Recording recording;
  if (!fuzz::isRead([&] { recording = Recording::parse(fuzz::textOf(bytes, size), "fuzzed.json"); }))
    return 0;
  fuzz::checkRoundTrip(*recording.scene);
  const std::string text = recording.format();
  Recording back;
  fuzz::demand(fuzz::isRead([&] { back = Recording::parse(text, "saved"); }),
               "a saved recording is refused:\n" + text);
  fuzz::demand(
      back.scene == recording.scene && back.events.size() == recording.events.size() && back.format() == text,
      "a saved recording is read as another:\n" + text);
  return 0;
}
