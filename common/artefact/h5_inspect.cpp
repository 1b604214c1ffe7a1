// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5_blocks.h"
#include "common/artefact/h5_content.h"
#include "common/artefact/json_values.h"
#include "common/artefact/known_artefacts.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace {

enum class Kind { kHdf5, kText, kOther };

/// By the first bytes; no data are read.
Kind kind_of(const std::filesystem::path& path) {
  std::array<unsigned char, 8> head{};
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    throw_unreadable(path, errno);
  }
  const ssize_t got = ::read(file, head.data(), head.size());
  ::close(file);
  static constexpr std::array<unsigned char, 8> kSignature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  if (got == 8 && head == kSignature) {
    return Kind::kHdf5;
  }
  const std::string_view text(reinterpret_cast<const char*>(head.data()),
                              static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  const std::size_t mark = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // an editor's
  const std::size_t begin = text.find_first_not_of(" \t\r\n", mark);
  return begin != std::string_view::npos && text[begin] == '{' ? Kind::kText : Kind::kOther;
}

/// Nothing for a file that is damaged.
InputRecord inspect_hdf5(const std::filesystem::path& path) {
  try {
    return h5::Content(path).stated();
  } catch (const StageError&) {
    return {};
  }
}

std::string text_member(const Json& value, const char* key) {
  return value.is_object() && value.contains(key) && value[key].is_string() ? value[key].get<std::string>()
                                                                            : std::string();
}

/// JSON artefacts say it at the top; wall_lines.geojson in its member `roomcut`.
InputRecord stated_in(const std::string& text) {
  const Json value = try_parse_json(text);
  InputRecord record;
  if (!value.is_object()) {
    return record;
  }
  const Json& home = value.contains("roomcut") ? value["roomcut"] : value;
  record.artefact = text_member(home, "artefact");
  record.schema_version = text_member(home, "schema_version");
  record.payload_sha256 = text_member(home, "payload_sha256");
  if (record.payload_sha256.empty() && home.is_object() && home.contains("provenance")) {
    record.payload_sha256 = text_member(home["provenance"], "payload_sha256");
  }
  return record;
}

InputRecord stated(const std::filesystem::path& path) {
  switch (kind_of(path)) {
    case Kind::kHdf5:
      return inspect_hdf5(path);
    case Kind::kText:
      return stated_in(read_text_file(path));
    default:
      return {};
  }
}

}  // namespace

InputRecord inspect_artefact(const std::filesystem::path& path) {
  if (const std::optional<InputRecord> known = known_artefact(path)) {
    return *known;
  }
  InputRecord record = stated_artefact(path);
  if (record.artefact.empty()) {
    record.payload_sha256 = sha256_of_file(path);
  }
  return record;
}

InputRecord stated_artefact(const std::filesystem::path& path) {
  InputRecord record = stated(path);
  return record.artefact.empty() || record.payload_sha256.empty() ? InputRecord() : record;
}

std::string stated_payload(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? stated(path).payload_sha256 : std::string();
}

Provenance read_provenance(const std::filesystem::path& path) {
  if (kind_of(path) == Kind::kHdf5) {
    const InputRecord record = inspect_hdf5(path);
    int major = 0;
    int minor = 0;
    if (std::sscanf(record.schema_version.c_str(), "%d.%d", &major, &minor) != 2) {
      throw_damaged(path, "", "states no schema version");
    }
    return H5Reader(path, {record.artefact.c_str(), major, minor}).provenance();
  }
  const Json value = try_parse_json(read_text_file(path));
  Provenance provenance;
  try {
    provenance =
        provenance_from_json((value.contains("roomcut") ? value["roomcut"] : value).at("provenance"));
  } catch (const std::exception&) {
    throw_damaged(path, "provenance", "is missing or not complete");
  }
  require_params(path, provenance);
  return provenance;
}

InputRecord verified_plain_artefact(const std::filesystem::path& path) {
  if (kind_of(path) != Kind::kHdf5) {
    const std::string text = read_text_file(path);
    InputRecord record = stated_in(text);
    require_payload(path, record.payload_sha256, json_payload_sha256(text));
    return record;
  }
  const h5::Content content(path);
  InputRecord record = content.stated();
  require_payload(path, record.payload_sha256, content.payload_sha256());
  h5::check_all_blocks(content);
  return record;
}

}  // namespace roomcut
