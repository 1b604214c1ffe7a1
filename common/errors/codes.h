// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/errors/error.h"

/// The error catalogue: every code once, in the order of schemas/errors.md (a contract test holds both
/// together).
namespace roomcut::errors {

// U: usage and parameters
inline constexpr ErrorCode kUsage{"U01", ExitCode::kUsage};             ///< bad command line
inline constexpr ErrorCode kConfigUnreadable{"U02", ExitCode::kUsage};  ///< pipeline.yaml missing or not YAML
inline constexpr ErrorCode kUnknownParameter{"U03", ExitCode::kUsage};  ///< unknown or repeated key
inline constexpr ErrorCode kBadParameter{"U04", ExitCode::kUsage};      ///< wrong type, range, not finite

// C: the scan (point cloud files)
inline constexpr ErrorCode kScanMissing{"C01", ExitCode::kInput};     ///< no such file, or a directory
inline constexpr ErrorCode kScanUnreadable{"C02", ExitCode::kInput};  ///< permission, I/O error
inline constexpr ErrorCode kScanEmpty{"C03", ExitCode::kInput};       ///< zero bytes
inline constexpr ErrorCode kScanFormat{"C04", ExitCode::kInput};      ///< not a format we read, bad header
inline constexpr ErrorCode kScanTruncated{"C05",
                                          ExitCode::kInput};  ///< header promises more than the file holds
inline constexpr ErrorCode kScanNoPoints{"C06", ExitCode::kInput};  ///< header only, no finite point
inline constexpr ErrorCode kScanTooFewPoints{
    "C07", ExitCode::kInput};  ///< finite points, but too few to mean a building
inline constexpr ErrorCode kScanBadLine{"C08", ExitCode::kInput};    ///< a text line that is not a point
inline constexpr ErrorCode kScanExtent{"C09", ExitCode::kInput};     ///< degenerate or absurd extent (unit?)
inline constexpr ErrorCode kScanTooCoarse{"C10", ExitCode::kInput};  ///< coordinates too coarse for a model
inline constexpr ErrorCode kScanColumns{"C11", ExitCode::kInput};    ///< which columns of a text are x, y, z?
inline constexpr ErrorCode kScanNoDecoder{"C12", ExitCode::kInput};  ///< E57, LAS: no environment for it
inline constexpr ErrorCode kScanLeans{"C13", ExitCode::kInput};      ///< out of level by more than 5 degrees

// A: artefacts
inline constexpr ErrorCode kArtefactMissing{"A01", ExitCode::kInput};  ///< an input artefact is not there
inline constexpr ErrorCode kArtefactDamaged{
    "A02", ExitCode::kInput};  ///< not HDF5/JSON, dataset missing or of wrong shape
inline constexpr ErrorCode kArtefactType{"A03", ExitCode::kInput};  ///< another artefact type
inline constexpr ErrorCode kArtefactVersion{"A04",
                                            ExitCode::kInput};  ///< another major or a newer minor version
inline constexpr ErrorCode kArtefactMismatch{
    "A05", ExitCode::kInput};  ///< inputs of one stage do not belong together

// L: wall lines, hand edited (L01 … one per rule of schemas/wall_lines.md)
inline constexpr ErrorCode kLinesNotJson{"L01", ExitCode::kInput};
inline constexpr ErrorCode kLinesNotFeatureCollection{"L02", ExitCode::kInput};
inline constexpr ErrorCode kLinesNoMember{"L03",
                                          ExitCode::kInput};  ///< the `roomcut` member is another artefact's
inline constexpr ErrorCode kLinesVersion{"L04", ExitCode::kInput};
inline constexpr ErrorCode kLinesGeometry{"L05", ExitCode::kInput};     ///< missing or not a LineString
inline constexpr ErrorCode kLinesCoordinates{"L06", ExitCode::kInput};  ///< not numbers, not finite, too few
inline constexpr ErrorCode kLinesDegenerate{"L07", ExitCode::kInput};   ///< both ends are equal
inline constexpr ErrorCode kLinesOutside{"L08",
                                         ExitCode::kInput};  ///< far outside the box: degrees? millimetres?
inline constexpr ErrorCode kLinesProperty{"L09",
                                          ExitCode::kInput};  ///< a known property of wrong type or value
inline constexpr ErrorCode kLinesDuplicateKey{"L10", ExitCode::kInput};  ///< a JSON key stands twice
inline constexpr ErrorCode kLinesUnit{"L11", ExitCode::kInput};  ///< unit or frame differs from the scan's
inline constexpr ErrorCode kLinesNone{"L12", ExitCode::kInput};  ///< an edit that leaves no line
inline constexpr ErrorCode kLinesUnreadable{"L13", ExitCode::kInput};  ///< cannot be opened or read

// N: no result possible from this data
inline constexpr ErrorCode kNoLevels{"N01", ExitCode::kNoResult};     ///< no floor or ceiling found
inline constexpr ErrorCode kNoVertical{"N02", ExitCode::kNoResult};   ///< no vertical surface found
inline constexpr ErrorCode kNoWallLines{"N03", ExitCode::kNoResult};  ///< no wall line found
inline constexpr ErrorCode kNoCells{"N04", ExitCode::kNoResult};      ///< no cell complex
inline constexpr ErrorCode kEmptyModel{"N05", ExitCode::kNoResult};   ///< every cell is solid
inline constexpr ErrorCode kMeshInvalid{"N06", ExitCode::kNoResult};  ///< own mesh failed its check
inline constexpr ErrorCode kTooComplex{"N07", ExitCode::kNoResult};   ///< a count budget is exceeded

// M: meshes and truths read from outside; Y: scene files of synthesize
inline constexpr ErrorCode kMeshUnreadable{"M01", ExitCode::kInput};
inline constexpr ErrorCode kMeshFormat{"M02", ExitCode::kInput};
inline constexpr ErrorCode kMeshNotClosed{"M03", ExitCode::kInput};
inline constexpr ErrorCode kMeshesUnlike{"M04", ExitCode::kInput};  ///< of different unit, size or place
inline constexpr ErrorCode kSceneUnreadable{"Y01", ExitCode::kInput};
inline constexpr ErrorCode kSceneInvalid{"Y02", ExitCode::kInput};

// O: output
inline constexpr ErrorCode kCannotWrite{"O01", ExitCode::kOutput};  ///< folder, permission, disk full

}  // namespace roomcut::errors
