// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_ply.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <utility>

#include "common/errors/codes.h"
#include "stages/ingest/byte_cursor.h"
#include "stages/ingest/ply_columns.h"
#include "stages/ingest/ply_counts.h"
#include "stages/ingest/scan_ply_ascii.h"
#include "stages/ingest/scan_records.h"
#include "stages/ingest/scan_stations.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kPointsPerBlock = 1 << 16;

/// Moves the cursor over one record, giving each scalar property to take(index, value). Returns false at the
/// end of file.
template <class Take>
bool walk_record(const PlyElement& element, bool swap, ByteCursor& cursor, Take&& take) {
  const auto value_of = [swap](ScalarType type, const unsigned char* bytes) {
    return with_loader(type, swap, [&](auto load) { return static_cast<double>(load(bytes)); });
  };
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const ScalarType type = property.is_list ? property.count_type : property.type;
    const unsigned char* bytes = cursor.peek(bytes_of(type));
    if (bytes == nullptr) {
      return false;
    }
    const double value = value_of(type, bytes);
    cursor.skip(bytes_of(type));
    if (!property.is_list) {
      take(i, value);
    } else if (value > 0) {
      cursor.skip(static_cast<std::uint64_t>(value) * bytes_of(property.type));
    }
  }
  return true;
}

/// Errors: kScanFormat (with the header's line), kScanTruncated (no end_header).
PlyHeader read_header(const ScanBytes& file) {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kLargestPlyHeader)), '\0');
  text.resize(file.read(0, text.data(), text.size()));
  const std::string again = "export the scan again as PLY, ascii or binary";
  try {
    if (std::optional<PlyHeader> header = parse_ply_header(text)) {
      return std::move(*header);
    }
  } catch (const PlyHeaderError& wrong) {
    throw StageError(errors::kScanFormat, file.name() + ": header line " + std::to_string(wrong.line),
                     wrong.cause, again);
  }
  if (text.size() == kLargestPlyHeader) {
    throw StageError(errors::kScanFormat, file.name(), "no end_header within the first MiB", again);
  }
  throw StageError(errors::kScanTruncated, file.name(), "the header ends before end_header",
                   "export or copy the scan again");
}

bool swaps(const PlyHeader& header) {
  return (header.format == PlyFormat::kBigEndian) == (std::endian::native == std::endian::little);
}

/// Where the elements [first, last) end that begin at `offset`. `broken` is called with the element of which
/// only so many, in words, are there.
template <class Broken>
std::uint64_t end_of_elements(const ScanBytes& file, const PlyHeader& header, std::size_t first,
                              std::size_t last, std::uint64_t offset, Broken&& broken) {
  for (std::size_t i = first; i < last; ++i) {
    const PlyElement& element = header.elements[i];
    const std::uint64_t record = element.smallest_record();
    if (record > 0 && element.count > (file.size() - offset) / record) {
      return broken(element, "fewer");
    }
    if (!element.has_list()) {
      offset += element.count * record;
      continue;
    }
    ByteCursor cursor(file, offset);
    for (std::uint64_t k = 0; k < element.count; ++k) {
      if (!walk_record(element, swaps(header), cursor, [](std::size_t, double) {}) ||
          cursor.offset() > file.size()) {
        return broken(element, std::to_string(k));
      }
    }
    offset = cursor.offset();
  }
  return offset;
}

/// Where the vertices begin, after the elements before them.
std::uint64_t skip_elements(const ScanBytes& file, const PlyHeader& header) {
  return end_of_elements(file, header, 0, header.vertex, header.data_offset,
                         [&](const PlyElement& element, const std::string& found) -> std::uint64_t {
                           too_few(file, element, found);
                         });
}

/// What the file holds behind the vertices, from `end` on, compared with what the header promises there; a
/// warning or "". `held`: how many vertices there would be if nothing else followed. Errors: kScanTruncated.
std::string check_rest(const ScanBytes& file, const PlyHeader& header, std::uint64_t end,
                       std::uint64_t held) {
  const PlyElement& vertex = header.elements[header.vertex];
  if (elements_after_vertices(header) == 0 && held > vertex.count) {
    too_many(file, vertex, std::to_string(held));
  }
  std::string warning;
  const std::uint64_t rest = end_of_elements(
      file, header, header.vertex + 1, header.elements.size(), end,
      [&](const PlyElement& element, const std::string& /*found*/) {
        warning = "the elements '" + element.name + "' behind the vertices are cut off; they were not needed";
        return file.size();
      });
  const std::uint64_t more = file.size() - rest;
  if (more >= std::max<std::uint64_t>(1, vertex.smallest_record())) {
    too_many(file, vertex, std::to_string(more) + " bytes more than it promises in all");
  }
  return more == 0
             ? warning
             : std::to_string(more) + " bytes behind the last element that the header promises were not read";
}

