// What decision nodes promise of their orders' liveliness, as the driver's side of the bus is told it.
#include <dds/dds.h>

#include "nodes/kick_decision/kick_decision_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

struct Promise {
  std::int64_t lease_ns = 0;
  std::int32_t strength = -1;
  bool operator==(const Promise&) const = default;
};

void PrintTo(const Promise& promise, std::ostream* out) {  // NOLINT(readability-identifier-naming): GoogleTest's name
  *out << promise.lease_ns << " ns, strength " << promise.strength;
}

class OrderLeaseTest : public NodeTest {
 protected:
  /// Of the one writer of kick_order that a node of this role has.
  Promise promise_of(DecisionNode which) {
    bus::Reader<msg::KickOrder> orders{participant};
    const KickDecisionNode node{context, which};
    EXPECT_TRUE(orders.wait_for_writers(1, kPlenty));
    dds_instance_handle_t writer = 0;
    if (dds_get_matched_publications(orders.handle(), &writer, 1) != 1) return {};
    dds_builtintopic_endpoint_t* const told = dds_get_matched_publication_data(orders.handle(), writer);
    if (told == nullptr) return {};
    Promise promise;
    dds_liveliness_kind_t kind = DDS_LIVELINESS_AUTOMATIC;
    dds_qget_liveliness(told->qos, &kind, &promise.lease_ns);
    dds_qget_ownership_strength(told->qos, &promise.strength);
    EXPECT_EQ(kind, DDS_LIVELINESS_MANUAL_BY_TOPIC) << "a loop that hangs would count as alive";
    dds_builtintopic_free_endpoint(told);
    return promise;
  }

  static constexpr std::int64_t kMs = 1'000'000;
};

TEST_F(OrderLeaseTest, AnOnlyDecisionNodesOrdersLapseAfterATenthOfASecond) {
  EXPECT_EQ(promise_of(DecisionNode::kFirst), (Promise{100 * kMs, 0}));
}

TEST_F(OrderLeaseTest, WithAStandbyTheyLapseAfter60MillisecondsAndTheFirstIsStronger) {
  context.settings.kick_decision.standby = true;
  EXPECT_EQ(promise_of(DecisionNode::kFirst), (Promise{60 * kMs, 1}));
  EXPECT_EQ(promise_of(DecisionNode::kSecond), (Promise{60 * kMs, 0}));
}

}  // namespace
}  // namespace trivela::nodes
