// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/cut_openings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "common/cells/face_locator.h"
#include "common/cells/interfaces.h"
#include "common/cells/manifold_check.h"
#include "stages/extract/cut_jambs.h"

namespace roomcut::extract {

namespace {

constexpr double kBeside_m = 0.2;  // of a wall beside a doorway the cut may empty that much with it

/// The level nearest to z when it is within kPlanSnap_m, else none.
std::optional<std::size_t> level_at(const std::vector<double>& levels, double z) {
  const auto above = std::lower_bound(levels.begin(), levels.end(), z - kPlanSnap_m);
  if (above != levels.end() && *above <= z + kPlanSnap_m) {
    return static_cast<std::size_t>(above - levels.begin());
  }
  return std::nullopt;
}

/// Adds sills and heads as levels. Returns the old layer of every new one.
std::vector<std::size_t> add_levels(CellComplex& complex, const std::vector<Opening>& openings) {
  const std::vector<double> old = complex.levels;
  for (const Opening& opening : openings) {
    for (const double z : {opening.sill_z, opening.head_z}) {
      if (z > old.front() && z < old.back() && !level_at(complex.levels, z)) {
        complex.levels.insert(std::upper_bound(complex.levels.begin(), complex.levels.end(), z), z);
      }
    }
  }
  std::vector<std::size_t> layer_of;
  for (std::size_t k = 0; k + 1 < complex.levels.size(); ++k) {
    const auto above = std::upper_bound(old.begin(), old.end(), complex.levels[k]);
    layer_of.push_back(static_cast<std::size_t>(above - old.begin()) - 1);
  }
  return layer_of;
}

/// Tries the openings on the refined complex. Closes in `closed` what the cut had emptied of an accepted one.
class Opener {
 public:
  Opener(const CellComplex& complex, Labels& closed)
      : complex_(complex), closed_(closed.label), label_(closed.label), check_(complex) {}

  /// Opens it when it fits; else says why not.
  std::string try_open(const Opening& opening, std::int32_t middle_face, Passage& passage) {
    const auto a = line_index(complex_, opening.wall_a);
    const auto b = line_index(complex_, opening.wall_b);
    const auto sill = level_at(complex_.levels, opening.sill_z);
    const auto head = level_at(complex_.levels, opening.head_z);
    if (!a || !b || !sill || !head || *sill >= *head || middle_face < 0) {
      return "it lies in no wall";
    }
    passage.opening = opening;
    Flood flood{*a, *b, *sill, *head, complex_.layers(), {middle_face}, {middle_face}};
    while (!flood.open.empty()) {
      const std::int32_t face = flood.open.back();
      flood.open.pop_back();
      for (const std::int32_t e : complex_.edges_of(static_cast<std::size_t>(face))) {
        if (std::string why = cross(opening, face, e, flood, passage); !why.empty()) {
          return why;
        }
      }
    }
    if (!flood.side_a || !flood.side_b) {
      return "it does not reach through the wall";
    }
    return fit(flood, passage);
  }

 private:
  /// The faces of the plan inside an opening, as found so far.
  struct Flood {
    std::int32_t line_a, line_b;
    std::size_t sill, head, top;  ///< levels; top: of the wall beside the jambs
    std::set<std::int32_t> faces;
    std::vector<std::int32_t> open;  ///< whose edges have not been crossed
    bool side_a = false, side_b = false;
    std::set<std::int32_t> beside = {};  ///< of the wall beside a jamb: what the cut emptied there, too
  };

  /// Goes on through an edge of a face inside the opening, or finds its border there. Says why it does not
  /// fit.
  std::string cross(const Opening& opening, std::int32_t face, std::int32_t e, Flood& flood,
                    Passage& passage) const {
    const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(e)];
    const std::int32_t other = edge.across(face);
    if (other < 0 || edge.line < 0) {
      return "it reaches the bounding box";
    }
    const bool face_a = edge.line == flood.line_a;
    if (face_a || edge.line == flood.line_b) {
      (face_a ? flood.side_a : flood.side_b) = true;
      (face_a ? passage.cell_a : passage.cell_b) = complex_.cell(static_cast<std::size_t>(other), flood.sill);
      return all(other, flood.sill, flood.head, Label::kEmpty) ? "" : "there is no room on one side";
    }
    if (lies_on_jamb(opening, edge)) {
      return wall_goes_on(opening, other, flood) ? "" : "the wall does not go on beside a jamb";
    }
    if (flood.faces.insert(other).second) {
      flood.open.push_back(other);
      return inside(opening, complex_.centroid(static_cast<std::size_t>(other)))
                 ? ""
                 : "the wall's faces do not bound it";
    }
    return "";
  }

