// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <sstream>

#include "common/picture/svg.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

namespace {

constexpr int kMargin_px = 12, kTitle_px = 16, kCaption_px = 13, kRow_px = 18;
constexpr double kLetter = 0.55;  // width of a letter over its height, on average
constexpr int kLeastWidth_px = 420;

struct Size {
  int width = 0, height = 0;
};

/// Of a PNG file: the first chunk holds it, big-endian.
Size png_size(const std::string& bytes) {
  constexpr std::size_t kWidthAt = 16;
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
      value = value * 256 + static_cast<unsigned char>(bytes.at(i));
    }
    return value;
  };
  return {number(kWidthAt), number(kWidthAt + 4)};
}

/// Of an SVG document as common/picture writes it.
Size svg_size(const std::string& document) {
  double width = 0, height = 0;
  const std::size_t at = document.find("width=\"");
  if (at == std::string::npos ||
      std::sscanf(document.c_str() + at, "width=\"%lf\" height=\"%lf\"", &width, &height) != 2) {
    return {};
  }
  return {static_cast<int>(width + 1), static_cast<int>(height + 1)};
}

/// Words in rows of at most `letters`.
std::vector<std::string> rows_of(const std::string& words, std::size_t letters) {
  std::vector<std::string> rows(1);
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    if (!rows.back().empty() && rows.back().size() + 1 + word.size() > letters) {
      rows.emplace_back();
    }
    rows.back() += (rows.back().empty() ? "" : " ") + word;
  }
  return rows;
}

std::string text_at(int y, int size, const char* colour, const std::string& words) {
  return "<text x=\"" + std::to_string(kMargin_px) + "\" y=\"" + std::to_string(y) + "\" font-size=\"" +
         std::to_string(size) + "\" font-family=\"sans-serif\" fill=\"" + colour + "\">" + escaped(words) +
         "</text>\n";
}

}  // namespace

std::string captioned(const Picture& picture) {
  const bool raster = picture.file.ends_with(".png");
  const Size size = raster ? png_size(picture.bytes) : svg_size(picture.bytes);
  const int width = std::max(size.width, kLeastWidth_px) + 2 * kMargin_px;
  const auto rows =
      rows_of(picture.caption, static_cast<std::size_t>((width - 2 * kMargin_px) / (kLetter * kCaption_px)));
  const int top = kMargin_px + kTitle_px + static_cast<int>(rows.size()) * kRow_px + kMargin_px;
  const std::string w = std::to_string(width), h = std::to_string(top + size.height + kMargin_px);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
                    "\" viewBox=\"0 0 " + w + " " + h + "\">\n<rect width=\"" + w + "\" height=\"" + h +
                    "\" fill=\"#ffffff\"/>\n";
  int y = kMargin_px + kTitle_px;
  out += text_at(y, kTitle_px, "#1f2428", picture.title);
  for (const std::string& row : rows) {
    y += kRow_px;
    out += text_at(y, kCaption_px, "#5b6770", row);
  }
  out += "<g transform=\"translate(" + std::to_string(kMargin_px) + " " + std::to_string(top) + ")\">\n";
  if (raster) {
    out += "<image width=\"" + std::to_string(size.width) + "\" height=\"" + std::to_string(size.height) +
           "\" href=\"data:image/png;base64," +
           base64({reinterpret_cast<const std::uint8_t*>(picture.bytes.data()), picture.bytes.size()}) +
           "\"/>\n";
  } else {
    out += picture.bytes;
  }
  return out + "</g>\n</svg>\n";
}

}  // namespace roomcut::report
