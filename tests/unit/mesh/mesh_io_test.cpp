// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "common/errors/codes.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut {
namespace {

using test::box;

std::string error_id(const std::string& content, const std::string& name) {
  try {
    parse_mesh(content, name);
  } catch (const StageError& error) {
    return error.problems().front().code.id;
  }
  return "none";
}

TEST(MeshIo, PlyKeepsDoublesKindStoreyAndRegion) {
  TriangleMesh mesh = box({0.1, 0.2, 0.3}, {1.0 / 3, 2, 3});
  for (std::size_t t = 0; t < 12; ++t) {
    mesh.kind.push_back(static_cast<std::uint8_t>(t % 3));
    mesh.storey.push_back(static_cast<std::int16_t>(t % 2));
    mesh.region.push_back(static_cast<std::int32_t>(1000 * t));
  }
  const TriangleMesh back = parse_mesh(ply_bytes(mesh, {0, 0, 0}, {"a comment"}), "m.ply");
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.kind, mesh.kind);
  EXPECT_EQ(back.storey, mesh.storey);
  EXPECT_EQ(back.region, mesh.region);
}

TEST(MeshIo, OffAndObjReadBackExactlyWhatWasWritten) {
  const TriangleMesh mesh = box({0.1, -1e-17, 6123456.789012345}, {1.0 / 3, 2, 6123460});
  EXPECT_EQ(parse_mesh(off_text(mesh, {0, 0, 0}), "m.off").vertices, mesh.vertices);
  ObjGroup group{"storey_0_wall", {}};
  for (const Triangle& t : mesh.triangles) {
    group.polygons.emplace_back(t.begin(), t.end());
  }
  const TriangleMesh back = parse_mesh(obj_text(mesh.vertices, {group}, {0, 0, 0}, {"c"}), "m.obj");
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST(MeshIo, TheOriginIsAddedOnWriting) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  const Vec3 origin(500000, 6000000, 12.5);
  EXPECT_EQ(parse_mesh(ply_bytes(mesh, origin, {}), "m.ply").vertices.front(), origin);
  EXPECT_EQ(parse_mesh(off_text(mesh, origin), "m.off").vertices.front(), origin);
}

TEST(MeshIo, PolygonsOfAFileAreTriangulatedAlsoWhenConcave) {
  const std::string off =
      "OFF # with a comment\n6 1 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n\n6 0 1 2 3 4 5 255 0 0\n";
  const TriangleMesh mesh = parse_mesh(off, "l.off");
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_NEAR(surface_area(mesh), 3, 1e-12);
}

TEST(MeshIo, AsciiAndBigEndianPlyAreRead) {
  const std::string ascii =
      "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float "
      "z\r\n"
      "property uchar red\r\nelement face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n"
      "0 0 0 1\r\n1 0 0 1\r\n1 1 0 1\r\n0 1 0 1\r\n4 0 1 2 3\r\n";
  EXPECT_EQ(parse_mesh(ascii, "a.ply").triangles.size(), 2U);
  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property short z\nelement face 1\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto word = [&big](std::initializer_list<int> bytes) {
    for (const int b : bytes) big.push_back(static_cast<char>(b));
  };
  word({0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff});  // 0, 0, -1
  word({0x3f, 0x80, 0, 0, 0, 0, 0, 0, 0, 2});  // 1, 0, 2
  word({0, 0, 0, 0, 0x3f, 0x80, 0, 0, 1, 0});  // 0, 1, 256
  word({3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2});
  const TriangleMesh mesh = parse_mesh(big, "b.ply");
  EXPECT_EQ(mesh.vertices[0], Vec3(0, 0, -1));
  EXPECT_EQ(mesh.vertices[1], Vec3(1, 0, 2));
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 1, 256));
}

