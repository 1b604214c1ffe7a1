// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/geometry/line2.h"

namespace roomcut {

/// A surface that bounds an opening (a jamb, or the head) and the points that prove it.
struct OpeningProof {
  std::uint32_t points = 0;  ///< on the surface, between the two faces of the wall
  double spread = 0;         ///< share of the jamb's height, or the head's width, with points on it, 0 … 1
  double sigma_m = 0;        ///< standard deviation of its position [m]
};

/// An opening through a wall between two rooms, from the floor up: a box between the wall's two faces.
/// Local metres.
struct Opening {
  std::string id;              ///< "o0001"; unique
  std::string wall_a, wall_b;  ///< wall ids of the wall's two faces
  Vec2 jamb_a, jamb_b;         ///< where the jambs meet the middle of the wall; both stand across a -> b
  double thickness_m = 0;      ///< of the wall, in the middle of the opening
  double sill_z = 0, head_z = 0;
  OpeningProof proof_a, proof_b, proof_head;  ///< of jamb_a, jamb_b and the head

  double width() const { return (jamb_b - jamb_a).norm(); }
  double height() const { return head_z - sill_z; }
};

/// The content of one openings.geojson.
struct Openings {
  Frame frame;
  std::string cells_payload_sha256;  ///< of the cells.h5 whose walls they pierce
  std::vector<Opening> openings;     ///< sorted by id
};

/// Where an opening lies as the file holds it: in the scan's own coordinates, rounded to 6 decimals, heights
/// in the middle of the opening.
struct OpeningPlace {
  Vec2 jamb_a, jamb_b;
  double sill_z = 0, head_z = 0;
};
OpeningPlace place_in_scan(const Opening& opening, const Frame& frame);
/// The other way: fills the places of `opening`.
void set_place(Opening& opening, const OpeningPlace& place, const Frame& frame);

/// Rounded as the file holds them, jamb_a the one with the lesser x there, then y. Coordinates stay local.
Openings normalised_openings(Openings openings);

}  // namespace roomcut
