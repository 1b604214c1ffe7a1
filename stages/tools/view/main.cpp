// SPDX-License-Identifier: GPL-3.0-or-later
#include <signal.h>

#include <iostream>
#include <thread>

#include "common/cli/run_stage.h"
#include "common/errors/codes.h"
#include "common/pipeline/pipeline_table.h"
#include "stages/tools/view/server.h"

namespace {

using namespace roomcut;
using namespace roomcut::view;

StageInfo info() {
  StageInfo stage;
  stage.name = "view";
  stage.summary = "Serves the report of a work folder on 127.0.0.1, takes edits and reruns the pipeline";
  stage.inputs = {{"report", "The page; its folder is the one that is served", false, false,
                   pipeline_table().path("report")}};
  stage.options = {{"port", "0", "Port to listen on; 0: any free one", {}},
                   {"pipeline", "", "Script that POST api/run starts: sh SCRIPT run", {}}};
  return stage;
}

int port_number(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 6 && text.find_first_not_of("0123456789") == std::string::npos;
  const int port = digits ? std::stoi(text) : -1;
  if (port < 0 || port > 65535) {
    throw StageError(errors::kUsage, "--port", "\"" + text + "\" is no port", "say a number from 0 to 65535");
  }
  return port;
}

void body(StageRun& run) {
  const std::filesystem::path page = run.input("report");
  if (!run.has_input("report")) {
    throw StageError(errors::kArtefactMissing, page.string(), "there is no page to show yet",
                     "make run makes it");
  }
  // Blocked before the first thread begins, so that only sigwait() below sees them.
  sigset_t ends;
  ::sigemptyset(&ends);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    ::sigaddset(&ends, number);
  }
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  ViewServer server(std::filesystem::canonical(page.parent_path()), {"sh", run.option("pipeline"), "run"});
  const int port = server.bind(port_number(run.option("port")));
  std::thread answering([&server] { server.serve(); });
  std::cout << "http://127.0.0.1:" << port << "/ shows " << page.string() << "; Ctrl-C ends it" << std::endl;
  int number = 0;
  ::sigwait(&ends, &number);
  server.stop();
  answering.join();
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(argc, argv, info(), {}, body);
}
