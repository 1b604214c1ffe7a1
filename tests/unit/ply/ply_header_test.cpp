// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/ply/ply_header.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

const std::string kHeader =
    "ply\nformat binary_big_endian 1.0\ncomment station 1 2 3\nobj_info anything\nelement camera 2\n"
    "property double f\nelement vertex 18446744073709551615\nproperty float x\nproperty uchar red\n"
    "property list ushort int32 seen_by\nend_header\n";

/// The line that is wrong, 0 = none is, and what is.
std::pair<std::size_t, std::string> fault(const std::string& text) {
  try {
    parse_ply_header(text);
    return {0, ""};
  } catch (const PlyHeaderError& error) {
    return {error.line, error.what()};
  }
}

/// kHeader with other words in the place of some.
std::string with(const std::string& words, const std::string& others) {
  std::string text = kHeader;
  return text.replace(text.find(words), words.size(), others);
}

TEST(PlyHeader, SaysWhatTheFileHolds) {
  const auto header = parse_ply_header(kHeader + "\n\n");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format, PlyFormat::kBigEndian);
  EXPECT_EQ(header->comments, (std::vector<std::string>{"station 1 2 3"}));
  EXPECT_EQ(header->data_offset, kHeader.size());
  EXPECT_EQ(header->lines, 11U);
  ASSERT_EQ(header->elements.size(), 2U);
  EXPECT_EQ(header->vertex, 1U);
  const PlyElement& vertex = header->elements[1];
  EXPECT_EQ(vertex.count, UINT64_MAX);
  ASSERT_EQ(vertex.properties.size(), 3U);
  EXPECT_EQ(vertex.properties[1].type, ScalarType::kUint8);
  EXPECT_TRUE(vertex.properties[2].is_list);
  EXPECT_EQ(vertex.properties[2].count_type, ScalarType::kUint16);
  EXPECT_EQ(vertex.smallest_record(), 4U + 1U + 2U);
  EXPECT_TRUE(vertex.has_list());
  EXPECT_FALSE(header->elements[0].has_list());
}

TEST(PlyHeader, LinesMayEndInAnyOfTheThreeWays) {
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    std::string text;
    for (const char c : kHeader) text += c == '\n' ? end : std::string(1, c);
    const auto header = parse_ply_header(text + "\n");  // the first byte of the data
    ASSERT_TRUE(header);
    EXPECT_EQ(header->data_offset, text.size());
    EXPECT_EQ(header->lines, 11U);
  }
}

TEST(PlyHeader, OneThatIsCutOffAnywhereHasNoEndAndIsNotWrong) {
  for (std::size_t size = 0; size + 1 < kHeader.size(); ++size) {
    EXPECT_FALSE(parse_ply_header(kHeader.substr(0, size))) << size;
  }
  EXPECT_TRUE(parse_ply_header(kHeader.substr(0, kHeader.size() - 1)));
}

TEST(PlyHeader, WhateverIsWrongIsNamedWithItsLine) {
  using Fault = std::pair<std::size_t, std::string>;
  EXPECT_EQ(fault(kHeader), (Fault{0, ""}));
  EXPECT_EQ(fault(with("binary_big_endian", "binary")), (Fault{2, "unknown format 'binary'"}));
  EXPECT_EQ(fault(with("format binary_big_endian 1.0\n", "")), (Fault{10, "there is no format line"}));
  EXPECT_EQ(fault(with("obj_info", "object")), (Fault{4, "unknown keyword 'object'"}));
  EXPECT_EQ(fault(with("element camera 2\n", "")), (Fault{5, "a property before the first element"}));
  for (const char* count : {"-1", "2x", "1e3", "", "99999999999999999999"}) {
    EXPECT_EQ(fault(with("camera 2", std::string("camera ") + count)),
              (Fault{5, std::string("'") + count + "' is no count of elements"}));
  }
  EXPECT_EQ(fault(with("float x", "real x")), (Fault{8, "unknown type 'real'"}));
  EXPECT_EQ(fault(with("float x", "float")), (Fault{8, "a property without a name"}));
  EXPECT_EQ(fault(with("list ushort", "list float")), (Fault{10, "the length of a list must be an integer"}));
  EXPECT_EQ(fault(with("list ushort int32 seen_by", "list")), (Fault{10, "unknown type ''"}));
  EXPECT_EQ(fault(with("element vertex", "element point")), (Fault{11, "there is no element 'vertex'"}));
}

}  // namespace
}  // namespace roomcut
