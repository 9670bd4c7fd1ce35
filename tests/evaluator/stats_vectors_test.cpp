// The statistics of the paper's Table 2 against tests/vectors/table2_statistics.csv.
#include <gtest/gtest.h>

#include <map>

#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr Counts kOld{34, 65};
constexpr Counts kNew{100, 132};

TEST(Table2Vectors, AreReproducedToTheirPrintedDigits) {
  std::map<std::string, double> expected;
  for (const auto& row : tests::rows("table2_statistics.csv")) expected[row.text("quantity")] = row.number("value");
  const auto ratio = risk_ratio(kOld, kNew);
  const std::map<std::string, double> ours{
      {"IranOpen2014 efficiency", *efficiency(kOld)},
      {"Robotica2014 efficiency", *efficiency(kNew)},
      {"Wilson95 IranOpen lo", wilson(kOld).lo},
      {"Wilson95 IranOpen hi", wilson(kOld).hi},
      {"Wilson95 Robotica lo", wilson(kNew).lo},
      {"Wilson95 Robotica hi", wilson(kNew).hi},
      {"difference", *efficiency(kNew) - *efficiency(kOld)},
      {"Newcombe95 diff lo", newcombe(kOld, kNew).lo},
      {"Newcombe95 diff hi", newcombe(kOld, kNew).hi},
      {"relative improvement from counts", *relative_gain(kOld, kNew)},
      {"risk ratio CI95 lo", ratio->ci.lo},
      {"risk ratio CI95 hi", ratio->ci.hi},
      {"odds ratio (sample)", odds_ratio(kOld, kNew)->value},
  };
  for (const auto& [quantity, value] : ours) EXPECT_NEAR(value, expected.at(quantity), 5e-7) << quantity;
  EXPECT_NEAR(fisher_two_sided(kOld, kNew), expected.at("Fisher exact two-sided p"), 5e-10);
}

}  // namespace
}  // namespace trivela::evaluator::stats
