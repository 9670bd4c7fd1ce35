#include "bus/writer.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <map>
#include <vector>

#include "bus/domain/qos.hpp"
#include "bus/waitset.hpp"

namespace trivela::bus {
namespace {

using Clock = std::chrono::steady_clock;

// Of so many readers that a writer is matched with, those that look on.
std::size_t observers_among(dds_entity_t writer, std::size_t matched) {
  std::vector<dds_instance_handle_t> readers(matched);
  const auto found = dds_get_matched_subscriptions(writer, readers.data(), readers.size());
  if (found <= 0) return 0;
  readers.resize(std::min(readers.size(), static_cast<std::size_t>(found)));
  return static_cast<std::size_t>(std::ranges::count_if(readers, [&](dds_instance_handle_t reader) {
    dds_builtintopic_endpoint_t* const endpoint = dds_get_matched_subscription_data(writer, reader);
    if (endpoint == nullptr) return false;  // it has just gone: the status says so next
    const bool looks_on = is_observer(endpoint->qos);
    dds_builtintopic_free_endpoint(endpoint);
    return looks_on;
  }));
}

}  // namespace

AnyWriter::AnyWriter(const Participant& participant, const dds_topic_descriptor& descriptor, std::string_view topic,
                     Profile profile, const WriterOptions& options)
    : participant_(participant),
      topic_(topic),
      owner_(options.owner),
      begun_ns_(Clock::now().time_since_epoch().count()) {
  topic_entity_ = Entity(checked(dds_create_topic(participant.handle(), &descriptor, topic_.c_str(), nullptr, nullptr),
                                 "dds_create_topic", topic_));
  const Qos qos = writer_qos(profile, options, begun_ns_);
  writer_ = Entity(checked(dds_create_writer(participant.handle(), topic_entity_.handle(), qos.get(), nullptr),
                           "dds_create_writer", topic_));
  checked(dds_set_status_mask(writer_.handle(), DDS_PUBLICATION_MATCHED_STATUS), "dds_set_status_mask", topic_);
}

void AnyWriter::write_raw(const void* sample) { checked(dds_write(writer_.handle(), sample), "dds_write", topic_); }

void AnyWriter::assert_liveliness() {
  checked(dds_assert_liveliness(writer_.handle()), "dds_assert_liveliness", topic_);
}

std::size_t AnyWriter::readers() const {
  dds_publication_matched_status_t status{};
  checked(dds_get_publication_matched_status(writer_.handle(), &status), "dds_get_publication_matched_status", topic_);
  return status.current_count - observers_among(writer_.handle(), status.current_count);
}

bool AnyWriter::wait_for_readers(std::size_t n, std::chrono::nanoseconds timeout) const {
  const auto deadline = Clock::now() + timeout;
  Waitset waitset(participant_);
  waitset.attach(writer_.handle(), 0);
  // readers() clears the status that the waitset waits for, so that a match after it ends the wait.
  while (readers() < n) {
    const auto left = deadline - Clock::now();
    if (left <= left.zero()) return false;
    waitset.wait(left);
  }
  return true;
}

bool AnyWriter::wait_until_received(std::chrono::nanoseconds timeout) const {
  const dds_return_t rc = dds_wait_for_acks(writer_.handle(), timeout.count());
  if (rc == DDS_RETCODE_TIMEOUT) return false;
  checked(rc, "dds_wait_for_acks", topic_);
  return true;
}

bool AnyWriter::other_writer_exists(std::chrono::nanoseconds since_joining) const {
  return writer_exists(since_joining, [](std::int64_t, std::int64_t) { return true; });
}

bool AnyWriter::elder_writer_exists() const {
  return writer_exists(kSinceJoining, [](std::int64_t own_ns, std::int64_t other_ns) {
    const bool younger = other_ns > own_ns && other_ns - own_ns < std::chrono::nanoseconds(kTogether).count();
    return !younger;
  });
}

bool AnyWriter::writer_exists(std::chrono::nanoseconds since_joining, Counts counts) const {
  // Of a process that has just ended, what it said before can still come, and its farewell after it.
  constexpr std::chrono::milliseconds kFarewell{200};
  constexpr std::chrono::milliseconds kLookBriefly{50};  // for who starts at the same moment
  const auto deadline = std::max(participant_.joined() + since_joining, Clock::now() + kLookBriefly);
  dds_instance_handle_t self = 0;
  checked(dds_get_instance_handle(writer_.handle(), &self), "dds_get_instance_handle", topic_);
  const Entity publications(
      checked(dds_create_reader(participant_.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
              "dds_create_reader", "DCPSPublication"));
  const Entity condition(checked(dds_create_readcondition(publications.handle(), DDS_ANY_STATE),
                                 "dds_create_readcondition", "DCPSPublication"));
  Waitset waitset(participant_);
  waitset.attach(condition.handle(), 0);
  std::map<dds_instance_handle_t, Clock::time_point> others;  // since when they are known
  for (;;) {
    void* sample = nullptr;
    dds_sample_info_t info;
    while (checked(dds_take(publications.handle(), &sample, &info, 1, 1), "dds_take", "DCPSPublication") > 0) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
      if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
        others.erase(info.instance_handle);
      } else if (info.valid_data && info.instance_handle != self && topic_ == endpoint.topic_name &&
                 owner_of(endpoint.qos) == owner_ && counts(begun_ns_, begun_ns_of(endpoint.qos))) {
        others.try_emplace(info.instance_handle, Clock::now());
      }
      checked(dds_return_loan(publications.handle(), &sample, 1), "dds_return_loan", "DCPSPublication");
    }
    using Other = decltype(others)::value_type;
    const auto wake =
        others.empty() ? deadline : std::ranges::min_element(others, {}, &Other::second)->second + kFarewell;
    const auto now = Clock::now();
    if (now >= wake) return !others.empty();
    waitset.wait(wake - now);
  }
}

}  // namespace trivela::bus
