// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/tools/report/pictures.h"
#include "tests/unit/report/count.h"

namespace roomcut::report {
namespace {

/// Two squares of 1 m side by side, one layer of 2 m.
CellComplex two_squares() {
  CellComplex complex;
  complex.levels = {0, 2};
  complex.vertices = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  complex.face_offset = {0, 4, 8};
  complex.face_vertex = {0, 1, 4, 5, 1, 2, 3, 4};
  complex.face_edge = {0, 1, 2, 3, 4, 5, 6, 1};
  complex.edges = {{0, 1, 0, -1, -1}, {1, 4, 0, 1, 0},   {4, 5, 0, -1, -1}, {5, 0, 0, -1, -1},
                   {1, 2, 1, -1, -1}, {2, 3, 1, -1, -1}, {3, 4, 1, -1, -1}};
  complex.lines = {{"w0001", line_through({1, 0}, {1, 1}), 0, 1, {}}};
  return complex;
}

Labels first_is_empty() {
  Labels labels;
  labels.label = {1, 0};
  labels.margin_m3 = {1, 1};
  labels.unobserved = {0, 0};
  return labels;
}

std::string openings_of(const Opening& opening) {
  return draw_openings("find_openings", two_squares(), first_is_empty(), {opening}, 0).bytes;
}

TEST(CellPictures, captions_say_heights_of_the_scan) {
  DataTerms terms;
  terms.reset(two_squares());
  CellComplex complex = two_squares();
  complex.frame.origin[2] = 512.5;
  const Picture picture = draw_cells("graphcut", complex, terms, first_is_empty(), 0);
  EXPECT_NE(picture.title.find("512.50 m to 514.50 m"), std::string::npos) << picture.title;
}

TEST(CellPictures, walls_are_drawn_where_labels_differ_and_only_there) {
  DataTerms terms;
  terms.reset(two_squares());
  const Picture picture = draw_cells("graphcut", two_squares(), terms, first_is_empty(), 0);
  EXPECT_EQ(picture.file, "graphcut_0.svg");
  EXPECT_EQ(count(picture.bytes, "stroke=\"#141414\""), 4U);  // the four sides of the first square
  EXPECT_EQ(count(picture.bytes, "<polygon"), 2U);
}

TEST(CellPictures, the_more_covered_a_face_the_thicker_it_is) {
  FaceWeights weights;
  weights.wall_omega = {0, 1, 0, 0, 0, 0, 0.5F};
  weights.wall_points = {0, 100, 0, 0, 0, 0, 50};
  weights.cell_points = {3, 4};
  const std::string svg = draw_weights("weigh_faces", two_squares(), weights, 0).bytes;
  EXPECT_EQ(count(svg, "stroke-width=\"3.50\""), 1U);
  EXPECT_EQ(count(svg, "stroke-width=\"2.00\""), 1U);
  EXPECT_EQ(count(svg, "stroke-width=\"0.50\""), 5U);
  EXPECT_NE(svg.find("covered over 100 %, 100 points"), std::string::npos);
}

TEST(CellPictures, an_opening_is_drawn_in_the_layers_that_it_reaches) {
  Opening opening;
  opening.id = "o0001";
  opening.jamb_a = {1, 0.2};
  opening.jamb_b = {1, 0.8};
  opening.thickness_m = 0.1;
  opening.head_z = 2;
  EXPECT_GE(count(openings_of(opening), "o0001"), 1U);
  opening.sill_z = 2;
  opening.head_z = 4;
  EXPECT_EQ(count(openings_of(opening), "o0001"), 0U);
}

TEST(CellPictures, surfaces_are_drawn_by_their_distance_from_the_level) {
  LevelSurfaces surfaces;
  surfaces.surfaces = {{{0, 0}, 2.013, 0.0002, 1, 500, -1}};
  surfaces.of_face = {-1, -1, 0, -1};
  const Picture picture = draw_surfaces("fit_surfaces", two_squares(), surfaces, 1);
  EXPECT_EQ(picture.file, "fit_surfaces_1.svg");
  EXPECT_EQ(count(picture.bytes, "<polygon"), 2U);
  EXPECT_EQ(count(picture.bytes, "2.0130 m, +13.0 mm from its level; sigma 0.2 mm"), 1U) << picture.bytes;
}

TEST(CellPictures, the_partition_names_its_lines) {
  const Picture picture = draw_partition("final_partition", two_squares());
  EXPECT_EQ(picture.file, "final_partition.svg");
  EXPECT_EQ(count(picture.bytes, "<title>w0001</title>"), 1U);
}

}  // namespace
}  // namespace roomcut::report
