// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/manifold_check.h"

#include <utility>

namespace roomcut {

namespace {

/// The cells around one place, as the parts of a sphere: `size` below and as many above. Counts connected
/// parts.
class Link {
 public:
  void start(std::size_t size) {
    size_ = size;
    label_.assign(2 * size, Label::kSolid);
  }
  void set(bool above, std::size_t i, std::uint8_t label) { label_[(above ? size_ : 0) + i] = label; }

  bool both_connected() {
    parts_[0] = parts_[1] = 0;
    parent_.resize(label_.size());
    for (std::size_t i = 0; i < label_.size(); ++i) {
      parent_[i] = i;
      ++parts_[label_[i]];
    }
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t after = i + 1 == size_ ? 0 : i + 1;
      join(i, after);
      join(size_ + i, size_ + after);
      join(i, size_ + i);
    }
    return parts_[0] <= 1 && parts_[1] <= 1;
  }

 private:
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      i = parent_[i] = parent_[parent_[i]];
    }
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    if (label_[i] != label_[j]) {
      return;
    }
    const std::size_t a = root(i);
    const std::size_t b = root(j);
    if (a != b) {
      parent_[a] = b;
      --parts_[label_[i]];
    }
  }

  std::size_t size_ = 0;
  std::vector<std::uint8_t> label_;
  std::vector<std::size_t> parent_;
  std::size_t parts_[2] = {0, 0};
};

/// Fills the link; false when all cells around the place have one label.
bool gather(const CellComplex& complex, const VertexRings& rings, const Place& place,
            const std::vector<std::uint8_t>& label, Link& link) {
  const auto faces = rings.faces_around(static_cast<std::size_t>(place.vertex));
  link.start(faces.size());
  std::size_t empty = 0;
  for (const bool above : {false, true}) {
    const std::int32_t layer = above ? place.level : place.level - 1;
    if (layer < 0 || layer >= static_cast<std::int32_t>(complex.layers())) {
      continue;  // beyond the lowest or highest level: solid
    }
    const std::uint8_t* row = label.data() + complex.cell(0, static_cast<std::size_t>(layer));
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i] != VertexRings::kOutsideFace && row[faces[i]] == Label::kEmpty) {
        link.set(above, i, Label::kEmpty);
        ++empty;
      }
    }
  }
  return empty != 0 && empty != 2 * faces.size();
}

}  // namespace

ManifoldCheck::ManifoldCheck(const CellComplex& complex) : complex_(complex), rings_(vertex_rings(complex)) {}

bool ManifoldCheck::is_manifold(const Place& place, const std::vector<std::uint8_t>& label) const {
  thread_local Link link;  // scratch memory only
  return !gather(complex_, rings_, place, label, link) || link.both_connected();
}

std::vector<Place> ManifoldCheck::find_all(const std::vector<std::uint8_t>& label) const {
  std::vector<Place> bad;
  for (std::int32_t level = 0; std::cmp_less(level, complex_.levels.size()); ++level) {
    for (std::int32_t vertex = 0; std::cmp_less(vertex, complex_.vertices.size()); ++vertex) {
      if (!is_manifold({level, vertex}, label)) {
        bad.push_back({level, vertex});
      }
    }
  }
  return bad;
}

}  // namespace roomcut
