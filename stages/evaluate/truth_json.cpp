// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"
#include "common/errors/codes.h"
#include "stages/evaluate/evaluate_io.h"

namespace roomcut {

namespace {

DescribedRoom described(const Json& room, const Vec3& origin) {
  DescribedRoom out;
  out.name = room.at("name").get<std::string>();
  out.floor = room.at("floor").get<double>() - origin.z();
  out.ceiling = room.at("ceiling").get<double>() - origin.z();
  if (room.contains("polygon")) {
    for (const Json& p : room.at("polygon")) {
      out.polygon.emplace_back(p.at(0).get<double>() - origin.x(), p.at(1).get<double>() - origin.y());
    }
  } else {
    const Json& p = room.at("center");
    out.inside = Vec3(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()) - origin;
  }
  return out;
}

}  // namespace

std::vector<DescribedRoom> read_described_rooms(const std::filesystem::path& path, const Vec3& origin) {
  const std::string text = read_text_file(path);
  std::vector<DescribedRoom> rooms;
  try {
    const Json root = Json::parse(text);
    for (const Json& room : root.at("rooms")) {
      rooms.push_back(described(room, origin));
    }
  } catch (const Json::exception& error) {
    throw StageError(
        errors::kMeshFormat, path.string(), std::string("not a description of rooms: ") + error.what(),
        "rooms need name, floor, ceiling and polygon or center; without --truth-json every body is a room");
  }
  return rooms;
}

}  // namespace roomcut
