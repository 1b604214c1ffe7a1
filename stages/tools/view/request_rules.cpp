// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/request_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace roomcut::view {

namespace {

constexpr std::array<std::string_view, 3> kOwnNames = {"127.0.0.1", "localhost", "[::1]"};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Whether `text` is prefix + one of our names + ":" + port. Port 80 may be left out, as browsers do.
bool is_own_address(const std::string& text, std::string_view prefix, int port) {
  const std::string given = lower(text);
  return std::any_of(kOwnNames.begin(), kOwnNames.end(), [&](std::string_view name) {
    const std::string address = std::string(prefix) + std::string(name);
    return given == address + ":" + std::to_string(port) || (port == 80 && given == address);
  });
}

bool is_json(const std::string& content_type) {
  const std::string type = lower(content_type.substr(0, content_type.find(';')));
  const std::string bare = type.substr(0, type.find_last_not_of(' ') + 1);
  return bare == "application/json" || bare == "application/geo+json";
}

std::optional<Refusal> refuse_body(const RequestHead& head) {
  const bool sized = head.content_length.size() == 1 && !head.content_length[0].empty() &&
                     head.content_length[0].find_first_not_of("0123456789") == std::string::npos;
  if (!head.transfer_encoding.empty() || !sized) {
    return Refusal{411, "a body must say its length (Content-Length)"};
  }
  if (head.content_length[0].size() > 15 || std::stoull(head.content_length[0]) > kLargestBody) {
    return Refusal{413, "the body is larger than " + std::to_string(kLargestBody >> 20U) + " MiB"};
  }
  if (!head.content_encoding.empty()) {
    return Refusal{415, "a packed body is not read"};
  }
  if (head.method == "PUT" && (head.content_type.size() != 1 || !is_json(head.content_type[0]))) {
    return Refusal{415, "only application/geo+json and application/json are read"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> refuse(const RequestHead& head, int port) {
  if (head.host.size() != 1 || !is_own_address(head.host[0], "", port)) {
    return Refusal{403, "the request is meant for another server (Host)"};
  }
  if (head.origin.size() > 1 ||
      (head.origin.size() == 1 && !is_own_address(head.origin[0], "http://", port))) {
    return Refusal{403, "the request comes from another page (Origin)"};
  }
  if (head.method == "GET" || head.method == "HEAD") {
    return std::nullopt;
  }
  if (head.method != "PUT" && head.method != "POST" && head.method != "DELETE") {
    return Refusal{405, "the method is not known here"};
  }
  if (head.mark.size() != 1 || head.mark[0] != "1") {
    return Refusal{403, std::string("a change needs the header ").append(kMarkHeader).append(": 1")};
  }
  const bool has_body = head.method == "PUT" || head.method == "POST" || !head.transfer_encoding.empty() ||
                        (!head.content_length.empty() && head.content_length[0] != "0");
  return has_body ? refuse_body(head) : std::nullopt;
}

std::optional<ServedFile> served_file(std::string_view path) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 5> kFixed = {{
      {"/", "text/html; charset=utf-8"},
      {"/report.html", "text/html; charset=utf-8"},
      {"/model.ply", "application/octet-stream"},
      {"/model.obj", "text/plain; charset=utf-8"},
      {"/summary.json", "application/json"},
  }};
  for (const auto& [known, type] : kFixed) {
    if (path == known) {
      return ServedFile{"", path == "/" ? "report.html" : std::string(path.substr(1)), type};
    }
  }
  constexpr std::string_view kPictures = "/pictures/";
  if (!path.starts_with(kPictures)) {
    return std::nullopt;
  }
  const std::string name(path.substr(kPictures.size()));
  const bool plain =
      !name.empty() && name[0] != '.' && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
      });
  if (plain && name.ends_with(".png")) {
    return ServedFile{"pictures", name, "image/png"};
  }
  if (plain && name.ends_with(".svg")) {
    return ServedFile{"pictures", name, "image/svg+xml"};
  }
  return std::nullopt;
}

}  // namespace roomcut::view
