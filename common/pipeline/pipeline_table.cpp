// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/pipeline/pipeline_table.h"

#include <algorithm>
#include <stdexcept>

#include "common/text/words.h"

namespace roomcut {

namespace {

constexpr std::string_view kBeside = "-";
constexpr std::string_view kScan = "scan";

/// Takes what stands before the separator off the front; empty when there is no separator.
std::string_view take_front(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string_view::npos) return {};
  const std::string_view front = text.substr(0, at);
  text.remove_prefix(at + 1);
  return front;
}

}  // namespace

PipelineTable::PipelineTable(std::string_view text) {
  for (const std::string_view line : split(text, '\n')) {
    if (!line.empty() && line.front() != '#') add_line(line);
  }
}

void PipelineTable::add_line(std::string_view line) {
  const std::vector<std::string_view> columns = split(line, '|');
  if (columns.size() != 4) {
    throw std::logic_error("pipeline table: not four columns: " + std::string(line));
  }
  PipelineRun run{std::string(columns[0]), std::string(columns[1]), {}, {}};
  for (const std::string_view item : split(columns[2], ' ')) run.reads.push_back(file_of(item));
  for (const std::string_view item : split(columns[3], ' ')) run.writes.push_back(file_of(item));
  if (std::find(programs_.begin(), programs_.end(), run.program) == programs_.end()) {
    programs_.push_back(run.program);
  }
  (run.name == kBeside ? beside_ : runs_).push_back(std::move(run));
}

RunFile PipelineTable::file_of(std::string_view item) {
  if (item == kScan || item.find_first_of(":=") == std::string_view::npos) {
    if (item == kScan || item.find('/') != std::string_view::npos) return {"", std::string(item)};
    return {std::string(item), path(item)};
  }
  std::string_view rest = item;
  const std::string_view option = take_front(rest, ':');
  const std::string_view defined = take_front(rest, '=');
  const std::string_view artefact = defined.empty() ? rest : defined;
  if (!defined.empty()) artefacts_.push_back({std::string(defined), std::string(rest)});
  return {std::string(option.empty() ? artefact : option), path(artefact)};
}

const std::string& PipelineTable::path(std::string_view artefact) const {
  const auto found = std::find_if(artefacts_.begin(), artefacts_.end(),
                                  [&](const Artefact& known) { return known.name == artefact; });
  if (found == artefacts_.end()) {
    throw std::logic_error("pipeline table: no artefact " + std::string(artefact));
  }
  return found->path;
}

const PipelineRun* PipelineTable::first_run(std::string_view program) const {
  for (const auto* list : {&runs_, &beside_}) {
    const auto found = std::find_if(list->begin(), list->end(),
                                    [&](const PipelineRun& run) { return run.program == program; });
    if (found != list->end()) return &*found;
  }
  return nullptr;
}

std::optional<std::string> PipelineTable::default_path(std::string_view program,
                                                       std::string_view option) const {
  if (const PipelineRun* run = first_run(program)) {
    for (const auto* list : {&run->reads, &run->writes}) {
      for (const RunFile& file : *list) {
        if (file.option == option) return file.path;
      }
    }
  }
  return std::nullopt;
}

std::vector<RunFile> PipelineTable::other_files(const PipelineRun& run) const {
  std::vector<RunFile> others;
  for (const auto* list : {&run.reads, &run.writes}) {
    for (const RunFile& file : *list) {
      if (!file.option.empty() && default_path(run.program, file.option) != file.path) others.push_back(file);
    }
  }
  return others;
}

const PipelineTable& pipeline_table() {
  static const PipelineTable kTable(
#include "pipeline_table.inc"
  );
  return kTable;
}

std::string make_rule(const PipelineTable& table, const PipelineRun& run) {
  const auto paths = [](const std::vector<RunFile>& files) {
    std::string text;
    for (const RunFile& file : files) text += (text.empty() ? "" : " ") + file.path;
    return text;
  };
  std::string options;
  for (const RunFile& file : table.other_files(run)) options += " --" + file.option + " " + file.path;
  return "$(eval $(call stage," + run.name + "," + run.program + "," + paths(run.writes) + "," +
         paths(run.reads) + "," + options + "))\n";
}

}  // namespace roomcut
