#include "bus/census.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <tuple>

#include "bus/domain/qos.hpp"

namespace trivela::bus {
namespace {

std::string key_text(const dds_guid_t& key) { return {reinterpret_cast<const char*>(key.v), sizeof key.v}; }

// What a participant tells of itself under that name; empty: nothing.
std::string property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value) || value == nullptr) return {};
  std::string text = value;
  dds_free(value);
  return text;
}

Member member_of(const dds_qos_t* qos) {
  Member member{property(qos, "__Hostname"), property(qos, "__ProcessName"), 0, property(qos, "__NetworkAddresses")};
  const std::string pid = property(qos, "__Pid");
  std::from_chars(pid.data(), pid.data() + pid.size(), member.pid);
  return member;
}

Entity builtin_reader(const Participant& participant, dds_entity_t topic, const char* name) {
  return Entity(checked(dds_create_reader(participant.handle(), topic, nullptr, nullptr), "dds_create_reader", name));
}

// Calls f(sample, info) with all that a reader of a builtin topic has; the sample is meaningless where it is not valid.
template <class Sample, class F>
void take_all(dds_entity_t reader, F&& f) {
  constexpr std::size_t kBatch = 32;
  for (;;) {
    std::array<void*, kBatch> samples{};
    std::array<dds_sample_info_t, kBatch> infos{};
    const auto n = checked(dds_take(reader, samples.data(), infos.data(), kBatch, kBatch), "dds_take", "discovery");
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) f(*static_cast<const Sample*>(samples[i]), infos[i]);
    if (samples[0] != nullptr) checked(dds_return_loan(reader, samples.data(), n), "dds_return_loan", "discovery");
    if (n == 0) return;
  }
}

bool is_there(const dds_sample_info_t& info) {
  return info.valid_data && info.instance_state == DDS_ALIVE_INSTANCE_STATE;
}

}  // namespace

CensusTaker::CensusTaker(const Participant& participant) : participant_(participant), waitset_(participant) {
  dds_guid_t own{};
  checked(dds_get_guid(participant.handle(), &own), "dds_get_guid", "participant");
  own_key_ = key_text(own);
  participants_ = builtin_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, "DCPSParticipant");
  publications_ = builtin_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "DCPSPublication");
  subscriptions_ = builtin_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, "DCPSSubscription");
  for (const Entity* reader : {&participants_, &publications_, &subscriptions_}) {
    conditions_.emplace_back(
        checked(dds_create_readcondition(reader->handle(), DDS_ANY_STATE), "dds_create_readcondition", "discovery"));
    waitset_.attach(conditions_.back().handle(), 0);
  }
}

void CensusTaker::take_members() {
  take_all<dds_builtintopic_participant_t>(participants_.handle(), [this](const auto& sample, const auto& info) {
    if (is_there(info)) {
      members_[info.instance_handle] = {key_text(sample.key), member_of(sample.qos)};
    } else if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
      members_.erase(info.instance_handle);
    }
  });
}

void CensusTaker::take_ends(std::int32_t reader, bool writers, Handles& ends) {
  take_all<dds_builtintopic_endpoint_t>(reader, [&](const auto& sample, const auto& info) {
    if (is_there(info)) {
      Found found;
      found.member = key_text(sample.participant_key);
      found.end.topic = sample.topic_name;
      if (writers) {
        found.end.owner = owner_of(sample.qos);
        dds_qget_ownership_strength(sample.qos, &found.end.strength);
      } else {
        found.end.observer = is_observer(sample.qos);
      }
      ends[info.instance_handle] = std::move(found);
    } else if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
      ends.erase(info.instance_handle);
    }
  });
}

std::vector<End> CensusTaker::ends_of(const Handles& ends) const {
  std::vector<End> all;
  for (const auto& entry : ends) {
    const auto& found = entry.second;
    if (found.member == own_key_) continue;
    End end = found.end;
    const auto member =
        std::ranges::find_if(members_, [&](const auto& known) { return known.second.key == found.member; });
    if (member != members_.end()) end.member = member->second.member;
    all.push_back(std::move(end));
  }
  std::ranges::sort(all, {},
                    [](const End& end) { return std::tie(end.topic, end.owner, end.member.process, end.member.pid); });
  return all;
}

bool CensusTaker::wait(std::chrono::nanoseconds timeout) { return !waitset_.wait(timeout).empty(); }

Census CensusTaker::take() {
  take_members();
  take_ends(publications_.handle(), true, writers_);
  take_ends(subscriptions_.handle(), false, readers_);
  Census census;
  for (const auto& [handle, known] : members_)
    if (known.key != own_key_) census.members.push_back(known.member);
  std::ranges::sort(census.members, {}, [](const Member& m) { return std::tie(m.host, m.process, m.pid); });
  census.writers = ends_of(writers_);
  census.readers = ends_of(readers_);
  return census;
}

}  // namespace trivela::bus
