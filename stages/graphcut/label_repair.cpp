// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/label_repair.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace roomcut::graphcut {

namespace {

/// A labelling under repair: the labels and the places where it is not manifold.
class Patient {
 public:
  Patient(const ManifoldCheck& check, const EnergyTerms& terms, std::vector<std::uint8_t> label)
      : check_(check), terms_(terms), complex_(check.complex()), label_(std::move(label)) {
    bad_.assign(complex_.levels.size() * complex_.vertices.size(), 0);
    for (const Place& place : check_.find_all(label_)) {
      mark(place) = 1;
      ++bad_places_;
    }
  }

  const std::vector<std::uint8_t>& label() const { return label_; }
  std::int64_t bad_places() const { return bad_places_; }
  double added_m3() const { return added_m3_; }

  /// Phase 1 (no direction) or 2 (only cells that have label `from`).
  void repair(std::optional<std::uint8_t> from);

 private:
  /// Flips that leave fewer bad places come first, then the cheaper ones.
  using Key = std::tuple<bool, double, std::size_t>;  // leaves no fewer bad places, cost, cell
  using Queue = std::priority_queue<Key, std::vector<Key>, std::greater<>>;

  std::uint8_t& mark(const Place& place) {
    return bad_[static_cast<std::size_t>(place.level) * complex_.vertices.size() +
                static_cast<std::size_t>(place.vertex)];
  }
  template <class F>
  void for_each_place_of(std::size_t cell, F&& f) const;
  template <class F>
  void for_each_cell_around(const Place& place, F&& f) const;
  bool touches_bad_place(std::size_t cell);
  int change_of_bad_places(std::size_t cell);
  void offer(std::size_t cell, std::optional<std::uint8_t> from, Queue& queue);
  void flip(std::size_t cell);

  const ManifoldCheck& check_;
  const EnergyTerms& terms_;
  const CellComplex& complex_;
  std::vector<std::uint8_t> label_;
  std::vector<std::uint8_t> bad_;  ///< per place
  std::int64_t bad_places_ = 0;
  double added_m3_ = 0;
};

template <class F>
void Patient::for_each_place_of(std::size_t cell, F&& f) const {
  const auto layer = static_cast<std::int32_t>(complex_.layer_of(cell));
  for (const std::int32_t vertex : complex_.vertices_of(complex_.face_of(cell))) {
    f(Place{layer, vertex});
    f(Place{layer + 1, vertex});
  }
}

template <class F>
void Patient::for_each_cell_around(const Place& place, F&& f) const {
  for (const std::int32_t layer : {place.level - 1, place.level}) {
    if (layer < 0 || std::cmp_greater_equal(layer, complex_.layers())) {
      continue;
    }
    for (const std::int32_t face : check_.rings().faces_around(static_cast<std::size_t>(place.vertex))) {
      if (face != VertexRings::kOutsideFace) {
        f(complex_.cell(static_cast<std::size_t>(face), static_cast<std::size_t>(layer)));
      }
    }
  }
}

bool Patient::touches_bad_place(std::size_t cell) {
  bool touches = false;
  for_each_place_of(cell, [&](const Place& place) { touches = touches || mark(place) != 0; });
  return touches;
}

/// By how much the number of bad places would grow if the cell were flipped.
int Patient::change_of_bad_places(std::size_t cell) {
  int change = 0;
  label_[cell] ^= 1;
  for_each_place_of(
      cell, [&](const Place& place) { change += (check_.is_manifold(place, label_) ? 0 : 1) - mark(place); });
  label_[cell] ^= 1;
  return change;
}

void Patient::offer(std::size_t cell, std::optional<std::uint8_t> from, Queue& queue) {
  if ((from && label_[cell] != *from) || !touches_bad_place(cell)) {
    return;
  }
  const bool no_fewer = change_of_bad_places(cell) >= 0;
  if (from || !no_fewer) {
    queue.emplace(no_fewer, flip_cost(complex_, terms_, label_, cell), cell);
  }
}

void Patient::flip(std::size_t cell) {
  added_m3_ += flip_cost(complex_, terms_, label_, cell);
  label_[cell] ^= 1;
  for_each_place_of(cell, [&](const Place& place) {
    std::uint8_t& bad = mark(place);
    const std::uint8_t now = check_.is_manifold(place, label_) ? 0 : 1;
    bad_places_ += now - bad;
    bad = now;
  });
}

void Patient::repair(std::optional<std::uint8_t> from) {
  Queue queue;
  for (std::int32_t level = 0; std::cmp_less(level, complex_.levels.size()); ++level) {
    for (std::int32_t vertex = 0; std::cmp_less(vertex, complex_.vertices.size()); ++vertex) {
      if (mark({level, vertex}) != 0) {
        for_each_cell_around({level, vertex}, [&](std::size_t cell) { offer(cell, from, queue); });
      }
    }
  }
  while (!queue.empty()) {
    const Key key = queue.top();
    queue.pop();
    const std::size_t cell = std::get<2>(key);
    if ((from && label_[cell] != *from) || !touches_bad_place(cell)) {
      continue;
    }
    // Flips nearby may have changed what this one does; whenever they did, it was offered again.
    const Key now{change_of_bad_places(cell) >= 0, flip_cost(complex_, terms_, label_, cell), cell};
    if (now != key) {
      continue;
    }
    flip(cell);
    for_each_place_of(cell, [&](const Place& place) {
      for_each_cell_around(place, [&](std::size_t near) { offer(near, from, queue); });
    });
  }
}

}  // namespace

Repair repair_labels(const ManifoldCheck& check, const EnergyTerms& terms,
                     const std::vector<std::uint8_t>& label) {
  const auto as_repair = [&](const Patient& patient) {
    Repair repair{patient.label(), 0, patient.added_m3()};
    for (std::size_t c = 0; c < label.size(); ++c) {
      repair.flips += repair.label[c] != label[c] ? 1 : 0;
    }
    return repair;
  };
  Patient patient(check, terms, label);
  patient.repair(std::nullopt);
  if (patient.bad_places() == 0) {
    return as_repair(patient);
  }
  Patient filled = patient;
  filled.repair(Label::kEmpty);
  Patient opened = std::move(patient);
  opened.repair(Label::kSolid);
  return as_repair(opened.added_m3() < filled.added_m3() ? opened : filled);
}

}  // namespace roomcut::graphcut
