// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_list.h"

#include "common/artefact/h5_content.h"

namespace roomcut {

std::vector<DatasetInfo> list_datasets(const H5Reader& file, const std::string& group) {
  const std::string prefix = h5::absolute_path(group) + "/";
  const auto& objects = file.content().objects();
  std::vector<DatasetInfo> list;
  for (auto found = objects.lower_bound(prefix); found != objects.end() && found->first.starts_with(prefix);
       ++found) {
    const auto& [path, object] = *found;
    const std::string name = path.substr(prefix.size());
    if (!object.dataset || name.find('/') != std::string::npos) {
      continue;  // a group within the group
    }
    DatasetInfo info{name,
                     object.dataset->type,
                     object.dataset->shape,
                     h5::text_of(object, "unit"),
                     h5::text_of(object, "description"),
                     {}};
    for (const auto& [attribute, value] : object.attributes) {
      if (const double* number = std::get_if<double>(&value)) {
        info.numbers.emplace(attribute, *number);
      }
    }
    list.push_back(info);
  }
  return list;
}

}  // namespace roomcut
