#include "bus/reactions.hpp"

#include <gmock/gmock.h>

#include <random>

namespace trivela::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(Graph, TheKickChainHasNoCycle) {
  const std::vector<Reaction> chain{
      {"odometry/wheels", "device:wheels", {"odometry"}},
      {"world_state/odometry", "odometry", {"world_state"}},
      {"kick_decision/world_state", "world_state", {"drive", "kick_decision", "kick_order"}},
      {"kicker_driver/kick_order", "kick_order", {"kick_receipt", "kicker_status"}}};
  EXPECT_EQ(find_cycle(chain), std::nullopt);
}

TEST(Graph, TwoWaysToTheSameTopicAreNoCycle) {
  const std::vector<Reaction> diamond{{"n/a", "a", {"b", "c"}}, {"n/b", "b", {"d"}}, {"n/c", "c", {"d"}}};
  EXPECT_EQ(find_cycle(diamond), std::nullopt);
}

TEST(Graph, AReactionThatWritesItsOwnInputIsACycle) {
  const std::vector<Reaction> self{{"n/a", "a", {"b", "a"}}};
  EXPECT_THAT(find_cycle(self), Optional(ElementsAre("a", "a")));
}

TEST(Graph, ACycleIsNamedWithoutTheTopicsThatLeadIntoIt) {
  const std::vector<Reaction> reactions{
      {"n/in", "in", {"x"}}, {"n/x", "x", {"y", "out"}}, {"m/y", "y", {"z"}}, {"n/z", "z", {"x"}}};
  EXPECT_THAT(find_cycle(reactions), Optional(ElementsAre("x", "y", "z", "x")));
}

TEST(Graph, NoReactionsHaveNoCycle) { EXPECT_EQ(find_cycle({}), std::nullopt); }

// Edges from lower to higher numbers cannot close; one edge back along a path does.
TEST(Graph, RandomForwardGraphsHaveNoCycleUntilAnEdgeLeadsBack) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const int topics = 2 + static_cast<int>(random() % 10);
    std::vector<Reaction> reactions;
    for (int from = 0; from + 1 < topics; ++from) {
      std::vector<std::string> outputs{std::to_string(from + 1)};
      for (int to = from + 2; to < topics; ++to)
        if (random() % 2) outputs.push_back(std::to_string(to));
      reactions.push_back({"n/" + std::to_string(from), std::to_string(from), outputs});
    }
    ASSERT_EQ(find_cycle(reactions), std::nullopt);
    const auto back = std::to_string(random() % static_cast<unsigned>(topics));
    reactions.push_back({"n/back", std::to_string(topics - 1), {back}});
    const auto cycle = find_cycle(reactions);
    ASSERT_TRUE(cycle);
    ASSERT_GE(cycle->size(), 2u);
    ASSERT_EQ(cycle->front(), cycle->back());
    for (std::size_t i = 0; i + 1 < cycle->size(); ++i) {  // every step is an edge
      const bool edge = std::any_of(reactions.begin(), reactions.end(), [&](const Reaction& r) {
        return r.input == (*cycle)[i] && std::count(r.outputs.begin(), r.outputs.end(), (*cycle)[i + 1]) > 0;
      });
      ASSERT_TRUE(edge) << (*cycle)[i] << " -> " << (*cycle)[i + 1];
    }
  }
}

}  // namespace
}  // namespace trivela::bus
