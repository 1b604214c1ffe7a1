// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "common/errors/codes.h"
#include "common/geometry/convex_hull.h"
#include "common/geometry/scan_coordinates.h"
#include "common/sloped_planes/planes_features.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

constexpr double kSame = 2e-6;  ///< twice the file's resolution, in metres or degrees

const PlaneFeature* find_plane(const std::vector<PlaneFeature>& planes, const std::string& id) {
  const auto found =
      std::find_if(planes.begin(), planes.end(), [&](const PlaneFeature& plane) { return plane.id == id; });
  return found == planes.end() || id.empty() ? nullptr : &*found;
}

bool same_outline(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Vec2& p, const Vec2& q) { return (p - q).norm() <= kSame; });
}

bool same_numbers(const PlaneNumbers& a, const PlaneNumbers& b) {
  return std::abs(a.pitch_deg - b.pitch_deg) <= kSame && std::abs(a.height_m - b.height_m) <= kSame &&
         std::abs(std::remainder(a.uphill_deg - b.uphill_deg, 360)) <= kSame;
}

/// Of several features with one id the one whose outline was not moved keeps it (copy and paste in QGIS
/// copies the id), else the first.
void drop_copied_ids(std::vector<DrawnPlane>& drawn, const AcceptedPlanes& base, EditReport& report) {
  std::map<std::string, std::size_t> keeper;
  for (const bool unmoved : {true, false}) {
    for (const DrawnPlane& d : drawn) {
      const PlaneFeature* original = find_plane(base.planes, d.id);
      if (!unmoved || (original != nullptr && same_outline(original->plane.outline, d.outline))) {
        keeper.try_emplace(d.id, d.feature);
      }
    }
  }
  for (DrawnPlane& d : drawn) {
    if (!d.id.empty() && keeper.at(d.id) != d.feature) {
      report.warn(place_of(d), "this plane_id stands more than once; the copy gets a new one");
      d.id.clear();
    }
  }
}

/// What the file says of the plane, else the base; nothing, with a problem, when neither does.
std::optional<PlaneNumbers> numbers_for(const DrawnPlane& drawn, const PlaneNumbers* known,
                                        EditReport& report) {
  const std::size_t problems = report.problems.size();
  const auto take = [&](const std::optional<double>& said, double PlaneNumbers::*member, const char* name) {
    if (said) return *said;
    if (known != nullptr) return known->*member;
    report.problem(errors::kLinesProperty, place_of(drawn), std::string("property ") + name + " is missing",
                   "give it a number: a plane needs pitch_deg, uphill_deg and height_m");
    return 0.0;
  };
  const PlaneNumbers numbers{take(drawn.pitch_deg, &PlaneNumbers::pitch_deg, "pitch_deg"),
                             take(drawn.uphill_deg, &PlaneNumbers::uphill_deg, "uphill_deg"),
                             take(drawn.height_m, &PlaneNumbers::height_m, "height_m")};
  return report.problems.size() == problems ? std::optional(numbers) : std::nullopt;
}

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/// Heights far from the building's are another unit, or local ones.
void check_heights(const DrawnPlane& drawn, const SlopedPlane& plane, const AcceptedPlanes& base,
                   EditReport& report) {
  const double low = base.levels.front().z;
  const double high = base.levels.back().z;
  const double margin = std::max(5.0, high - low);
  const auto [from, to] = plane.range();
  if (from >= low - margin && to <= high + margin) return;
  const ScanCoordinates scan(base.frame);
  report.problem(errors::kLinesOutside, place_of(drawn),
                 "reaches from " + metres(scan.caption_height(from)) + " to " +
                     metres(scan.caption_height(to)) + " m, the building from " +
                     metres(scan.caption_height(low)) + " to " + metres(scan.caption_height(high)) + " m",
                 "correct height_m (metres of the scan, at the outline's middle), pitch_deg or the outline");
}

