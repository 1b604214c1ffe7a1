// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_ptx.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/scan_text.h"
#include "stages/ingest/text_lines.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kHeaderLines = 10;
constexpr std::size_t kLargestHeader = 1 << 13;
constexpr std::uint64_t kShortestPoint = 6;  // "0 0 0" and a line break
constexpr double kMatrixTolerance = 1e-3;    // of a rotation that is written with few digits
constexpr std::array<std::size_t, kHeaderLines> kNumbers{1, 1, 3, 3, 3, 3, 4, 4, 4, 4};

/// Numbers of the header lines of one scan, as far as they are what they should be.
struct HeaderLines {
  std::vector<std::vector<double>> numbers;
  std::uint64_t end = 0;  ///< byte after the last of them
};

HeaderLines header_lines(const ScanBytes& text, std::uint64_t begin) {
  std::string bytes(kLargestHeader, '\0');
  bytes.resize(text.read(begin, bytes.data(), bytes.size()));
  HeaderLines lines;
  for (std::size_t at = 0; at < bytes.size() && lines.numbers.size() < kHeaderLines;) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const Fields fields = split_fields(std::string_view(bytes).substr(at, end - at), {});
    at = end + 1;
    if (fields.empty()) {
      continue;
    }
    std::vector<double> numbers(fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!read_field(fields[i], {}, numbers[i])) {
        return lines;
      }
    }
    if (numbers.size() != kNumbers[lines.numbers.size()]) {
      return lines;
    }
    lines.numbers.push_back(std::move(numbers));
    lines.end = begin + std::min(at, bytes.size());
  }
  return lines;
}

/// One scan of the file.
struct Section {
  std::unique_ptr<ScanReader> points;
  Eigen::Matrix3d rotation;  ///< p ↦ rotation · p + translation
  Vec3 translation;
  std::size_t first_block = 0;
};

class PtxReader : public ScanReader {
 public:
  explicit PtxReader(const std::shared_ptr<const ScanBytes>& text) : text_(text) {
    std::uint64_t begin = 0;
    do {
      begin = take_section(begin);
    } while (more_after(begin));
  }

  std::size_t blocks() const override { return blocks_; }
  bool has_normals() const override { return false; }
  const std::vector<Vec3>& stations() const override { return stations_; }
  double resolution(double /*magnitude*/) const override { return 0; }

  void read(std::size_t index, ScanBlock& block) const override {
    const auto section = std::prev(std::upper_bound(
        sections_.begin(), sections_.end(), index,
        [](std::size_t wanted, const Section& candidate) { return wanted < candidate.first_block; }));
    section->points->read(index - section->first_block, block);
    block.drop_no_returns();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Vec3 moved = section->rotation * Vec3(block.x[i], block.y[i], block.z[i]) + section->translation;
      block.x[i] = moved.x();
      block.y[i] = moved.y();
      block.z[i] = moved.z();
    }
  }

 private:
  std::string scan_name() const { return text_->name() + ": scan " + std::to_string(sections_.size() + 1); }

  std::uint64_t take_section(std::uint64_t begin) {
    const HeaderLines header = header_lines(*text_, begin);
    if (header.numbers.size() < kHeaderLines) {
      throw StageError(errors::kScanFormat, scan_name(),
                       "its header breaks off after " + std::to_string(header.numbers.size()) +
                           " of its 10 lines (columns, rows, position, axes, matrix)",
                       "export the scan again");
    }
    const std::uint64_t points = count_of(header);
    TextLayout layout;
    layout.fields = {0, 1, 2};
    layout.begin = header.end;
    std::uint64_t found = 0;
    layout.end = points > (text_->size() - header.end) / kShortestPoint + 1
                     ? header.end
                     : end_of_lines(*text_, header.end, points, found);
    if (found < points) {
      throw StageError(errors::kScanTruncated, scan_name(),
                       "its header promises " + std::to_string(points) + " points, the file holds " +
                           (found == 0 ? "fewer" : std::to_string(found)),
                       "the file was cut off while it was written or copied: export or copy it again");
    }
    Section section = placed(header);
    section.points = text_reader(text_, layout, {});
    section.first_block = blocks_;
    blocks_ += section.points->blocks();
    sections_.push_back(std::move(section));
    return layout.end;
  }

  std::uint64_t count_of(const HeaderLines& header) const {
    const double columns = header.numbers[0][0];
    const double rows = header.numbers[1][0];
    const double points = columns * rows;
    if (!(columns >= 0) || !(rows >= 0) || columns != std::floor(columns) || rows != std::floor(rows) ||
        points > 1e15) {
      throw StageError(errors::kScanFormat, scan_name(), "its numbers of columns and rows are no counts",
                       "export the scan again");
    }
    return static_cast<std::uint64_t>(points);
  }

  /// Rotation and translation of the matrix, and the station they give.
  Section placed(const HeaderLines& header) {
    Section section;
    bool sound = true;
    for (int row = 0; row < 3; ++row) {
      const std::vector<double>& line = header.numbers[static_cast<std::size_t>(6 + row)];
      section.rotation.col(row) = Vec3(line[0], line[1], line[2]);
      sound = sound && line[3] == 0;
    }
    const std::vector<double>& last = header.numbers[9];
    section.translation = Vec3(last[0], last[1], last[2]);
    const Eigen::Matrix3d gram = section.rotation.transpose() * section.rotation;
    sound = sound && last[3] == 1 && section.translation.allFinite() &&
            gram.isApprox(Eigen::Matrix3d::Identity(), kMatrixTolerance) &&
            section.rotation.determinant() > 0;
    if (!sound) {
      throw StageError(errors::kScanFormat, scan_name(), "its matrix is no rotation and translation",
                       "export the scan again; with a wrong matrix its points would lie in a wrong place");
    }
    const Vec3 stated(header.numbers[2][0], header.numbers[2][1], header.numbers[2][2]);
    const bool unmoved =
        section.rotation.isIdentity(kMatrixTolerance * kMatrixTolerance) && section.translation.isZero();
    if (!unmoved || (!stated.isZero() && stated.allFinite())) {
      stations_.push_back(unmoved ? stated : section.translation);
    }
    return section;
  }

  /// Whether another scan follows. Anything else behind the points is more than the header promises.
  bool more_after(std::uint64_t begin) const {
    std::uint64_t lines = 0;
    end_of_lines(*text_, begin, 1, lines);
    if (lines == 0) {
      return false;
    }
    const std::size_t numbers = header_lines(*text_, begin).numbers.size();
    if (numbers < 2) {
      throw StageError(errors::kScanTruncated, text_->name(),
                       "behind the points that the header of scan " + std::to_string(sections_.size()) +
                           " promises there are more, or no header of a next scan",
                       "export the scan again, or correct its numbers of columns and rows");
    }
    return true;
  }

  std::shared_ptr<const ScanBytes> text_;
  std::vector<Section> sections_;
  std::vector<Vec3> stations_;
  std::size_t blocks_ = 0;
};

}  // namespace

bool is_ptx(const ScanBytes& text) {
  return header_lines(text, 0).numbers.size() == kHeaderLines;
}

std::unique_ptr<ScanReader> open_ptx(const std::shared_ptr<const ScanBytes>& text) {
  return std::make_unique<PtxReader>(text);
}

}  // namespace roomcut::ingest
