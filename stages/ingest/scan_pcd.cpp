// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_pcd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "common/errors/codes.h"
#include "stages/ingest/lzf.h"
#include "stages/ingest/pcd_header.h"
#include "stages/ingest/scan_records.h"
#include "stages/ingest/scan_text.h"
#include "stages/ingest/spooled_bytes.h"
#include "stages/ingest/text_lines.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kShortestPoint = 6;      // "0 0 0" and a line break
constexpr std::uint64_t kLargestPage = 65'536;   // bytes
constexpr std::uint64_t kLargestExpansion = 88;  // three bytes of LZF are at most 264
constexpr std::array<const char*, 6> kNames{"x", "y", "z", "normal_x", "normal_y", "normal_z"};

[[noreturn]] void wrong(const ScanBytes& file, const std::string& what) {
  throw StageError(errors::kScanFormat, file.name(), what, "export the scan again as PCD or PLY");
}

[[noreturn]] void wrong_count(const ScanBytes& file, const PcdHeader& header, const std::string& found) {
  throw StageError(
      errors::kScanTruncated, file.name(),
      "the header promises " + std::to_string(header.points) + " points, the file holds " + found,
      "export or copy the scan again");
}

/// Index of each of x, y, z and the normals among the fields; −1: not there.
std::array<int, 6> find_fields(const ScanBytes& file, const PcdHeader& header) {
  std::array<int, 6> found{};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    found[i] = -1;
    for (std::size_t k = 0; k < header.fields.size(); ++k) {
      const PcdField& field = header.fields[k];
      if (field.name != kNames[i] || field.count != 1) {
        continue;
      }
      if (found[i] >= 0) {
        wrong(file, "the field '" + field.name + "' stands twice");
      }
      found[i] = static_cast<int>(k);
    }
    if (i < 3 && found[i] < 0) {
      wrong(file, std::string("there is no field '") + kNames[i] + "'");
    }
  }
  if (found[3] < 0 || found[4] < 0 || found[5] < 0) {
    found[3] = found[4] = found[5] = -1;
  }
  return found;
}

ScalarType scalar_of(const ScanBytes& file, const PcdField& field) {
  const std::string kind = field.type + std::to_string(field.size);
  static const std::array<const char*, 8> kKinds{"I1", "U1", "I2", "U2", "I4", "U4", "F4", "F8"};
  const auto* const found = std::find(kKinds.begin(), kKinds.end(), kind);
  if (found == kKinds.end()) {
    wrong(file, "field '" + field.name + "' is of type " + kind + ", which is no coordinate");
  }
  return static_cast<ScalarType>(found - kKinds.begin());
}

std::vector<Vec3> stations_of(const PcdHeader& header) {
  const auto& v = header.viewpoint;
  const bool turned = v[3] != 1 || v[4] != 0 || v[5] != 0 || v[6] != 0;
  const Vec3 place(v[0], v[1], v[2]);
  return turned || place.isZero() || !place.allFinite() ? std::vector<Vec3>{} : std::vector<Vec3>{place};
}

std::unique_ptr<ScanReader> ascii_reader(const std::shared_ptr<const ScanBytes>& text,
                                         const PcdHeader& header, const std::array<int, 6>& fields) {
  TextLayout layout;
  layout.normals = fields[3] >= 0;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    const auto* const role = std::find(fields.begin(), fields.end(), static_cast<int>(k));
    layout.fields.insert(layout.fields.end(), static_cast<std::size_t>(header.fields[k].count),
                         role == fields.end() ? TextLayout::kSkip : static_cast<int>(role - fields.begin()));
  }
  while (layout.fields.back() < 0) {
    layout.fields.pop_back();
  }
  layout.begin = header.data_offset;
  if (header.points > (text->size() - layout.begin) / kShortestPoint + 1) {
    wrong_count(*text, header, "fewer");
  }
  std::uint64_t found = 0;
  layout.end = end_of_lines(*text, layout.begin, header.points, found);
  std::uint64_t more = 0;
  end_of_lines(*text, layout.end, text->size(), more);
  if (found < header.points || more > 0) {
    wrong_count(*text, header, std::to_string(found + more));
  }
  return text_reader(text, layout, stations_of(header));
}

/// Binary points are records one after the other; compressed ones are columns.
RecordLayout layout_of(const ScanBytes& file, const PcdHeader& header, const std::array<int, 6>& fields,
                       std::uint64_t first) {
  RecordLayout layout;
  layout.count = header.points;
  layout.normals = fields[3] >= 0;
  layout.swap = std::endian::native == std::endian::big;
  const bool columns = header.data == PcdData::kCompressed;
  std::uint64_t offset = first;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    const PcdField& field = header.fields[k];
    const auto* const role = std::find(fields.begin(), fields.end(), static_cast<int>(k));
    if (role != fields.end()) {
      layout.columns[static_cast<std::size_t>(role - fields.begin())] = {
          offset, static_cast<std::size_t>(columns ? field.size : header.record_bytes()),
          scalar_of(file, field)};
    }
    offset += field.size * field.count * (columns ? header.points : 1);
  }
  return layout;
}

