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

/// The first `most` repeated keys of a JSON text, each once, in the order of the text; the texts are cut to
/// what a message can hold. A plain parser would silently keep one of the values. Pre: parse_json() takes
/// `text`.
std::vector<DuplicateKey> find_duplicate_keys(const std::string& text, std::size_t most);

}  // namespace roomcut
