// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "common/artefact/provenance.h"

namespace roomcut {

/// Notes what the artefact at `path` states of itself: its type, version and payload digest. Opening a HDF5
/// file costs a third of a millisecond, and a stage needs this of its inputs for the provenance and of its
/// outputs for the stamp, having just read the ones and written the others. Thread-safe.
void remember_artefact(const std::filesystem::path& path, const InputRecord& stated);

/// What was noted, as long as the file is still the one that it was noted of (by identity, size and time).
std::optional<InputRecord> known_artefact(const std::filesystem::path& path);

}  // namespace roomcut
