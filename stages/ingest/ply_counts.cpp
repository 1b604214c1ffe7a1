// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ply_counts.h"

#include <algorithm>

#include "common/errors/codes.h"

namespace roomcut::ingest {

namespace {

[[noreturn]] void wrong_count(const ScanBytes& file, const PlyElement& element, const std::string& found,
                              const std::string& hint) {
  throw StageError(errors::kScanTruncated, file.name(),
                   "the header promises " + std::to_string(element.count) + " elements '" + element.name +
                       "', the file holds " + found,
                   hint);
}

}  // namespace

void too_few(const ScanBytes& file, const PlyElement& element, const std::string& found) {
  wrong_count(file, element, found,
              "the file was cut off while it was written or copied: export or copy it again");
}

void too_many(const ScanBytes& file, const PlyElement& element, const std::string& found) {
  wrong_count(file, element, found,
              "export the scan again, or correct the line 'element " + element.name + " " +
                  std::to_string(element.count) + "' of its header");
}

std::size_t elements_after_vertices(const PlyHeader& header) {
  return static_cast<std::size_t>(
      std::count_if(header.elements.begin() + static_cast<std::ptrdiff_t>(header.vertex) + 1,
                    header.elements.end(), [](const PlyElement& element) { return element.count > 0; }));
}

}  // namespace roomcut::ingest
