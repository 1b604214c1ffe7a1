// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_planes/accept_planes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "common/slices/plane_steps.h"

namespace roomcut::accept_planes {

namespace {

std::vector<SlopedPlane> planes_of(const AcceptedPlanes& accepted) {
  std::vector<SlopedPlane> planes;
  for (const PlaneFeature& feature : accepted.planes) {
    planes.push_back(feature.plane);
  }
  return planes;
}

void count(const AcceptedPlanes& detected, Acceptance& result) {
  for (const PlaneFeature& feature : result.planes.planes) {
    int& counter = feature.source == LineSource::kDetected ? result.kept
                   : feature.source == LineSource::kEdited ? result.edited
                                                           : result.added;
    ++counter;
    result.locked += feature.locked ? 1 : 0;
  }
  result.deleted = static_cast<int>(detected.planes.size()) - result.kept - result.edited;
}

}  // namespace

AcceptedPlanes detected_planes(const Slices& slices) {
  AcceptedPlanes detected{
      slices.frame, slices.bbox_min.head<2>(), slices.bbox_max.head<2>(), "", slices.levels, {}};
  for (const SlopedPlane& plane : slices.planes) {
    std::array<char, 16> id{};
    std::snprintf(id.data(), id.size(), "p%04zu", detected.planes.size() + 1);
    PlaneFeature feature;
    feature.id = id.data();
    feature.plane = plane;
    detected.planes.push_back(std::move(feature));
  }
  return normalised_planes(std::move(detected));
}

Acceptance accept_planes(const Slices& slices, const AcceptedPlanes& detected,
                         const std::string& detection_sha256, const std::optional<AcceptedPlanes>& edit) {
  Acceptance result;
  result.planes = edit ? *edit : detected;
  result.base_moved = edit && !edit->base_sha256.empty() && edit->base_sha256 != detection_sha256;
  if (!result.base_moved) {
    result.planes.base_sha256 = detection_sha256;
  }
  count(detected, result);
  if (result.edited + result.added + result.deleted > 0) {
    result.planes.levels =
        levels_with_planes(slices.levels, slices.planes, planes_of(result.planes), slices.step_m);
    result.steps_moved = result.planes.levels.size() != slices.levels.size();
  }
  return result;
}

}  // namespace roomcut::accept_planes
