// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5_detail.h"
#include "common/artefact/json.h"
#include "common/artefact/known_artefacts.h"
#include "common/errors/codes.h"

namespace roomcut {

using h5::Handle;

std::string version_text(ArtefactType type) {
  return std::to_string(type.major) + "." + std::to_string(type.minor);
}

void check_type_and_version(const std::filesystem::path& path, const std::string& artefact,
                            const std::string& version, ArtefactType expected) {
  if (artefact.empty()) {
    throw StageError(errors::kArtefactDamaged, path.string(),
                     "does not say which artefact it is (expected " + std::string(expected.name) + ")",
                     "was it written by roomcut?");
  }
  if (artefact != expected.name) {
    throw StageError(errors::kArtefactType, path.string(),
                     "is an artefact of type " + artefact + ", not " + expected.name,
                     "look at the options of this stage");
  }
  int major = 0;
  int minor = 0;
  const char* end = version.data() + version.size();
  const auto [dot, bad_major] = std::from_chars(version.data(), end, major);
  const bool has_minor = bad_major == std::errc() && dot != end && *dot == '.';
  const auto [stop, bad_minor] = has_minor ? std::from_chars(dot + 1, end, minor)
                                           : std::from_chars_result{dot, std::errc::invalid_argument};
  if (bad_minor != std::errc() || stop != end) {
    throw StageError(errors::kArtefactDamaged, path.string(), "states no schema version");
  }
  if (major != expected.major || minor > expected.minor) {
    throw StageError(errors::kArtefactVersion, path.string(),
                     artefact + " has schema version " + version + ", this program reads " +
                         version_text(expected) + (expected.minor > 0 ? " and older minor versions" : ""),
                     "make it again with this version of roomcut");
  }
}

namespace {

enum class Kind { kHdf5, kText, kOther };

/// By the first bytes; no data are read.
Kind kind_of(const std::filesystem::path& path) {
  std::array<unsigned char, 8> head{};
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    throw StageError(errors::kArtefactMissing, path.string(),
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  const ssize_t got = ::read(file, head.data(), head.size());
  ::close(file);
  static constexpr std::array<unsigned char, 8> kSignature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  if (got == 8 && head == kSignature) {
    return Kind::kHdf5;
  }
  return got > 0 && head[0] == '{' ? Kind::kText : Kind::kOther;
}

InputRecord inspect_hdf5(const std::filesystem::path& path) {
  InputRecord record;
  const Handle file = h5::open_for_reading(path);
  if (!file.valid()) {
    return record;
  }
  const Handle root(H5Oopen(file.get(), "/", H5P_DEFAULT), H5Oclose);
  const Handle provenance(H5Oopen(file.get(), "/provenance", H5P_DEFAULT), H5Oclose);
  h5::read_text_attribute(root.get(), "artefact", record.artefact);
  h5::read_text_attribute(root.get(), "schema_version", record.schema_version);
  if (provenance.valid()) {
    h5::read_text_attribute(provenance.get(), "payload_sha256", record.payload_sha256);
  }
  return record;
}

std::string text_member(const Json& value, const char* key) {
  return value.is_object() && value.contains(key) && value[key].is_string() ? value[key].get<std::string>()
                                                                            : std::string();
}

/// JSON artefacts say it at the top; wall_lines.geojson in its member `roomcut`.
InputRecord inspect_json(const std::filesystem::path& path) {
  const Json value = Json::parse(read_text_file(path), nullptr, false);
  InputRecord record;
  if (!value.is_object()) {
    return record;
  }
  const Json& home = value.contains("roomcut") ? value["roomcut"] : value;
  record.artefact = text_member(home, "artefact");
  record.schema_version = text_member(home, "schema_version");
  record.payload_sha256 = text_member(home, "payload_sha256");
  if (record.payload_sha256.empty() && home.is_object() && home.contains("provenance")) {
    record.payload_sha256 = text_member(home["provenance"], "payload_sha256");
  }
  return record;
}

InputRecord stated(const std::filesystem::path& path) {
  switch (kind_of(path)) {
    case Kind::kHdf5:
      return inspect_hdf5(path);
    case Kind::kText:
      return inspect_json(path);
    default:
      return {};
  }
}

}  // namespace

InputRecord inspect_artefact(const std::filesystem::path& path) {
  if (const std::optional<InputRecord> known = known_artefact(path)) {
    return *known;
  }
  InputRecord record = stated(path);
  if (record.artefact.empty() || record.payload_sha256.empty()) {
    record = {};
    record.payload_sha256 = sha256_of_file(path);
  }
  return record;
}

std::string stated_payload(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? stated(path).payload_sha256 : std::string();
}

namespace {

/// Adds what one object of the file holds to the digest; the callback of H5Ovisit.
struct Visitor {
  hid_t file;
  h5::PayloadDigest digest;
  std::string trouble;

