// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <string_view>

#include "common/artefact/atomic_file.h"

namespace roomcut {

static_assert(sizeof(Colour) == 3, "pixels are three bytes, one after the other");

Image::Image(int width, int height, Colour background)
    : width_(width),
      height_(height),
      bytes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(Colour)) {
  fill(background);
}

void Image::fill(Colour colour) {
  if (colour.g == colour.r && colour.b == colour.r) {
    std::fill(bytes_.begin(), bytes_.end(), colour.r);
  } else {
    std::fill_n(row(0), pixels().size(), colour);
  }
}

void halve_rows(const Colour* upper, const Colour* lower, int width, Colour* out) {
  const auto mean = [](unsigned p, unsigned q, unsigned r, unsigned s) {
    return static_cast<std::uint8_t>((p + q + r + s + 2) / 4);
  };
  for (int x = 0; x < width; ++x) {
    const Colour a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
    out[x] = {mean(a.r, b.r, c.r, d.r), mean(a.g, b.g, c.g, d.g), mean(a.b, b.b, c.b, d.b)};
  }
}

namespace {

/// A picture of few colours: each pixel names one of them.
struct IndexedPixels {
  std::vector<Colour> palette;
  std::vector<std::uint8_t> index;
};

/// No pixels when there are more than 256 colours. The palette is in the order in which colours first occur.
IndexedPixels index_colours(std::span<const Colour> pixels) {
  constexpr std::size_t kMost = 256;
  constexpr std::size_t kSlots = 1024;  // of a hash table with open addressing
  constexpr std::uint32_t kEmpty = ~0U;
  std::array<std::uint32_t, kSlots> keys{};
  std::array<std::uint8_t, kSlots> places{};
  keys.fill(kEmpty);
  IndexedPixels indexed;
  indexed.index.reserve(pixels.size());
  std::uint32_t last = kEmpty;
  std::uint8_t place = 0;
  for (const Colour colour : pixels) {
    const std::uint32_t key = std::uint32_t{colour.r} << 16 | std::uint32_t{colour.g} << 8 | colour.b;
    if (key != last) {
      std::size_t slot = key * 2654435761U >> 22;
      while (keys[slot] != key && keys[slot] != kEmpty) {
        slot = (slot + 1) % kSlots;
      }
      if (keys[slot] == kEmpty) {
        if (indexed.palette.size() == kMost) {
          return {};
        }
        keys[slot] = key;
        places[slot] = static_cast<std::uint8_t>(indexed.palette.size());
        indexed.palette.push_back(colour);
      }
      last = key;
      place = places[slot];
    }
    indexed.index.push_back(place);
  }
  return indexed;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, PngPixels pixels) {
  const IndexedPixels indexed =
      pixels == PngPixels::kSmallest ? index_colours(image.pixels()) : IndexedPixels{};
  const bool has_palette = !indexed.index.empty();
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = has_palette ? PNG_FORMAT_RGB_COLORMAP : PNG_FORMAT_RGB;
  png.colormap_entries = static_cast<png_uint_32>(indexed.palette.size());
  // The fast filters and level: a picture takes a third of the time and a tenth more room.
  png.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::uint8_t> bytes(size);
  const void* const data =
      has_palette ? static_cast<const void*>(indexed.index.data()) : image.pixels().data();
  const void* const palette = has_palette ? indexed.palette.data() : nullptr;
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, data, 0, palette) == 0) {
    const std::string why = png.message;
    if (why.find("memory") != std::string::npos) {
      throw std::bad_alloc();
    }
    throw std::runtime_error("libpng: " + why);
  }
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const auto bytes = encode_png(image);
  write_text_file(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace roomcut
