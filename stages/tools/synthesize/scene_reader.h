// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// One object of a scene file while it is read: typed access to its members, all problems collected, unknown
/// keys found.
class SceneNode {
 public:
  SceneNode(const nlohmann::json& value, std::string path, std::vector<Problem>& problems);
  /// Reports the members that nobody asked for.
  ~SceneNode();
  SceneNode(const SceneNode&) = delete;
  SceneNode& operator=(const SceneNode&) = delete;

  bool has(const std::string& key) const;
  double number(const std::string& key, double fallback, double lowest, double highest);
  double required_number(const std::string& key, double lowest, double highest);
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t lowest,
                       std::int64_t highest);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string choice(const std::string& key, const std::string& fallback,
                     const std::vector<std::string>& choices);
  Vec2 point(const std::string& key);
  std::vector<Vec3> points3(const std::string& key);
  /// A list of corners, `{"arc": {"through": [x,y], "to": [x,y], "segments": n}}` allowed in between; empty
  /// when wrong. `side_of_segment[i]` is the index of the listed side that side i came from.
  Polygon2 polygon(const std::string& key, std::vector<std::size_t>* side_of_segment = nullptr);
  /// The members of a list of objects; an empty list when the key is absent.
  const nlohmann::json& list(const std::string& key);
  const nlohmann::json* member(const std::string& key);

  void problem(const std::string& what, const std::string& hint = "");
  std::string path(const std::string& key) const { return path_ + "." + key; }
  std::vector<Problem>& problems() { return problems_; }

 private:
  const nlohmann::json& value_;
  std::string path_;
  std::vector<Problem>& problems_;
  std::set<std::string> used_;
};

}  // namespace roomcut::synthesize
