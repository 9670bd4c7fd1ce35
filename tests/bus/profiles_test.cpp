#include <gtest/gtest.h>

#include "bus/domain/qos.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// The QoS that Cyclone gave an entity.
Qos qos_of(dds_entity_t entity) {
  Qos qos(dds_create_qos());
  EXPECT_EQ(dds_get_qos(entity, qos.get()), DDS_RETCODE_OK);
  return qos;
}

struct Facts {
  dds_reliability_kind_t reliability;
  dds_history_kind_t history;
  std::int32_t depth;
  dds_durability_kind_t durability;
  dds_ownership_kind_t ownership;
  dds_liveliness_kind_t liveliness;
  dds_duration_t lease;
  dds_duration_t deadline;
  dds_duration_t latency_budget;
};

Facts facts_of(dds_entity_t entity) {
  const Qos qos = qos_of(entity);
  Facts f{};
  dds_duration_t blocking = 0;
  EXPECT_TRUE(dds_qget_reliability(qos.get(), &f.reliability, &blocking));
  EXPECT_TRUE(dds_qget_history(qos.get(), &f.history, &f.depth));
  EXPECT_TRUE(dds_qget_durability(qos.get(), &f.durability));
  EXPECT_TRUE(dds_qget_ownership(qos.get(), &f.ownership));
  EXPECT_TRUE(dds_qget_liveliness(qos.get(), &f.liveliness, &f.lease));
  EXPECT_TRUE(dds_qget_deadline(qos.get(), &f.deadline));
  EXPECT_TRUE(dds_qget_latency_budget(qos.get(), &f.latency_budget));
  return f;
}

class Profiles : public ::testing::Test {
 protected:
  Participant participant_{fresh_domain()};
};

TEST_F(Profiles, StateIsReliableKeepsTheLastAndServesLateJoiners) {
  const Facts w = facts_of(Writer<msg::WorldState>(participant_).handle());
  EXPECT_EQ(w.reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(w.history, DDS_HISTORY_KEEP_LAST);
  EXPECT_EQ(w.depth, 1);
  EXPECT_EQ(w.durability, DDS_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(w.ownership, DDS_OWNERSHIP_SHARED);
  EXPECT_EQ(w.liveliness, DDS_LIVELINESS_AUTOMATIC);
  EXPECT_EQ(w.deadline, DDS_INFINITY);
  EXPECT_EQ(w.latency_budget, 0);
}

TEST_F(Profiles, StateWithAPeriodHasADeadlineOfThree) {
  EXPECT_EQ(facts_of(Writer<msg::WorldState>(participant_, {.period = milliseconds(20)}).handle()).deadline,
            DDS_MSECS(60));
  EXPECT_EQ(facts_of(Reader<msg::WorldState>(participant_, {.period = milliseconds(20)}).handle()).deadline,
            DDS_MSECS(60));
}

TEST_F(Profiles, AWriterOfAStateIsGoneAfterASecondUnlessItSaysOtherwise) {
  EXPECT_EQ(facts_of(Writer<msg::WorldState>(participant_).handle()).lease, DDS_SECS(1));
  EXPECT_EQ(facts_of(Writer<msg::WorldState>(participant_, {.lease = seconds(5)}).handle()).lease, DDS_SECS(5));
}

TEST_F(Profiles, OrderIsExclusiveWithManualLiveliness) {
  const Facts w = facts_of(Writer<msg::KickOrder>(participant_).handle());
  EXPECT_EQ(w.reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(w.history, DDS_HISTORY_KEEP_LAST);
  EXPECT_EQ(w.depth, 1);
  EXPECT_EQ(w.durability, DDS_DURABILITY_VOLATILE);
  EXPECT_EQ(w.ownership, DDS_OWNERSHIP_EXCLUSIVE);
  EXPECT_EQ(w.liveliness, DDS_LIVELINESS_MANUAL_BY_TOPIC);
  EXPECT_EQ(w.lease, DDS_MSECS(100));
  const Facts r = facts_of(Reader<msg::KickOrder>(participant_).handle());
  EXPECT_EQ(r.ownership, DDS_OWNERSHIP_EXCLUSIVE);
  EXPECT_EQ(r.liveliness, DDS_LIVELINESS_MANUAL_BY_TOPIC);
}

TEST_F(Profiles, EventKeepsFiftyAndAllAtTheRecorder) {
  EXPECT_EQ(facts_of(Writer<msg::KickReceipt>(participant_).handle()).depth, 50);
  EXPECT_EQ(facts_of(Reader<msg::KickReceipt>(participant_).handle()).depth, 50);
  const Reader<msg::KickReceipt> recorder(participant_, {.keep_all = true});
  EXPECT_EQ(facts_of(recorder.handle()).history, DDS_HISTORY_KEEP_ALL);
  std::int32_t samples = 0, instances = 0, per_instance = 0;
  dds_qget_resource_limits(qos_of(recorder.handle()).get(), &samples, &instances, &per_instance);
  EXPECT_EQ(samples, DDS_LENGTH_UNLIMITED);
  EXPECT_EQ(instances, DDS_LENGTH_UNLIMITED);
  EXPECT_EQ(per_instance, DDS_LENGTH_UNLIMITED);
}

template <class T>
void expect_writer_never_blocks(const Participant& participant) {
  const Writer<T> writer(participant);
  EXPECT_EQ(facts_of(writer.handle()).history, DDS_HISTORY_KEEP_LAST) << meta<T>::topic;
  bool autodispose = true;
  EXPECT_TRUE(dds_qget_writer_data_lifecycle(qos_of(writer.handle()).get(), &autodispose));
  EXPECT_FALSE(autodispose) << meta<T>::topic;
}

TEST_F(Profiles, NoWriterKeepsAllOrDisposesWhatItSaid) {
  expect_writer_never_blocks<msg::Odometry>(participant_);
  expect_writer_never_blocks<msg::KickOrder>(participant_);
  expect_writer_never_blocks<msg::KickDecision>(participant_);
}

TEST_F(Profiles, AReaderThatDemandsAPeriodTurnsAwayAWriterWithout) {
  const Writer<msg::Odometry> writer(participant_);
  const Reader<msg::Odometry> reader(participant_, {.period = milliseconds(20)});
  EXPECT_EQ(reader.writers(), 0u);
  EXPECT_EQ(reader.counts().incompatible, 1u);
}

}  // namespace
}  // namespace trivela::bus
