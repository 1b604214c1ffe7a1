// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/svg.h"

#include <openssl/evp.h>

#include <array>
#include <charconv>

#include "common/picture/colour_map.h"

namespace roomcut {

namespace {

/// Two decimals, whatever the locale.
std::string fixed(double value) {
  std::array<char, 352> text{};  // the longest number there is
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 2).ptr;
  return {text.data(), end};
}

std::string title_element(std::string_view title) {
  return title.empty() ? "/>\n" : "><title>" + escaped(title) + "</title>";
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

Svg::Svg(Eigen::Vector2d low, Eigen::Vector2d high, double pixels_per_metre)
    : low_(std::move(low)), high_(std::move(high)), scale_(pixels_per_metre) {}

Eigen::Vector2d Svg::to_page(const Eigen::Vector2d& p) const {
  return {scale_ * (p.x() - low_.x()), scale_ * (high_.y() - p.y())};
}

void Svg::line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Colour colour, double width_px,
               std::string_view title) {
  const Eigen::Vector2d p = to_page(a), q = to_page(b);
  body_ += "<line x1=\"" + fixed(p.x()) + "\" y1=\"" + fixed(p.y()) + "\" x2=\"" + fixed(q.x()) + "\" y2=\"" +
           fixed(q.y()) + "\" stroke=\"" + hex(colour) + "\" stroke-width=\"" + fixed(width_px) + "\"" +
           title_element(title);
  body_ += title.empty() ? "" : "</line>\n";
}

void Svg::polygon(std::span<const Eigen::Vector2d> corners, Colour fill, double opacity,
                  std::string_view title) {
  body_ += "<polygon points=\"";
  for (const auto& corner : corners) {
    const Eigen::Vector2d p = to_page(corner);
    body_ += fixed(p.x()) + "," + fixed(p.y()) + " ";
  }
  body_ += "\" fill=\"" + hex(fill) + "\" fill-opacity=\"" + fixed(opacity) + "\"" + title_element(title);
  body_ += title.empty() ? "" : "</polygon>\n";
}

void Svg::rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Colour fill, double opacity) {
  const Eigen::Vector2d top_left = to_page({low.x(), high.y()});
  body_ += "<rect x=\"" + fixed(top_left.x()) + "\" y=\"" + fixed(top_left.y()) + "\" width=\"" +
           fixed(scale_ * (high.x() - low.x())) + "\" height=\"" + fixed(scale_ * (high.y() - low.y())) +
           "\" fill=\"" + hex(fill) + "\" fill-opacity=\"" + fixed(opacity) + "\"/>\n";
}

void Svg::circle(const Eigen::Vector2d& centre, double radius_px, Colour fill) {
  const Eigen::Vector2d p = to_page(centre);
  body_ += "<circle cx=\"" + fixed(p.x()) + "\" cy=\"" + fixed(p.y()) + "\" r=\"" + fixed(radius_px) +
           "\" fill=\"" + hex(fill) + "\"/>\n";
}

void Svg::text(const Eigen::Vector2d& at, std::string_view words, double size_px, Colour colour) {
  const Eigen::Vector2d p = to_page(at);
  body_ += "<text x=\"" + fixed(p.x()) + "\" y=\"" + fixed(p.y()) + "\" font-size=\"" + fixed(size_px) +
           "\" font-family=\"sans-serif\" fill=\"" + hex(colour) + "\">" + escaped(words) + "</text>\n";
}

void Svg::image(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Image& picture) {
  const Eigen::Vector2d top_left = to_page({low.x(), high.y()});
  body_ +=
      "<image x=\"" + fixed(top_left.x()) + "\" y=\"" + fixed(top_left.y()) + "\" width=\"" +
      fixed(scale_ * (high.x() - low.x())) + "\" height=\"" + fixed(scale_ * (high.y() - low.y())) +
      "\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64," +
      base64(encode_png(picture)) + "\"/>\n";
}

void Svg::open(std::string_view tag, std::string_view attributes) {
  body_.append("<").append(tag).append(attributes.empty() ? "" : " ").append(attributes).append(">\n");
}

void Svg::close(std::string_view tag) {
  body_.append("</").append(tag).append(">\n");
}

std::string Svg::str() const {
  const Eigen::Vector2d size = scale_ * (high_ - low_);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(size.x()) + "\" height=\"" +
         fixed(size.y()) + "\" viewBox=\"0 0 " + fixed(size.x()) + " " + fixed(size.y()) + "\">\n" + body_ +
         "</svg>\n";
}

}  // namespace roomcut
