// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roomcut {

/// A file of a run, by the option of its program that names it.
struct RunFile {
  std::string option;  ///< "cloud" of --cloud; empty: the program is not told of it (inputs/stations.txt)
  std::string path;    ///< in the work folder; "scan" for the scan, wherever it lies
};

/// One run of a program in the pipeline. Some programs run twice, on other files.
struct PipelineRun {
  std::string name;     ///< "final_partition"; "-" for a program beside the pipeline
  std::string program;  ///< "partition"
  std::vector<RunFile> reads;
  std::vector<RunFile> writes;
};

/// A pipeline table: stages/pipeline.table, as README.md describes it.
class PipelineTable {
 public:
  /// Throws std::logic_error, with the line, for what is no table.
  explicit PipelineTable(std::string_view text);

  /// The runs in the order of the pipeline, without the programs beside it.
  const std::vector<PipelineRun>& runs() const { return runs_; }
  /// The programs with a block in pipeline.yaml: each once, in the table's order.
  const std::vector<std::string>& programs() const { return programs_; }
  /// Where an artefact lies in the work folder. Throws std::logic_error for a name that the table does not
  /// have.
  const std::string& path(std::string_view artefact) const;
  /// Where the file of a program's option lies in its first run; none when the table does not say.
  std::optional<std::string> default_path(std::string_view program, std::string_view option) const;
  /// The options that a run needs because its files are not those of its program's first run.
  std::vector<RunFile> other_files(const PipelineRun& run) const;

 private:
  struct Artefact {
    std::string name;
    std::string path;
  };
  void add_line(std::string_view line);
  RunFile file_of(std::string_view item);
  const PipelineRun* first_run(std::string_view program) const;

  std::vector<PipelineRun> runs_;
  std::vector<PipelineRun> beside_;
  std::vector<std::string> programs_;
  std::vector<Artefact> artefacts_;
};

/// The table that the programs were built with.
const PipelineTable& pipeline_table();

/// `run` as rules of Make, for stages/pipeline.mk.
std::string make_rule(const PipelineTable& table, const PipelineRun& run);

}  // namespace roomcut
