// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/thin_walls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace roomcut::evaluate {

namespace {

struct ThinPlace {
  bool thin = false, kept = false, opening = false;
  bool parts_rooms = false;  // two different ones
  std::int32_t near_room = -1, far_room = -1;
  Vec3 middle{0, 0, 0};
};

ThinPlace inspect(const SurfaceSample& sample, const MeshTree& tree, const RoomFinder& finder,
                  const Columns& model, double thickest_m, const ScannedSurface* scanned) {
  ThinPlace place;
  const Vec3& normal = tree.unit_normal(sample.triangle);
  constexpr double kOwnSurface = 1e-6;
  constexpr double kFacesAway = -0.7;
  const auto hit = tree.first_on_ray(sample.point, normal, kOwnSurface, thickest_m);
  if (hit.triangle < 0 || tree.unit_normal(hit.triangle).dot(normal) > kFacesAway) {
    return place;
  }
  place.thin = true;
  place.middle = sample.point + 0.5 * hit.distance * normal;
  place.kept = !model.inside(place.middle);
  place.near_room = finder.at_surface(sample.point, sample.triangle, normal);
  place.far_room =
      finder.at_surface(sample.point + hit.distance * normal, hit.triangle, tree.unit_normal(hit.triangle));
  place.parts_rooms = place.near_room >= 0 && place.far_room >= 0 && place.near_room != place.far_room;
  if (place.parts_rooms && scanned != nullptr &&
      (finder.scanned(place.near_room) || finder.scanned(place.far_room))) {
    place.parts_rooms = scanned->surrounds(sample.point, normal) ||
                        scanned->surrounds(sample.point + hit.distance * normal, normal);
  }
  return place;
}

}  // namespace

ThinWallScores score_thin_walls(const SurfaceDistances& truth_samples, const MeshTree& truth_tree,
                                const RoomFinder& finder, const Columns& model, double thickest_m,
                                const std::function<bool(const Vec3&)>& in_opening,
                                const ScannedSurface* scanned) {
  const auto& samples = truth_samples.samples;
  std::vector<ThinPlace> places(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
    if (samples[i].area_m2 > 0) {
      places[i] = inspect(samples[i], truth_tree, finder, model, thickest_m, scanned);
      places[i].opening = places[i].thin && !places[i].kept && in_opening(places[i].middle);
    }
  });
  ThinWallScores out;
  std::map<std::pair<std::int32_t, std::int32_t>, ThinWallScores::Pair> pairs;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ThinPlace& place = places[i];
    if (!place.thin) {
      continue;
    }
    const double area = samples[i].area_m2;
    const bool wall = truth_samples.slope[i] == SlopeClass::kWall;
    (wall ? out.wall_m2 : out.slab_m2) += area;
    (wall ? out.wall_kept_m2 : out.slab_kept_m2) += place.kept ? area : 0;
    if (place.parts_rooms) {
      const std::int32_t a = std::min(place.near_room, place.far_room);
      const std::int32_t b = std::max(place.near_room, place.far_room);
      auto& pair = pairs.try_emplace({a, b}, ThinWallScores::Pair{a, b}).first->second;
      pair.area_m2 += area;
      const bool missing = !place.kept && !place.opening;
      pair.missing_m2 += missing ? area : 0;
      if (missing) {
        out.lost.push_back({a, b, place.middle, truth_tree.unit_normal(samples[i].triangle), area, wall});
      }
    }
  }
  constexpr double kLeastArea = 0.5;
  for (const auto& [key, pair] : pairs) {
    if (pair.area_m2 >= kLeastArea) {
      out.pairs.push_back(pair);
    }
  }
  return out;
}

std::vector<std::vector<std::int32_t>> merged_rooms(const ThinWallScores& thin,
                                                    const std::vector<std::uint8_t>& found) {
  std::vector<std::int32_t> group(found.size());
  std::iota(group.begin(), group.end(), 0);
  for (const ThinWallScores::Pair& pair : thin.pairs) {
    const bool both =
        found[static_cast<std::size_t>(pair.a)] != 0 && found[static_cast<std::size_t>(pair.b)] != 0;
    if (both && ThinWallScores::is_lost(pair)) {
      const std::int32_t a = group[static_cast<std::size_t>(pair.a)];
      const std::int32_t b = group[static_cast<std::size_t>(pair.b)];
      std::replace(group.begin(), group.end(), std::max(a, b), std::min(a, b));
    }
  }
  std::map<std::int32_t, std::vector<std::int32_t>> members;
  for (std::size_t room = 0; room < group.size(); ++room) {
    members[group[room]].push_back(static_cast<std::int32_t>(room));
  }
  std::vector<std::vector<std::int32_t>> out;
  for (auto& [first, rooms] : members) {
    if (rooms.size() > 1) {
      out.push_back(std::move(rooms));
    }
  }
  return out;
}

}  // namespace roomcut::evaluate
