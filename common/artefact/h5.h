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

using Shape = std::vector<std::uint64_t>;  ///< e.g. {N} or {N, 3}; row-major

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
  /// memory.
  template <class T>
  void begin(const std::string& path, const h5::Shape& shape, std::string_view unit,
             std::string_view description) {
    begin_raw(path, h5::memory_type<T>(), h5::file_type<T>(), sizeof(T), shape, unit, description);
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
  std::unique_ptr<State> state_;
};

/// Reads an HDF5 artefact. The constructor checks that the file is one, of this type, of a version it can
/// read. Errors: kArtefactMissing, kArtefactDamaged, kArtefactType, kArtefactVersion; the message names file
/// and object.
class H5Reader {
 public:
  H5Reader(const std::filesystem::path& path, ArtefactType expected);
  ~H5Reader();
  H5Reader(H5Reader&&) noexcept;

  /// The whole dataset, flattened row-major; checks that the number of dimensions and the inner sizes fit
  /// `shape` when given (0 = any size).
  template <class T>
  std::vector<T> read(const std::string& path, const h5::Shape& shape = {}) const {
    const h5::Shape actual = checked_shape(path, shape);
    std::size_t count = 1;
    for (const auto n : actual) count *= n;
    std::vector<T> data(count);
    if (count > 0) read_raw(path, data.data(), h5::memory_type<T>(), 0, actual.empty() ? 1 : actual[0]);
    return data;
  }
  /// Rows [first, first+count) of a dataset into `out` (count × inner sizes elements).
  template <class T>
  void read_rows(const std::string& path, std::uint64_t first, std::uint64_t count, T* out) const {
    read_raw(path, out, h5::memory_type<T>(), first, count);
  }
  h5::Shape shape(const std::string& path) const { return checked_shape(path, {}); }
  bool exists(const std::string& path) const;
  /// Where the dataset's bytes begin in the file: contiguous, little-endian, never compressed, so that a
  /// reader of a big cloud may use pread from several threads. Throws kArtefactDamaged when the dataset is
  /// chunked or has no bytes.
  std::uint64_t contiguous_offset(const std::string& path) const;
  double attribute_double(const std::string& object_path, const std::string& name) const;
  std::int64_t attribute_int(const std::string& object_path, const std::string& name) const;
  std::string attribute_string(const std::string& object_path, const std::string& name) const;

  const Frame& frame() const;
  const Provenance& provenance() const;
  const std::string& payload_sha256() const;
  const std::filesystem::path& path() const;
  /// kArtefactDamaged with this file's name.
  [[noreturn]] void damaged(const std::string& object_path, const std::string& what) const;

 private:
  struct State;
  h5::Shape checked_shape(const std::string& path, const h5::Shape& expected) const;
  void read_raw(const std::string& path, void* out, hid_t memory_type, std::uint64_t first,
                std::uint64_t count) const;
  std::unique_ptr<State> state_;
};

/// The provenance of an artefact of any type. Errors as H5Reader.
Provenance read_provenance(const std::filesystem::path& path);

/// The payload digest computed again from everything that the file holds except its provenance: HDF5
/// artefacts and plain JSON ones (wall_lines.geojson has its own: wall_lines_payload_sha256()). Reads all
/// data. Errors as H5Reader.
std::string recompute_payload_sha256(const std::filesystem::path& path);

/// The payload digest stored in an artefact of any type (HDF5, or JSON with a `provenance` member), its type
/// and version, without reading the data; for any other file the digest of its bytes, with type "".
InputRecord inspect_artefact(const std::filesystem::path& path);

}  // namespace roomcut
