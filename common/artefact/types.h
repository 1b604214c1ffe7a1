// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut {

/// Type and version of an artefact: one constant each, so that they cannot be mixed up.
/// A reader takes the same major and a minor not above its own. Pages: schemas/<name>.md.
struct ArtefactType {
  const char* name;
  int major;
  int minor;
};

namespace artefacts {
inline constexpr ArtefactType kCloud{"cloud", 1, 1};
inline constexpr ArtefactType kSlices{"slices", 1, 2};
inline constexpr ArtefactType kHough{"hough", 1, 0};
inline constexpr ArtefactType kWallLines{"wall_lines", 1, 1};
inline constexpr ArtefactType kPlanes{"planes", 1, 0};
inline constexpr ArtefactType kCells{"cells", 1, 1};
inline constexpr ArtefactType kWeights{"weights", 1, 1};
inline constexpr ArtefactType kDataTerms{"data_terms", 3, 0};
inline constexpr ArtefactType kLabels{"labels", 1, 1};
inline constexpr ArtefactType kSurfaces{"surfaces", 1, 0};
inline constexpr ArtefactType kRooms{"rooms", 2, 0};
inline constexpr ArtefactType kSummary{"summary", 1, 3};
inline constexpr ArtefactType kScores{"scores", 1, 2};
inline constexpr ArtefactType kTruthCells{"truth_cells", 1, 0};
inline constexpr ArtefactType kScene{"scene", 1, 1};
}  // namespace artefacts

}  // namespace roomcut
