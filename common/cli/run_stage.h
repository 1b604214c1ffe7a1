// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/errors/error.h"
#include "common/params/params.h"

namespace roomcut {

/// A file that a stage reads or writes: option `--<name> FILE`, default `<work>/<default_path>`.
struct StageFile {
  std::string name;  ///< "cloud" gives the option --cloud
  std::string description;
  bool optional = false;  ///< may be absent (e.g. edits/wall_lines.geojson) or not asked for
  /// Inputs only: provenance takes the digest of the file's bytes, whatever the file says of itself. For
  /// files that a person may edit.
  bool by_bytes = false;
  /// Below the work folder. run_stage() takes it from the pipeline table (common/pipeline); given here by
  /// programs that stand in no line of it. None in either: the option is required, unless optional.
  std::string default_path{};
};

/// A free-standing option of one stage that is neither a parameter nor an artefact (e.g. ingest's --up).
struct StageOption {
  std::string name;
  std::string default_value;
  std::string description;
  std::vector<std::string> choices;  ///< empty: any text
};

struct StageInfo {
  std::string name;
  int revision = 1;     ///< raised whenever the results change for equal inputs and parameters
  std::string summary;  ///< first line of --help
  std::vector<StageFile> inputs;
  std::vector<StageFile> outputs;
  std::vector<StageOption> options;
};

/// A progress bar with rate and remaining time on a terminal, a plain line now and then when piped, nothing
/// with -q.
class Progress {
 public:
  Progress(std::string what, std::uint64_t total, bool quiet);
  ~Progress();
  void advance(std::uint64_t amount);  ///< thread-safe, cheap

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a stage's body gets: its files, its provenance and the ways to tell the user something.
class StageRun {
 public:
  std::filesystem::path input(const std::string& name) const;
  bool has_input(const std::string& name) const;  ///< whether an optional input is there
  std::filesystem::path output(const std::string& name) const;
  const std::string& option(const std::string& name) const;
  int threads() const;
  bool quiet() const;

  /// Stage, revision, parameters and the digests of all inputs that are there, with paths relative to the
  /// first output. An artefact's digest is the payload digest it states; for other files the bytes are
  /// hashed.
  const Provenance& provenance() const;
  /// Replaces the digest of an input that is no artefact and that the stage hashes while it reads (the scan).
  void set_input_digest(const std::string& name, const std::string& sha256);

  /// A file that the stage has written beside its declared outputs: Make notices when it is missing or
  /// changed.
  void wrote(const std::filesystem::path& path);

  Progress progress(const std::string& what, std::uint64_t total) const;
  /// A value that `auto` resolved to: printed with the parameter's formula as "slice: bandwidth_m = 0.012 (2
  /// x noise)" and kept in the log.
  void chose(const std::string& parameter, double value);
  /// A count or figure of this run: printed at the end and kept in the log.
  void count(const std::string& what, double value, const std::string& unit = "");
  /// How something was understood: printed at once, kept in the log.
  void note(const std::string& text);
  /// A warning: printed at once, repeated at the end, kept in the log.
  void warn(const std::string& text);

  struct State;
  explicit StageRun(State& state) : state_(state) {}

 private:
  State& state_;
};

/// The whole life of a stage's process: options (--work, --config, --params, --set, --threads, --log, -q,
/// --dump-params,
/// --version, --help and one per file), TBB thread limit, log file `<work>/logs/<stage>.json`, errors, exit
/// code. `table` is bound to the params struct that `body` uses.
int run_stage(int argc, char** argv, const StageInfo& declared, ParameterTable table,
              const std::function<void(StageRun&)>& body);

}  // namespace roomcut
