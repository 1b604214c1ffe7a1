// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "common/picture/image.h"

namespace roomcut {

/// A drawing in metres with y up, written as SVG: y is flipped once, here; one metre is `pixels_per_metre`
/// user units.
class Svg {
 public:
  /// The box that is shown [m].
  Svg(Eigen::Vector2d low, Eigen::Vector2d high, double pixels_per_metre);

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Colour colour, double width_px,
            std::string_view title = "");
  /// Filled; `opacity` 0 … 1. `title` is shown by browsers when the pointer rests on it.
  void polygon(std::span<const Eigen::Vector2d> corners, Colour fill, double opacity,
               std::string_view title = "");
  void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Colour fill, double opacity = 1);
  void circle(const Eigen::Vector2d& centre, double radius_px, Colour fill);
  void text(const Eigen::Vector2d& at, std::string_view words, double size_px, Colour colour);
  /// A raster that fills the box [low, high], row 0 at the top.
  void image(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Image& picture);

  /// What is drawn until close() is inside an element: open("g", "opacity=\"0.5\"").
  void open(std::string_view tag, std::string_view attributes);
  void close(std::string_view tag);

  /// The whole document; also valid inside an HTML page.
  std::string str() const;

 private:
  Eigen::Vector2d to_page(const Eigen::Vector2d& p) const;
  Eigen::Vector2d low_, high_;
  double scale_;
  std::string body_;
};

/// Bytes as base64 (RFC 4648), as data: URLs want them.
std::string base64(std::span<const std::uint8_t> bytes);
/// `text` with &, <, > and quotes replaced, for SVG and HTML.
std::string escaped(std::string_view text);

}  // namespace roomcut
