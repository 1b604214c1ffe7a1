// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/artefact/atomic_file.h"
#include "common/artefact/provenance.h"
#include "common/artefact/sha256.h"
#include "common/artefact/types.h"

namespace roomcut {

namespace h5 {

/// Owns one HDF5 identifier; closed by the matching H5?close.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }
  void reset();
  /// Like reset(); false when the library could not close it. It is not tried again.
  bool try_close();

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// File type of T, little-endian (char/bool are not supported: use uint8_t). Defined for
/// (u)int8_t … (u)int64_t, float, double.
template <class T>
hid_t file_type();
/// Memory type of T.
template <class T>
hid_t memory_type();

#define ROOMCUT_H5_TYPE(T) \
  template <>              \
  hid_t file_type<T>();    \
  template <>              \
  hid_t memory_type<T>();
ROOMCUT_H5_TYPE(std::int8_t)
ROOMCUT_H5_TYPE(std::uint8_t)
ROOMCUT_H5_TYPE(std::int16_t)
ROOMCUT_H5_TYPE(std::uint16_t)
ROOMCUT_H5_TYPE(std::int32_t)
ROOMCUT_H5_TYPE(std::uint32_t)
ROOMCUT_H5_TYPE(std::int64_t)
ROOMCUT_H5_TYPE(std::uint64_t)
ROOMCUT_H5_TYPE(float)
ROOMCUT_H5_TYPE(double)
#undef ROOMCUT_H5_TYPE

/// "f32", "i64", "u8" …
template <class T>
std::string number_name() {
  return (std::is_floating_point_v<T> ? "f"
          : std::is_signed_v<T>       ? "i"
                                      : "u") +
         std::to_string(8 * sizeof(T));
}

using Shape = std::vector<std::uint64_t>;  ///< e.g. {N} or {N, 3}; row-major

class Content;

}  // namespace h5

/// Writes an HDF5 artefact: root attributes, /frame, /provenance, datasets with `unit` and `description`.
/// Object times are off and versions default, so equal content gives equal bytes. Not thread-safe.
/// Every function throws StageError(kCannotWrite) when the file system refuses.
class H5Writer {
 public:
  H5Writer(const std::filesystem::path& path, ArtefactType type, const Provenance& provenance,
           const Frame& frame);
  ~H5Writer();

  /// Writes a whole dataset; parent groups are made. `path` like "levels/z". Empty data are allowed (shape
  /// {0,…}). `unit`: "m", "m^2", "rad", "1" for pure numbers and indices.
  template <class T>
  void write(const std::string& path, std::span<const T> data, const h5::Shape& shape, std::string_view unit,
             std::string_view description) {
    write_raw(path, data.data(), data.size(), h5::memory_type<T>(), h5::file_type<T>(), sizeof(T), shape,
              unit, description);
  }
  template <class T>
  void write(const std::string& path, const std::vector<T>& data, std::string_view unit,
             std::string_view description) {
    write(path, std::span<const T>(data), {data.size()}, unit, description);
  }

  /// Begins a dataset of `shape` that is filled by append() in order, in blocks: nothing is held back in
  /// memory. With `checksum_column` the caller writes the table of its blocks' checksums (h5_blocks.h), and
  /// the payload digest covers that instead of the bytes.
  template <class T>
  void begin(const std::string& path, const h5::Shape& shape, std::string_view unit,
             std::string_view description, std::optional<std::int64_t> checksum_column = {}) {
    begin_raw(path, h5::memory_type<T>(), h5::file_type<T>(), sizeof(T), shape, unit, description);
    if (checksum_column) {
      sum_blocks(path, *checksum_column);
    }
  }
  template <class T>
  void append(const std::string& path, std::span<const T> data) {
    append_raw(path, data.data(), data.size(), sizeof(T));
  }

  void attribute(const std::string& object_path, const std::string& name, double value);
  void attribute(const std::string& object_path, const std::string& name, std::int64_t value);
  void attribute(const std::string& object_path, const std::string& name, const std::string& value);

  /// Completes /provenance with the payload digest, closes and publishes the file. When the file that stands
  /// there has the same payload digest, the new one takes over its modification time. Returns whether the
  /// payload is new.
  bool commit();