PlaneFeature plane_for(const DrawnPlane& drawn, const AcceptedPlanes& base, EditReport& report) {
  PlaneFeature result{drawn.id, {}, LineSource::kAdded, drawn.locked, drawn.note, drawn.extra_json};
  const PlaneFeature* original = find_plane(base.planes, drawn.id);
  PlaneNumbers known;
  if (original != nullptr) known = numbers_of(original->plane, base.frame);
  const std::optional<PlaneNumbers> numbers =
      numbers_for(drawn, original != nullptr ? &known : nullptr, report);
  if (!numbers) return result;
  result.plane = plane_of(drawn.outline, *numbers, base.frame);
  check_heights(drawn, result.plane, base, report);
  result.plane.ceiling = drawn.ceiling.value_or(original == nullptr || original->plane.ceiling);
  if (original == nullptr) return result;
  result.source = LineSource::kEdited;
  if (!same_numbers(*numbers, known)) return result;
  if (same_outline(drawn.outline, original->plane.outline) &&
      result.plane.ceiling == original->plane.ceiling) {
    result.source = original->source;
    result.plane = original->plane;
  } else {  // an outline that was redrawn leaves the plane where it is
    result.plane.gradient = original->plane.gradient;
    result.plane.c = original->plane.c;
  }
  return result;
}

/// "e0001" … in the order of their places, so that the order of the features doesn't matter.
void name_nameless(std::vector<PlaneFeature>& planes) {
  std::set<std::string> taken;
  std::vector<PlaneFeature*> nameless;
  for (PlaneFeature& feature : planes) {
    if (feature.id.empty()) {
      nameless.push_back(&feature);
    } else {
      taken.insert(feature.id);
    }
  }
  const auto key = [](const PlaneFeature* feature) {
    const SlopedPlane& plane = feature->plane;
    const Vec2 middle = middle_of(plane.outline);
    return std::make_tuple(middle.x(), middle.y(), plane.height(middle), plane.gradient.x(),
                           plane.gradient.y(), plane.ceiling);
  };
  std::stable_sort(nameless.begin(), nameless.end(),
                   [&](const PlaneFeature* p, const PlaneFeature* q) { return key(p) < key(q); });
  int number = 0;
  for (PlaneFeature* feature : nameless) {
    do {
      std::array<char, 16> text{};
      std::snprintf(text.data(), text.size(), "e%04d", ++number);
      feature->id = text.data();
    } while (!taken.insert(feature->id).second);
  }
}

bool equal(const SlopedPlane& a, const SlopedPlane& b) {
  return same_outline(a.outline, b.outline) && (a.gradient - b.gradient).norm() <= kSame &&
         std::abs(a.c - b.c) <= kSame * (1 + a.outline[0].norm()) && a.ceiling == b.ceiling;
}

/// Of equal planes the one with a known id stays.
void drop_doubles(std::vector<PlaneFeature>& planes, EditReport& report) {
  std::stable_sort(planes.begin(), planes.end(), [](const PlaneFeature& a, const PlaneFeature& b) {
    return std::make_pair(a.source == LineSource::kAdded, a.id) <
           std::make_pair(b.source == LineSource::kAdded, b.id);
  });
  std::vector<PlaneFeature> kept;
  for (PlaneFeature& feature : planes) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const PlaneFeature& other) {
      return equal(other.plane, feature.plane);
    });
    if (twin == kept.end()) {
      kept.push_back(std::move(feature));
    } else {
      report.warn("plane_id " + feature.id, "lies exactly on " + twin->id + " and is dropped");
    }
  }
  planes = std::move(kept);
}

}  // namespace

std::vector<PlaneFeature> identify_planes(std::vector<DrawnPlane> drawn, const AcceptedPlanes& base,
                                          EditReport& report) {
  drop_copied_ids(drawn, base, report);
  std::vector<PlaneFeature> planes;
  planes.reserve(drawn.size());
  for (const DrawnPlane& d : drawn) {
    planes.push_back(plane_for(d, base, report));
  }
  if (!report.problems.empty()) return {};
  name_nameless(planes);
  drop_doubles(planes, report);
  return planes;
}

}  // namespace roomcut
