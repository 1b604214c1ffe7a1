// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/errors/codes.h"
#include "common/mesh/triangle_mesh.h"

// The readers of the single formats behind parse_mesh().

namespace roomcut::mesh_readers {

TriangleMesh parse_ply(std::string_view content, const std::string& name);
TriangleMesh parse_off(std::string_view content, const std::string& name);
TriangleMesh parse_obj(std::string_view content, const std::string& name);

/// Throws StageError(kMeshFormat).
[[noreturn]] void bad_mesh(const std::string& name, const std::string& what);

/// Appends a vertex, whose coordinates must be finite and no larger than any place's in any unit.
void append_vertex(TriangleMesh& mesh, const Vec3& p, const std::string& name);

/// Appends a face with 3 or more corners (0-based indices) as triangles; returns how many.
std::size_t append_face(TriangleMesh& mesh, std::span<const std::int64_t> corners, const std::string& name);

/// Walks through text: lines, and numbers and words on a line.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}
  /// Moves to the next line that holds more than blanks and a comment (#); false at the end.
  bool next_line();
  std::size_t line_number() const { return line_number_; }
  /// The next word of the line; empty when there is none.
  std::string_view word();
  /// The next number of the line; false when there is none.
  bool number(double& value);
  bool number(std::int64_t& value);

 private:
  std::string_view rest_, line_;
  std::size_t line_number_ = 0;
};

}  // namespace roomcut::mesh_readers
