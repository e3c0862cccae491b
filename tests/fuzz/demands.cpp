#include "demands.h"

#include <cstdio>
#include <cstdlib>

#include "cloth/cloth.h"
#include "scene_io/scene_io.h"

namespace clothsim::fuzz {

void demand(bool holds, const std::string& sentence) {
  if (holds) return;
  std::fprintf(stderr, "\nfuzz: %s\n", sentence.c_str());
  std::abort();
}

void checkMessage(const Error& error) {
  constexpr std::size_t longest = 4096;
  const std::string message = error.what();
  demand(!message.empty(), "an error without a message");
  demand(message.size() <= longest, "a message of " + std::to_string(message.size()) + " bytes");
  for (const char c : message)
    demand((static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) || c == '\n' || c == '\t',
           "a message with a control character: " + message);
}

void checkRoundTrip(const Scene& scene) {
  const std::string text = formatScene(scene);
  Scene back;
  demand(isRead([&] { back = parseScene(text, "saved"); }), "a saved scene is refused:\n" + text);
  demand(back == scene, "a saved scene is read as another:\n" + text);
  demand(formatScene(back) == text, "a scene that was read is saved in another way:\n" + text);
}

void checkCloth(const Scene& scene) {
  constexpr double most = 4096;  // particles; larger ones take too long for a fuzzer
  double particles = 0;
  for (const ClothSettings& cloth : scene.cloths)
    particles += cloth.isMesh() ? 0 : 1.0 * cloth.numWidthPoints * cloth.numHeightPoints;
  if (particles > most) return;
  (void)isRead([&] {
    const Cloth cloth(scene);
    demand(cloth.inverseMasses().size() == cloth.particleCount(), "a particle without a mass");
    for (const double inverseMass : cloth.inverseMasses())
      demand(inverseMass >= 0, "an inverse mass of " + std::to_string(inverseMass));
    for (const auto& triangle : cloth.triangles())
      for (const std::uint32_t corner : triangle)
        demand(corner < cloth.particleCount(), "a triangle with a corner that is no particle");
  });
}

}  // namespace clothsim::fuzz
