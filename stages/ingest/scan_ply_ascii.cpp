// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_ply_ascii.h"

#include <algorithm>
#include <limits>
#include <string>

#include "stages/ingest/line_parser.h"
#include "stages/ingest/ply_counts.h"
#include "stages/ingest/scan_stations.h"
#include "stages/ingest/scan_text.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kShortestPoint = 6;  // "0 0 0" and a line break
constexpr std::size_t kLookedAt = 1 << 16;

TextLayout layout_of(const PlyElement& vertex, const PlyColumns& columns) {
  TextLayout layout;
  layout.normals = columns.normals;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    layout.fields.push_back(vertex.properties[i].is_list ? TextLayout::kList : TextLayout::kSkip);
    for (int column = 0; column < columns.count(); ++column) {
      if (columns.property[static_cast<std::size_t>(column)] == i) {
        layout.fields.back() = column;
      }
    }
  }
  while (layout.fields.back() < 0) {
    layout.fields.pop_back();
  }
  return layout;
}

/// Whether one of the next lines after `offset` is a point.
bool point_follows(const ScanBytes& text, std::uint64_t offset, const TextLayout& layout) {
  std::string rest(kLookedAt, '\0');
  rest.resize(text.read(offset, rest.data(), rest.size()));
  LineParser parser(layout);
  for (std::size_t begin = 0; begin < rest.size();) {
    const std::size_t end = std::min(rest.find('\n', begin), rest.size());
    if (parser.parse(rest.data() + begin, rest.data() + end)) {
      return true;
    }
    begin = end + 1;
  }
  return false;
}

/// Compares the lines behind the vertices with what the header promises there; returns a warning or "".
std::string check_rest(const ScanBytes& text, const PlyHeader& header, const TextLayout& layout) {
  std::uint64_t promised = 0;
  for (std::size_t i = header.vertex + 1; i < header.elements.size(); ++i) {
    promised += header.elements[i].properties.empty() ? 0 : header.elements[i].count;
  }
  std::uint64_t found = 0;
  const std::uint64_t begin = end_of_lines(text, layout.end, promised, found);
  std::uint64_t more = 0;
  if (found == promised) {
    end_of_lines(text, begin, std::numeric_limits<std::uint64_t>::max(), more);
  }
  if (more == 0) {
    return "";
  }
  if (point_follows(text, begin, layout)) {
    const PlyElement& vertex = header.elements[header.vertex];
    too_many(text, vertex,
             promised == 0 ? std::to_string(vertex.count + more)
                           : std::to_string(more) + " lines more than it promises in all");
  }
  return std::to_string(more) + " lines behind the last element that the header promises were not read";
}

}  // namespace

std::unique_ptr<ScanReader> open_ascii_ply(const std::shared_ptr<const ScanBytes>& text,
                                           const PlyHeader& header, const PlyColumns& columns) {
  TextLayout layout = layout_of(header.elements[header.vertex], columns);
  layout.begin = header.data_offset;
  for (std::size_t i = 0; i <= header.vertex; ++i) {
    const PlyElement& element = header.elements[i];
    std::uint64_t found = 0;
    const bool possible =
        i < header.vertex || element.count <= (text->size() - layout.begin) / kShortestPoint + 1;
    const std::uint64_t end =
        possible ? end_of_lines(*text, layout.begin, element.count, found) : layout.begin;
    if (found < element.count) {
      too_few(*text, element, possible ? std::to_string(found) : std::string("fewer"));
    }
    (i < header.vertex ? layout.begin : layout.end) = end;
  }
  std::unique_ptr<ScanReader> reader = text_reader(text, layout, stations_of_comments(header.comments));
  if (const std::string warning = check_rest(*text, header, layout); !warning.empty()) {
    reader->warn(warning);
  }
  return reader;
}

}  // namespace roomcut::ingest
