// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/errors/error.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "common/errors/codes.h"

namespace roomcut {
namespace {

std::string read(const std::string& path) {
  std::ifstream in(std::string(ROOMCUT_SOURCE_DIR) + path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::set<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> ids;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    ids.insert((*it)[1]);
  }
  return ids;
}

TEST(Errors, AProblemIsPrintedWithCodePlaceCauseAndHint) {
  const Problem problem{errors::kLinesDegenerate, "edits/wall_lines.geojson: features[17]",
                        "both ends are equal", "delete the feature or move an end"};
  EXPECT_EQ(to_string(problem),
            "error[L07] edits/wall_lines.geojson: features[17]: both ends are equal\n"
            "hint: delete the feature or move an end\n");
}

TEST(Errors, WordsOfAMegabyteInAFileMakeNoMessageOfAMegabyte) {
  const std::string text =
      to_string({errors::kUsage, std::string(1000000, 'x'), std::string(1000000, 'y'), "look"});
  EXPECT_LT(text.size(), 5000U);
  EXPECT_NE(text.find("\nhint: look\n"), std::string::npos);
}

TEST(Errors, TheExitCodeIsTheFirstProblems) {
  const StageError error({{errors::kScanEmpty, "a", "b", ""}, {errors::kCannotWrite, "c", "d", ""}});
  EXPECT_EQ(error.exit_code(), ExitCode::kInput);
  EXPECT_EQ(error.problems().size(), 2U);
}

TEST(Errors, AnErrorWithoutAProblemIsABug) {
  EXPECT_THROW(throw StageError(std::vector<Problem>{}), std::logic_error);
}

TEST(Errors, EveryCodeHasAParagraphInTheCatalogueAndTheOtherWayRound) {
  const auto declared = all_matches(read("/common/errors/codes.h"), std::regex("\"([A-Z][0-9]{2})\""));
  const auto documented =
      all_matches(read("/schemas/errors.md"), std::regex("- \\*\\*([A-Z][0-9]{2})\\*\\*"));
  EXPECT_GT(declared.size(), 40U);
  EXPECT_EQ(declared, documented);
}

}  // namespace
}  // namespace roomcut
