// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/comparable.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "common/errors/codes.h"

namespace roomcut::evaluate {

namespace {

struct Unit {
  double per_metre;
  const char* name;
  const char* remedy;
};
constexpr std::array<Unit, 4> kUnits = {{{1000, "millimetres", "with UNIT=mm"},
                                         {100, "centimetres", "with UNIT=cm"},
                                         {39.3701, "inches", "after converting it"},
                                         {3.28084, "feet", "with UNIT=ft"}}};
constexpr double kUnitTolerance = 0.1;  ///< of the ratio: a model errs, and may lack a part
constexpr double kLargestRatio = 100;   ///< of the diagonals

std::string text(const char* format, double value) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

std::string text(const Vec3& p, const char* between) {
  return text("%.6g", p.x()) + between + text("%.6g", p.y()) + between + text("%.6g", p.z());
}

std::string described(const Bounds3& box) {
  return text(box.hi - box.lo, " x ") + " m around (" + text(0.5 * (box.lo + box.hi), ", ") + ")";
}

/// The unit of which `larger` has as many as `smaller` has metres, along every axis; nullptr = none.
const Unit* likely_unit(const Bounds3& larger, const Bounds3& smaller) {
  for (const Unit& unit : kUnits) {
    const Eigen::Array3d scaled = (smaller.hi - smaller.lo).array() * unit.per_metre;
    const Eigen::Array3d off = ((larger.hi - larger.lo).array() - scaled).abs();
    if ((off <= kUnitTolerance * scaled).all()) {
      return &unit;
    }
  }
  return nullptr;
}

bool meet(const Bounds3& a, const Bounds3& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

}  // namespace

void require_comparable(const NamedBox& model, const NamedBox& truth) {
  const double model_m = model.box.diagonal();
  const double truth_m = truth.box.diagonal();
  const NamedBox& larger = model_m > truth_m ? model : truth;
  const NamedBox& smaller = model_m > truth_m ? truth : model;
  const double ratio = larger.box.diagonal() / smaller.box.diagonal();
  const Unit* unit = likely_unit(larger.box, smaller.box);
  if (unit == nullptr && ratio <= kLargestRatio && meet(model.box, truth.box)) {
    return;
  }
  std::string what = "does not fit " + smaller.name + ": ";
  std::string hint = "are both of one building and in one frame? Coordinates count as metres";
  if (unit != nullptr) {
    what += text("%.4g", ratio) + " times as large along all axes";
    hint = larger.name + " is probably in " + unit->name +
           ": convert it to metres, or, where it was made of a scan, run that scan " + unit->remedy +
           " (unless " + smaller.name + " is the one that was made with a wrong UNIT)";
  } else if (ratio > kLargestRatio) {
    what += text("%.4g", ratio) + " times as large";
  } else {
    what += "they do not meet";
    hint = "move one of them: both must be in the frame of the scan" +
           std::string(" (UTM against local coordinates? x and y swapped? another building?)");
  }
  throw StageError(errors::kMeshesUnlike, larger.name,
                   what + "; " + described(larger.box) + " against " + described(smaller.box), hint);
}

}  // namespace roomcut::evaluate
