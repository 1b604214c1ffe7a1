// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <optional>
#include <system_error>

#include "common/artefact/unsynced_file.h"
#include "common/cli/describe.h"
#include "common/cli/messages.h"
#include "common/cli/stage_stamp.h"
#include "common/cli/stage_state.h"
#include "common/errors/codes.h"
#include "common/pipeline/pipeline_table.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace {

/// What the command line says, before it is resolved.
struct CommandLine {
  std::string work = ".";
  std::string config;
  std::string params;
  std::vector<std::string> sets;
  int threads = 0;
  std::string log;
  std::string stamp;
  std::string reads;
  std::string announce;
  bool if_changed = false;
  bool quiet = false;
  bool verbose = false;
  bool dump = false;
  bool dump_yaml = false;
  bool describe = false;
  bool only_prints() const { return dump || dump_yaml || describe; }
  std::map<std::string, std::string> files;
};

/// For Make, which runs every stage in the work folder.
void declare_stamp_options(CLI::App& app, CommandLine& line) {
  app.add_option("--stamp", line.stamp, "Written when the stage has run: what it read and wrote, by digest")
      ->type_name("FILE")
      ->group("Make");
  app.add_option("--reads", line.reads, "What the stamp says of the inputs: names, separated by spaces")
      ->type_name("FILES")
      ->group("Make");
  app.add_flag("--if-changed", line.if_changed, "Do nothing when the stamp's inputs are still the same")
      ->group("Make");
  app.add_option("--announce", line.announce, "Printed to standard output when the stage begins")
      ->type_name("TEXT")
      ->group("Make");
}

void declare_options(CLI::App& app, const StageInfo& info, CommandLine& line, StageRun::State& state) {
  app.set_version_flag("--version",
                       info.name + " " ROOMCUT_VERSION + ", revision " + std::to_string(info.revision));
  app.add_option("--work", line.work, "Folder of all default paths")->type_name("DIR")->capture_default_str();
  auto* config = app.add_option("--config", line.config, "Parameters: pipeline.yaml")->type_name("FILE");
  app.add_option("--params", line.params, "Parameters: a file written by --dump-params")
      ->type_name("FILE")
      ->excludes(config);
  app.add_option("--set", line.sets, "One parameter, key=value; may be repeated; wins over the files")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--threads", line.threads,
                 "Threads; default: all processors; the result is the same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  app.add_option("--log", line.log,
                 "Log of this run; default: <work>/logs/" + info.name + ".json when --work is given")
      ->type_name("FILE");
  declare_stamp_options(app, line);
  app.add_flag("-q,--quiet", line.quiet, "Print nothing but errors");
  app.add_flag("-v,--verbose", line.verbose, "Print settings and files as well");
  app.add_flag("--dump-params", line.dump, "Print the resolved parameters and stop");
  app.add_flag("--dump-yaml", line.dump_yaml, "Print the parameters as a block of pipeline.yaml and stop");
  app.add_flag("--describe", line.describe, "Print files, options and parameters as JSON and stop");
  for (const auto* list : {&info.inputs, &info.outputs}) {
    const bool is_input = list == &info.inputs;
    for (const StageFile& file : *list) {
      std::string text = file.description + (!file.optional ? ""
                                             : is_input     ? " (may be absent)"
                                                            : " (only when given)");
      text += file.default_path.empty() ? "" : "; default: <work>/" + file.default_path;
      app.add_option("--" + file.name, line.files[file.name], text)
          ->type_name("FILE")
          ->group(is_input ? "Input" : "Output");
    }
  }
  for (const StageOption& option : info.options) {
    std::string& value = state.options[option.name];
    value = option.default_value;
    auto* added = app.add_option("--" + option.name, value, option.description)->capture_default_str();
    if (!option.choices.empty()) {
      added->check(CLI::IsMember(option.choices));
    }
  }
}

