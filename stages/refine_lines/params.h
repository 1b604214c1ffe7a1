// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "common/params/params.h"

namespace roomcut::refine_lines {

struct RefineLinesParams {
  bool enabled = true;
  double min_interface_m2 = 0.2;
  double one_sided_m2 = 3;
  std::optional<double> band_m;  ///< auto: max(6 cm, 5 noise)
  double bin_m = 0.1;
  double regularity_rad = 0.1 * std::numbers::pi / 180;
  std::optional<double> merge_m;  ///< auto: max(1.5 cm, 1.2 noise)
  std::optional<double> split_m;  ///< auto: max(5 mm, noise / 2)
  double merge_angle_rad = 0.6 * std::numbers::pi / 180;
  std::string edited_lines = "prior";
};

/// The block `refine_lines` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(RefineLinesParams& p) {
  return {
      boolean("enabled", p.enabled, "Refine the lines; false passes them through: the paper's single pass."),
      number(
          "min_interface_m2", p.min_interface_m2, "m^2", 0, 100,
          "Detected lines with less surface between empty and solid cells are dropped from the second pass."),
      number("one_sided_m2", p.one_sided_m2, "m^2", 0, 1000,
             "A wall of which this much was seen from one side gets its unseen face, one usual thickness "
             "behind."),
      auto_number("band_m", p.band_m, "m", 0.005, 0.5,
                  "Half width of the band around a line whose points are observed.", "max(6 cm, 5 x noise)"),
      number("bin_m", p.bin_m, "m", 0.01, 1, "Length of line that gives one observation."),
      angle("regularity_deg", p.regularity_rad, 0, 5,
            "How exactly walls of one direction (mod 90 deg) are taken to be parallel; 0 switches it off."),
      auto_number("merge_m", p.merge_m, "m", 0, 0.2, "Refined lines of one face closer than this become one.",
                  "max(1.5 cm, 1.2 x noise)"),
      auto_number("split_m", p.split_m, "m", 0, 0.2,
                  "Walls on one line that differ by more, and measurably so, become lines of their own.",
                  "max(5 mm, noise / 2)"),
      angle("merge_angle_deg", p.merge_angle_rad, 0, 5, "Lines that differ by more are never merged."),
      choice("edited_lines", p.edited_lines, {"prior", "locked", "free"},
             "Lines drawn or moved by hand: held near (2 cm, 1 deg), held exactly, or treated like detected "
             "ones."),
  };
}

}  // namespace roomcut::refine_lines
