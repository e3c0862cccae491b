// `--set`: each line of the input is one flag, applied to a scene that has every kind of part.
#include <sstream>

#include "demands.h"
#include "scene_io/scene_io.h"

using namespace clothsim;

namespace {

const Scene& wholeScene() {
  static const Scene scene = parseScene(R"({
    "cloths": [
      {"ks": 5000, "num_width_points": 4, "num_height_points": 4, "pinned": ["top", [0, 0]],
       "pin_motion": {"keys": [{"t": 1, "position": [1, 0, 0]}]}},
      {"material": "silk", "num_width_points": 4, "num_height_points": 4}],
    "sphere": {"motion": {"keys": [{"t": 0}, {"t": 1, "position": [0, 1, 0]}], "loop": true}},
    "plane": {},
    "colliders": [{"type": "capsule"}, {"type": "box"}, {"type": "torus"}, {"type": "cylinder"}, {"type": "cone"}],
    "attractors": [{}, {"strength": -1}], "wind": {"gust": {"strength": 1}}, "camera": {}, "solver": {"integrator": "implicit"},
    "expect": {"frames": 1}})",
                                        "the harness");
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::istringstream lines{std::string(fuzz::textOf(bytes, size))};
  Scene scene = wholeScene();
  int flags = 0;
  for (std::string flag; flags < 4 && std::getline(lines, flag); ++flags) {
    const Scene before = scene;
    if (!fuzz::isRead([&] { setSceneValue(scene, flag); }))
      fuzz::demand(scene == before, "a flag that is refused changed the scene: " + flag);
  }
  fuzz::checkRoundTrip(scene);
  fuzz::checkCloth(scene);
  return 0;
}