  void dataset(hid_t object, const std::string& path) {
    const Handle type(H5Dget_type(object), H5Tclose);
    const Handle space(H5Dget_space(object), H5Sclose);
    std::vector<hsize_t> sizes(
        static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
    H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
    Sha256 sha;
    const std::size_t item = H5Tget_size(type.get());
    std::uint64_t row = item;
    for (std::size_t i = 1; i < sizes.size(); ++i) {
      row *= sizes[i];
    }
    const std::uint64_t rows_at_once =
        row == 0 ? 1 : std::max<std::uint64_t>(1, (std::uint64_t{1} << 22) / row);
    std::vector<char> block;
    std::vector<hsize_t> start(sizes.size(), 0);
    std::vector<hsize_t> extent = sizes;
    for (std::uint64_t first = 0; row > 0 && !sizes.empty() && first < sizes[0]; first += rows_at_once) {
      start[0] = first;
      extent[0] = std::min<std::uint64_t>(rows_at_once, sizes[0] - first);
      block.resize(extent[0] * row);
      const Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                          H5Sclose);
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
      if (H5Dread(object, type.get(), memory.get(), space.get(), H5P_DEFAULT, block.data()) < 0) {
        trouble = path + ": " + h5::last_error();
        return;
      }
      sha.update(block.data(), block.size());
    }
    digest.dataset(path, h5::type_name(type.get()), {sizes.begin(), sizes.end()}, sha.hex());
  }

  void attributes(hid_t object, const std::string& path) {
    for (hsize_t i = 0, n = static_cast<hsize_t>(std::max(0, H5Aget_num_attrs(object))); i < n; ++i) {
      std::array<char, 256> name{};
      H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
      std::string text;
      double number = 0;
      std::int64_t integer = 0;
      double vector[3] = {0, 0, 0};
      if (h5::read_text_attribute(object, name.data(), text)) {
        digest.attribute(path, name.data(), text);
      } else if (h5::read_number_attribute(object, name.data(), number)) {
        digest.attribute(path, name.data(), number);
      } else if (h5::read_number_attribute(object, name.data(), integer)) {
        digest.attribute(path, name.data(), integer);
      } else if (h5::read_vector_attribute(object, name.data(), vector)) {
        digest.attribute(path, name.data(), vector);
      }
    }
  }
};

herr_t visit(hid_t root, const char* name, const H5O_info_t* info, void* data) {
  auto& visitor = *static_cast<Visitor*>(data);
  const std::string path = std::string(name) == "." ? "/" : "/" + std::string(name);
  if (path == "/provenance" || path.starts_with("/provenance/")) {
    return 0;
  }
  const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  if (info->type == H5O_TYPE_DATASET) {
    visitor.dataset(object.get(), path);
  }
  visitor.attributes(object.get(), path);
  return visitor.trouble.empty() ? 0 : -1;
}

}  // namespace

Provenance read_provenance(const std::filesystem::path& path) {
  const InputRecord record = stated(path);
  if (kind_of(path) == Kind::kHdf5) {
    int major = 0;
    int minor = 0;
    if (std::sscanf(record.schema_version.c_str(), "%d.%d", &major, &minor) != 2) {
      throw StageError(errors::kArtefactDamaged, path.string(), "states no schema version");
    }
    return H5Reader(path, {record.artefact.c_str(), major, minor}).provenance();
  }
  try {
    const Json value = Json::parse(read_text_file(path));
    return provenance_from_json((value.contains("roomcut") ? value["roomcut"] : value).at("provenance"));
  } catch (const Json::exception& error) {
    throw StageError(errors::kArtefactDamaged, path.string(),
                     std::string("has no provenance: ") + error.what());
  }
}

std::string recompute_payload_sha256(const std::filesystem::path& path) {
  if (kind_of(path) != Kind::kHdf5) {
    return json_payload_sha256(read_text_file(path));
  }
  const Handle file = h5::open_for_reading(path);
  Visitor visitor{file.get(), {}, {}};
  if (!file.valid()) {
    throw StageError(errors::kArtefactDamaged, path.string(),
                     "cannot be opened as HDF5: " + h5::last_error());
  }
  if (H5Ovisit(file.get(), H5_INDEX_NAME, H5_ITER_INC, visit, &visitor) < 0) {
    throw StageError(errors::kArtefactDamaged, path.string(), "cannot be read: " + visitor.trouble);
  }
  return visitor.digest.hex();
}

}  // namespace roomcut
