// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/plan_triangulation.h"

#include <vector>

namespace roomcut::synthesize {

Cdt::Face_handle flood(const Cdt& cdt, Cdt::Face_handle seed, std::int32_t region) {
  std::vector<Cdt::Face_handle> todo{seed};
  Cdt::Face_handle largest = seed;
  double largest_area = 0;
  seed->info() = region;
  while (!todo.empty()) {
    const auto face = todo.back();
    todo.pop_back();
    const double area = cdt.is_infinite(face) ? 0 : cdt.triangle(face).area();
    if (area > largest_area) {
      largest_area = area;
      largest = face;
    }
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() != kUnset || cdt.is_constrained({face, i})) continue;
      next->info() = region;
      todo.push_back(next);
    }
  }
  return largest;
}

}  // namespace roomcut::synthesize
