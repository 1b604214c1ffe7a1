// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// Called with a block's index and its points, those without return taken out.
using VisitBlock = std::function<void(std::size_t, const ScanBlock&)>;

/// Reads every block once, in parallel; visit() has to be thread-safe. Errors: those of the reader and of
/// visit(); of several the one of the earliest block, whatever thread comes first.
void for_blocks(const ScanReader& reader, const VisitBlock& visit);

/// Where a scan lies, in the file's unit and axes: the mean of all points within `reach` of the medians of
/// `sample` along each axis, so that ghosts have no part in it. It follows the points whatever frame, unit
/// and rounding they are written in (steps of a millimetre move it by less than a micrometre) and whatever
/// their order; so does what stands on it. Whole numbers are added up: the same for any number of threads.
/// 0 0 0 when no point of the sample is finite. `advance(1)` is called per block. Errors: those of the
/// reader.
Vec3 scan_middle(const ScanReader& reader, const ScanBlock& sample, double reach,
                 const std::function<void(std::uint64_t)>& advance = {});

}  // namespace roomcut::ingest
