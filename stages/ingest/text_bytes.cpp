// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_bytes.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace roomcut::ingest {

namespace {

constexpr std::size_t kLooked = 1 << 18;
constexpr std::size_t kHead = 64;

/// Whether every second byte, from `first` on, is 0 and no other is.
bool alternates(std::string_view head, std::size_t first) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    if ((head[i] == '\0') != (i % 2 == first)) {
      return false;
    }
  }
  return head.size() >= 8;
}

}  // namespace

TextBytes::TextBytes(std::shared_ptr<const ScanBytes> file) : file_(std::move(file)) {
  find_encoding();
  size_ = (file_->size() - begin_) / width_;
  returns_end_lines_ = has_lone_returns();
}

void TextBytes::find_encoding() {
  std::string head(kHead, '\0');
  head.resize(file_->read(0, head.data(), head.size()));
  if (head.starts_with("\xef\xbb\xbf")) {
    begin_ = 3;
  } else if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) {
    begin_ = 2;
    width_ = 2;
    big_endian_ = head.front() == '\xfe';
  } else if (alternates(head, 1) || alternates(head, 0)) {
    width_ = 2;
    big_endian_ = head.front() == '\0';
  }
}

bool TextBytes::has_lone_returns() const {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(size_, kLooked)), '\0');
  text.resize(read(0, text.data(), text.size()));
  for (std::size_t i = text.find('\r'); i != std::string::npos; i = text.find('\r', i + 1)) {
    // "\r\r\n" is what some programs make of "\r\n".
    if (i + 1 < text.size() && text[i + 1] != '\n' && text[i + 1] != '\r') {
      return true;
    }
  }
  return false;
}

std::size_t TextBytes::read_wide(std::uint64_t offset, char* out, std::size_t bytes) const {
  thread_local std::vector<unsigned char> units;
  constexpr std::size_t kAtOnce = 1 << 18;
  std::size_t done = 0;
  while (done < bytes) {
    units.resize(2 * std::min(kAtOnce, bytes - done));
    const std::size_t got = file_->read(begin_ + 2 * (offset + done), units.data(), units.size()) / 2;
    for (std::size_t i = 0; i < got; ++i) {
      const unsigned char low = units[2 * i + (big_endian_ ? 1 : 0)];
      const unsigned char high = units[2 * i + (big_endian_ ? 0 : 1)];
      out[done + i] = high == 0 && low < 128 ? static_cast<char>(low) : '?';
    }
    done += got;
    if (2 * got < units.size()) {
      break;
    }
  }
  return done;
}

std::size_t TextBytes::read(std::uint64_t offset, void* out, std::size_t bytes) const {
  if (offset >= size_) {
    return 0;
  }
  bytes = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, size_ - offset));
  auto* const characters = static_cast<char*>(out);
  const std::size_t got =
      width_ == 2 ? read_wide(offset, characters, bytes) : file_->read(begin_ + offset, characters, bytes);
  if (returns_end_lines_) {
    std::replace(characters, characters + got, '\r', '\n');
  }
  return got;
}

}  // namespace roomcut::ingest
