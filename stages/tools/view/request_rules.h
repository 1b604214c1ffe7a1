// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roomcut::view {

/// The largest request body that is read: an edit of some 60,000 lines [bytes].
inline constexpr std::size_t kLargestBody = std::size_t{16} << 20U;

/// The header that every changing request carries. A page of another site cannot send it without asking
/// first (a preflight), and preflights are refused.
inline constexpr const char* kMarkHeader = "X-Roomcut";

/// What is looked at of a request before anything is done for it. A header that is given twice counts as
/// two values.
struct RequestHead {
  std::string method;
  std::vector<std::string> host, origin, mark;
  std::vector<std::string> content_length, transfer_encoding, content_encoding, content_type;
};

struct Refusal {
  int status = 0;   ///< of HTTP
  std::string why;  ///< one sentence, no full stop
};

/// Whether a request is refused, before its body is read. Refused are: names of the server other than
/// 127.0.0.1, localhost and [::1] with `port` (a foreign name that was made to point here: DNS rebinding);
/// an Origin that is not the same; methods other than GET, HEAD, PUT, POST, DELETE (preflights among them);
/// changes without kMarkHeader; bodies of unknown length, packed bodies, bodies that are not JSON.
std::optional<Refusal> refuse(const RequestHead& head, int port);

/// A file of the work folder that may be read: its folder ("" or "pictures"), its name and media type.
struct ServedFile {
  std::string folder, name;
  const char* media_type = nullptr;
};

/// The file behind a decoded path ("/", "/pictures/cloud.png"): the page, its pictures, the model and the
/// summary; nullopt for everything else, so that no path leads out of the work folder.
std::optional<ServedFile> served_file(std::string_view path);

}  // namespace roomcut::view
