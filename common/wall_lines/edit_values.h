// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/artefact/json.h"

// What people and their programs write into the fields of a feature.
namespace roomcut {

/// A text without blanks around it, or whatever else it is as JSON.
std::string trimmed_text(const Json& value);

/// A number, or text that is one as a whole: columns of text are common in QGIS.
std::optional<double> number_of(const Json& value);

std::optional<bool> truth_of(const Json& value);

/// The name of a feature: a short text or a whole number; "" for null. Nothing for what cannot be one.
std::optional<std::string> id_of(const Json& value);

/// Whether a text is the digest of a payload: 64 hexadecimal digits.
bool is_digest(std::string_view text);

}  // namespace roomcut
