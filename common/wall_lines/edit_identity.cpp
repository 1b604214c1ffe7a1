// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

#include "common/wall_lines/compare_lines.h"
#include "common/wall_lines/edit_document.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

const WallLine* find_line(const std::vector<WallLine>& lines, const std::string& id) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const WallLine& line) { return line.id == id; });
  return found == lines.end() ? nullptr : &*found;
}

/// Of several features with one id the unmoved one keeps it (copy and paste in QGIS copies the id), else the
/// first.
void drop_copied_ids(std::vector<DrawnLine>& drawn, const WallLines& base, EditReport& report) {
  std::map<std::string, std::vector<std::size_t>> holders;  // id -> features, in the order of the file
  std::map<std::string, std::size_t> keeper;
  for (const DrawnLine& d : drawn) {
    auto& features = holders[d.line.id];
    if (features.empty() || features.back() != d.feature) {
      features.push_back(d.feature);
    }
    const WallLine* original = find_line(base.lines, d.line.id);
    if (original != nullptr && d.piece == 0 && same_geometry(*original, d.line)) {
      keeper.try_emplace(d.line.id, d.feature);
    }
  }
  for (DrawnLine& d : drawn) {
    const std::string id = d.line.id;
    if (id.empty() || holders[id].size() == 1) {
      continue;
    }
    const auto kept = keeper.find(id);
    if (d.feature != (kept == keeper.end() ? holders[id].front() : kept->second)) {
      d.line.id.clear();
      if (d.piece <= 1) {
        report.warn(feature_place(d.feature, id),
                    "this wall_id stands more than once; the copy gets a new one");
      }
    }
  }
}

/// "w0007.1", "w0007.2" … for the pieces of a polyline that has an id.
void name_pieces(std::vector<DrawnLine>& drawn) {
  for (DrawnLine& d : drawn) {
    if (d.piece > 0 && !d.line.id.empty()) {
      d.line.id += "." + std::to_string(d.piece);
    }
  }
}

bool before(const WallLine& p, const WallLine& q) {
  const std::array<double, 4> left{p.a.x(), p.a.y(), p.b.x(), p.b.y()};
  const std::array<double, 4> right{q.a.x(), q.a.y(), q.b.x(), q.b.y()};
  return left < right;
}

/// "e0001" … in the order of the coordinates, so that the order of the features doesn't matter.
void name_nameless(std::vector<WallLine>& lines) {
  std::set<std::string> taken;
  std::vector<WallLine*> nameless;
  for (WallLine& line : lines) {
    if (line.id.empty() || !taken.insert(line.id).second) {
      nameless.push_back(&line);
    }
  }
  std::stable_sort(nameless.begin(), nameless.end(),
                   [](const WallLine* p, const WallLine* q) { return before(*p, *q); });
  int number = 0;
  for (WallLine* line : nameless) {
    do {
      std::array<char, 16> text{};
      std::snprintf(text.data(), text.size(), "e%04d", ++number);
      line->id = text.data();
    } while (!taken.insert(line->id).second);
  }
}

/// Two equal lines are one wall face: a doubled line would count twice for every ray that crosses it.
void drop_doubles(std::vector<WallLine>& lines, EditReport& report) {
  std::vector<WallLine> kept;
  for (WallLine& line : lines) {
    const auto twin = std::find_if(kept.begin(), kept.end(),
                                   [&](const WallLine& other) { return same_geometry(other, line); });
    if (twin == kept.end()) {
      kept.push_back(std::move(line));
    } else {
      report.warn("wall_id " + line.id, "lies exactly on " + twin->id + " and is dropped");
    }
  }
  lines = std::move(kept);
}

/// What a line is, seen from the base; a line of the user's counts as supported over its whole length.
void take_from_base(WallLine& line, const WallLines& base) {
  const WallLine* original = find_line(base.lines, line.id);
  const auto same = [&](const WallLine& other) { return same_geometry(other, line); };
  if (original == nullptr || !same(*original)) {
    const auto twin = std::find_if(base.lines.begin(), base.lines.end(), same);
    if (twin == base.lines.end()) {
      line.source = base_id(line.id, base.lines).empty() ? LineSource::kAdded : LineSource::kEdited;
      line.support_m = line.length();
      return;
    }
    original = &*twin;
  }
  line.a = original->a;
  line.b = original->b;
  line.source = original->source;
  line.support_m = original->support_m;
  line.rms_m = original->rms_m;
  line.sigma_offset_m = original->sigma_offset_m;
  line.sigma_angle_rad = original->sigma_angle_rad;
}

}  // namespace

std::vector<WallLine> identify_lines(std::vector<DrawnLine> drawn, const WallLines& base,
                                     EditReport& report) {
  drop_copied_ids(drawn, base, report);
  name_pieces(drawn);
  WallLines named;
  named.frame = base.frame;
  for (DrawnLine& d : drawn) {
    named.lines.push_back(std::move(d.line));
  }
  named = normalised_lines(std::move(named));  // ends in order, before the coordinates decide names
  name_nameless(named.lines);
  for (WallLine& line : named.lines) {
    take_from_base(line, base);
  }
  named = normalised_lines(std::move(named));
  std::stable_partition(named.lines.begin(), named.lines.end(),
                        [&](const WallLine& line) { return find_line(base.lines, line.id) != nullptr; });
  drop_doubles(named.lines, report);
  return normalised_lines(std::move(named)).lines;
}

}  // namespace roomcut
