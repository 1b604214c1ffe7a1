// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_stations.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>

#include "common/errors/codes.h"
#include "stages/ingest/scan_file.h"
#include "stages/ingest/text_bytes.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kLargestStationsFile = 1 << 20;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The words of `text`, split at spaces, tabs, commas, semicolons.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  while ((begin = text.find_first_not_of(" \t,;\r", begin)) != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(" \t,;\r", begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// All numbers among the words, in order.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    if (const std::optional<double> value = number_of(word)) {
      numbers.push_back(*value);
    }
  }
  return numbers;
}

}  // namespace

std::vector<Vec3> stations_of_comments(const std::vector<std::string>& comments) {
  Vec3 offset(0, 0, 0);
  for (const std::string& comment : comments) {
    const std::vector<double> numbers = numbers_in(comment);
    if (lower_case(comment).find("offset_subtracted") != std::string::npos && numbers.size() == 3) {
      offset = Vec3(numbers[0], numbers[1], numbers[2]);
    }
  }
  std::vector<Vec3> stations;
  for (const std::string& comment : comments) {
    const std::string text = lower_case(comment);
    const std::vector<std::string> words = words_of(text);
    const bool one = words.size() == 4 && words.front() == "station";
    const bool many =
        text.find("scanner position") != std::string::npos && text.find(':') != std::string::npos;
    if (!one && !many) {
      continue;
    }
    const std::vector<double> numbers = numbers_in(many ? text.substr(text.find(':') + 1) : text);
    if (numbers.size() % 3 != 0) {
      continue;
    }
    const bool before = text.find("before offset") != std::string::npos;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
      stations.emplace_back(Vec3(numbers[i], numbers[i + 1], numbers[i + 2]) -
                            (before ? offset : Vec3(0, 0, 0)));
    }
  }
  return stations;
}

std::vector<Vec3> read_stations(const std::filesystem::path& path) {
  const TextBytes file(std::make_shared<const ScanFile>(path));
  if (file.size() > kLargestStationsFile) {
    throw StageError(errors::kScanFormat, file.name(), "too large for a list of scanner positions",
                     "give one position per line: x y z");
  }
  std::string text(static_cast<std::size_t>(file.size()), '\0');
  text.resize(file.read(0, text.data(), text.size()));
  std::vector<Vec3> stations;
  std::size_t begin = 0;
  for (std::size_t line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<std::string> words = words_of(text.substr(begin, end - begin));
    begin = end + 1;
    if (words.empty() || words.front().starts_with('#')) {
      continue;
    }
    Vec3 position;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = i < words.size() ? number_of(words[i]) : std::nullopt;
      if (!value) {
        throw StageError(errors::kScanBadLine, file.name() + ": line " + std::to_string(line),
                         "is no scanner position", "give one position per line: x y z");
      }
      position[static_cast<Eigen::Index>(i)] = *value;
    }
    stations.push_back(position);
  }
  return stations;
}

}  // namespace roomcut::ingest
