// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/new_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "stages/refine_lines/bends.h"
#include "stages/refine_lines/hinges.h"
#include "stages/refine_lines/split_lines.h"

namespace roomcut::refine_lines {
namespace {

std::vector<double> layer_heights(const CellComplex& complex) {
  std::vector<double> heights;
  heights.reserve(complex.layers());
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    heights.push_back(complex.height(layer));
  }
  return heights;
}

std::set<std::string> ids_of(const std::vector<LineItem>& items) {
  std::set<std::string> ids;
  for (const LineItem& item : items) {
    ids.insert(item.wall.id);
  }
  return ids;
}

/// The first of "id.1", "id.2" … that is not among `ids`, where it is put.
std::string next_id(const std::string& id, std::set<std::string>& ids) {
  std::string next = id;
  for (int number = 1; !ids.insert(next).second; ++number) {
    next = id + "." + std::to_string(number);
  }
  return next;
}

/// Splits items[i] where its wall bends; the larger part keeps the name, the other one goes to the end.
bool split_at_hinge(const std::vector<double>& heights, std::set<std::string>& ids, std::size_t i,
                    std::vector<LineItem>& items) {
  const LineItem whole = items[i];
  const LineFaces& faces = whole.faces.front();
  const std::optional<Hinge> hinge = find_hinge({whole.wall.line(), &faces, &whole.observations});
  if (!hinge) {
    return false;
  }
  const auto part_of = [&](std::size_t first, std::size_t end, const Line2& line) {
    LineItem part = whole;
    part.faces = {slice_bins(faces, first, end, heights)};
    part.area_m2 = part.faces.front().area_m2;
    std::erase_if(part.observations, [&](const Observation& o) { return o.bin < first || o.bin >= end; });
    for (Observation& o : part.observations) {
      o.bin -= first;
    }
    part.wall.a = line.at(line.along(faces.line.at(part.faces.front().t0)));
    part.wall.b = line.at(line.along(faces.line.at(part.faces.front().t1)));
    return part;
  };
  items[i] = part_of(0, hinge->bin, hinge->before);
  items.push_back(part_of(hinge->bin, faces.bins, hinge->behind));
  if (items.back().area_m2 > items[i].area_m2) {
    std::swap(items[i], items.back());
  }
  items.back().wall.id = next_id(whole.wall.id, ids);
  return true;
}

}  // namespace

int split_items(const CellComplex& complex, double apart_m,
                const std::function<LinePrior(const LineItem&)>& prior_of,
                std::vector<OneSidedWall>& one_sided, std::vector<LineItem>& items) {
  const std::vector<double> heights = layer_heights(complex);
  std::set<std::string> ids = ids_of(items);
  const std::size_t whole = items.size();
  std::vector<std::vector<LinePart>> parts_of(whole);
  tbb::parallel_for(std::size_t{0}, whole, [&](std::size_t i) {
    const LineItem& item = items[i];
    if (!item.users && !item.faces.empty()) {
      parts_of[i] = split_line(item.faces.front(), item.observations, heights, prior_of(item), apart_m);
    }
  });
  for (std::size_t i = 0; i < whole; ++i) {
    std::vector<LinePart>& parts = parts_of[i];
    if (parts.size() < 2) {
      continue;
    }
    const std::string id = items[i].wall.id;
    std::vector<std::vector<OneSidedWall*>> one_sided_of(parts.size());
    for (OneSidedWall& wall : one_sided) {
      if (wall.wall_id == id) {
        const auto nearest = std::min_element(
            parts.begin(), parts.end(),
            [&](const LinePart& a, const LinePart& b) { return steps_to(a, wall) < steps_to(b, wall); });
        one_sided_of[static_cast<std::size_t>(nearest - parts.begin())].push_back(&wall);
      }
    }
    for (std::size_t k = parts.size(); k-- > 0;) {
      LineItem part = items[i];
      part.area_m2 = parts[k].faces.area_m2;
      part.wall.levels = levels_of(parts[k], items[i].wall.levels);
      part.faces = {std::move(parts[k].faces)};
      part.observations = std::move(parts[k].observations);
      if (k > 0) {
        part.wall.id = next_id(id, ids);
      }
      part.keeps_ends = !one_sided_of[k].empty();
      for (OneSidedWall* wall : one_sided_of[k]) {
        wall->wall_id = part.wall.id;
      }
      if (k == 0) {
        items[i] = std::move(part);
        break;
      }
      items.push_back(std::move(part));
    }
  }
  return static_cast<int>(items.size() - whole);
}

int split_at_hinges(const CellComplex& complex, std::vector<LineItem>& items) {
  const std::vector<double> heights = layer_heights(complex);
  std::set<std::string> ids = ids_of(items);
  const std::size_t whole = items.size();
  for (std::size_t i = 0; i < items.size();) {
    const bool split = !items[i].users && !items[i].keeps_ends && !items[i].faces.empty() &&
                       split_at_hinge(heights, ids, i, items);
    i += split ? 0 : 1;  // a part may bend again
  }
  return static_cast<int>(items.size() - whole);
}

int add_bends(const CellComplex& complex, std::vector<LineItem>& items) {
  std::vector<FittedLine> lines;
  std::vector<std::size_t> of_line;
  std::set<std::string> ids = ids_of(items);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const LineItem& item = items[i];
    if (!item.faces.empty() && item.faces.front().bins > 0) {
      lines.push_back({posed(item.problem.line, item.problem.centre, item.fit.pose), &item.faces.front(),
                       &item.observations});
      of_line.push_back(i);
    }
  }
  std::vector<LineItem> added;
  for (Bend& bend : find_bends(lines, layer_heights(complex))) {
    LineItem item = items[of_line[bend.parent]];
    item.wall.id = next_id(item.wall.id, ids);
    item.wall.a = bend.faces.line.at(bend.faces.t0);
    item.wall.b = bend.faces.line.at(bend.faces.t1);
    item.users = item.keeps_ends = false;
    item.wall.locked = false;
    item.wall.source = LineSource::kRefined;
    item.area_m2 = bend.faces.area_m2;
    item.faces = {std::move(bend.faces)};
    item.observations = std::move(bend.observations);
    item.stale = true;
    added.push_back(std::move(item));
  }
  items.insert(items.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
  return static_cast<int>(added.size());
}

}  // namespace roomcut::refine_lines
