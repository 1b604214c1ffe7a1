// SPDX-License-Identifier: GPL-3.0-or-later
// usage: learn_weights LESSONS PRIOR GENERATIONS THREADS [BUILDING …]: learns the weights of the data term
// with the cut in the loop, with all lessons and with those of each BUILDING left out. LESSONS: JSON, what
// `make accuracy-weights` writes; PRIOR: a weights.table where the search starts and is drawn to. Prints one
// line of JSON for each: the weights, and how every lesson does with them: IoU of graphcut's labels, the
// truth's own labels' (bound), loss.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <string>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "stages/raycast/features.h"
#include "tests/accuracy/learn/teacher.h"

namespace {

using namespace roomcut;
using namespace roomcut::learn;

Lesson read_lesson(const Json& item) {
  LessonData data;
  data.scene = item.at("scene");
  data.building = item.at("building");
  data.made_up = item.at("made_up");
  data.final = item.at("final");
  ParameterTable table = graphcut::parameters(data.params);
  load_dump(std::string(item.at("params")), "graphcut", table);
  read_files({std::string(item.at("cells")), std::string(item.at("weights")), std::string(item.at("terms")),
              std::string(item.at("truth"))},
             data);
  return Lesson(std::move(data));
}

std::vector<Lesson> read_lessons(const std::filesystem::path& path) {
  const Json items = parse_json(read_text_file(path));
  std::vector<std::optional<Lesson>> read(items.size());
  tbb::parallel_for(std::size_t{0}, read.size(),
                    [&](std::size_t i) { read[i].emplace(read_lesson(items[i])); });
  std::vector<Lesson> lessons;
  for (std::optional<Lesson>& lesson : read) {
    lessons.push_back(std::move(*lesson));
  }
  return lessons;
}

/// Weights as weights.table has them: two digits behind the point.
Eigen::VectorXd rounded(const Eigen::VectorXd& weights) {
  return weights.unaryExpr([](double weight) { return std::round(100 * weight) / 100; });
}

/// How the weights do on every lesson.
void report(std::vector<Lesson>& lessons, const std::string& name, const Eigen::VectorXd& weights) {
  std::vector<Json> scores(lessons.size());
  tbb::parallel_for(std::size_t{0}, lessons.size(), [&](std::size_t i) {
    const LessonData& data = lessons[i].data();
    scores[i] = {{"scene", data.scene},         {"building", data.building},
                 {"final", data.final},         {"iou", lessons[i].iou(weights)},
                 {"bound", lessons[i].bound()}, {"loss", lessons[i].loss(weights)}};
  });
  Json result{{"name", name}, {"lessons", scores}};
  const std::vector<std::string>& names = lessons.front().names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    result["weights"][names[i]] = weights[static_cast<Eigen::Index>(i)];
  }
  std::cout << result.dump() << std::endl;
}

int run(const std::vector<std::string>& arguments) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, std::stoul(arguments[3]));
  std::vector<Lesson> lessons = read_lessons(arguments[0]);
  const std::vector<std::string>& names = lessons.at(0).names();
  const School school{lessons, in_order(raycast::shipped_weights(), names),
                      in_order(raycast::parse_weights(read_text_file(arguments[1])), names)};
  EvolutionParams params;
  params.generations = std::stoi(arguments[2]);
  report(lessons, "shipped", school.shipped);
  report(lessons, "prior", school.prior);
  report(lessons, "all", rounded(learned_weights(school, "", params).best));
  for (std::size_t i = 4; i < arguments.size(); ++i) {
    report(lessons, "without " + arguments[i], rounded(learned_weights(school, arguments[i], params).best));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: learn_weights LESSONS PRIOR GENERATIONS THREADS [BUILDING …]\n";
    return 2;
  }
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "learn_weights: " << error.what() << "\n";
    return 3;
  }
}
