// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <map>
#include <string>

#include "common/artefact/h5.h"

/// What the HDF5 reader, writer and inspector share; not for stages.
namespace roomcut::h5 {

/// Silences the library's own error printing, in this thread, and its clean-up at exit; cheap after the first
/// call. To be called wherever a thread may meet the library for the first time.
void prepare_library();

/// The deepest entry of the library's error stack, e.g. "No space left on device"; never empty.
std::string last_error();

/// "/levels/z" for "levels/z"; "/" for "" and "/".
std::string absolute_path(const std::string& path);

/// Attributes of scalar type only: float64, int64, fixed-length UTF-8 text. Return false or an invalid handle
/// on failure.
bool write_text_attribute(hid_t object, const std::string& name, const std::string& value);
bool write_number_attribute(hid_t object, const std::string& name, double value);
bool write_number_attribute(hid_t object, const std::string& name, std::int64_t value);
/// Three float64: the one vector that artefacts have as attribute, the frame's origin.
bool write_vector_attribute(hid_t object, const std::string& name, const double (&value)[3]);
bool read_vector_attribute(hid_t object, const std::string& name, double (&value)[3]);
bool read_text_attribute(hid_t object, const std::string& name, std::string& value);
bool read_number_attribute(hid_t object, const std::string& name, double& value);
bool read_number_attribute(hid_t object, const std::string& name, std::int64_t& value);

/// "f32", "i64", "u8" …; "" for types that no artefact uses.
std::string type_name(hid_t type);

/// Opens an existing file for reading, or gives an invalid handle.
Handle open_for_reading(const std::filesystem::path& path);

/// One line per dataset and attribute of the payload; the digest is taken over them in sorted order.
class PayloadDigest {
 public:
  void dataset(const std::string& path, const std::string& type, const Shape& shape,
               const std::string& sha256);
  void attribute(const std::string& object_path, const std::string& name, double value);
  void attribute(const std::string& object_path, const std::string& name, std::int64_t value);
  void attribute(const std::string& object_path, const std::string& name, const std::string& value);
  void attribute(const std::string& object_path, const std::string& name, const double (&value)[3]);
  std::string hex() const;

 private:
  std::map<std::string, std::string> entries_;
};

}  // namespace roomcut::h5
