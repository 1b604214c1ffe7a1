// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/normal_hint.h"
#include "stages/ingest/tile_store.h"

namespace roomcut::ingest {

using namespace fixed_grid;

namespace {

/// -1, 0 or 1: in whose halo, below or above, a coordinate inside its tile lies.
std::int8_t beside(std::int32_t units_in_tile) {
  return static_cast<std::int8_t>((units_in_tile >= kTileUnits - kHaloUnits ? 1 : 0) -
                                  (units_in_tile < kHaloUnits ? 1 : 0));
}

}  // namespace

TileSorter::TileSorter(const ScanFrame& frame, const UnitScale& scale, const IngestParams& params)
    : frame_(frame), scale_(scale), params_(params), slot_of_tile_(kWindowTiles) {}

std::uint32_t TileSorter::slot_of(std::uint32_t tile) {
  std::vector<std::uint32_t>& row = slot_of_tile_[tile / kWindowTiles];
  if (row.empty()) {
    row.assign(kWindowTiles, 0);
  }
  std::uint32_t& slot = row[tile % kWindowTiles];
  if (slot == 0) {
    slots_.push_back({tile, 0, {}});
    slot = static_cast<std::uint32_t>(slots_.size());
  }
  return slot - 1;
}

/// Calls visit(slot) for the up to three neighbours in whose halo the point lies; none beyond the window.
template <class Visit>
void TileSorter::for_halos(const Place& place, Visit&& visit) {
  const std::uint32_t tile = slots_[place.slot].tile;
  const auto visit_tile = [&](int dx, int dy) {
    const int tx = static_cast<int>(tile % kWindowTiles) + dx;
    const int ty = static_cast<int>(tile / kWindowTiles) + dy;
    if (tx >= 0 && tx < kWindowTiles && ty >= 0 && ty < kWindowTiles) {
      visit(slot_of(static_cast<std::uint32_t>(ty * kWindowTiles + tx)));
    }
  };
  if (place.beside_x != 0) {
    visit_tile(place.beside_x, 0);
  }
  if (place.beside_y != 0) {
    visit_tile(0, place.beside_y);
  }
  if (place.beside_x != 0 && place.beside_y != 0) {
    visit_tile(place.beside_x, place.beside_y);
  }
}

void TileSorter::place_points(const LocalPoints& local) {
  places_.resize(local.x.size());
  std::uint32_t last_tile = ~0U;
  std::uint32_t slot = 0;
  for (std::size_t i = 0; i < local.x.size(); ++i) {
    const std::int32_t ux = scale_.units(local.x[i]);
    const std::int32_t uy = scale_.units(local.y[i]);
    const std::int32_t uz = scale_.units(local.z[i]);
    const std::int32_t tx = (ux >> kTileBits) - frame_.window[0];
    const std::int32_t ty = (uy >> kTileBits) - frame_.window[1];
    const std::int32_t layer = (uz >> kTileBits) - frame_.window[2];
    const auto tile = static_cast<std::uint32_t>(ty * kWindowTiles + tx);
    if (tile != last_tile) {
      slot = slot_of(tile);
      last_tile = tile;
    }
    ++slots_[slot].points;
    ++slots_[slot].layers[static_cast<std::size_t>(layer)];
    const Place place{slot, beside(ux & (kTileUnits - 1)), beside(uy & (kTileUnits - 1))};
    places_[i] = place;
    if ((place.beside_x | place.beside_y) != 0) {
      for_halos(place, [&](std::uint32_t halo) { ++slots_[halo].points; });
    }
  }
}

void TileSorter::lay_out(bool hints, SortedBlock& block) {
  block.runs.clear();
  block.cells.clear();
  cursors_.clear();
  block.size = 0;
  for (const Slot& slot : slots_) {
    block.runs.push_back({slot.tile, slot.points, block.size});
    block.size += std::uint64_t{slot.points} * (hints ? 14 : 12);
    block.size += block.size % 4;  // hints may end on half a float
    for (std::size_t layer = 0; layer < slot.layers.size(); ++layer) {
      if (slot.layers[layer] > 0) {
        block.cells.push_back({slot.tile, static_cast<std::uint32_t>(layer), slot.layers[layer]});
      }
    }
  }
  block.bytes.reset(new std::byte[block.size]);  // not initialised: every byte that is read is written first
  for (const SortedBlock::Run& run : block.runs) {
    auto* x = reinterpret_cast<float*>(block.bytes.get() + run.offset);
    auto* hint = reinterpret_cast<std::uint16_t*>(x + std::size_t{3} * run.points);
    cursors_.push_back({x, run.points, hints ? hint : nullptr});
  }
}

void TileSorter::scatter(const LocalPoints& local) {
  const bool hints = !local.nx.empty();
  for (std::size_t i = 0; i < local.x.size(); ++i) {
    const std::uint16_t hint =
        hints ? normal_hint(local.nx[i], local.ny[i], local.nz[i], params_) : std::uint16_t{0};
    const auto store = [&](std::uint32_t slot) {
      Cursor& cursor = cursors_[slot];
      float* const at = cursor.x++;
      at[0] = local.x[i];
      at[cursor.points] = local.y[i];
      at[2 * cursor.points] = local.z[i];
      if (hints) {
        *cursor.hint++ = hint;
      }
    };
    const Place place = places_[i];
    store(place.slot);
    if ((place.beside_x | place.beside_y) != 0) {
      for_halos(place, store);
    }
  }
}

void TileSorter::clear() {
  for (const Slot& slot : slots_) {
    slot_of_tile_[slot.tile / kWindowTiles][slot.tile % kWindowTiles] = 0;
  }
  slots_.clear();
}

void TileSorter::sort(const LocalPoints& local, SortedBlock& block) {
  place_points(local);
  lay_out(!local.nx.empty(), block);
  scatter(local);
  clear();
}

}  // namespace roomcut::ingest
