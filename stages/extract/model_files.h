// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/artefact/provenance.h"
#include "stages/extract/extract.h"

namespace roomcut::extract {

// The end products. The frame's origin is added to all coordinates, so that they lie on the scan.

/// model.ply: triangles with kind (SurfaceKind), storey and region. Returns whether the file is new.
bool write_model_ply(const std::filesystem::path& path, const Model& model, const Frame& frame);
/// model.obj: strictly convex polygons in groups storey_<i>_<kind>. OBJ knows no holes, so a region with
/// holes (or a concave one) is several polygons.
bool write_model_obj(const std::filesystem::path& path, const Model& model, const Frame& frame);
/// summary.json (schemas/summary.md). Returns whether its content is new.
bool write_summary(const std::filesystem::path& path, const Model& model, const CellComplex& complex,
                   const Labels& labels, const Provenance& provenance);

}  // namespace roomcut::extract
