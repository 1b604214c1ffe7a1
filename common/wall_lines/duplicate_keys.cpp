// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/duplicate_keys.h"

#include <map>

#include "common/artefact/json.h"

namespace roomcut {

namespace {

/// Walks the text without building values; keeps the keys of the open objects only.
class DuplicateFinder : public nlohmann::json_sax<Json> {
 public:
  explicit DuplicateFinder(std::vector<DuplicateKey>& found) : found_(found) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (++level.times[name] == 2) {
      found_.push_back({path(), name});
    }
    level.key = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  struct Level {
    bool array = false;
    std::size_t index = 0;  ///< of the current element of an array
    std::string key;        ///< of the current member of an object
    std::map<std::string, int> times;
  };

  bool open(bool array) {
    levels_.push_back({array, 0, "", {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }
  /// A value is complete: the array that holds it goes on to its next element.
  bool value() {
    if (!levels_.empty() && levels_.back().array) {
      ++levels_.back().index;
    }
    return true;
  }
  /// Path of the object that is open innermost.
  std::string path() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
      const Level& level = levels_[i];
      if (level.array) {
        text += "[" + std::to_string(level.index) + "]";
      } else {
        text += (text.empty() ? "" : ".") + level.key;
      }
    }
    return text;
  }

  std::vector<DuplicateKey>& found_;
  std::vector<Level> levels_;
};

}  // namespace

std::vector<DuplicateKey> find_duplicate_keys(const std::string& text) {
  std::vector<DuplicateKey> found;
  DuplicateFinder finder(found);
  Json::sax_parse(text, &finder);
  return found;
}

}  // namespace roomcut