/// With the default paths of the pipeline table, where the program gives none itself.
StageInfo with_default_paths(StageInfo info) {
  for (auto* list : {&info.inputs, &info.outputs}) {
    for (StageFile& file : *list) {
      if (file.default_path.empty()) {
        file.default_path = pipeline_table().default_path(info.name, file.name).value_or("");
      }
    }
  }
  return info;
}

void resolve_files(const StageInfo& info, const CommandLine& line, StageRun::State& state) {
  for (const auto* list : {&info.inputs, &info.outputs}) {
    for (const StageFile& file : *list) {
      const std::string& given = line.files.at(file.name);
      if (given.empty() && file.default_path.empty() && !file.optional) {
        throw StageError(errors::kUsage, "--" + file.name, "is required", "see " + info.name + " --help");
      }
      if (!given.empty()) {
        state.files[file.name] = given;
      } else if (!file.default_path.empty()) {
        state.files[file.name] = (std::filesystem::path(line.work) / file.default_path).lexically_normal();
      } else {
        state.files[file.name] = "";
      }
    }
  }
}

std::vector<std::filesystem::path> outputs_of(const StageInfo& info, const StageRun::State& state) {
  std::vector<std::filesystem::path> outputs;
  for (const StageFile& file : info.outputs) {
    if (const std::filesystem::path& path = state.files.at(file.name); !path.empty()) {
      outputs.push_back(path);
    }
  }
  outputs.insert(outputs.end(), state.also_written.begin(), state.also_written.end());
  return outputs;
}

void resolve_parameters(const StageInfo& info, const CommandLine& line, ParameterTable& table) {
  if (!line.params.empty()) {
    load_dump(line.params, info.name, table);
  } else if (!line.config.empty()) {
    load_yaml(line.config, info.name, table);
  }
  for (const std::string& assignment : line.sets) {
    set_parameter(assignment, info.name, table);
  }
}

void echo_settings(const StageInfo& info, const StageRun::State& state, const ParameterTable& table) {
  for (const Parameter& p : table) {
    messages::detail(info.name + ": " + p.name + " = " + p.get() + (p.unit == "1" ? "" : " " + p.unit));
  }
  for (const auto& [name, path] : state.files) {
    messages::detail(info.name + ": --" + name + " " + path.string());
  }
}

/// "slice: 12 levels, 340 cells; 0.53 s, 210 MB", and the warnings once more when there is more than one line
/// of them.
void print_summary(const StageRun::State& state) {
  std::string text;
  for (const Count& count : state.counts) {
    text += (text.empty() ? "" : ", ") + count.what + " " + messages::readable(count.value) +
            (count.unit.empty() || count.unit == "1" ? "" : " " + count.unit);
  }
  const Usage used = usage_since(state.clock);
  messages::info(state.info->name + ": " + text + (text.empty() ? "" : "; ") +
                 messages::resources(used.wall_s, used.peak_mb));
  if (state.warnings.size() > 1) {
    messages::warn(state.info->name + ": " + std::to_string(state.warnings.size()) + " warnings:");
    for (const std::string& warning : state.warnings) {
      messages::warn("  " + warning);
    }
  }
}

/// The body with what Make wants to know before and after it; false when there was nothing to do.
bool run_body(const StageInfo& info, const CommandLine& line, StageRun::State& state,
              const std::function<void(StageRun&)>& body) {
  std::optional<StageStamp> stamp;
  if (!line.stamp.empty()) {
    stamp.emplace(line.stamp, line.reads);
    if (line.if_changed && stamp->is_current()) {
      return false;
    }
    const auto scan = state.files.find(kScanName);
    stamp->begin(scan == state.files.end() ? std::filesystem::path() : scan->second);
  }
  if (!line.announce.empty()) {
    std::cout << line.announce << std::endl;  // at once: somebody waits for it
  }
  StageRun run(state);
  body(run);
  if (stamp) {
    stamp->settle(run, outputs_of(info, state));
  }
  return true;
}

