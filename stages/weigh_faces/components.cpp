// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/components.h"

#include <cstddef>

namespace roomcut {
namespace {

/// Calls visit(neighbour) for the up to four neighbours of a bin.
template <class Visit>
void for_neighbours(std::size_t bin, std::size_t nx, std::size_t ny, const Visit& visit) {
  const std::size_t x = bin % nx;
  const std::size_t y = bin / nx;
  if (x > 0) visit(bin - 1);
  if (x + 1 < nx) visit(bin + 1);
  if (y > 0) visit(bin - nx);
  if (y + 1 < ny) visit(bin + nx);
}

}  // namespace

Components find_components(const std::vector<std::uint8_t>& occupied, int nx, int ny) {
  const auto w = static_cast<std::size_t>(nx);
  const auto h = static_cast<std::size_t>(ny);
  Components result;
  result.grown.assign(occupied.size(), -1);
  std::vector<std::size_t> open;
  for (std::size_t seed = 0; seed < occupied.size(); ++seed) {
    if (occupied[seed] == 0 || result.grown[seed] >= 0) {
      continue;
    }
    const std::int32_t number = result.count++;
    result.grown[seed] = number;
    open.push_back(seed);
    while (!open.empty()) {
      const std::size_t bin = open.back();
      open.pop_back();
      for_neighbours(bin, w, h, [&](std::size_t next) {
        if (occupied[next] != 0 && result.grown[next] < 0) {
          result.grown[next] = number;
          open.push_back(next);
        }
      });
    }
  }
  const std::vector<std::int32_t> inner = result.grown;
  for (std::size_t bin = 0; bin < occupied.size(); ++bin) {
    if (occupied[bin] == 0) {
      for_neighbours(bin, w, h, [&](std::size_t next) {
        if (inner[next] >= 0 && (result.grown[bin] < 0 || inner[next] < result.grown[bin])) {
          result.grown[bin] = inner[next];
        }
      });
    }
  }
  return result;
}

}  // namespace roomcut
