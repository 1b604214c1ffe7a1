// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "common/cloud/cloud.h"

namespace roomcut::slice {

using TileVisitor = std::function<void(std::size_t, const CloudTile&)>;

/// One pass over the points: calls the visitor with every tile, or with every part of it one after another,
/// possibly from several threads and in any order.
/// CloudReader::for_each_tile is one; tests make their own.
using TileSource = std::function<void(const TileVisitor&)>;

}  // namespace roomcut::slice