int report(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) {
    std::cerr << to_string(problem);
  }
  return static_cast<int>(problems.front().code.exit_code);
}

/// std::filesystem says it by a code.
bool is_want_of_memory(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         (system != nullptr && system->code() == std::errc::not_enough_memory);
}

/// Runs the body; every way in which it can end becomes an exit code.
int guarded(const std::function<void()>& body, std::vector<Problem>& problems) {
  try {
    body();
    return static_cast<int>(ExitCode::kDone);
  } catch (const StageError& error) {
    problems = error.problems();
    return report(problems);
  } catch (const std::exception& error) {
    if (is_want_of_memory(error)) {
      problems.push_back({errors::kTooComplex, "", std::string(kNoMemory), std::string(kNoMemoryHint)});
      return report(problems);
    }
    static constexpr ErrorCode kBug{"B01", ExitCode::kBug};
    problems.push_back({kBug, "", std::string("unexpected: ") + error.what(),
                        "this is a bug in roomcut: please report it with the command line and the log"});
    return report(problems);
  }
}

void write_log(const CommandLine& line, bool work_given, const StageInfo& info, const StageRun::State& state,
               const std::vector<Problem>& problems, int exit_code) {
  if (line.log.empty() && !work_given) {
    return;
  }
  const std::filesystem::path path = line.log.empty()
                                         ? std::filesystem::path(line.work) / "logs" / (info.name + ".json")
                                         : std::filesystem::path(line.log);
  try {
    write_unsynced_file(path, run_log(state, problems, exit_code) + "\n");
  } catch (const std::exception& error) {
    std::cerr << "warning: " << info.name << ": the log is not written: " << error.what();
  }
}

}  // namespace

int run_stage(int argc, char** argv, const StageInfo& declared, ParameterTable table,
              const std::function<void(StageRun&)>& body) {
  const StageInfo info = with_default_paths(declared);
  StageRun::State state;
  state.info = &info;
  state.table = &table;
  CommandLine line;
  CLI::App app(info.summary, info.name);
  app.footer("Parameters (pipeline.yaml, block " + info.name + ", or --set):\n" + parameter_help(table));
  declare_options(app, info, line, state);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return report({{errors::kUsage, info.name, error.what(), "see " + info.name + " --help"}});
  }
  messages::start(line.quiet     ? messages::Level::kErrorsOnly
                  : line.verbose ? messages::Level::kDetails
                                 : messages::Level::kUsual);
  install_signal_handlers();
  const bool work_given = app.get_option("--work")->count() > 0;

  std::vector<Problem> problems;
  bool ran = true;  // also a stage that failed
  const int exit_code = guarded(
      [&] {
        resolve_parameters(info, line, table);
        if (line.dump) {
          std::cout << dump_params(info.name, info.revision, table) << std::flush;
          return;
        }
        if (line.dump_yaml) {
          std::cout << parameter_yaml(info.name, info.summary, table) << std::flush;
          return;
        }
        if (line.describe) {
          std::cout << describe_program(info, table) << "\n" << std::flush;
          return;
        }
        resolve_files(info, line, state);
        state.params_json = params_json(table);
        state.quiet = line.quiet;
        state.verbose = line.verbose;
        state.threads = line.threads > 0 ? line.threads : available_threads();
        // All available threads are TBB's own default; to ask for them costs a millisecond of looking for
        // libraries.
        std::optional<tbb::global_control> limit;
        if (line.threads > 0) {
          limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(line.threads));
        }
        echo_settings(info, state, table);
        ran = run_body(info, line, state, body);
        if (!ran) {
          return;
        }
        print_summary(state);
      },
      problems);
  if (!line.only_prints() && ran) {
    write_log(line, work_given, info, state, problems, exit_code);
  }
  return exit_code;
}

}  // namespace roomcut
