// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "common/artefact/json_values.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

namespace {

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json share(double part, double whole) {
  return whole > 0 ? Json(part / whole) : Json(nullptr);
}

Json deviation_json(const Deviation& d, double diagonal_m) {
  const double percent = 100 / diagonal_m;
  return {{"hausdorff_m", d.max}, {"hausdorff_pct", percent * d.max},
          {"mean_m", d.mean},     {"mean_pct", percent * d.mean},
          {"rms_m", d.rms},       {"rms_pct", percent * d.rms},
          {"p95_m", d.p95},       {"p95_pct", percent * d.p95}};
}

Deviation larger(const Deviation& a, const Deviation& b) {
  return {std::max(a.max, b.max), std::max(a.mean, b.mean), std::max(a.rms, b.rms), std::max(a.p95, b.p95)};
}

Json isprs_json(const IsprsScore& score) {
  return {{"completeness", or_null(score.completeness)},
          {"correctness", or_null(score.correctness)},
          {"accuracy_m", or_null(score.accuracy_m)}};
}

Json check_json(const MeshCheck& check) {
  return {
      {"valid", check.valid()},
      {"watertight", check.closed()},
      {"oriented", check.oriented()},
      {"manifold", check.manifold()},
      {"self_intersections", check.self_intersections < 0 ? Json(nullptr) : Json(check.self_intersections)},
      {"degenerate_triangles", check.degenerate_triangles},
      {"open_edges", check.open_edges},
      {"nonmanifold_edges", check.nonmanifold_edges},
      {"nonmanifold_vertices", check.nonmanifold_vertices},
      {"components", check.components},
      {"euler", check.euler},
      {"triangles", check.triangles},
      {"vertices", check.vertices},
      {"area_m2", check.area_m2},
      {"volume_m3", check.volume_m3}};
}

Json compared_json(const ComparedVolumes& v) {
  return {{"iou", v.iou()},         {"recall", v.recall()},   {"precision", v.precision()},
          {"truth_m3", v.truth_m3}, {"model_m3", v.model_m3}, {"common_m3", v.common_m3}};
}

Json volume_json(const Scores& scores) {
  if (!scores.volume) {
    return nullptr;
  }
  const VolumeScores& v = *scores.volume;
  Json out = compared_json(v);
  out["seen"] = compared_json(v.seen);
  out["ignored_m3"] = v.ignored_m3;
  out["unknown_m3"] = v.unknown_m3;
  out["unknown_in_truth_m3"] = v.unknown_in_truth_m3;
  return out;
}

Json unentered_json(const UnenteredScores& unentered) {
  Json out = {{"volume_m3", unentered.volume_m3},
              {"empty_m3", unentered.empty_m3},
              {"unknown_m3", unentered.unknown_m3},
              {"denied_m3", unentered.denied_m3()}};
  for (std::size_t answer = 0; answer < kRoomAnswers.size(); ++answer) {
    out[kRoomAnswers[answer]] = unentered.rooms[answer];
  }
  return out;
}

Json rooms_json(const Scores& scores) {
  if (!scores.volume) {
    return nullptr;
  }
  Json list = Json::array();
  for (const RoomScore& room : scores.rooms) {
    list.push_back({{"name", room.room.name},
                    {"volume_m3", room.volume_m3},
                    {"empty_in_model", share(room.empty_m3, room.volume_m3)},
                    {"found", room.found()},
                    {"unknown_in_model", share(room.unknown_m3, room.volume_m3)},
                    {"answer", kRoomAnswers[static_cast<std::size_t>(room.answer)]},
                    {"floor_off_m", or_null(room.heights.floor_off_m)},
                    {"ceiling_off_m", or_null(room.heights.ceiling_off_m)},
                    {"scanned", room.room.scanned}});
  }
  return {{"truth", scores.rooms.size()},
          {"found", scores.found()},
          {"missed", scores.rooms.size() - scores.found()},
          {"merged", scores.in_merged_groups()},
          {"merged_groups", scores.merged},
          {"unentered", unentered_json(scores.unentered())},
          {"list", list}};
}

Json thin_json(const Scores& scores) {
  if (!scores.volume) {
    return nullptr;
  }
  const ThinWallScores& thin = scores.thin;
  Json pairs = Json::array();
  for (const ThinWallScores::Pair& pair : thin.pairs) {
    pairs.push_back({{"rooms", {pair.a, pair.b}},
                     {"area_m2", pair.area_m2},
                     {"kept", 1 - pair.missing_m2 / pair.area_m2}});
  }
  return {{"walls_m2", thin.wall_m2},
          {"walls_kept", share(thin.wall_kept_m2, thin.wall_m2)},
          {"slabs_m2", thin.slab_m2},
          {"slabs_kept", share(thin.slab_kept_m2, thin.slab_m2)},
          {"pairs", pairs}};
}

Json columns_json(const Scores& scores) {
  if (!scores.columns) {
    return nullptr;
  }
  const ColumnScores& columns = *scores.columns;
  Json list = Json::array();
  for (const ColumnScores::Column& column : columns.columns) {
    list.push_back({{"size_m", column.size_m}, {"solid_in_model", column.solid}, {"found", column.found()}});
  }
  return {{"truth", columns.columns.size()},
          {"found", columns.found()},
          {"false", columns.false_pillars},
          {"floor_m2", columns.floor_m2},
          {"list", list}};
}

Json niches_json(const NicheScores& niches) {
  Json list = Json::array();
  for (const NicheScores::Niche& niche : niches.niches) {
    list.push_back({{"width_m", niche.width_m},
                    {"depth_m", niche.depth_m},
                    {"pilaster", niche.solid},
                    {"area_m2", niche.area_m2},
                    {"within_2cm", share(niche.near_m2, niche.area_m2)}});
  }
  return {{"truth", niches.niches.size()},
          {"area_m2", niches.area_m2()},
          {"within_2cm", share(niches.near_m2(), niches.area_m2())},
          {"list", list}};
}

Json arcs_json(const Scores& scores) {
  if (!scores.arcs) {
    return nullptr;
  }
  const ArcScores& arcs = *scores.arcs;
  Json list = Json::array();
  for (const ArcScores::Arc& arc : arcs.arcs) {
    list.push_back({{"radius_m", arc.radius_m},
                    {"found", arc.found},
                    {"radius_error_m", arc.found ? Json(arc.radius_error_m) : Json(nullptr)},
                    {"centre_error_m", arc.found ? Json(arc.centre_error_m) : Json(nullptr)}});
  }
  return {{"truth", arcs.arcs.size()},
          {"found", arcs.found()},
          {"false", arcs.false_arcs},
          {"close", arcs.close()},
          {"precision", or_null(arcs.precision())},
          {"recall", or_null(arcs.recall())},
          {"f1", or_null(arcs.f1())},
          {"list", list}};
}

Json slopes_json(const SlopeScores& slopes) {
  return {{"area_m2", slopes.area_m2},
          {"angle_median_deg", or_null(slopes.angle_median_deg)},
          {"angle_p95_deg", or_null(slopes.angle_p95_deg)},
          {"within_1deg_2cm", or_null(slopes.matched)}};
}

Json scores_json(const Scores& scores) {
  Json isprs = Json::array();
  for (const Scores::Isprs& at : scores.isprs) {
    isprs.push_back({{"buffer_m", at.buffer_m},
                     {"walls", isprs_json(at.walls)},
                     {"horizontals", isprs_json(at.horizontals)}});
  }
  return {{"diagonal_m", scores.diagonal_m},
          {"distance",
           {{"model_to_truth", deviation_json(scores.model_to_truth, scores.diagonal_m)},
            {"truth_to_model", deviation_json(scores.truth_to_model, scores.diagonal_m)},
            {"symmetric",
             deviation_json(larger(scores.model_to_truth, scores.truth_to_model), scores.diagonal_m)}}},
          {"volume", volume_json(scores)},
          {"mesh", check_json(scores.model_check)},
          {"truth_mesh", check_json(scores.truth_check)},
          {"isprs", isprs},
          {"walls_within_1deg_2cm", or_null(scores.walls_matched)},
          {"walls_within_1_5deg_4cm", or_null(scores.walls_loosely_matched)},
          {"horizontals_within_1deg_2cm", or_null(scores.horizontals_matched)},
          {"horizontals_within_1deg_5mm", or_null(scores.horizontals_finely_matched)},
          {"slopes", slopes_json(scores.slopes)},
          {"columns", columns_json(scores)},
          {"niches", niches_json(scores.niches)},
          {"arcs", arcs_json(scores)},
          {"rooms", rooms_json(scores)},
          {"thin", thin_json(scores)},
          {"explanation", scores.explanation ? explanation_json(*scores.explanation, scores) : Json(nullptr)},
          {"sampling",
           {{"sample_spacing_m", scores.sample_spacing_m},
            {"model_samples", scores.model_samples},
            {"truth_samples", scores.truth_samples},
            {"column_spacing_m", scores.volume ? Json(scores.column_spacing_m) : Json(nullptr)}}}};
}

}  // namespace

void write_scores(const std::filesystem::path& path, const Scores& scores, const Provenance& provenance) {
  write_json_artefact(path, artefacts::kScores, provenance, Frame{}, scores_json(scores));
}

}  // namespace roomcut::evaluate