 private:
  struct Stream;
  struct State;
  void write_raw(const std::string& path, const void* data, std::size_t count, hid_t memory_type,
                 hid_t file_type, std::size_t size, const h5::Shape& shape, std::string_view unit,
                 std::string_view description);
  void begin_raw(const std::string& path, hid_t memory_type, hid_t file_type, std::size_t size,
                 const h5::Shape& shape, std::string_view unit, std::string_view description);
  void append_raw(const std::string& path, const void* data, std::size_t count, std::size_t size);
  void sum_blocks(const std::string& path, std::int64_t checksum_column);
  std::unique_ptr<State> state_;
};

/// Reads an HDF5 artefact. The constructor checks that the file is one, of this type, of a version it can
/// read, and that what it holds has the payload digest that it states (datasets whose blocks have checksums:
/// those; check each block with BlockChecksums as it is read). Nothing but what was checked can be asked for.
/// Errors: kArtefactMissing, kArtefactDamaged, kArtefactType, kArtefactVersion; the message names file and
/// object. Reading is thread-safe.
class H5Reader {
 public:
  H5Reader(const std::filesystem::path& path, ArtefactType expected);
  ~H5Reader();
  H5Reader(H5Reader&&) noexcept;

  /// The whole dataset, flattened row-major; checks that it holds this very type, and that the number of
  /// dimensions and the sizes fit `shape` when given (0 = any size).
  template <class T>
  std::vector<T> read(const std::string& path, const h5::Shape& shape = {}) const {
    const h5::Shape actual = checked_shape(path, shape);
    std::size_t count = 1;
    for (const auto n : actual) count *= n;
    require_type<T>(path);
    std::vector<T> data(count);
    read_raw(path, data.data(), 0, actual[0]);
    return data;
  }
  /// Rows [first, first+count) of a dataset into `out` (count × inner sizes elements).
  template <class T>
  void read_rows(const std::string& path, std::uint64_t first, std::uint64_t count, T* out) const {
    require_type<T>(path);
    read_raw(path, out, first, count);
  }
  /// Throws kArtefactDamaged unless the dataset holds numbers of type T.
  template <class T>
  void require_type(const std::string& path) const {
    require_type(path, h5::number_name<T>());
  }
  void require_type(const std::string& path, const std::string& type) const;
  h5::Shape shape(const std::string& path) const { return checked_shape(path, {}); }
  bool exists(const std::string& path) const;
  /// Where the dataset's bytes begin in the file: contiguous, little-endian, never compressed. Throws
  /// kArtefactDamaged when there are none.
  std::uint64_t contiguous_offset(const std::string& path) const;
  double attribute_double(const std::string& object_path, const std::string& name) const;
  std::int64_t attribute_int(const std::string& object_path, const std::string& name) const;
  std::string attribute_string(const std::string& object_path, const std::string& name) const;

  const Frame& frame() const;
  const Provenance& provenance() const;
  const std::string& payload_sha256() const;
  const std::filesystem::path& path() const;
  /// All that the file holds (h5_content.h).
  const h5::Content& content() const;
  /// kArtefactDamaged with this file's name.
  [[noreturn]] void damaged(const std::string& object_path, const std::string& what) const;

 private:
  struct State;
  h5::Shape checked_shape(const std::string& path, const h5::Shape& expected) const;
  void read_raw(const std::string& path, void* out, std::uint64_t first, std::uint64_t count) const;
  std::unique_ptr<State> state_;
};

/// The provenance of an artefact of any type. Errors as H5Reader.
Provenance read_provenance(const std::filesystem::path& path);

/// What an HDF5 artefact or a plain JSON one states of itself, after all that it holds was compared with its
/// digest and its blocks' checksums. (Any artefact: common/artefact_digest.) Errors as H5Reader.
InputRecord verified_plain_artefact(const std::filesystem::path& path);

/// The payload digest stored in an artefact of any type (HDF5, or JSON with a `provenance` member), its type
/// and version, without reading the data; for any other file the digest of its bytes, with type "".
InputRecord inspect_artefact(const std::filesystem::path& path);

/// What an artefact of any type states of itself, from the file as it is now; empty for any other file, and
/// for an HDF5 file whose structure is damaged. Throws kArtefactMissing.
InputRecord stated_artefact(const std::filesystem::path& path);

}  // namespace roomcut
