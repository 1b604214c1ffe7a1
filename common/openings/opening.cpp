// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/openings/opening.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roomcut {

namespace {

double rounded(double value) {
  const double result = std::round(value * 1e6) / 1e6;
  return result == 0 ? 0 : result;
}

}  // namespace

Openings normalised_openings(Openings openings) {
  for (Opening& o : openings.openings) {
    for (Vec2* p : {&o.jamb_a, &o.jamb_b}) {
      *p = {rounded(p->x()), rounded(p->y())};
    }
    for (double* value :
         {&o.thickness_m, &o.sill_z, &o.head_z, &o.proof_a.spread, &o.proof_a.sigma_m, &o.proof_b.spread,
          &o.proof_b.sigma_m, &o.proof_head.spread, &o.proof_head.sigma_m}) {
      *value = rounded(*value);
    }
    if (std::pair(o.jamb_b.x(), o.jamb_b.y()) < std::pair(o.jamb_a.x(), o.jamb_a.y())) {
      std::swap(o.jamb_a, o.jamb_b);
      std::swap(o.proof_a, o.proof_b);
    }
  }
  std::sort(openings.openings.begin(), openings.openings.end(),
            [](const Opening& a, const Opening& b) { return a.id < b.id; });
  return openings;
}

}  // namespace roomcut