  /// Whether the wall is solid beyond a jamb, from a face there on: at once, or where the cut has emptied
  /// more of it than the opening, within kBeside_m.
  bool wall_goes_on(const Opening& opening, std::int32_t first, Flood& flood) const {
    std::vector<std::int32_t> open{first};
    while (!open.empty()) {
      const std::int32_t face = open.back();
      open.pop_back();
      if (all(face, flood.sill, flood.head, Label::kSolid)) {
        flood.top = std::min(flood.top, end_of_solid(face, flood.head));
        continue;
      }
      if (!lies_beside(opening, face)) {
        return false;
      }
      if (!flood.beside.insert(face).second) {
        continue;
      }
      for (const std::int32_t e : complex_.edges_of(static_cast<std::size_t>(face))) {
        const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(e)];
        if (edge.line == flood.line_a || edge.line == flood.line_b || lies_on_jamb(opening, edge)) continue;
        if (edge.across(face) < 0) {
          return false;
        }
        open.push_back(edge.across(face));
      }
    }
    return true;
  }

  bool all(std::int32_t face, std::size_t sill, std::size_t head, std::uint8_t label) const {
    for (std::size_t k = sill; k < head; ++k) {
      if (label_[complex_.cell(static_cast<std::size_t>(face), k)] != label) {
        return false;
      }
    }
    return true;
  }

  /// How far p lies along the opening from its first jamb, and how far from the middle of the wall.
  static std::pair<double, double> place_in_wall(const Opening& opening, const Vec2& p) {
    const Vec2 along = (opening.jamb_b - opening.jamb_a).normalized();
    const double t = along.dot(p - opening.jamb_a);
    return {t, (p - opening.jamb_a - t * along).norm()};
  }

  /// Whether p lies between the jambs and not further from their middle line than the wall may be thick.
  static bool inside(const Opening& opening, const Vec2& p) {
    const auto [t, off] = place_in_wall(opening, p);
    return t > 0 && t < opening.width() && off <= opening.thickness_m;
  }

  /// Whether a face lies in the wall and within kBeside_m of the opening.
  bool lies_beside(const Opening& opening, std::int32_t face) const {
    const FaceCorners corners = complex_.corners(static_cast<std::size_t>(face));
    return std::all_of(corners.begin(), corners.end(), [&](const Vec2& p) {
      const auto [t, off] = place_in_wall(opening, p);
      return off <= opening.thickness_m && std::max(-t, t - opening.width()) <= kBeside_m + kPlanSnap_m;
    });
  }

  /// Both ends of the edge on the plane of one jamb: the jamb's own cut, or an edge that was there before.
  bool lies_on_jamb(const Opening& opening, const CellComplex::Edge& edge) const {
    const Vec2 along = (opening.jamb_b - opening.jamb_a).normalized();
    const auto near = [&](const Vec2& jamb) {
      const double a = along.dot(complex_.vertices[static_cast<std::size_t>(edge.v0)] - jamb);
      const double b = along.dot(complex_.vertices[static_cast<std::size_t>(edge.v1)] - jamb);
      return std::max(std::abs(a), std::abs(b)) <= 2 * kPlanSnap_m;
    };
    return near(opening.jamb_a) || near(opening.jamb_b);
  }

  /// The first layer from `layer` upwards in which the face is not solid.
  std::size_t end_of_solid(std::int32_t face, std::size_t layer) const {
    while (layer < complex_.layers() && all(face, layer, layer + 1, Label::kSolid)) {
      ++layer;
    }
    return layer;
  }

