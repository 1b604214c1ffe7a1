// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "common/sloped_planes/planes_io.h"

namespace roomcut::testing {

inline constexpr double kEast = 512000.25, kNorth = 5400123.5, kHigh = 250;

inline SlopedPlane plane_through(const Vec2& gradient, double c, std::vector<Vec2> outline, bool ceiling) {
  SlopedPlane plane;
  plane.gradient = gradient;
  plane.c = c;
  plane.outline = std::move(outline);
  plane.area_m2 = 20;
  plane.rms_m = 0.004;
  plane.ceiling = ceiling;
  return plane;
}

/// A gable roof of 8 × 6 m over knees of 2.5 m, and a ramp; a frame far from the origin.
inline AcceptedPlanes gable() {
  AcceptedPlanes base;
  base.frame.origin[0] = kEast;
  base.frame.origin[1] = kNorth;
  base.frame.origin[2] = kHigh;
  base.bbox_min = {0, 0};
  base.bbox_max = {8, 6};
  base.levels = {{0, 0, 0, 40, 40}, {3.1, 3.1, 3.1, 0, 0, false, true}, {5, 5, 5, 0, 0, true}};
  const auto add = [&](const char* id, SlopedPlane plane) {
    PlaneFeature feature;
    feature.id = id;
    feature.plane = std::move(plane);
    base.planes.push_back(std::move(feature));
  };
  add("p0001", plane_through({0, 0.5}, 2.5, {{0, 0}, {8, 0}, {8, 3}, {0, 3}}, true));
  add("p0002", plane_through({0, -0.5}, 5.5, {{0, 3}, {8, 3}, {8, 6}, {0, 6}}, true));
  add("p0003", plane_through({0.1, 0}, 0, {{2, 1}, {6, 1}, {6, 2}, {2, 2}}, false));
  return normalised_planes(base);
}

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("roomcut_planes_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

inline Provenance provenance() {
  return {"accept_planes", 1, "{}", "", {}};
}

/// planes.geojson of gable(), as JSON to be changed.
inline nlohmann::json document() {
  const Folder folder;
  write_planes_file(folder / "planes.geojson", gable(), provenance());
  return nlohmann::json::parse(text_of(folder / "planes.geojson"));
}

/// What the door makes of an edit.
inline PlanesFile edited_text(const std::string& text) {
  const Folder folder;
  std::ofstream(folder / "edit.geojson") << text;
  return read_edited_planes(folder / "edit.geojson", gable());
}
inline PlanesFile edited(const nlohmann::json& document) {
  return edited_text(document.dump(3));
}

/// A feature drawn by hand: a ring in the scan's coordinates, from local ones.
inline nlohmann::json drawn(const std::vector<Vec2>& corners, const nlohmann::json& properties) {
  nlohmann::json ring = nlohmann::json::array();
  for (const Vec2& p : corners) ring.push_back({p.x() + kEast, p.y() + kNorth});
  return {{"type", "Feature"},
          {"properties", properties},
          {"geometry", {{"type", "Polygon"}, {"coordinates", nlohmann::json::array({ring})}}}};
}

inline const PlaneFeature& plane_named(const PlanesFile& file, const std::string& id) {
  for (const PlaneFeature& plane : file.content.planes) {
    if (plane.id == id) return plane;
  }
  throw std::runtime_error("no plane " + id);
}

}  // namespace roomcut::testing
