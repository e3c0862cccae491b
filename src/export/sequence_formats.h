// The writers behind makeSequenceWriter().
#pragma once

#include "export/sequence.h"

namespace clothsim {

[[nodiscard]] std::unique_ptr<SequenceWriter> makePointCacheWriter(const std::filesystem::path& path,
                                                                   const Cloth& cloth,
                                                                   const FrameTimes& times);
[[nodiscard]] std::unique_ptr<SequenceWriter> makeUsdWriter(const std::filesystem::path& path,
                                                            const Cloth& cloth, const Scene& scene,
                                                            const FrameTimes& times);

// @throws InputOutputError when `now` has other points or triangles than the cloth of the start
void checkIsSameMesh(const Cloth& now, const Cloth& start, const std::filesystem::path& path);

}  // namespace clothsim
