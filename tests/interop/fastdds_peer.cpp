// fastdds_peer DOMAIN: another vendor's DDS on loopback, with types that its own generator made: of our IDL, and of
// what ROS 2's generator makes of the .msg files of examples/ros2. Writes world_state at 50 Hz, of a robot that stands
// 6 m before the goal with the ball; prints each kick_decision that it reads as ROS 2 has it ("decision", a field a
// line, "end"), and why it does not read kick_decision as we write it.
#include <chrono>
#include <csignal>
#include <iostream>
#include <limits>
#include <memory>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include "KickDecisionPubSubTypes.h"
#include "kickPubSubTypes.h"
#include "robotPubSubTypes.h"
#include "tests/interop/value_text.hpp"
// After the types that it shows.
#include "ros_fields.hpp"

namespace {

using namespace eprosima::fastdds::dds;
namespace ros = trivela_msgs::msg;
namespace own = trivela::msg;

struct Decisions : DataReaderListener {
  void on_data_available(DataReader* reader) override {
    ros::KickDecision decision;
    SampleInfo info;
    while (reader->take_next_sample(&decision, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      trivela::interop::FieldText text;
      visit_fields(decision, text);
      std::cout << "decision\n" << text.out << "end\n" << std::flush;
    }
  }
};

struct Refusals : DataReaderListener {
  void on_requested_incompatible_qos(DataReader*, const RequestedIncompatibleQosStatus& status) override {
    if (status.last_policy_id == DATAREPRESENTATION_QOS_POLICY_ID)
      std::cout << "kick_decision as it is: another data representation\n" << std::flush;
  }
  void on_subscription_matched(DataReader*, const SubscriptionMatchedStatus&) override {
    std::cout << "kick_decision as it is: matched\n" << std::flush;
  }
};

DomainParticipant* join(unsigned domain) {
  DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
  const auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  loopback->interfaceWhiteList.push_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(loopback);
  eprosima::fastrtps::rtps::Locator_t here;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(here, 127, 0, 0, 1);
  qos.wire_protocol().builtin.initialPeersList.push_back(here);
  return DomainParticipantFactory::get_instance()->create_participant(domain, qos);
}

Topic* topic(DomainParticipant* bus, const char* name, TopicDataType* type) {
  TypeSupport support{type};
  support.register_type(bus);
  return bus->create_topic(name, support.get_type_name(), TOPIC_QOS_DEFAULT);
}

DataReader* read(DomainParticipant* bus, Topic* on, DataReaderListener& listener) {
  DataReaderQos qos = DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.history().depth = 50;
  return bus->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(on, qos, &listener);
}

// What idl/README.md says of a state.
DataWriter* write_state(DomainParticipant* bus, Topic* on) {
  DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.history().depth = 1;
  qos.liveliness().lease_duration = {1, 0};
  qos.liveliness().announcement_period = {0, 300'000'000};
  qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
  return bus->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(on, qos);
}

own::WorldState world(std::uint64_t seq) {
  own::WorldState state;
  state.robot_id(1);
  state.seq(seq);
  state.t_ns(std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count());
  state.half(1);
  state.playing(true);
  state.possession(true);
  state.possession_id(7);
  state.ball_known(true);
  state.x_m(0.25);
  state.y_m(3.0);
  state.ball_x_m(0.25);
  state.ball_y_m(3.27);
  state.opponent_distance_m(std::numeric_limits<double>::quiet_NaN());
  return state;
}

}  // namespace

int main(int argc, char** argv) {
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &end, nullptr);  // of all threads: it is waited for
  DomainParticipant* const bus = join(argc > 1 ? static_cast<unsigned>(std::stoul(argv[1])) : 0);
  if (bus == nullptr) return 1;
  Decisions decisions;
  Refusals refusals;
  read(bus, topic(bus, "rt/trivela/kick_decision", new ros::KickDecisionPubSubType), decisions);
  read(bus, topic(bus, "kick_decision", new own::KickDecisionPubSubType), refusals);
  DataWriter* const worlds = write_state(bus, topic(bus, "world_state", new own::WorldStatePubSubType));
  constexpr timespec kCycle{.tv_sec = 0, .tv_nsec = 20'000'000};
  for (std::uint64_t seq = 1; sigtimedwait(&end, nullptr, &kCycle) != SIGTERM; ++seq) {
    own::WorldState state = world(seq);
    worlds->write(&state);
  }
  bus->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(bus);
  return 0;
}
