#include "kicking/text/nearest_word.hpp"

#include <gtest/gtest.h>

namespace trivela::kicking {
namespace {

TEST(EditDistance, CountsLettersPutInLeftOutReplacedAndSwapped) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("match", "match"), 0u);
  EXPECT_EQ(edit_distance("", "lob"), 3u);
  EXPECT_EQ(edit_distance("lob", ""), 3u);
  EXPECT_EQ(edit_distance("simulte", "simulate"), 1u);
  EXPECT_EQ(edit_distance("mattch", "match"), 1u);
  EXPECT_EQ(edit_distance("metch", "match"), 1u);
  EXPECT_EQ(edit_distance("macth", "match"), 1u);
  EXPECT_EQ(edit_distance("sloev", "solve"), 2u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(EditDistance, IsTheSameBothWays) {
  const std::vector<std::string> words{"", "a", "ab", "ba", "match", "macth", "replay", "report", "evaluate-policy"};
  for (const std::string& one : words) {
    for (const std::string& other : words)
      EXPECT_EQ(edit_distance(one, other), edit_distance(other, one)) << one << other;
  }
}

TEST(NearestWord, IsTheOneThatWasMeant) {
  const std::vector<std::string> verbs{"match", "simulate", "scan", "lob", "report", "replay", "evaluate-policy"};
  EXPECT_EQ(nearest_word("simulte", verbs), "simulate");
  EXPECT_EQ(nearest_word("macth", verbs), "match");
  EXPECT_EQ(nearest_word("reprot", verbs), "report");
  EXPECT_EQ(nearest_word("evaluate_policies", verbs), "evaluate-policy");
  EXPECT_EQ(nearest_word("lop", verbs), "lob");
}

TEST(NearestWord, IsNoneWhereNothingIsNear) {
  EXPECT_EQ(nearest_word("dance", {"match", "scan", "lob"}), std::nullopt);
  EXPECT_EQ(nearest_word("", {"match", "lob"}), std::nullopt);
  EXPECT_EQ(nearest_word("match", {}), std::nullopt);
  EXPECT_EQ(nearest_word("bob", {"cat"}), std::nullopt);
}

}  // namespace
}  // namespace trivela::kicking
