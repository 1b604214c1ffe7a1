// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <variant>

#include "common/artefact/h5_detail.h"
#include "common/artefact/h5_parser.h"

/// What the HDF5 readers share; not for stages.
namespace roomcut::h5 {

/// A file open for reading; closed with the object.
class Descriptor {
 public:
  /// Errors: kArtefactMissing with the system's reason.
  explicit Descriptor(const std::filesystem::path& path);
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  int get() const { return id_; }

 private:
  int id_;
};

/// Everything that a file holds, found in one walk, so that nothing is read that the digest did not cover.
/// The walk refuses (kArtefactDamaged, naming the object) what no artefact has: other types of numbers, texts
/// that are not UTF-8, datasets that are chunked, compressed, in other files or longer than the file; nothing
/// is allocated for them.
class Content {
 public:
  /// With `expected` another type or version is refused first (check_type_and_version()).
  explicit Content(const std::filesystem::path& path, const ArtefactType* expected = nullptr);

  const std::map<std::string, StoredObject>& objects() const { return objects_; }
  /// Errors: kArtefactDamaged when there is none.
  const StoredDataset& dataset(const std::string& object_path) const;
  /// Likewise.
  template <class T>
  const T& attribute(const std::string& object_path, const std::string& name) const {
    const auto found = objects_.find(absolute_path(object_path));
    if (found != objects_.end()) {
      const auto value = found->second.attributes.find(name);
      if (value != found->second.attributes.end() && std::holds_alternative<T>(value->second)) {
        return std::get<T>(value->second);
      }
    }
    lacks_attribute(object_path, name);
  }

  /// Bytes [first, first + count) of a dataset. Thread-safe.
  void read(const std::string& object_path, const StoredDataset& dataset, std::uint64_t first,
            std::uint64_t count, void* out) const;

  /// The payload digest of what the file holds. Datasets with checksums for each block (h5_blocks.h) enter
  /// with those, not with their bytes.
  std::string payload_sha256() const;

  /// Type, version and payload digest as stated in the file; empty where they are missing.
  InputRecord stated() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void lacks_attribute(const std::string& object_path, const std::string& name) const;
  std::string sha256_of(const std::string& object_path, const StoredDataset& dataset) const;

  std::filesystem::path path_;
  Descriptor file_;
  std::map<std::string, StoredObject> objects_;
};

/// A text attribute of an object; "" when there is none.
std::string text_of(const StoredObject& object, const std::string& name);

/// Attribute of a dataset whose blocks have checksums: its column in the table of them.
inline constexpr const char* kChecksumColumn = "checksum_column";
/// What such a dataset has in place of its own digest in the payload's.
inline constexpr const char* kByChecksums = "by checksums";

}  // namespace roomcut::h5
