#include "tests/faults/schedule.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

namespace trivela::faults {
namespace {

using testing::Each;
using testing::Pair;

std::vector<std::string> texts(const std::vector<Fault>& faults) {
  std::vector<std::string> out;
  for (const Fault& fault : faults) out.push_back(text(fault));
  return out;
}

TEST(Schedule, IsTheSeeds) {
  EXPECT_EQ(texts(draw_faults(100, 7, true)), texts(draw_faults(100, 7, true)));
  EXPECT_NE(texts(draw_faults(100, 7, true)), texts(draw_faults(100, 8, true)));
  const auto more = texts(draw_faults(200, 7, true));
  EXPECT_EQ(texts(draw_faults(100, 7, true)), std::vector(more.begin(), more.begin() + 100)) << "more goes on with it";
}

TEST(Schedule, HasEachKindOnEachNodeAlike) {
  std::map<FaultKind, int> kinds;
  std::map<std::pair<FaultKind, std::size_t>, int> nodes;
  for (Fault fault : draw_faults(560, 1, true)) {
    if (fault.kind == FaultKind::kSilence) {
      EXPECT_EQ(kNodes[fault.node], "referee");
      fault.kind = FaultKind::kTwin;  // in whose place it is
    }
    ++kinds[fault.kind];
    if (!on_link(fault.kind)) ++nodes[{fault.kind, fault.node}];
  }
  EXPECT_EQ(kinds.size(), 7u);
  EXPECT_THAT(kinds, Each(Pair(testing::_, 80)));
  EXPECT_EQ(nodes.size(), 4 * kNodes.size());
  EXPECT_THAT(nodes, Each(Pair(testing::_, 10)));
}

TEST(Schedule, ComesToEachLinkAndEachNodesCable) {
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (const Fault& fault : draw_faults(7 * (links().size() + kNodes.size()), 3, true)) {
    if (fault.kind == FaultKind::kCut) seen.insert({fault.node, fault.other.value_or(kNodes.size())});
  }
  EXPECT_EQ(seen.size(), links().size() + kNodes.size());
}

TEST(Schedule, LeavesLinksAloneWhereThereAreNone) {
  const auto faults = draw_faults(100, 1, false);
  EXPECT_EQ(faults.size(), 100u);
  EXPECT_TRUE(std::none_of(faults.begin(), faults.end(), [](const Fault& fault) { return on_link(fault.kind); }));
}

TEST(Schedule, StallsGoRoundTheNodesForHalfASecondToTwo) {
  const auto stalls = draw_stalls(3, 1);
  std::map<std::size_t, int> nodes;
  for (std::size_t i = 0; i < stalls.size(); ++i) {
    EXPECT_EQ(stalls[i].kind, FaultKind::kStop);
    ++nodes[stalls[i].node];
    EXPECT_GE(stalls[i].lasts_s, 0.5);
    EXPECT_LE(stalls[i].lasts_s, 2.0);
  }
  EXPECT_EQ(nodes.size(), kNodes.size() - 1) << "all but the referee, which is lost in ways of its own";
  EXPECT_THAT(nodes, Each(Pair(testing::_, 3)));
}

}  // namespace
}  // namespace trivela::faults
