// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/page_block.h"

#include <bit>
#include <cstring>

namespace roomcut::report {

static_assert(std::endian::native == std::endian::little, "the page's arrays are little-endian");

namespace {

constexpr std::size_t kAlignment = 8;

std::size_t aligned(std::size_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

void PageBlockBuilder::add_bytes(const std::string& array, const char* type, std::size_t count,
                                 std::string_view bytes) {
  arrays_.push_back({array, type, std::string(bytes), count});
}

PageBlock PageBlockBuilder::finish() const {
  // Offsets count from the end of the head, whose length they would otherwise change.
  Json head = facts;
  head["arrays"] = Json::object();
  std::size_t offset = 0;
  for (const Array& array : arrays_) {
    head["arrays"][array.name] = {array.type, array.count, offset};
    offset = aligned(offset + array.bytes.size());
  }
  const std::string text = lossy_json(head);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  bytes += text;
  bytes.resize(aligned(bytes.size()), '\0');
  for (const Array& array : arrays_) {
    bytes += array.bytes;
    bytes.resize(aligned(bytes.size()), '\0');
  }
  return {name_, bytes};
}

}  // namespace roomcut::report
