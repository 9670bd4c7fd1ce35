// The node in a match and `trivela drift` on the same match's log. Simulated.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "evaluator/drift_report/log_drift.hpp"
#include "experiment/run/experiment.hpp"
#include "nodes/kicker_drift/kicker_drift_node.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

/// A match whose kicker loses 8 % of its speed after 40 kicks.
experiment::ExperimentPlan failing(std::uint64_t seed, kicking::PolicyName policy) {
  experiment::ExperimentPlan plan;
  plan.scenario.kicker.drop_ratio = 0.08;
  plan.scenario.kicker.drop_after_kicks = 40;
  plan.arms.resize(1);
  plan.arms[0].name = "failing";
  plan.arms[0].policy = policy;
  plan.seed = seed;
  plan.possessions = 160;
  return plan;
}

class KickerDriftMatchTest : public NodeTest {
 protected:
  evaluator::RobotDrift as_the_verb_says(const experiment::ExperimentPlan& plan) const {
    const std::filesystem::path log = folder / fmt::format("{}.db", plan.seed);
    const experiment::ExperimentWatch nobody{.found = [](std::int64_t) {},
                                             .progress = [](double, double, const std::string&) {},
                                             .stop = [] { return false; }};
    experiment::run_experiment(plan, log.string(), nobody);
    return evaluator::drift_in({log}).robots.at(0);
  }

  /// The messages of the same match, by their instants, over the bus.
  std::vector<msg::KickerDrift> as_the_node_says(const experiment::ExperimentPlan& plan) {
    experiment::MatchRecord record;
    experiment::play_match(plan.scenario, plan.arms[0], plan.seed, 0, plan.possessions, {}, &record);
    KickerDriftNode node{context};
    Received<msg::KickerDrift> received{participant};
    const Running running{bus::Executor::kListener, stop, {&node.node()}};
    std::multimap<std::int64_t, std::function<void()>> words;
    const auto add = [&](auto& writer, const auto& messages) {
      for (const auto& message : messages) words.emplace(message.t_ns, [&] { writer.write(message); });
    };
    add(decisions, record.decisions);
    add(receipts, record.receipts);
    add(outcomes, record.outcomes);
    for (const auto& [t_ns, say] : words) say();
    return received.now();
  }

  tests::Folder folder;
  bus::Writer<msg::KickDecision> decisions{participant};
  bus::Writer<msg::KickReceipt> receipts{participant};
  bus::Writer<msg::KickOutcome> outcomes{participant};
};

class KickerDriftMatchOf : public KickerDriftMatchTest,
                           public testing::WithParamInterface<std::tuple<std::uint64_t, kicking::PolicyName>> {};

TEST_P(KickerDriftMatchOf, NodeAndVerbNameTheSameKicks) {
  const auto plan = failing(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const evaluator::RobotDrift verb = as_the_verb_says(plan);
  const std::vector<msg::KickerDrift> node = as_the_node_says(plan);
  ASSERT_FALSE(verb.timeline.drifts.empty());
  ASSERT_EQ(node.size(), verb.timeline.drifts.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    const evaluator::Drift& drift = verb.timeline.drifts[i];
    EXPECT_EQ(node[i].changes, i + 1);
    EXPECT_EQ(node[i].changed_kick_id, verb.kicks[drift.changed].kick_id);
    EXPECT_EQ(node[i].found_kick_id, verb.kicks[drift.found].kick_id);
    EXPECT_EQ(node[i].kind == msg::DRIFT_ELEVATION, drift.kind == evaluator::DriftKind::kElevation);
    EXPECT_NEAR(std::log(node[i].factor), drift.factor.value, 1e-12);
    EXPECT_NEAR(node[i].height_m, drift.height_m, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, KickerDriftMatchOf,
                         testing::Combine(testing::Values(1, 2, 3, 4), testing::Values(kicking::PolicyName::kPredictive,
                                                                                       kicking::PolicyName::kMoving)));

}  // namespace
}  // namespace trivela::nodes
