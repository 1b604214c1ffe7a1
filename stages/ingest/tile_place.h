// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/ingest/ingest.h"
#include "stages/ingest/tile_grid.h"

namespace roomcut::ingest {

/// Where a tile lies, and which layers of it and around it are kept.
TilePlace place_of(const TiledScan& scan, const KeptTile& tile);

/// Whether it is worked on in bands (LargeTile): one that is not much larger than a band is faster as a
/// whole.
bool is_large(const TiledScan& scan, const KeptTile& tile);

/// Has the points of `scan` that repeat another one's coordinates left out from here on: corrects the numbers
/// of points of its tiles and its counts. Sorts every tile once, in parallel; memory: a few tiles of
/// band_points each.
void leave_out_duplicates(TiledScan& scan, const IngestParams& params);

}  // namespace roomcut::ingest
