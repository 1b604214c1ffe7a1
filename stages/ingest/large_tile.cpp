// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/large_tile.h"

#include <algorithm>
#include <limits>

namespace roomcut::ingest {

namespace {

constexpr std::size_t kChunk = 4096;  // records that are written or read at a time

}  // namespace

LargeTile::LargeTile(const TileStore& store, std::uint32_t tile, const TilePlace& place,
                     const UnitScale& scale, const IngestParams& params, std::uint64_t band_points)
    : store_(store),
      tile_(tile),
      place_(place),
      scale_(scale),
      file_(store.scratch_folder()),
      finder_(params) {
  std::vector<std::uint32_t> column_points(static_cast<std::size_t>(TileColumns().end), 0);
  float lowest_z = std::numeric_limits<float>::max();
  store.for_runs(tile, [&](const TileRun& run) {
    for (std::size_t i = 0; i < run.points; ++i) {
      ++column_points[static_cast<std::size_t>(column_of(run.x[i], run.y[i], place.ix, place.iy, scale))];
      lowest_z = std::min(lowest_z, run.z[i]);
    }
  });
  cut_bands(column_points, band_points);
  fill_file();
  grid_.begin(place, lowest_z, scale);
}

/// Bands from the first column without a gap.
void LargeTile::cut_bands(const std::vector<std::uint32_t>& column_points, std::uint64_t band_points) {
  bands_.push_back({{0, 0}, 0, 0});
  for (const std::uint32_t here : column_points) {
    const Band& last = bands_.back();
    if (last.points > 0 && last.points + here > band_points) {
      bands_.push_back({{last.columns.end, last.columns.end}, last.first + last.points, 0});
    }
    ++bands_.back().columns.end;
    bands_.back().points += here;
  }
}

void LargeTile::fill_file() {
  struct Waiting {
    std::vector<Record> records;
    std::uint64_t at = 0;  // of the file, in records
  };
  std::vector<Waiting> waiting(bands_.size());
  std::vector<std::uint32_t> band_of_column;
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    waiting[b].at = bands_[b].first;
    band_of_column.resize(static_cast<std::size_t>(bands_[b].columns.end), static_cast<std::uint32_t>(b));
  }
  const auto write = [&](Waiting& band) {
    file_.write(band.at * sizeof(Record), std::as_bytes(std::span<const Record>(band.records)));
    band.at += band.records.size();
    band.records.clear();
  };
  store_.for_runs(tile_, [&](const TileRun& run) {
    for (std::size_t i = 0; i < run.points; ++i) {
      const int column = column_of(run.x[i], run.y[i], place_.ix, place_.iy, scale_);
      Waiting& band = waiting[band_of_column[static_cast<std::size_t>(column)]];
      band.records.push_back(
          {run.x[i], run.y[i], run.z[i], run.hint != nullptr ? run.hint[i] : std::uint16_t{0}});
      if (band.records.size() == kChunk) {
        write(band);
      }
    }
  });
  for (Waiting& band : waiting) {
    write(band);
  }
}

void LargeTile::sort_band(const Band& band) {
  points_.resize(band.points, store_.has_hints());
  records_.resize(kChunk);
  for (std::size_t at = 0; at < band.points;) {
    const std::size_t n = std::min<std::size_t>(kChunk, band.points - at);
    file_.read((band.first + at) * sizeof(Record),
               std::as_writable_bytes(std::span<Record>(records_.data(), n)));
    for (std::size_t i = 0; i < n; ++i, ++at) {
      points_.x[at] = records_[i].x;
      points_.y[at] = records_[i].y;
      points_.z[at] = records_[i].z;
      if (store_.has_hints()) {
        points_.hint[at] = records_[i].hint;
      }
    }
  }
  grid_.sort_columns({run_of(points_)}, band.columns, place_, scale_);
}

std::uint64_t LargeTile::count_points() {
  std::uint64_t points = 0;
  for (const Band& band : bands_) {
    sort_band(band);
    points += grid_.own_points();
  }
  return points;
}

bool LargeTile::find_surfaces(SurfaceEstimates& estimates) {
  for (const Band& band : bands_) {
    sort_band(band);
    grid_.sum_moments(scale_);
  }
  grid_.finish();
  surfaces_ = &finder_.find(grid_, scale_, estimates);
  NormalsCheck normals;
  for (const Band& band : bands_) {
    if (!store_.has_hints()) {
      break;
    }
    sort_band(band);
    normals.add(grid_, *surfaces_);
  }
  use_normals_ = store_.has_hints() && !normals.refused();
  return store_.has_hints() && !use_normals_;
}

void LargeTile::hand_over(const std::function<void(const CloudTile&, bool)>& take) {
  CloudTile part;
  for (const Band& band : bands_) {
    sort_band(band);
    make_cloud_part(grid_, *surfaces_, use_normals_, part);
    take(part, &band == &bands_.back());
  }
}

}  // namespace roomcut::ingest
