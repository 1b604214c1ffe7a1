// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// What the `random` block of a scene asks for.
struct FamilySpec {
  std::string family = "office";  ///< one of family_names()
  std::uint64_t seed = 1;
  int storeys = 0;     ///< 0 = the family's own range
  int rooms = 0;       ///< per storey, about; 0 = the family's own range
  bool doors = true;   ///< a way into every room, and some more doors
  bool shafts = true;  ///< stairwells between the storeys
  double unscanned =
      0;  ///< share of the rooms that no scanner enters; each has a door to one that is entered
  std::vector<std::string> elements;  ///< some of element_names()
};

const std::vector<std::string>& family_names();

/// Adds a random building to `scene`: storeys, rooms, doors, shafts, windows. The floor plan is split
/// recursively; walls, heights and doors are drawn from the family's ranges. At
/// last the elements are added. Deterministic in the spec alone.
void add_random_building(const FamilySpec& spec, Scene& scene);

}  // namespace roomcut::synthesize
