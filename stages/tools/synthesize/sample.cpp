// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/sample.h"

#include "stages/tools/synthesize/tripod.h"
#include "stages/tools/synthesize/uniform.h"

namespace roomcut::synthesize {

std::unique_ptr<PointSource> make_source(const Scene& scene, const Building& building,
                                         const Surfaces& surfaces) {
  if (scene.sampling.kind == SamplingKind::kTripod)
    return std::make_unique<TripodSource>(scene, building, surfaces);
  return std::make_unique<UniformSource>(scene, building, surfaces);
}

std::uint64_t copies(const Scene& scene) {
  return static_cast<std::uint64_t>(scene.repeat.x) * static_cast<std::uint64_t>(scene.repeat.y) *
         static_cast<std::uint64_t>(scene.repeat.storeys);
}

Vec3 copy_offset(const Scene& scene, const Building& building, std::uint64_t copy) {
  const auto nx = static_cast<std::uint64_t>(scene.repeat.x);
  const auto ny = static_cast<std::uint64_t>(scene.repeat.y);
  const Vec3 step = building.hi - building.lo + Vec3::Constant(scene.repeat.gap);
  return step.cwiseProduct(Vec3(static_cast<double>(copy % nx), static_cast<double>(copy / nx % ny),
                                static_cast<double>(copy / (nx * ny))));
}

}  // namespace roomcut::synthesize