  /// Empties the layers [sill, head) of the faces and closes [head, top), and of those beside them all.
  std::string fit(const Flood& flood, Passage& passage) {
    std::set<std::int32_t> faces = flood.faces;
    faces.insert(flood.beside.begin(), flood.beside.end());
    std::vector<std::size_t> touched, flipped;
    for (const std::int32_t face : faces) {
      for (std::size_t k = flood.sill; k < flood.top; ++k) {
        const std::size_t cell = complex_.cell(static_cast<std::size_t>(face), k);
        if (label_[cell] == Label::kEmpty && closed_[cell] == Label::kSolid) {
          return "it overlaps another opening";
        }
        const bool opens = k < flood.head && flood.faces.contains(face);
        touched.push_back(cell);
        if (opens) {
          passage.cells.push_back(cell);
        }
        if (label_[cell] != (opens ? Label::kEmpty : Label::kSolid)) {
          const double volume = complex_.area(static_cast<std::size_t>(face)) * complex_.height(k);
          passage.volume_m3 += opens ? volume : -volume;
          flipped.push_back(cell);
        }
      }
    }
    flip(flipped);
    if (!is_manifold(faces, flood.sill, flood.top)) {
      flip(flipped);
      return "surfaces would touch in an edge or a corner";
    }
    for (const std::size_t cell : touched) {
      closed_[cell] = Label::kSolid;
    }
    return "";
  }

  void flip(const std::vector<std::size_t>& cells) {
    for (const std::size_t cell : cells) {
      label_[cell] = label_[cell] == Label::kEmpty ? Label::kSolid : Label::kEmpty;
    }
  }

  bool is_manifold(const std::set<std::int32_t>& faces, std::size_t sill, std::size_t top) const {
    for (const std::int32_t face : faces) {
      const auto f = static_cast<std::size_t>(face);
      for (const std::int32_t vertex : complex_.vertices_of(f)) {
        for (std::size_t level = sill; level <= top; ++level) {
          if (!check_.is_manifold({static_cast<std::int32_t>(level), vertex}, label_)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  const CellComplex& complex_;
  std::vector<std::uint8_t>& closed_;
  std::vector<std::uint8_t> label_;  // with the accepted openings open
  ManifoldCheck check_;
};

/// Which cell of the old complex each cell of the refined one is a part of.
std::vector<std::size_t> whole_cells(const CellComplex& old, const CellComplex& refined,
                                     const std::vector<std::int32_t>& parent,
                                     const std::vector<std::size_t>& layer_of) {
  std::vector<std::size_t> whole;
  whole.reserve(refined.cells());
  for (std::size_t k = 0; k < refined.layers(); ++k) {
    for (std::size_t f = 0; f < refined.faces(); ++f) {
      whole.push_back(old.cell(static_cast<std::size_t>(parent[f]), layer_of[k]));
    }
  }
  return whole;
}

Labels inherited(const Labels& labels, const std::vector<std::size_t>& whole) {
  Labels result = labels;
  result.label.resize(whole.size());
  result.unobserved.resize(whole.size());
  result.margin_m3.clear();
  for (std::size_t cell = 0; cell < whole.size(); ++cell) {
    result.label[cell] = labels.label[whole[cell]];
    result.unobserved[cell] = labels.unobserved[whole[cell]];
  }
  return result;
}

}  // namespace

OpenableComplex cut_openings(const CellComplex& complex, const Labels& labels,
                             const std::vector<Opening>& openings) {
  if (openings.empty()) {
    OpenableComplex same{complex, labels, std::vector<std::size_t>(complex.cells()), {}, {}};
    std::iota(same.whole.begin(), same.whole.end(), 0);
    return same;
  }
  std::vector<std::int32_t> parent;
  OpenableComplex result{with_jambs(complex, openings, parent), {}, {}, {}, {}};
  const std::vector<std::size_t> layer_of = add_levels(result.complex, openings);
  result.whole = whole_cells(complex, result.complex, parent, layer_of);
  result.labels = inherited(labels, result.whole);
  const FaceLocator locator(result.complex);
  Opener opener(result.complex, result.labels);
  for (const Opening& opening : openings) {
    Passage passage;
    const std::string why =
        opener.try_open(opening, locator.face_at(0.5 * (opening.jamb_a + opening.jamb_b)), passage);
    if (why.empty()) {
      result.passages.push_back(std::move(passage));
    } else {
      result.refused.push_back(opening.id + ": " + why);
    }
  }
  return result;
}

void open_passages(const std::vector<Passage>& passages, Labels& labels) {
  for (const Passage& passage : passages) {
    for (const std::size_t cell : passage.cells) {
      labels.label[cell] = Label::kEmpty;
      labels.unobserved[cell] = 0;
    }
  }
}

}  // namespace roomcut::extract