TEST(MeshIo, BadFilesAreFormatErrors) {
  EXPECT_EQ(error_id("", "a.ply"), "M02");
  EXPECT_EQ(error_id("solid cube", "a.stl"), "M02");
  EXPECT_EQ(error_id("OFF\n4000000000 4000000000 0\n", "a.off"), "M02");
  EXPECT_EQ(error_id("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off"), "M02");
  EXPECT_EQ(error_id("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "a.off"), "M02");
  EXPECT_EQ(error_id("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a.off"), "M02");
  EXPECT_EQ(error_id("v 0 0 0\nf 1 2 3\n", "a.obj"), "M02");
  const std::string whole = ply_bytes(box({0, 0, 0}, {1, 1, 1}), {0, 0, 0}, {});
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{60}, std::size_t{4}}) {
    EXPECT_EQ(error_id(whole.substr(0, size), "cut.ply"), "M02") << size;
  }
}

TEST(MeshIo, VerticesThatAreNoPlacesOfABuildingAreFormatErrors) {
  for (const char* far : {"1e308", "-1e308", "1e11", "inf", "nan", "600000"}) {
    EXPECT_EQ(error_id(std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 ") + far + "\n3 0 1 2\n", "a.off"), "M02")
        << far;
    EXPECT_EQ(error_id(std::string("v 0 0 0\nv 1 0 0\nv 0 1 ") + far + "\nf 1 2 3\n", "a.obj"), "M02") << far;
    EXPECT_EQ(
        error_id(std::string(
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                     "property double z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 ") +
                     far + "\n3 0 1 2\n",
                 "a.ply"),
        "M02")
        << far;
  }
  EXPECT_EQ(
      error_id("OFF\n3 1 0\n500000 5900000 40\n500001 5900000 40\n500000 5900001 40\n3 0 1 2\n", "utm.off"),
      "none");
}

TEST(MeshIo, NumbersOfAPlyThatAreNoIndicesAreFormatErrors) {
  const auto ply = [](const char* face_properties, const std::string& face,
                      const char* list = "list int double") {
    return std::string(
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element face 1\nproperty ") +
           list + " vertex_indices\n" + face_properties + "end_header\n0 0 0\n1 0 0\n0 1 0\n" + face + "\n";
  };
  EXPECT_EQ(error_id(ply("", "3 0 1 2"), "a.ply"), "none");
  EXPECT_EQ(error_id(ply("", "3 0 1 2", "list float double"), "a.ply"), "M02");
  for (const char* face : {"3 0 1 3", "3 0 1 -1", "3 0 1 1e300", "3 0 1 0.5", "1e300 0 1 2", "-3 0 1 2",
                           "2.5 0 1 2", "4000000000 0 1 2"}) {
    EXPECT_EQ(error_id(ply("", face), "a.ply"), "M02") << face;
  }
  const char* extras = "property double kind\nproperty double storey\nproperty double region\n";
  EXPECT_EQ(error_id(ply(extras, "3 0 1 2 2 -1 2147483647"), "a.ply"), "none");
  for (const char* face : {"3 0 1 2 4 0 0", "3 0 1 2 -1 0 0", "3 0 1 2 0 32768 0", "3 0 1 2 0 0 2147483648",
                           "3 0 1 2 1e308 0 0", "3 0 1 2 0.5 0 0"}) {
    EXPECT_EQ(error_id(ply(extras, face), "a.ply"), "M02") << face;
  }
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 1\nproperty list uchar float vertex_indices\nend_header\n";
  const auto floats = [](std::initializer_list<float> values) {
    std::string bytes;
    for (const float v : values) bytes.append(std::bit_cast<std::array<char, 4>>(v).data(), 4);
    return bytes;
  };
  const std::string vertices = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_EQ(error_id(head + vertices + "\3" + floats({0, 1, 2}), "a.ply"), "none");
  for (const float v : {NAN, INFINITY, -INFINITY}) {
    EXPECT_EQ(error_id(head + vertices + "\3" + floats({0, 1, v}), "nan.ply"), "M02") << v;
  }
}

TEST(MeshIo, MissingFilesAndFoldersAreUnreadable) {
  for (const char* path : {"no/such/file.ply", "/"}) {
    try {
      read_mesh(path);
      FAIL() << path;
    } catch (const StageError& error) {
      EXPECT_STREQ(error.problems().front().code.id, "M01");
    }
  }
}

}  // namespace
}  // namespace roomcut
