// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <charconv>
#include <utility>

#include "common/artefact/h5_detail.h"

namespace roomcut::h5 {

static_assert(std::endian::native == std::endian::little,
              "artefacts are little-endian and hashed as they lie in memory");

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = other.id_;
    close_ = other.close_;
    other.id_ = -1;
  }
  return *this;
}

void Handle::reset() {
  try_close();
}

bool Handle::try_close() {
  const hid_t id = std::exchange(id_, -1);
  return id < 0 || close_ == nullptr || close_(id) >= 0;
}

#define ROOMCUT_H5_TYPE(T, FILE_TYPE, MEMORY_TYPE) \
  template <>                                      \
  hid_t file_type<T>() {                           \
    return FILE_TYPE;                              \
  }                                                \
  template <>                                      \
  hid_t memory_type<T>() {                         \
    return MEMORY_TYPE;                            \
  }
ROOMCUT_H5_TYPE(std::int8_t, H5T_STD_I8LE, H5T_NATIVE_INT8)
ROOMCUT_H5_TYPE(std::uint8_t, H5T_STD_U8LE, H5T_NATIVE_UINT8)
ROOMCUT_H5_TYPE(std::int16_t, H5T_STD_I16LE, H5T_NATIVE_INT16)
ROOMCUT_H5_TYPE(std::uint16_t, H5T_STD_U16LE, H5T_NATIVE_UINT16)
ROOMCUT_H5_TYPE(std::int32_t, H5T_STD_I32LE, H5T_NATIVE_INT32)
ROOMCUT_H5_TYPE(std::uint32_t, H5T_STD_U32LE, H5T_NATIVE_UINT32)
ROOMCUT_H5_TYPE(std::int64_t, H5T_STD_I64LE, H5T_NATIVE_INT64)
ROOMCUT_H5_TYPE(std::uint64_t, H5T_STD_U64LE, H5T_NATIVE_UINT64)
ROOMCUT_H5_TYPE(float, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT)
ROOMCUT_H5_TYPE(double, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE)
#undef ROOMCUT_H5_TYPE

void prepare_library() {
  // Without this the library tries again at exit to flush a file that the disk refused, and never comes to an
  // end.
  static const bool kNoRetry = H5dont_atexit() >= 0;
  // A thread-safe library keeps an error stack, and whether it is printed, for each thread.
  thread_local const bool kSilent = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  static_cast<void>(kNoRetry);
  static_cast<void>(kSilent);
}

std::string last_error() {
  std::string text;
  const auto deepest = [](unsigned /*depth*/, const H5E_error2_t* entry, void* data) -> herr_t {
    auto& out = *static_cast<std::string*>(data);
    if (out.empty() && entry->desc != nullptr) {
      out = entry->desc;
    }
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, deepest, &text);
  return text.empty() ? "HDF5 gives no reason" : text;
}

std::string absolute_path(const std::string& path) {
  return path.empty() || path.front() != '/' ? "/" + path : path;
}

namespace {

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), length > 0 ? length : 1);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

bool write_attribute(hid_t object, const std::string& name, hid_t file, hid_t memory, const void* value,
                     hsize_t count = 0) {
  const Handle space(count == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), file, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), memory, value) >= 0;
}

}  // namespace

bool write_text_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size());
  return write_attribute(object, name, type.get(), type.get(), value.c_str());
}
bool write_number_attribute(hid_t object, const std::string& name, double value) {
  return write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}
bool write_number_attribute(hid_t object, const std::string& name, std::int64_t value) {
  return write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

bool write_vector_attribute(hid_t object, const std::string& name, const std::array<double, 3>& value) {
  return write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, value.data(), 3);
}
void PayloadDigest::dataset(const std::string& path, const std::string& type, const Shape& shape,
                            const std::string& sha256) {
  std::string text = type;
  for (const std::uint64_t n : shape) {
    text += " " + std::to_string(n);
  }
  entries_["d " + path] = text + " " + sha256;
}
namespace {

std::string hex_text(double value) {
  std::array<char, 40> text{};
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::hex).ptr};
}

}  // namespace

void PayloadDigest::attribute(const std::string& object_path, const std::string& name, double value) {
  entries_["a " + object_path + " " + name] = "f64 " + hex_text(value);
}
void PayloadDigest::attribute(const std::string& object_path, const std::string& name,
                              const std::array<double, 3>& value) {
  entries_["a " + object_path + " " + name] =
      "f64 3 " + hex_text(value[0]) + " " + hex_text(value[1]) + " " + hex_text(value[2]);
}
void PayloadDigest::attribute(const std::string& object_path, const std::string& name, std::int64_t value) {
  entries_["a " + object_path + " " + name] = "i64 " + std::to_string(value);
}
void PayloadDigest::attribute(const std::string& object_path, const std::string& name,
                              const std::string& value) {
  entries_["a " + object_path + " " + name] = "text " + sha256_hex(value);
}
std::string PayloadDigest::hex() const {
  Sha256 sha;
  for (const auto& [key, value] : entries_) {
    sha.update(key + "\t" + value + "\n");
  }
  return sha.hex();
}

}  // namespace roomcut::h5
