// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "common/cells/evidence_io.h"

// The page of this artefact is schemas/rooms.md.

namespace roomcut {

CellRooms read_rooms(const std::filesystem::path& path, const CellsFile& cells) {
  const H5Reader file = open_for_cells(path, artefacts::kRooms, cells);
  const std::size_t count = cells.complex.cells();
  CellRooms rooms;
  rooms.storey =
      read_in_range<std::int16_t>(file, "cell/storey", {count}, -1, std::numeric_limits<std::int16_t>::max());
  rooms.room =
      read_in_range<std::int32_t>(file, "cell/room", {count}, -1, std::numeric_limits<std::int32_t>::max());
  rooms.unknown_space = read_in_range<std::int32_t>(file, "cell/unknown_space", {count}, -1,
                                                    std::numeric_limits<std::int32_t>::max());
  return rooms;
}

bool write_rooms(const std::filesystem::path& path, const CellRooms& rooms, const CellsFile& cells,
                 const Provenance& provenance) {
  require_size(rooms.storey.size(), cells.complex.cells(), "cell/storey");
  require_size(rooms.room.size(), cells.complex.cells(), "cell/room");
  require_size(rooms.unknown_space.size(), cells.complex.cells(), "cell/unknown_space");
  H5Writer file(path, artefacts::kRooms, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  file.write("cell/storey", rooms.storey, "1", "storey of summary.json; -1 = solid or unknown");
  file.write("cell/room", rooms.room, "1", "room of summary.json; -1 = solid, unknown, or in a door");
  file.write("cell/unknown_space", rooms.unknown_space, "1",
             "unknown space of summary.json; -1 = part of none");
  return file.commit();
}

}  // namespace roomcut
