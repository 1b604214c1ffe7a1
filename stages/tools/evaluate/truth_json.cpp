// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

namespace {

Vec3 corner(const Json& p) {
  return {scan_metres(p.at(0)), scan_metres(p.at(1)), scan_metres(p.at(2))};
}

DescribedRoom described(const Json& room, const ComparedAxes& axes) {
  DescribedRoom out;
  out.name = room.at("name").get<std::string>();
  const double floor = scan_metres(room.at("floor"));
  const double height = scan_metres(room.at("ceiling")) - floor;
  Vec3 middle(0, 0, 0);  // of the floor: there its height counts, should the axes lean against the room's
  if (room.contains("polygon")) {
    for (const Json& p : room.at("polygon")) {
      const Vec3 place = axes.from_file({scan_metres(p.at(0)), scan_metres(p.at(1)), floor});
      out.polygon.emplace_back(place.head<2>());
      middle += place / static_cast<double>(room.at("polygon").size());
    }
  } else {
    const Vec3 p = corner(room.at("center"));
    out.inside = axes.from_file(p);
    middle = axes.from_file({p.x(), p.y(), floor});
  }
  out.scanned = room.value("scanned", true);
  out.floor = middle.z();
  out.ceiling = middle.z() + height;
  return out;
}

Bounds3 ignored_box(const Json& corners) {
  const Vec3 a = corner(corners.at(0));
  const Vec3 b = corner(corners.at(1));
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// Reads polygon, z0 and z1 of a column or niche.
template <class Described>
Described described_prism(const Json& prism, const ComparedAxes& axes) {
  Described out;
  out.z0 = axes.from_file({0, 0, scan_metres(prism.at("z0"))}).z();
  out.z1 = out.z0 + scan_metres(prism.at("z1")) - scan_metres(prism.at("z0"));
  for (const Json& p : prism.at("polygon")) {
    out.polygon.emplace_back(
        axes.from_file({scan_metres(p.at(0)), scan_metres(p.at(1)), 0}).template head<2>());
  }
  return out;
}

DescribedColumn described_column(const Json& column, const ComparedAxes& axes) {
  auto out = described_prism<DescribedColumn>(column, axes);
  out.size_m = std::min(scan_metres(column.at("width")), scan_metres(column.at("depth")));
  return out;
}

DescribedNiche described_niche(const Json& niche, const ComparedAxes& axes) {
  auto out = described_prism<DescribedNiche>(niche, axes);
  out.width_m = scan_metres(niche.at("width"));
  out.depth_m = scan_metres(niche.at("depth"));
  out.solid = niche.value("pilaster", false);
  return out;
}

double azimuth(const Json& p, const Json& centre) {
  return std::atan2(scan_metres(p.at(1)) - scan_metres(centre.at(1)),
                    scan_metres(p.at(0)) - scan_metres(centre.at(0)));
}

DescribedArc described_arc(const Json& centre, double z0, double z1, const ComparedAxes& axes) {
  DescribedArc out;
  const Vec3 low = axes.from_file({scan_metres(centre.at(0)), scan_metres(centre.at(1)), z0});
  out.centre = low.head<2>();
  out.z0 = low.z();
  out.z1 = low.z() + z1 - z0;
  return out;
}

DescribedArc truth_arc(const Json& arc, const ComparedAxes& axes) {
  const Json& centre = arc.at("center");
  DescribedArc out = described_arc(centre, scan_metres(arc.at("z0")), scan_metres(arc.at("z1")), axes);
  out.radius_m = scan_metres(arc.at("radius"));
  out.from = azimuth(arc.at("from"), centre);
  out.sweep = azimuth(arc.at("to"), centre) - out.from;
  if (out.sweep <= 1e-9) out.sweep += 2 * std::numbers::pi;  // equal ends: a whole circle
  return out;
}

}  // namespace

std::vector<DescribedArc> read_curved_walls(const std::filesystem::path& path, const ComparedAxes& axes) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<DescribedArc> arcs;
  try {
    const Json root = parse_json(read_text_file(path));
    for (const Json& wall : root.value("curved_walls", Json::array())) {
      arcs.push_back(described_arc(wall.at("centre_m"), scan_metres(wall.at("z0_m")),
                                   scan_metres(wall.at("z1_m")), axes));
      arcs.back().radius_m = scan_metres(wall.at("radius_m"));
      arcs.back().from = kDegree * wall.at("from_deg").get<double>();
      arcs.back().sweep = kDegree * wall.at("to_deg").get<double>() - arcs.back().from;
    }
  } catch (const Json::exception& error) {
    throw StageError(errors::kMeshFormat, path.string(), "not a summary: " + short_message(error),
                     "give the summary.json of the model, or none");
  } catch (const BadJson& error) {
    throw StageError(errors::kMeshFormat, path.string(), std::string("not a summary: ") + error.what(),
                     "give the summary.json of the model, or none");
  }
  return arcs;
}

TruthDescription read_truth_description(const std::filesystem::path& path, const ComparedAxes& axes) {
  const std::string text = read_text_file(path);
  TruthDescription out;
  const auto refuse = [&path](const std::string& what) {
    throw StageError(
        errors::kMeshFormat, path.string(), "not a description of rooms: " + what,
        "rooms need name, floor, ceiling and polygon or center, ignore_boxes two corners each; without "
        "--truth-json every body is a room");
  };
  try {
    const Json root = parse_json(text);
    for (const Json& room : root.at("rooms")) {
      out.rooms.push_back(described(room, axes));
    }
    std::vector<Bounds3> boxes;
    for (const Json& box : root.value("ignore_boxes", Json::array())) {
      boxes.push_back(ignored_box(box));
    }
    for (const Json& column : root.value("columns", Json::array())) {
      out.columns.push_back(described_column(column, axes));
    }
    for (const Json& niche : root.value("niches", Json::array())) {
      out.niches.push_back(described_niche(niche, axes));
    }
    for (const Json& arc : root.value("arcs", Json::array())) {
      out.arcs.push_back(truth_arc(arc, axes));
    }
    out.ignored = IgnoredSpace(std::move(boxes), axes);
  } catch (const Json::exception& error) {
    refuse(short_message(error));
  } catch (const BadJson& error) {
    refuse(error.what());
  }
  return out;
}

}  // namespace roomcut::evaluate
