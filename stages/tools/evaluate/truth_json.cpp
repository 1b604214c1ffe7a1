// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

namespace {

DescribedRoom described(const Json& room, const ComparedAxes& axes) {
  DescribedRoom out;
  out.name = room.at("name").get<std::string>();
  const double floor = scan_metres(room.at("floor"));
  const double height = scan_metres(room.at("ceiling")) - floor;
  Vec3 middle(0, 0, 0);  // of the floor: there its height counts, should the axes lean against the room's
  if (room.contains("polygon")) {
    for (const Json& p : room.at("polygon")) {
      const Vec3 corner = axes.from_file(Vec3(scan_metres(p.at(0)), scan_metres(p.at(1)), floor));
      out.polygon.emplace_back(corner.head<2>());
      middle += corner / static_cast<double>(room.at("polygon").size());
    }
  } else {
    const Json& p = room.at("center");
    out.inside = axes.from_file(Vec3(scan_metres(p.at(0)), scan_metres(p.at(1)), scan_metres(p.at(2))));
    middle = axes.from_file(Vec3(scan_metres(p.at(0)), scan_metres(p.at(1)), floor));
  }
  out.floor = middle.z();
  out.ceiling = middle.z() + height;
  return out;
}

}  // namespace

std::vector<DescribedRoom> read_described_rooms(const std::filesystem::path& path, const ComparedAxes& axes) {
  const std::string text = read_text_file(path);
  std::vector<DescribedRoom> rooms;
  const auto refuse = [&path](const std::string& what) {
    throw StageError(
        errors::kMeshFormat, path.string(), "not a description of rooms: " + what,
        "rooms need name, floor, ceiling and polygon or center; without --truth-json every body is a room");
  };
  try {
    const Json root = parse_json(text);
    for (const Json& room : root.at("rooms")) {
      rooms.push_back(described(room, axes));
    }
  } catch (const Json::exception& error) {
    refuse(short_message(error));
  } catch (const BadJson& error) {
    refuse(error.what());
  }
  return rooms;
}

}  // namespace roomcut::evaluate
