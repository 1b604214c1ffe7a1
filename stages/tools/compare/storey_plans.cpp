// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/storey_plans.h"

#include "stages/tools/compare/comparison_rows.h"
#include "stages/tools/compare/storey_layer.h"

namespace roomcut::compare {

namespace {

constexpr Colour kEmpty{196, 222, 240}, kUnobserved{228, 180, 206}, kUnknown{240, 228, 66},
    kWords{58, 68, 75}, kBoth{230, 232, 233}, kOnlyA{230, 159, 0}, kOnlyB{0, 114, 178};
/// A line that moved less is not drawn as moved [m].
constexpr double kShownMove_m = 0.002;

struct Box {
  Vec2 low{1e30, 1e30}, high{-1e30, -1e30};
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

void add_rooms(const StoreyLayer& layer, Box& box) {
  for (std::size_t f = 0; f < layer.faces(); ++f) {
    for (const Vec2& corner :
         layer.empty(static_cast<std::int32_t>(f)) ? layer.corners(f) : std::vector<Vec2>{}) {
      box.add(corner);
    }
  }
}

Svg empty_drawing(const Box& box) {
  constexpr double kMargin_m = 0.6, kWidth_px = 560;
  const Vec2 low = box.low.array() - kMargin_m, high = box.high.array() + kMargin_m;
  return {low, high, kWidth_px / (high - low).x()};
}

std::string draw_side(const Box& box, const StoreyLayer& layer, const SpaceFacts& storey) {
  Svg svg = empty_drawing(box);
  for (std::size_t f = 0; f < layer.faces(); ++f) {
    if (layer.empty(static_cast<std::int32_t>(f))) {
      svg.polygon(layer.corners(f), layer.unobserved(f) ? kUnobserved : kEmpty, 1);
    } else if (layer.unknown(f)) {
      svg.polygon(layer.corners(f), kUnknown, 1);
    }
  }
  draw_walls(svg, layer, 1.5);
  draw_openings(svg, layer);
  for (const SpaceFacts& room : layer.run.rooms) {
    if (room.storey == storey.storey) {
      const Vec2 at = layer.drawing.to_local(Vec3(room.centre.x(), room.centre.y(), room.floor_z)).head<2>();
      svg.text(at, std::to_string(room.number) + ": " + fixed_number(room.area_m2, 1) + " m²", 10, kWords);
    }
  }
  return svg.str();
}

void draw_line_changes(Svg& svg, const RunFacts& a, const std::vector<WallLine>& b_lines,
                       const LineMatches& matches) {
  for (const std::size_t i : matches.only_a) {
    svg.line(a.lines[i].a, a.lines[i].b, kOnlyA, 2, a.lines[i].id + ": only in A");
  }
  for (const std::size_t i : matches.only_b) {
    svg.line(b_lines[i].a, b_lines[i].b, kOnlyB, 2, b_lines[i].id + ": only in B");
  }
  for (const LinePair& pair : matches.pairs) {
    if (pair.move.offset_m >= kShownMove_m) {
      const std::string title = a.lines[pair.a].id + " of A, " + b_lines[pair.b].id +
                                " of B: " + fixed_number(1e3 * pair.move.offset_m, 1) + " mm apart";
      svg.line(a.lines[pair.a].a, a.lines[pair.a].b, kOnlyA, 1.2, title);
      svg.line(b_lines[pair.b].a, b_lines[pair.b].b, kOnlyB, 1.2, title);
    }
  }
}

}  // namespace

std::vector<StoreyPlans> draw_storeys(const RunFacts& a, const RunFacts& b, const Comparison& comparison) {
  std::vector<std::pair<const SpaceFacts*, const SpaceFacts*>> storeys;
  for (const auto& [i, k] : comparison.storeys.both) {
    storeys.emplace_back(&a.storeys[i], &b.storeys[k]);
  }
  for (const std::size_t i : comparison.storeys.only_a) {
    storeys.emplace_back(&a.storeys[i], nullptr);
  }
  for (const std::size_t k : comparison.storeys.only_b) {
    storeys.emplace_back(nullptr, &b.storeys[k]);
  }
  const auto b_lines = lines_in(b, a.frame);
  std::vector<StoreyPlans> plans;
  for (const auto& [in_a, in_b] : storeys) {
    const auto layer_a = layer_of(a, in_a, a.frame), layer_b = layer_of(b, in_b, a.frame);
    Box box;
    for (const auto* layer : {&layer_a, &layer_b}) {
      if (*layer) {
        add_rooms(**layer, box);
      }
    }
    if (box.low.x() > box.high.x()) {
      continue;
    }
    const SpaceFacts& storey = in_a != nullptr ? *in_a : *in_b;
    StoreyPlans plan;
    plan.title =
        "Storey " + std::to_string(storey.storey) + ", floor at " + fixed_number(storey.floor_z, 2) + " m";
    plan.a = layer_a ? draw_side(box, *layer_a, *in_a) : "";
    plan.b = layer_b ? draw_side(box, *layer_b, *in_b) : "";
    Svg svg = empty_drawing(box);
    const std::string number = std::to_string(plans.size());
    if (layer_a) {
      draw_only(svg, *layer_a, std::nullopt, kBoth, "");
    }
    if (layer_b) {
      draw_only(svg, *layer_b, std::nullopt, kBoth, "");
    }
    if (layer_a) {
      draw_only(svg, *layer_a, layer_b, kOnlyA, "only-a-" + number);
    }
    if (layer_b) {
      draw_only(svg, *layer_b, layer_a, kOnlyB, "only-b-" + number);
      draw_walls(svg, *layer_b, 0.7);
    }
    draw_line_changes(svg, a, b_lines, comparison.lines);
    plan.difference = svg.str();
    plans.push_back(plan);
  }
  return plans;
}

}  // namespace roomcut::compare
