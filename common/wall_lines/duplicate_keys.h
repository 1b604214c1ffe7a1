// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace roomcut {

/// A key that stands twice in one JSON object.
struct DuplicateKey {
  std::string object;  ///< path of the object, e.g. "features[17].properties"; "" for the outermost
  std::string key;
};

/// All repeated keys of a JSON text, each once, in the order of the text. A plain parser would silently keep
/// one of the values. Pre: `text` is valid JSON.
std::vector<DuplicateKey> find_duplicate_keys(const std::string& text);

}  // namespace roomcut
