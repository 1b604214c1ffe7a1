// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry/line2.h"
#include "stages/ingest/scan_file.h"

namespace roomcut::ingest {

/// Points as they stand in the file: its unit, axes and order; not checked for being finite.
struct ScanBlock {
  std::vector<double> x, y, z;
  std::vector<float> nx, ny, nz;  ///< normals; empty when the file has none
  std::uint64_t no_returns = 0;   ///< points of the block that are none: beams that met nothing
  std::size_t size() const { return x.size(); }
  void resize(std::size_t points, bool normals);
  /// Takes out points at exactly 0 0 0, which is how scanners write a beam without return, and counts them.
  void drop_no_returns();
};

/// What `open_scan` may be told.
struct ScanOptions {
  std::vector<int> columns;  ///< what each column of a text is (parse_columns()); empty: to be found out
  std::filesystem::path scratch_folder{};  ///< for what has to be decoded first
  std::filesystem::path decoders{};        ///< folder with python/ and decoders/ (decoded_scan.h)
};

/// Points that a decoder has left out already.
struct DroppedPoints {
  std::uint64_t no_returns = 0;  ///< beams that met nothing
  std::uint64_t invalid = 0;     ///< marked so in the file, withheld, or not finite
};

/// A scan cut into blocks that can be read in any order and by several threads. Block order is file order.
class ScanReader {
 public:
  virtual ~ScanReader() = default;
  virtual std::size_t blocks() const = 0;
  /// Reads block `index`. Thread-safe. Errors: kScanUnreadable, kScanTruncated, kScanBadLine.
  virtual void read(std::size_t index, ScanBlock& block) const = 0;
  virtual bool has_normals() const = 0;
  /// Scanner positions that the file states, in its own unit and axes.
  virtual const std::vector<Vec3>& stations() const = 0;
  /// Distance between neighbouring representable coordinates at `magnitude`: 0 for text and doubles, the
  /// spacing of float32 numbers there otherwise [file units].
  virtual double resolution(double magnitude) const = 0;
  /// Called with the number of points that all blocks gave: kScanTruncated when the file promised others.
  virtual void check_total(std::uint64_t /*points*/) const {}

  /// What the user should know about the file although it could be read.
  const std::vector<std::string>& warnings() const { return warnings_; }
  void warn(const std::string& text) { warnings_.push_back(text); }
  /// How the file was understood.
  const std::vector<std::string>& notes() const { return notes_; }
  void note(const std::string& text) { notes_.push_back(text); }
  /// The coordinate system as the file states it, WKT or a name; empty when it does not.
  virtual const std::string& crs() const {
    static const std::string kNone;
    return kNone;
  }
  /// After check_total(): what is in no block although it stands in the file.
  virtual DroppedPoints dropped() const { return {}; }
  /// After check_total(): notes and warnings that could not be given before all points were read.
  virtual std::vector<std::string> late_notes() const { return {}; }
  virtual std::vector<std::string> late_warnings() const { return {}; }

 private:
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
};

/// Finds out the format by the content. Errors: those of ScanFile, kScanFormat, kScanTruncated (the header
/// promises more points than there are, or fewer; nothing is allocated on a promise), kScanNoPoints; of text,
/// kScanColumns.
std::unique_ptr<ScanReader> open_scan(const std::filesystem::path& path, const ScanOptions& options = {});

}  // namespace roomcut::ingest
