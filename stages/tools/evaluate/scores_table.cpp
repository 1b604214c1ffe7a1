// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>

#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string percent(const std::optional<double>& share) {
  return share ? format("%6.2f %%", 100 * *share) : "     – ";
}

std::string ratio(double part, double whole) {
  return percent(whole > 0 ? std::optional(part / whole) : std::nullopt);
}

std::string deviation_row(const char* name, const Deviation& d, double diagonal_m) {
  return format("  %-15s %9.4f m = %7.4f %%   %9.5f   %9.5f   %9.5f\n", name, d.max, 100 * d.max / diagonal_m,
                d.mean, d.rms, d.p95);
}

std::string isprs_row(double buffer_m, const char* name, const IsprsScore& score) {
  return format("  %3.0f cm %-12s", 100 * buffer_m, name) + percent(score.completeness) + "      " +
         percent(score.correctness) + "    " +
         (score.accuracy_m ? format("%8.5f", *score.accuracy_m) : "       –") + "\n";
}

std::string space_rows(const Scores& s) {
  if (!s.volume) {
    return "volume            none: the model is not closed\n";
  }
  std::string text = format(
      "volume            IoU %.4f  recall %.4f  precision %.4f  (truth %.2f, model %.2f m3)\n",
      s.volume->iou(), s.volume->recall(), s.volume->precision(), s.volume->truth_m3, s.volume->model_m3);
  text += format("over what was seen IoU %.4f\n", s.volume->seen.iou());
  const UnenteredScores unentered = s.unentered();
  if (unentered.volume_m3 > 0) {
    text += format("not entered       %zu rooms found, %zu unknown, %zu denied (", unentered.rooms[0],
                   unentered.rooms[1], unentered.rooms[2]) +
            ratio(unentered.denied_m3(), unentered.volume_m3) + " of their volume)\n";
  }
  if (s.volume->unknown_m3 > 0) {
    text += format("unknown           %.2f m3, %.2f of them empty in the truth\n", s.volume->unknown_m3,
                   s.volume->unknown_in_truth_m3);
  }
  text += format("rooms             %zu of %zu found, %zu in merged groups\n", s.found(), s.rooms.size(),
                 s.in_merged_groups());
  for (const RoomScore& room : s.rooms) {
    if (!room.found()) {
      text += (room.answer == RoomAnswer::kUnknown ? "  unknown         " : "  missed          ") +
              room.room.name + " (" + ratio(room.empty_m3, room.volume_m3) + " empty in the model)\n";
    }
  }
  return text + "thin structure    walls kept " + ratio(s.thin.wall_kept_m2, s.thin.wall_m2) +
         ", slabs kept " + ratio(s.thin.slab_kept_m2, s.thin.slab_m2) + "\n";
}

std::string element_rows(const Scores& s) {
  std::string text;
  if (s.slopes.angle_median_deg) {
    text += format("slopes            %.1f m2, angle off by %.2f deg (95 %%: %.2f), ", s.slopes.area_m2,
                   *s.slopes.angle_median_deg, *s.slopes.angle_p95_deg) +
            percent(s.slopes.matched) + " within 1 deg and 2 cm\n";
  }
  if (s.columns && (!s.columns->columns.empty() || s.columns->false_pillars > 0)) {
    text += format("columns           %zu of %zu found, %zu false on %.0f m2\n", s.columns->found(),
                   s.columns->columns.size(), s.columns->false_pillars, s.columns->floor_m2);
  }
  if (!s.niches.niches.empty()) {
    text += format("niches            %zu, of their faces ", s.niches.niches.size()) +
            ratio(s.niches.near_m2(), s.niches.area_m2()) + " within 2 cm\n";
  }
  return text;
}

}  // namespace

std::string scores_table(const Scores& s) {
  const std::string faults = describe_faults(s.model_check);
  std::string text = "mesh              " +
                     (s.model_check.valid() ? "closed, oriented, 2-manifold, no self-intersection" : faults) +
                     format(" (%lld triangles)\n", static_cast<long long>(s.model_check.triangles));
  text += "distance            Hausdorff                    mean m       rms m       95 % m\n";
  text += deviation_row("model to truth", s.model_to_truth, s.diagonal_m);
  text += deviation_row("truth to model", s.truth_to_model, s.diagonal_m);
  text += space_rows(s);
  text += "within 1 deg and 2 cm         walls " + percent(s.walls_matched) + ", floors and ceilings " +
          percent(s.horizontals_matched) + "\n";
  text += "within 1 deg and 5 mm         floors and ceilings " + percent(s.horizontals_finely_matched) + "\n";
  text += element_rows(s);
  text += "ISPRS within         complete      correct  accuracy m\n";
  for (const Scores::Isprs& at : s.isprs) {
    text += isprs_row(at.buffer_m, "walls", at.walls) + isprs_row(at.buffer_m, "horizontals", at.horizontals);
  }
  if (s.explanation) {
    text += explanation_rows(*s.explanation, s);
  }
  return text;
}

}  // namespace roomcut::evaluate
