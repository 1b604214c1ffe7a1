// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <string_view>

namespace roomcut::fuzz {

/// The text with one node of its tree replaced, removed, doubled or renamed; "" when it is not JSON, is
/// deeper than 200, or would come out longer than `size_limit`.
std::string mutated_json(std::string_view text, std::size_t size_limit, std::minstd_rand& draw);

}  // namespace roomcut::fuzz
