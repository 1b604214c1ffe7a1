// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/openings/opening.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry/scan_coordinates.h"

namespace roomcut {

namespace {

double rounded(double value) {
  const double result = std::round(value * 1e6) / 1e6;
  return result == 0 ? 0 : result;
}

Vec2 rounded(const Vec2& p) {
  return {rounded(p.x()), rounded(p.y())};
}

}  // namespace

OpeningPlace place_in_scan(const Opening& opening, const Frame& frame) {
  const ScanCoordinates scan(frame);
  const Vec2 middle = 0.5 * (opening.jamb_a + opening.jamb_b);
  return {rounded(scan.plan_to_scan(opening.jamb_a)), rounded(scan.plan_to_scan(opening.jamb_b)),
          rounded(scan.height_to_scan(middle, opening.sill_z)),
          rounded(scan.height_to_scan(middle, opening.head_z))};
}

void set_place(Opening& opening, const OpeningPlace& place, const Frame& frame) {
  const ScanCoordinates scan(frame);
  opening.jamb_a = without_rounding(scan.plan_to_local(place.jamb_a));
  opening.jamb_b = without_rounding(scan.plan_to_local(place.jamb_b));
  const Vec2 middle = 0.5 * (opening.jamb_a + opening.jamb_b);
  opening.sill_z = without_rounding(scan.height_to_local(middle, place.sill_z));
  opening.head_z = without_rounding(scan.height_to_local(middle, place.head_z));
}

Openings normalised_openings(Openings openings) {
  for (Opening& o : openings.openings) {
    for (double* value : {&o.thickness_m, &o.proof_a.spread, &o.proof_a.sigma_m, &o.proof_b.spread,
                          &o.proof_b.sigma_m, &o.proof_head.spread, &o.proof_head.sigma_m}) {
      *value = rounded(*value);
    }
    OpeningPlace place = place_in_scan(o, openings.frame);
    if (std::pair(place.jamb_b.x(), place.jamb_b.y()) < std::pair(place.jamb_a.x(), place.jamb_a.y())) {
      std::swap(place.jamb_a, place.jamb_b);
      std::swap(o.proof_a, o.proof_b);
    }
    set_place(o, place, openings.frame);
  }
  std::sort(openings.openings.begin(), openings.openings.end(),
            [](const Opening& a, const Opening& b) { return a.id < b.id; });
  return openings;
}

}  // namespace roomcut
