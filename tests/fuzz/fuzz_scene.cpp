// Scene files.
#include "demands.h"
#include "scene_io/scene_io.h"

using namespace clothsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  Scene scene;
  if (!fuzz::isRead([&] { scene = parseScene(fuzz::textOf(bytes, size), "fuzzed.json"); })) return 0;
  fuzz::checkRoundTrip(scene);
  fuzz::checkCloth(scene);
  return 0;
}
