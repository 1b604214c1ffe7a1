// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Reads a scene (schemas/scene.md): names become indices, outlines become polygons, arcs become chords,
/// `random` becomes rooms. Errors: kSceneUnreadable (no file, not JSON), kSceneInvalid (all problems of the
/// file at once).
Scene read_scene(const std::filesystem::path& path);

/// The same from JSON in memory; `where` names it in messages.
Scene scene_from_json(const nlohmann::json& root, const std::string& where);

}  // namespace roomcut::synthesize
