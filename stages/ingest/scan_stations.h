// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::ingest {

/// Scanner positions in the comments of a PLY header, in the file's unit and axes. Two forms are read:
/// `comment station X Y Z`, one each, and `comment scanner positions …: X Y Z and X Y Z …`. When the second
/// says
/// "(before offset)", the numbers of a comment `offset_subtracted X Y Z` are subtracted. Anything else is no
/// position.
std::vector<Vec3> stations_of_comments(const std::vector<std::string>& comments);

/// Scanner positions from a text file: X Y Z on each line, separated by spaces, tabs, commas or semicolons;
/// lines that begin with # are comments. Errors: those of ScanFile, kScanBadLine.
std::vector<Vec3> read_stations(const std::filesystem::path& path);

}  // namespace roomcut::ingest
