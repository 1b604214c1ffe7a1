// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/server.h"

#include <boost/system/system_error.hpp>
#include <map>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "stages/tools/view/byte_range.h"
#include "stages/tools/view/edit_store.h"
#include "stages/tools/view/http_server.h"
#include "stages/tools/view/pipeline_run.h"
#include "stages/tools/view/request_rules.h"
#include "stages/tools/view/work_file.h"

namespace roomcut::view {

namespace {

/// File names and log lines may hold any bytes; an answer is valid JSON all the same.
HttpAnswer json_answer(int status, const Json& body) {
  HttpAnswer answer;
  answer.status = status;
  answer.text = lossy_json(body) + "\n";
  return answer;
}

/// The errors of an edit: 422 when the edit is at fault, 500 when it cannot be written.
HttpAnswer problems_answer(const StageError& error) {
  Json problems = Json::array();
  for (const Problem& problem : error.problems()) {
    std::string text = to_string(problem);
    text.erase(text.find_last_not_of('\n') + 1);
    problems.push_back(text);
  }
  return json_answer(error.exit_code() == ExitCode::kInput ? 422 : 500, {{"problems", problems}});
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

HttpAnswer nothing_here() {
  return error_answer(404, "there is nothing here");
}

/// A file as it lies there, not packed, or the part of it that `range` asks for.
HttpAnswer file_answer(OpenFile file, const char* media_type, const std::string& range) {
  const std::uint64_t size = file.size().value_or(0);
  const auto part = byte_range(range, size);
  const std::string of_size = "/" + std::to_string(size);
  if (!part) {
    HttpAnswer answer = error_answer(416, "the file has " + std::to_string(size) + " bytes");
    answer.content_range = "bytes *" + of_size;
    return answer;
  }
  HttpAnswer answer;
  answer.media_type = media_type;
  answer.file = std::move(file);
  answer.offset = part->offset;
  answer.length = part->length;
  if (!part->whole) {
    answer.status = 206;
    answer.content_range = "bytes " + std::to_string(part->offset) + "-" +
                           std::to_string(part->offset + part->length - 1) + of_size;
  }
  return answer;
}

Json run_json(const RunProgress& run) {
  return {{"running", run.running}, {"stage", text_or_null(run.stage)},
          {"done", run.done},       {"of", run.of},
          {"log", run.log},         {"exit", run.exit_code ? Json(*run.exit_code) : Json(nullptr)}};
}

}  // namespace

HttpAnswer error_answer(int status, const std::string& why) {
  return json_answer(status, {{"error", why}});
}

struct ViewServer::State {
  State(std::filesystem::path folder, std::vector<std::string> pipeline)
      : work(std::move(folder)), edits(work), run(std::move(pipeline)) {}

  HttpAnswer handle(const HttpRequest& request);
  HttpAnswer get_file(const HttpRequest& request) const;
  HttpAnswer get_edit(const HttpRequest& request) const;
  HttpAnswer put_edit(const HttpRequest& request);
  HttpAnswer delete_edit(const HttpRequest& request);
  HttpAnswer get_status(const HttpRequest& request) const;
  HttpAnswer get_run(const HttpRequest& request) const;
  HttpAnswer post_run(const HttpRequest& request);

  std::filesystem::path work;
  EditStore edits;
  PipelineRun run;
  int port = 0;
  HttpServer server{{[this](const RequestHead& head) { return refuse(head, port); },
                     [this](const HttpRequest& request) { return handle(request); }}};
};

/// What a request is answered with; nothing is thrown.
HttpAnswer ViewServer::State::handle(const HttpRequest& request) {
  using Answer = HttpAnswer (State::*)(const HttpRequest&);
  using ConstAnswer = HttpAnswer (State::*)(const HttpRequest&) const;
  static const std::map<std::string, Answer> kChanges = {{"PUT /api/edit", &State::put_edit},
                                                         {"DELETE /api/edit", &State::delete_edit},
                                                         {"POST /api/run", &State::post_run}};
  static const std::map<std::string, ConstAnswer> kReads = {
      {"/api/edit", &State::get_edit}, {"/api/status", &State::get_status}, {"/api/run", &State::get_run}};
  try {
    if (request.head.method != "GET" && request.head.method != "HEAD") {
      const auto change = kChanges.find(request.head.method + " " + request.path);
      return change == kChanges.end() ? nothing_here() : (this->*change->second)(request);
    }
    const auto read = kReads.find(request.path);
    return read == kReads.end() ? get_file(request) : (this->*read->second)(request);
  } catch (const StageError& error) {
    return problems_answer(error);
  } catch (const std::exception& error) {
    return error_answer(500, error.what());
  }
}

HttpAnswer ViewServer::State::get_file(const HttpRequest& request) const {
  const auto file = served_file(request.path);
  auto opened = file ? open_work_file(work, *file) : std::nullopt;
  return opened ? file_answer(std::move(*opened), file->media_type, request.range) : nothing_here();
}

HttpAnswer ViewServer::State::get_edit(const HttpRequest& /*request*/) const {
  auto edit = edits.read();
  if (!edit) {
    return error_answer(404, "there is no edit");
  }
  HttpAnswer answer;
  answer.media_type = "application/geo+json";
  answer.text = std::move(*edit);
  return answer;
}

HttpAnswer ViewServer::State::put_edit(const HttpRequest& request) {
  const AcceptedEdit edit = edits.accept(request.body);
  return json_answer(200, {{"accepted", true}, {"changes", edit.changes}, {"warnings", edit.warnings}});
}

HttpAnswer ViewServer::State::delete_edit(const HttpRequest& /*request*/) {
  const auto kept = edits.drop();
  return kept ? json_answer(200, {{"kept", kept->generic_string()}}) : error_answer(404, "there is no edit");
}

HttpAnswer ViewServer::State::get_status(const HttpRequest& /*request*/) const {
  const RunProgress now = run.progress();
  return json_answer(200, {{"work", work.filename().string()},
                           {"running", now.running},
                           {"stage", text_or_null(now.stage)},
                           {"error", text_or_null(now.running ? "" : now.error)},
                           {"edit", edits.exists()}});
}

HttpAnswer ViewServer::State::get_run(const HttpRequest& /*request*/) const {
  return json_answer(200, run_json(run.progress()));
}

HttpAnswer ViewServer::State::post_run(const HttpRequest& /*request*/) {
  const bool started = run.start();
  return json_answer(started ? 202 : 409, run_json(run.progress()));
}

ViewServer::ViewServer(std::filesystem::path work, std::vector<std::string> pipeline)
    : state_(std::make_unique<State>(std::move(work), std::move(pipeline))) {}

ViewServer::~ViewServer() = default;

int ViewServer::bind(int port) {
  try {
    state_->port = state_->server.bind(port);
  } catch (const boost::system::system_error&) {
    throw StageError(errors::kUsage, "--port", "the port cannot be taken: another program has it",
                     "choose another one with PORT=, or none to get any that is free");
  }
  return state_->port;
}

void ViewServer::serve() {
  state_->server.serve();
}

void ViewServer::stop() {
  state_->server.stop();
  state_->run.stop();
}

}  // namespace roomcut::view