/// Records of one size: block i lies at a known place.
std::unique_ptr<ScanReader> fixed_ply(const std::shared_ptr<const ScanBytes>& file, const PlyHeader& header,
                                      std::uint64_t first) {
  const PlyElement& vertex = header.elements[header.vertex];
  const PlyColumns columns = find_columns(vertex, *file);
  const std::uint64_t record = vertex.smallest_record();
  const std::uint64_t held = (file->size() - first) / record;
  if (held < vertex.count) {
    too_few(*file, vertex, std::to_string(held));
  }
  std::vector<std::uint64_t> offsets{first};
  for (const PlyProperty& property : vertex.properties) {
    offsets.push_back(offsets.back() + bytes_of(property.type));
  }
  RecordLayout layout{vertex.count, {}, columns.normals, swaps(header)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(columns.count()); ++i) {
    const std::size_t property = columns.property[i];
    layout.columns[i] = {offsets[property], static_cast<std::size_t>(record),
                         vertex.properties[property].type};
  }
  const std::string warning = check_rest(*file, header, first + vertex.count * record, held);
  std::unique_ptr<ScanReader> reader = record_reader(file, layout, stations_of_comments(header.comments));
  if (!warning.empty()) {
    reader->warn(warning);
  }
  return reader;
}

/// Vertex records with lists in them: the beginning of each block is found in one walk.
class RaggedPly : public ScanReader {
 public:
  RaggedPly(std::shared_ptr<const ScanBytes> file, const PlyHeader& header, std::uint64_t first)
      : file_(std::move(file)),
        vertex_(header.elements[header.vertex]),
        columns_(find_columns(vertex_, *file_)),
        swap_(swaps(header)),
        stations_(stations_of_comments(header.comments)) {
    ByteCursor cursor(*file_, first);
    const auto take_one = [&] {
      return walk_record(vertex_, swap_, cursor, [](std::size_t, double) {}) &&
             cursor.offset() <= file_->size();
    };
    for (std::uint64_t i = 0; i < vertex_.count; ++i) {
      if (i % kPointsPerBlock == 0) {
        begins_.push_back(cursor.offset());
      }
      if (!take_one()) {
        too_few(*file_, vertex_, std::to_string(i));
      }
    }
    const std::uint64_t end = cursor.offset();
    std::uint64_t held = vertex_.count;
    while (elements_after_vertices(header) == 0 && take_one()) {
      ++held;
    }
    if (const std::string warning = check_rest(*file_, header, end, held); !warning.empty()) {
      warn(warning);
    }
  }

  std::size_t blocks() const override { return begins_.size(); }
  bool has_normals() const override { return columns_.normals; }
  const std::vector<Vec3>& stations() const override { return stations_; }
  double resolution(double magnitude) const override {
    return spacing_of(vertex_.properties[columns_.property[0]].type, magnitude);
  }

  void read(std::size_t index, ScanBlock& block) const override {
    const auto points =
        static_cast<std::size_t>(std::min(kPointsPerBlock, vertex_.count - index * kPointsPerBlock));
    block.resize(points, columns_.normals);
    ByteCursor cursor(*file_, begins_[index]);
    for (std::size_t point = 0; point < points; ++point) {
      walk_record(vertex_, swap_, cursor, [&](std::size_t property, double value) {
        for (int column = 0; column < columns_.count(); ++column) {
          if (columns_.property[static_cast<std::size_t>(column)] == property) {
            store_column(block, column, point, value);
          }
        }
      });
    }
  }

 private:
  std::shared_ptr<const ScanBytes> file_;
  PlyElement vertex_;
  PlyColumns columns_;
  bool swap_;
  std::vector<Vec3> stations_;
  std::vector<std::uint64_t> begins_;
};

}  // namespace

bool is_ply(std::string_view head) {
  return head == "ply" || head.starts_with("ply\n") || head.starts_with("ply\r");
}

std::unique_ptr<ScanReader> open_ply(const std::shared_ptr<const ScanBytes>& file,
                                     const std::shared_ptr<const TextBytes>& text) {
  const PlyHeader header = read_header(text->same_places() ? *file : *text);
  if (header.format != PlyFormat::kAscii && !text->same_places()) {
    throw StageError(
        errors::kScanFormat, file->name(),
        "a binary PLY that was saved as text (UTF-16 or with a byte-order mark): its numbers are lost",
        "copy the file again without a text editor, or export it again");
  }
  const PlyElement& vertex = header.elements[header.vertex];
  if (vertex.count == 0 || header.data_offset >= file->size()) {
    throw StageError(errors::kScanNoPoints, file->name(), "there is a header and not one point after it",
                     "export the scan again");
  }
  if (header.format == PlyFormat::kAscii) {
    return open_ascii_ply(text, header, find_columns(vertex, *file));
  }
  const std::uint64_t first = skip_elements(*file, header);
  const std::uint64_t smallest = std::max<std::uint64_t>(1, vertex.smallest_record());
  if (vertex.has_list() && vertex.count > (file->size() - first) / smallest) {
    too_few(*file, vertex, "at most " + std::to_string((file->size() - first) / smallest));
  }
  if (vertex.has_list()) {
    return std::make_unique<RaggedPly>(file, header, first);
  }
  return fixed_ply(file, header, first);
}

}  // namespace roomcut::ingest
