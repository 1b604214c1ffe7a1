// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"
#include "common/mesh/facet_surface.h"
#include "common/mesh/mesh_check.h"
#include "common/openings/opening.h"
#include "stages/extract/build_surface.h"
#include "stages/extract/curved_walls.h"
#include "stages/extract/params.h"
#include "stages/extract/rooms.h"
#include "stages/extract/storeys.h"
#include "stages/extract/unknown_spaces.h"

namespace roomcut::extract {

/// An opening of the model and the two rooms that it joins.
struct ModelOpening {
  Opening opening;
  std::int32_t room_a = -1, room_b = -1;  ///< indices into Model::rooms; equal for an opening within one room
  int storey = 0;
  double volume_m3 = 0;
};

/// The model: the border of the empty cells (paper §2, the result of the labelling), and what it measures.
struct Model {
  MergedSurface surface;                 ///< local metres; normals point out of the empty space
  std::vector<Space> storeys;            ///< ascending
  std::vector<Space> rooms;              ///< by storey, then by volume; without the openings between them
  std::vector<CurvedWall> curved_walls;  ///< by id; empty until find_curved_walls() was asked
  CellRooms cell_rooms;  ///< of the given complex: a cell that openings cut has those of its largest part
  std::vector<UnknownSpace> unknown_spaces;  ///< by storey, then by volume: no part of the surface
  std::vector<ModelOpening> openings;
  std::vector<std::string> refused;  ///< "o0007: why": openings that do not fit the labels
  SurfaceAreas areas;
  double empty_m3 = 0;     ///< sum of the empty space between floors and ceilings
  double put_back_m2 = 0;  ///< of floors and ceilings that lie at their levels, since the model would touch
                           ///< itself at their surfaces
  double unobserved_empty_m3 = 0;
  double unobserved_solid_m3 = 0;
  MeshCheck check;
  std::string
      fault;  ///< "" or why the mesh must not be used (F1.7: closed, oriented, no self-intersection, volume)
};

/// Extracts the model, with the given openings cut into its walls and its floors and ceilings at `surfaces`
/// (none: at their levels). Equal inputs give equal bytes. With wrong
/// labels (surfaces that touch in an edge or a vertex) the fault is set and the mesh is what could be made.
/// Throws StageError(kEmptyModel) when no cell is empty.
Model extract_model(const CellComplex& complex, const Labels& labels, const std::vector<Opening>& openings,
                    const ExtractParams& params, const LevelSurfaces& surfaces = {});

/// Lists the unknown spaces of the labels that the model was extracted from, in model.unknown_spaces and
/// model.cell_rooms.
void list_unknown_spaces(const CellComplex& complex, const Labels& labels, const FaceWeights& weights,
                         const DataTerms& terms, const ExtractParams& params, Model& model);

}  // namespace roomcut::extract