/// Whether zeros fill up the last page behind the points, as PCL leaves them there.
bool is_padded(const ScanBytes& file, const PcdHeader& header) {
  std::uint64_t points = 0, end = 0;
  if (__builtin_mul_overflow(header.points, header.record_bytes(), &points) ||
      __builtin_add_overflow(header.data_offset, points, &end) || end >= file.size() ||
      file.size() - end >= kLargestPage) {
    return false;
  }
  std::vector<unsigned char> rest(file.size() - end);
  return file.read(end, rest.data(), rest.size()) == rest.size() &&
         std::all_of(rest.begin(), rest.end(), [](unsigned char byte) { return byte == 0; });
}

std::unique_ptr<ScanReader> binary_reader(const std::shared_ptr<const ScanBytes>& file,
                                          const PcdHeader& header, const std::array<int, 6>& fields) {
  std::uint64_t rest = file->size() - header.data_offset;
  if (is_padded(*file, header)) rest = header.points * header.record_bytes();
  const std::uint64_t held = rest / header.record_bytes();
  if (held != header.points) {
    wrong_count(*file, header, std::to_string(held));
  }
  auto reader =
      record_reader(file, layout_of(*file, header, fields, header.data_offset), stations_of(header));
  if (const std::uint64_t more = rest % header.record_bytes(); more > 0) {
    reader->warn(std::to_string(more) +
                 " bytes behind the last point that the header promises were not read");
  }
  return reader;
}

std::unique_ptr<ScanReader> compressed_reader(const std::shared_ptr<const ScanBytes>& file,
                                              const PcdHeader& header, const std::array<int, 6>& fields,
                                              const std::filesystem::path& scratch_folder) {
  std::array<unsigned char, 8> sizes{};
  if (file->read(header.data_offset, sizes.data(), sizes.size()) < sizes.size()) {
    wrong_count(*file, header, "none");
  }
  const auto size_at = [&](std::size_t i) {
    return std::uint64_t{sizes[i]} | std::uint64_t{sizes[i + 1]} << 8U | std::uint64_t{sizes[i + 2]} << 16U |
           std::uint64_t{sizes[i + 3]} << 24U;
  };
  const std::uint64_t compressed = size_at(0);
  const std::uint64_t expected = size_at(4);
  const std::uint64_t begin = header.data_offset + sizes.size();
  if (compressed > file->size() - begin) {
    wrong_count(*file, header, "the beginning of them");
  }
  std::uint64_t promised = 0;
  if (__builtin_mul_overflow(header.points, header.record_bytes(), &promised) || promised != expected ||
      expected > kLargestExpansion * compressed) {
    wrong(*file, "the sizes before the compressed points do not fit its " + std::to_string(header.points) +
                     " points");
  }
  auto spooled = std::make_shared<SpooledBytes>(file->name(), scratch_folder);
  const std::uint64_t got = decompress_lzf(*file, begin, compressed, expected,
                                           [&](std::span<const std::byte> bytes) { spooled->append(bytes); });
  if (got != expected) {
    wrong(*file, "the compressed points are damaged");
  }
  return record_reader(spooled, layout_of(*file, header, fields, 0), stations_of(header));
}

}  // namespace

std::unique_ptr<ScanReader> open_pcd(const std::shared_ptr<const ScanBytes>& file,
                                     const std::shared_ptr<const TextBytes>& text,
                                     const std::filesystem::path& scratch_folder) {
  PcdHeader header = read_pcd_header(*text);
  if (header.data != PcdData::kAscii && text->same_places()) {
    header = read_pcd_header(*file);  // where carriage returns are not taken for line ends
  }
  const std::array<int, 6> fields = find_fields(*text, header);
  if (header.points == 0) {
    throw StageError(errors::kScanNoPoints, text->name(), "there is a header that promises no point",
                     "export the scan again");
  }
  if (header.data == PcdData::kAscii) {
    return ascii_reader(text, header, fields);
  }
  if (!text->same_places()) {
    wrong(*text, "a binary PCD that was saved as text: its numbers are lost");
  }
  return header.data == PcdData::kBinary ? binary_reader(file, header, fields)
                                         : compressed_reader(file, header, fields, scratch_folder);
}

}  // namespace roomcut::ingest
