// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/decoder_stream.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/errors/codes.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kCopied = 1 << 20;
constexpr std::size_t kLongestText = 1 << 16;

/// The record of kind B.
struct HeadRecord {
  std::uint64_t most_points, form;
  std::array<double, 3> scale, offset;
};

}  // namespace

std::size_t bytes_per_point(PointForm form) {
  switch (form) {
    case PointForm::kScaled:
      return 3 * sizeof(std::int32_t);
    case PointForm::kWithNormals:
      return 3 * sizeof(double) + 3 * sizeof(float);
    default:
      return 3 * sizeof(double);
  }
}

DecoderStream::DecoderStream(std::string file, const std::vector<std::string>& command)
    : file_(std::move(file)), process_(command, ChildProcess::Stream::kOutput) {}

void DecoderStream::read_head() {
  while (!begun_ && next({})) {
  }
  if (!begun_) {
    came_to_no_end();
  }
}

void DecoderStream::read_points(const TakeBytes& take) {
  while (!ended_ && next(take)) {
  }
  if (!ended_) {
    came_to_no_end();
  }
  if (const std::string how = process_.finish(); !how.empty()) {
    throw StageError(errors::kScanFormat, file_, "its decoder did not come to the end; it " + how,
                     "the file is probably damaged: copy or export it again");
  }
}

void DecoderStream::came_to_no_end() {
  process_.stop();  // what it says is no stream: it may go on with that
  const std::string how = process_.finish();
  throw StageError(errors::kScanFormat, file_,
                   "its decoder did not come to the end; it " + (how.empty() ? "stopped" : how),
                   "the file is probably damaged: copy or export it again");
}

bool DecoderStream::next(const TakeBytes& take) {
  std::byte kind{};
  std::uint64_t size = 0;
  return process_.read({&kind, 1}) == 1 &&
         process_.read(std::as_writable_bytes(std::span(&size, 1))) == sizeof size &&
         take_record(static_cast<char>(kind), size, take);
}

bool DecoderStream::take_record(char kind, std::uint64_t size, const TakeBytes& take) {
  switch (kind) {
    case 'B':
      return !begun_ && take_head(size);
    case 'S': {
      std::array<double, 3> place{};
      const bool whole = !begun_ && numbers(place, size);
      stations_.emplace_back(place[0], place[1], place[2]);
      return whole;
    }
    case 'P':
      return begun_ && copy_points(size, take);
    case 'D': {
      std::array<std::uint64_t, 2> counts{};
      const bool whole = numbers(counts, size);
      dropped_ = {counts[0], counts[1]};
      return whole;
    }
    case 'E': {
      std::array<std::uint64_t, 1> total{};
      ended_ = begun_ && numbers(total, size) && total[0] * bytes_per_point(head_.form) == point_bytes_;
      return ended_;
    }
    default:
      return take_text(kind, size);
  }
}

bool DecoderStream::take_head(std::uint64_t size) {
  std::array<HeadRecord, 1> record{};
  if (!numbers(record, size) || record[0].form > 2) {
    return false;
  }
  head_ = {record[0].most_points, static_cast<PointForm>(record[0].form), record[0].scale, record[0].offset};
  begun_ = true;
  return true;
}

bool DecoderStream::copy_points(std::uint64_t size, const TakeBytes& take) {
  const std::uint64_t point = bytes_per_point(head_.form);
  if (size % point != 0 || size / point > head_.most_points - point_bytes_ / point) {
    return false;  // more than it has said
  }
  buffer_.resize(kCopied);
  point_bytes_ += size;
  while (size > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size, kCopied));
    if (process_.read({buffer_.data(), wanted}) < wanted) {
      return false;
    }
    take({buffer_.data(), wanted});
    size -= wanted;
  }
  return true;
}

template <class T, std::size_t kCount>
bool DecoderStream::numbers(std::array<T, kCount>& values, std::uint64_t size) {
  return size == sizeof values && process_.read(std::as_writable_bytes(std::span(values))) == sizeof values;
}

bool DecoderStream::take_text(char kind, std::uint64_t size) {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(size, kLongestText)), '\0');
  if (size > kLongestText || process_.read(std::as_writable_bytes(std::span(text))) < text.size()) {
    return false;
  }
  switch (kind) {
    case 'X':
      fail(text);
    case 'N':
      notes_.push_back(text);
      return true;
    case 'W':
      warnings_.push_back(text);
      return begun_;
    case 'C':
      crs_ = text;
      return true;
    default:
      return false;
  }
}

void DecoderStream::fail(const std::string& text) const {
  const std::size_t first = text.find('\n');
  const std::size_t second = text.find('\n', first + 1);
  const std::string code = text.substr(0, first);
  for (const ErrorCode& known :
       {errors::kScanUnreadable, errors::kScanTruncated, errors::kScanNoPoints, errors::kScanFormat}) {
    if (code == known.id || known.id == errors::kScanFormat.id) {
      throw StageError(known, file_, text.substr(first + 1, second - first - 1), text.substr(second + 1));
    }
  }
  throw std::logic_error("the list ends with kScanFormat");
}

}  // namespace roomcut::ingest
