// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <array>
#include <map>
#include <string>

#include "common/artefact/h5.h"

/// What the HDF5 writer and readers share; not for stages.
namespace roomcut::h5 {

/// Silences the library's own error printing, in this thread, and its clean-up at exit; cheap after the first
/// call. To be called wherever a thread may meet the library for the first time.
void prepare_library();

/// The deepest entry of the library's error stack, e.g. "No space left on device"; never empty.
std::string last_error();

/// "/levels/z" for "levels/z"; "/" for "" and "/".
std::string absolute_path(const std::string& path);

/// Attributes: float64, int64, fixed-length UTF-8 text; three float64 for the one vector that artefacts have,
/// the frame's origin. Return false on failure.
bool write_text_attribute(hid_t object, const std::string& name, const std::string& value);
bool write_number_attribute(hid_t object, const std::string& name, double value);
bool write_number_attribute(hid_t object, const std::string& name, std::int64_t value);
bool write_vector_attribute(hid_t object, const std::string& name, const std::array<double, 3>& value);

/// One line per dataset and attribute of the payload; the digest is taken over them in sorted order.
class PayloadDigest {
 public:
  void dataset(const std::string& path, const std::string& type, const Shape& shape,
               const std::string& sha256);
  void attribute(const std::string& object_path, const std::string& name, double value);
  void attribute(const std::string& object_path, const std::string& name, std::int64_t value);
  void attribute(const std::string& object_path, const std::string& name, const std::string& value);
  void attribute(const std::string& object_path, const std::string& name, const std::array<double, 3>& value);
  std::string hex() const;

 private:
  std::map<std::string, std::string> entries_;
};

}  // namespace roomcut::h5
