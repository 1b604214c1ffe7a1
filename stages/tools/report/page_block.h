// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/artefact/json_values.h"
#include "stages/tools/report/page_template.h"

namespace roomcut::report {

/// Builds one block of the page's data: a JSON object and flat arrays of numbers. In bytes: the length of the
/// JSON text (uint32), the text, then the arrays, each at a multiple of 8, all
/// little-endian. The JSON's member `arrays` tells {name: [type, count, offset behind the text]}; types are
/// u8, u16, u32, i16, i32, f32. The counterpart is page/src/data/blocks.js.
class PageBlockBuilder {
 public:
  explicit PageBlockBuilder(std::string name) : name_(std::move(name)) {}

  Json facts = Json::object();  ///< everything that is no array

  template <class T>
  void add(const std::string& array, std::span<const T> values) {
    add_bytes(array, type_of(T{}), values.size(),
              {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  template <class T>
  void add(const std::string& array, const std::vector<T>& values) {
    add(array, std::span<const T>(values));
  }

  PageBlock finish() const;

 private:
  struct Array {
    std::string name, type, bytes;
    std::size_t count;
  };
  static const char* type_of(std::uint8_t /*value*/) { return "u8"; }
  static const char* type_of(std::uint16_t /*value*/) { return "u16"; }
  static const char* type_of(std::uint32_t /*value*/) { return "u32"; }
  static const char* type_of(std::int16_t /*value*/) { return "i16"; }
  static const char* type_of(std::int32_t /*value*/) { return "i32"; }
  static const char* type_of(float /*value*/) { return "f32"; }
  void add_bytes(const std::string& array, const char* type, std::size_t count, std::string_view bytes);

  std::string name_;
  std::vector<Array> arrays_;
};

}  // namespace roomcut::report
