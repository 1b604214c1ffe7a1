// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace roomcut::fuzz {

/// The artefact seeds()/`seed` with edits applied to it, one a line; what is no edit, or names what is not
/// there, is left out. Written by libhdf5 itself: what is fuzzed is what roomcut believes of a file, not the
/// library, whose own faults would drown it (tests/fuzz/README.md). The digests that the file states are
/// those of before.
///
///   set PATH INDEX VALUE        one number of a dataset; the index is taken modulo its size
///   fill PATH VALUE             all of them
///   rows PATH N                 longer (by zeros) or shorter
///   type PATH f32|f64|u8|…|i64  the same values, as another type
///   rank PATH N                 so many dimensions, by further ones of 1 or by flattening
///   chunked PATH N              a chunked dataset that claims N rows and stores one chunk
///   drop PATH                   no such object
///   number OBJECT NAME VALUE    an attribute of type float64; `integer`, `text` likewise
///   strip OBJECT NAME           no such attribute
std::string edited_artefact(std::string_view seed, std::string_view edits);

/// Another list of edits: one added, changed or taken away. `size_limit`: bytes it may have.
std::string mutated_edits(std::string_view seed, std::string_view edits, std::size_t size_limit,
                          std::minstd_rand& draw);

}  // namespace roomcut::fuzz
