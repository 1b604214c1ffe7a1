// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_list.h"

#include "common/artefact/h5_detail.h"
#include "common/errors/codes.h"
#include "common/errors/error.h"

namespace roomcut {

using h5::Handle;

namespace {

herr_t collect_name(hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* out) {
  static_cast<std::vector<std::string>*>(out)->emplace_back(name);
  return 0;
}

herr_t collect_number(hid_t object, const char* name, const H5A_info_t* /*info*/, void* out) {
  double value = 0;
  if (h5::read_number_attribute(object, name, value)) {
    static_cast<std::map<std::string, double>*>(out)->emplace(name, value);
  }
  return 0;
}

h5::Shape shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> sizes(dimensions > 0 ? static_cast<std::size_t>(dimensions) : 0);
  if (!sizes.empty()) {
    H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
  }
  return {sizes.begin(), sizes.end()};
}

}  // namespace

std::vector<DatasetInfo> list_datasets(const std::filesystem::path& path, const std::string& group) {
  const Handle file = h5::open_for_reading(path);
  if (!file.valid()) {
    throw StageError(errors::kArtefactDamaged, path.string(), "cannot be opened as HDF5: " + h5::last_error(),
                     "make it again: delete the file and run make");
  }
  std::vector<DatasetInfo> list;
  const std::string place = h5::absolute_path(group);
  if (H5Lexists(file.get(), place.c_str(), H5P_DEFAULT) <= 0) {
    return list;
  }
  const Handle opened(H5Gopen2(file.get(), place.c_str(), H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names);
  for (const std::string& name : names) {
    const Handle dataset(H5Dopen2(opened.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) {
      continue;  // a group within the group
    }
    DatasetInfo info;
    info.name = name;
    const Handle type(H5Dget_type(dataset.get()), H5Tclose);
    info.type = h5::type_name(type.get());
    info.shape = shape_of(dataset.get());
    h5::read_text_attribute(dataset.get(), "unit", info.unit);
    h5::read_text_attribute(dataset.get(), "description", info.description);
    H5Aiterate2(dataset.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_number, &info.numbers);
    list.push_back(info);
  }
  return list;
}

}  // namespace roomcut
