// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "stages/tools/view/request_rules.h"
#include "stages/tools/view/work_file.h"

namespace roomcut::view {

struct HttpRequest {
  RequestHead head;
  std::string path;   ///< as it was sent, up to a "?"; nothing that is served needs %-escapes
  std::string range;  ///< header Range; "" = none
  std::string body;
};

/// A text, or a part of a file that is sent piece by piece and never held whole.
struct HttpAnswer {
  int status = 200;
  std::string media_type = "application/json";
  std::string text;
  std::optional<OpenFile> file;
  std::uint64_t offset = 0, length = 0;  ///< of the file [bytes]
  std::string content_range;             ///< header Content-Range; "" = none
};

/// {"error": why}
HttpAnswer error_answer(int status, const std::string& why);

/// What an HttpServer serves. Both are called by several threads at once and must not throw.
struct HttpService {
  std::function<std::optional<Refusal>(const RequestHead&)> refuse;  ///< before the body is read
  std::function<HttpAnswer(HttpRequest)> handle;
};

}  // namespace roomcut::view
