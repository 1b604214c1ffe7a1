// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/view/server.h"

#include <httplib.h>
#include <sys/socket.h>

#include "common/artefact/json.h"
#include "common/errors/codes.h"
#include "stages/view/edit_store.h"
#include "stages/view/pipeline_run.h"
#include "stages/view/request_rules.h"
#include "stages/view/work_file.h"

namespace roomcut {

namespace {

std::vector<std::string> values(const httplib::Request& request, const char* name) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < request.get_header_value_count(name); ++i) {
    result.push_back(request.get_header_value(name, i));
  }
  return result;
}

RequestHead head_of(const httplib::Request& request) {
  return {request.method,
          values(request, "Host"),
          values(request, "Origin"),
          values(request, kMarkHeader),
          values(request, "Content-Length"),
          values(request, "Transfer-Encoding"),
          values(request, "Content-Encoding"),
          values(request, "Content-Type")};
}

/// File names and log lines may hold any bytes; an answer is valid JSON all the same.
void answer(httplib::Response& response, int status, const Json& body) {
  response.status = status;
  response.set_content(body.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", "application/json");
}

void answer_error(httplib::Response& response, int status, const std::string& why) {
  answer(response, status, {{"error", why}});
}

/// The errors of an edit: 422 when the edit is at fault, 500 when it cannot be written.
void answer_problems(httplib::Response& response, const StageError& error) {
  Json problems = Json::array();
  for (const Problem& problem : error.problems()) {
    std::string text = to_string(problem);
    text.erase(text.find_last_not_of('\n') + 1);
    problems.push_back(text);
  }
  answer(response, error.exit_code() == ExitCode::kInput ? 422 : 500, {{"problems", problems}});
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

/// A file as it is. The library would pack what browsers take packed, as small as brotli can, which takes ten
/// seconds for a page that goes no further than to this machine.
void answer_file(httplib::Response& response, std::string bytes, const std::string& media_type) {
  if (bytes.empty()) {
    response.set_content("", media_type);
    return;
  }
  const std::size_t size = bytes.size();
  response.set_content_provider(
      size, media_type,
      [content = std::move(bytes)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(content.data() + offset, length);
      });
}

Json run_json(const RunProgress& run) {
  return {{"running", run.running}, {"stage", text_or_null(run.stage)},
          {"done", run.done},       {"of", run.of},
          {"log", run.log},         {"exit", run.exit_code ? Json(*run.exit_code) : Json(nullptr)}};
}

}  // namespace

struct ViewServer::State {
  State(std::filesystem::path folder, std::vector<std::string> pipeline)
      : work(std::move(folder)), edits(work), run(std::move(pipeline)) {}

  void protect();
  void route_files();
  void route_edit();
  void route_run();

  std::filesystem::path work;
  EditStore edits;
  PipelineRun run;
  httplib::Server server;
  int port = 0;
};

/// What holds for every request and every answer.
void ViewServer::State::protect() {
  // The library would set SO_REUSEPORT, which lets a second program share the port and steal requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_payload_max_length(kLargestBody);
  server.set_keep_alive_max_count(1);  // a refused body is not read: the connection ends with the answer
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Content-Security-Policy", "frame-ancestors 'none'"},
                              {"Referrer-Policy", "no-referrer"}});
  server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const auto refusal = refuse(head_of(request), port);
    if (!refusal) {
      return httplib::Server::HandlerResponse::Unhandled;
    }
    answer_error(response, refusal->status, refusal->why);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_error_handler([](const httplib::Request& /*request*/, httplib::Response& response) {
    if (response.body.empty()) {
      answer_error(response, response.status, response.status == 404 ? "there is nothing here" : "refused");
    }
  });
  server.set_exception_handler(
      [](const httplib::Request& /*request*/, httplib::Response& response, const std::exception_ptr& error) {
        try {
          std::rethrow_exception(error);
        } catch (const StageError& known) {
          answer_problems(response, known);
        } catch (const std::exception& other) {
          answer_error(response, 500, other.what());
        }
      });
}

void ViewServer::State::route_files() {
  server.Get(R"(/(?!api/).*)", [this](const httplib::Request& request, httplib::Response& response) {
    const auto file = served_file(request.path);
    auto bytes = file ? read_work_file(work, *file) : std::nullopt;
    if (bytes) {
      answer_file(response, std::move(*bytes), std::string(file->media_type));
    } else {
      response.status = 404;
    }
  });
}

void ViewServer::State::route_edit() {
  server.Get("/api/edit", [this](const httplib::Request& /*request*/, httplib::Response& response) {
    const auto edit = edits.read();
    if (edit) {
      response.set_content(*edit, "application/geo+json");
    } else {
      answer_error(response, 404, "there is no edit");
    }
  });
  server.Put("/api/edit", [this](const httplib::Request& request, httplib::Response& response) {
    const AcceptedEdit edit = edits.accept(request.body);
    answer(response, 200, {{"accepted", true}, {"changes", edit.changes}, {"warnings", edit.warnings}});
  });
  server.Delete("/api/edit", [this](const httplib::Request& /*request*/, httplib::Response& response) {
    const auto kept = edits.drop();
    if (kept) {
      answer(response, 200, {{"kept", kept->generic_string()}});
    } else {
      answer_error(response, 404, "there is no edit");
    }
  });
}

void ViewServer::State::route_run() {
  server.Get("/api/status", [this](const httplib::Request& /*request*/, httplib::Response& response) {
    const RunProgress now = run.progress();
    answer(response, 200,
           {{"work", work.filename().string()},
            {"running", now.running},
            {"stage", text_or_null(now.stage)},
            {"error", text_or_null(now.running ? "" : now.error)},
            {"edit", edits.read().has_value()}});
  });
  server.Get("/api/run", [this](const httplib::Request& /*request*/, httplib::Response& response) {
    answer(response, 200, run_json(run.progress()));
  });
  server.Post("/api/run", [this](const httplib::Request& /*request*/, httplib::Response& response) {
    const bool started = run.start();
    answer(response, started ? 202 : 409, run_json(run.progress()));
  });
}

ViewServer::ViewServer(std::filesystem::path work, std::vector<std::string> pipeline)
    : state_(std::make_unique<State>(std::move(work), std::move(pipeline))) {
  state_->protect();
  state_->route_files();
  state_->route_edit();
  state_->route_run();
}

ViewServer::~ViewServer() = default;

int ViewServer::bind(int port) {
  constexpr const char* kLoopback = "127.0.0.1";
  if (port == 0) {
    port = state_->server.bind_to_any_port(kLoopback);
  } else if (!state_->server.bind_to_port(kLoopback, port)) {
    port = -1;
  }
  if (port <= 0) {
    throw StageError(errors::kUsage, "--port", "the port cannot be taken: another program has it",
                     "choose another one with PORT=, or none to get any that is free");
  }
  state_->port = port;
  return port;
}

void ViewServer::serve() {
  state_->server.listen_after_bind();
}

void ViewServer::stop() {
  state_->server.stop();
  state_->run.stop();
}

}  // namespace roomcut
