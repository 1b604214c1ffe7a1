// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// The structure of an HDF5 file, as far as artefacts have it, read without the HDF5 library: that one reads
/// and writes outside its memory when a file is damaged (README.md, Safety). HDF5 File Format Specification
/// 3.0: superblock 0, groups as symbol tables, object headers 1, attribute messages 1 and 3, contiguous data.
/// Not for stages.
namespace roomcut::h5 {

/// Where the numbers of a dataset are in the file: contiguous, little-endian, as long as the file is.
struct StoredDataset {
  std::string type;                  ///< "f32", "i64", "u8" …
  std::vector<std::uint64_t> shape;  ///< at least one dimension
  std::uint64_t bytes = 0;
  std::uint64_t offset = 0;  ///< in the file; 0 when there are no bytes
};

using AttributeValue = std::variant<std::string, double, std::int64_t, std::array<double, 3>>;

/// A group or a dataset.
struct StoredObject {
  std::map<std::string, AttributeValue> attributes;
  std::optional<StoredDataset> dataset;
};

/// What is wrong with the file; the reader above knows its name.
struct Malformed {
  std::string object;  ///< "/levels/z"; empty for the file as a whole
  std::string what;
};

/// Reads the structures by pread() from an open file. Every length, address and count is checked against the
/// file before it is used; each structure is visited once, so that no circle ends in a loop. Functions throw
/// Malformed.
class Parser {
 public:
  /// Reads the superblock.
  Parser(int descriptor, std::uint64_t file_bytes);

  StoredObject root();
  /// All objects by path, "/levels/z"; the root is "/".
  std::map<std::string, StoredObject> objects();

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Header;
  struct Group;

  Bytes bytes(std::uint64_t address, std::uint64_t count) const;
  Header header(std::uint64_t address);
  StoredObject object(const Header& header, const std::string& path) const;
  void visit(std::uint64_t address, const std::string& path, std::map<std::string, StoredObject>& objects);
  void visit_node(std::uint64_t address, const Group& group, int level);
  void visit_leaf(std::uint64_t address, const Group& group);
  void once(std::uint64_t address);

  int descriptor_;
  std::uint64_t file_bytes_;
  std::uint64_t root_ = 0;  ///< address of the root group's header
  std::map<std::uint64_t, bool> visited_;
};

}  // namespace roomcut::h5
