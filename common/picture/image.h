// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace roomcut {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// An RGB picture, rows from top to bottom. Pixels outside are ignored by set().
class Image {
 public:
  Image(int width, int height, Colour background = {255, 255, 255});
  int width() const { return width_; }
  int height() const { return height_; }
  void set(int x, int y, Colour colour) {
    if (x >= 0 && y >= 0 && x < width_ && y < height_) {
      row(y)[x] = colour;
    }
  }
  void fill(Colour colour);
  Colour get(int x, int y) const { return row(y)[x]; }
  Colour* row(int y) {
    return reinterpret_cast<Colour*>(bytes_.data()) + static_cast<std::size_t>(y) * width_;
  }
  const Colour* row(int y) const {
    return reinterpret_cast<const Colour*>(bytes_.data()) + static_cast<std::size_t>(y) * width_;
  }
  std::span<const Colour> pixels() const {
    return {row(0), static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)};
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t>
      bytes_;  ///< red, green, blue of each pixel: filled ten times as fast as colours are
};

/// Two rows of 2 width pixels become one of half the size: each pixel is the mean of 2 × 2. Drawing at double
/// size and halving smooths edges.
void halve_rows(const Colour* upper, const Colour* lower, int width, Colour* out);

/// How a PNG file holds its pixels.
enum class PngPixels {
  kRgb,      ///< red, green, blue: for rasters that other programs compute with
  kSmallest  ///< with a palette when the picture has no more than 256 colours: a third of the bytes to
             ///< compress
};

/// The bytes of a PNG file (libpng, no time stamp: equal pictures give equal bytes).
std::vector<std::uint8_t> encode_png(const Image& image, PngPixels pixels = PngPixels::kSmallest);

/// Publishes a PNG file whole or not at all. Throws StageError(kCannotWrite).
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace roomcut
