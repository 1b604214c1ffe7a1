// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/invented.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace roomcut::evaluate {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Groups of marked cells that share faces: per cell the group's number, kNone for the others.
class Groups {
 public:
  Groups(const CellComplex& complex, const std::vector<InventedPart>& parts)
      : complex_(complex), group_(complex.cells(), kNone) {
    constexpr std::size_t kMarked = kNone - 1;
    for (const InventedPart& part : parts) {
      group_[part.cell] = kMarked;
    }
    for (const InventedPart& part : parts) {
      if (group_[part.cell] == kMarked) {
        fill(part.cell, kMarked);
        ++count_;
      }
    }
  }
  std::size_t of(std::size_t cell) const { return group_[cell]; }
  std::size_t count() const { return count_; }

 private:
  void fill(std::size_t first, std::size_t marked) {
    std::vector<std::size_t> open = {first};
    group_[first] = count_;
    const auto reach = [&](std::size_t cell) {
      if (group_[cell] == marked) {
        group_[cell] = count_;
        open.push_back(cell);
      }
    };
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      const std::size_t face = complex_.face_of(cell);
      const std::size_t layer = complex_.layer_of(cell);
      for (const std::int32_t side : complex_.edges_of(face)) {
        const std::int32_t next =
            complex_.edges[static_cast<std::size_t>(side)].across(static_cast<std::int32_t>(face));
        if (next >= 0) {
          reach(complex_.cell(static_cast<std::size_t>(next), layer));
        }
      }
      if (layer > 0) {
        reach(cell - complex_.faces());
      }
      if (layer + 1 < complex_.layers()) {
        reach(cell + complex_.faces());
      }
    }
  }

  const CellComplex& complex_;
  std::vector<std::size_t> group_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<Explanation::InventedSpace> find_invented(const ExplainInput& input,
                                                      const std::vector<InventedPart>& parts,
                                                      double area_m2) {
  const double thin = 0.5 * input.thin_wall_m;
  std::vector<std::uint8_t> deep(parts.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    deep[i] = input.truth_surface.all().nearest(parts[i].middle, thin).triangle < 0 ? 1 : 0;
  });
  const Groups groups(input.complex, parts);
  std::vector<Explanation::InventedSpace> spaces(groups.count());
  std::vector<std::uint8_t> is_space(groups.count(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t group = groups.of(parts[i].cell);
    spaces[group].volume_m3 += area_m2 * parts[i].length;
    spaces[group].centre += area_m2 * parts[i].length * parts[i].middle;
    is_space[group] |= deep[i];
  }
  std::vector<Explanation::InventedSpace> out;
  for (std::size_t group = 0; group < spaces.size(); ++group) {
    if (is_space[group] != 0) {
      spaces[group].centre /= spaces[group].volume_m3;
      out.push_back(spaces[group]);
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.volume_m3 > b.volume_m3; });
  return out;
}

}  // namespace roomcut::evaluate
