// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/artefact/h5.h"

namespace roomcut {

/// What an artefact says of one of its datasets.
struct DatasetInfo {
  std::string name;  ///< without its group
  std::string type;  ///< "f32", "i64", "u8" …
  h5::Shape shape;
  std::string unit, description;
  std::map<std::string, double> numbers;  ///< its attributes that are float64
};

/// The datasets of a group, in alphabetical order; none when there is no such group. For readers that show
/// what is there, whatever it is called.
std::vector<DatasetInfo> list_datasets(const H5Reader& file, const std::string& group);

}  // namespace roomcut
