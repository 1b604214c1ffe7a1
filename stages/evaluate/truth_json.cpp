// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"
#include "common/artefact/limits.h"
#include "common/errors/codes.h"
#include "stages/evaluate/evaluate_io.h"

namespace roomcut {

namespace {

/// In the scan's coordinates.
double coordinate(const Json& value) {
  return number_in(value, -limits::kFarthestOrigin_m, limits::kFarthestOrigin_m);
}

DescribedRoom described(const Json& room, const Vec3& origin) {
  DescribedRoom out;
  out.name = room.at("name").get<std::string>();
  out.floor = coordinate(room.at("floor")) - origin.z();
  out.ceiling = coordinate(room.at("ceiling")) - origin.z();
  if (room.contains("polygon")) {
    for (const Json& p : room.at("polygon")) {
      out.polygon.emplace_back(coordinate(p.at(0)) - origin.x(), coordinate(p.at(1)) - origin.y());
    }
  } else {
    const Json& p = room.at("center");
    out.inside = Vec3(coordinate(p.at(0)), coordinate(p.at(1)), coordinate(p.at(2))) - origin;
  }
  return out;
}

}  // namespace

std::vector<DescribedRoom> read_described_rooms(const std::filesystem::path& path, const Vec3& origin) {
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
      rooms.push_back(described(room, origin));
    }
  } catch (const Json::exception& error) {
    refuse(short_message(error));
  } catch (const BadJson& error) {
    refuse(error.what());
  }
  return rooms;
}

}  // namespace roomcut
