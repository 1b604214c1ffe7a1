// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/features.h"

#include <gtest/gtest.h>

#include "stages/raycast/raycast.h"
#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
namespace {

std::string table_of(const FeatureWeights& weights) {
  std::string text = "# a comment\n\nsource: " + weights.source + "\n";
  for (const FeatureWeight& f : weights.features) {
    text += f.name + " | " + std::to_string(f.weight) + " | " + f.meaning + "\n";
  }
  return text + "constant | " + std::to_string(weights.constant) + " | what is known of nothing\n";
}

TEST(Weights, ATableIsReadInWhateverOrder) {
  FeatureWeights weights = shipped_weights();
  std::swap(weights.features[0], weights.features[7]);
  const FeatureWeights read = parse_weights(table_of(weights));
  EXPECT_EQ(read.constant, shipped_weights().constant);
  EXPECT_EQ(read.source, shipped_weights().source);
  for (std::size_t i = 0; i < kFeatures; ++i) {
    EXPECT_EQ(read.features[i].name, shipped_weights().features[i].name);
    EXPECT_EQ(read.features[i].weight, shipped_weights().features[i].weight);
  }
}

TEST(Weights, ATableThatLeavesADoubtIsRefused) {
  const std::string good = table_of(shipped_weights());
  const auto without = [&](const std::string& begin) {
    std::string text = good;
    const std::size_t at = text.find("\n" + begin);
    return text.erase(at, text.find('\n', at + 1) - at);
  };
  EXPECT_NO_THROW(parse_weights(good));
  for (const std::string& bad :
       {good + "sky | 1 | once more\n", good + "smell | 1 | no feature\n", good + "sky\n",
        without("sky") + "sky | one | no number\n", without("sky") + "sky | nan | no number\n",
        without("sky") + "sky | 1 2 | two\n", without("sky") + "sky | 1 |\n", without("sky"),
        without("constant"), without("source")}) {
    EXPECT_THROW(parse_weights(bad), std::invalid_argument) << bad;
  }
}

TEST(Weights, BetaIsTheSigmoidOfTheWeighedFeaturesThatAreStored) {
  const CellComplex complex = weigh_faces::grid_complex({-2, 0, 3, 5}, {-2, 0, 3, 5}, {-1, 0, 3, 4});
  std::vector<bool> empty(complex.cells(), false);
  empty[complex.cell(4, 1)] = true;
  const DataTerms terms = cast_rays(complex, weights_of(complex, empty), {});
  ASSERT_EQ(terms.features.size(), kFeatures);
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    double odds = terms.constant;
    for (const CellFeature& feature : terms.features) {
      odds += feature.weight * static_cast<double>(feature.value[c]);
    }
    EXPECT_NEAR(terms.beta[c], 1 / (1 + std::exp(-odds)), 1e-5) << c;
  }
}

}  // namespace
}  // namespace roomcut::raycast
