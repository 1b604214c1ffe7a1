// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/scene_limits.h"

#include <algorithm>
#include <sstream>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan.h"

namespace roomcut::synthesize {

namespace {

using namespace scene_limits;

class Checker {
 public:
  explicit Checker(const Scene& scene) : scene_(scene) {}

  void check() {
    check_counts();
    check_rooms();
    if (!problems_.empty()) refuse_scene(problems_);
  }

 private:
  void at_most(const std::string& what, double count, double most, const char* hint) {
    if (count <= most) return;
    std::ostringstream text;
    text << what << ": " << count << ", at most " << most << " can be made";
    problems_.push_back({errors::kSceneInvalid, scene_.name, text.str(), hint});
  }

  void check_counts() {
    constexpr const char* kFewer = "describe a part of the building; copies of it are made by \"repeat\"";
    const auto items = [&](const char* what, std::size_t count) {
      at_most(what, static_cast<double>(count), static_cast<double>(kItems), kFewer);
    };
    items("rooms", scene_.rooms.size());
    items("doors", scene_.doors.size());
    items("windows", scene_.windows.size());
    items("furniture", scene_.furniture.size());
    items("shafts", scene_.shafts.size());
    std::size_t columns = 0;
    std::size_t niches = 0;
    for (const SceneRoom& room : scene_.rooms) {
      columns += room.columns.size();
      niches += room.niches.size();
    }
    items("columns", columns);
    items("niches", niches);
    items("sampling.stations", scene_.sampling.stations.size());
    const double each =
        static_cast<double>(scene_.rooms.size() + scene_.doors.size() + scene_.windows.size());
    at_most("rooms, doors and windows of all copies",
            each * scene_.repeat.x * scene_.repeat.y * scene_.repeat.storeys, kCopies,
            "lower repeat.x, repeat.y or repeat.storeys");
  }

  void check_rooms() {
    std::size_t corners = 0;
    double all_m2 = 0;
    double all_clutter = 0;
    for (const SceneShaft& shaft : scene_.shafts) corners += shaft.polygon.size();
    for (const SceneRoom& room : scene_.rooms) {
      corners += room.polygon.size();
      for (const SceneColumn& column : room.columns) corners += column.polygon.size();
      if (room.polygon.empty()) continue;
      Vec2 lo = room.polygon[0];
      Vec2 hi = lo;
      for (const Vec2& p : room.polygon) {
        lo = lo.cwiseMin(p);
        hi = hi.cwiseMax(p);
      }
      const double box_m2 = (hi - lo).prod();
      const double clutter = doubled_area(room.polygon) / 2 * scene_.clutter_per_m2;
      const std::string name = std::string("room \"").append(shown(room.name)).append("\": ");
      at_most(name + "m^2 of the box around it", box_m2, kRoom_m2,
              "give its corners in metres, or divide it");
      at_most(name + "boxes of furniture", clutter, kRoomClutter, "lower clutter_per_m2");
      all_m2 += box_m2;
      all_clutter += clutter;
    }
    at_most("m^2 of the boxes around all rooms", all_m2, kAllRooms_m2,
            "describe a part of the building; copies of it are made by \"repeat\"");
    at_most("boxes of furniture in all rooms", all_clutter, kAllClutter, "lower clutter_per_m2");
    at_most("corners of all plans", static_cast<double>(corners), static_cast<double>(kAllCorners),
            "give arcs fewer segments");
  }

  const Scene& scene_;
  std::vector<Problem> problems_;
};

}  // namespace

void check_limits(const Scene& scene) {
  Checker(scene).check();
}

std::string shown(const std::string& text) {
  constexpr std::size_t kMost = 60;
  return text.size() <= kMost ? text : text.substr(0, kMost).append("…");
}

void refuse_scene(std::vector<Problem> problems) {
  if (problems.size() > kProblems) {
    const std::size_t more = problems.size() - kProblems;
    problems.resize(kProblems);
    problems.push_back({errors::kSceneInvalid, "the scene", std::to_string(more) + " more problems",
                        "correct those above first"});
  }
  throw StageError(std::move(problems));
}

}  // namespace roomcut::synthesize
