// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/duplicate_keys.h"

#include <algorithm>
#include <map>

#include "common/artefact/json_values.h"

namespace roomcut {

namespace {

/// Walks the text without building values; keeps the keys of the open objects only.
class DuplicateFinder : public nlohmann::json_sax<Json> {
 public:
  DuplicateFinder(std::vector<DuplicateKey>& found, std::size_t most) : found_(found), most_(most) {}

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
      found_.push_back({path(), shortened(name)});
    }
    level.key = name;
    return found_.size() < most_;
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
        text += (text.empty() ? "" : ".") + shortened(level.key);
      }
    }
    return text;
  }

  /// A name as a message can hold it; cut between letters.
  static std::string shortened(const std::string& name) {
    constexpr std::size_t kLongest = 80;
    std::size_t end = std::min(name.size(), kLongest);
    while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0U) == 0x80U) {
      --end;
    }
    return end < name.size() ? name.substr(0, end) + "…" : name;
  }

  std::vector<DuplicateKey>& found_;
  std::size_t most_;
  std::vector<Level> levels_;
};

}  // namespace

std::vector<DuplicateKey> find_duplicate_keys(const std::string& text, std::size_t most) {
  std::vector<DuplicateKey> found;
  DuplicateFinder finder(found, most);
  Json::sax_parse(text, &finder);
  return found;
}

}  // namespace roomcut
