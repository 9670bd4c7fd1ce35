#include "bus/domain/qos.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace trivela::bus {
namespace {

constexpr int kPeriodsPerDeadline = 3;

// In a writer's user data, between its owner and when it began.
constexpr char kBehindOwner = '\n';

// The user data of a reader that looks on.
constexpr std::string_view kObserver = "observer";

std::string userdata_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size)) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

// What every writer of the profile meets: a reader that demands nothing but, if asked to, the last sample.
Qos observer_qos(Profile profile, const ReaderOptions& options) {
  Qos qos(dds_create_qos());
  const bool last = options.with_the_last && profile == Profile::kState;
  dds_qset_reliability(qos.get(), last ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  if (last) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  if (options.keep_all) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  } else {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, profile == Profile::kEvent ? kEventDepth : 1);
  }
  // Both ends must say the same of it.
  if (profile == Profile::kOrder) dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  dds_qset_userdata(qos.get(), kObserver.data(), kObserver.size());
  return qos;
}

// What both ends of a topic agree on.
Qos profile_qos(Profile profile, std::optional<std::chrono::nanoseconds> period) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, profile == Profile::kEvent ? kEventDepth : 1);
  if (profile == Profile::kState) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    if (period) dds_qset_deadline(qos.get(), kPeriodsPerDeadline * period->count());
  }
  // An order is for the driver that is there: volatile, or one that restarts would be handed an old one.
  if (profile == Profile::kOrder) dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  return qos;
}

}  // namespace

Qos writer_qos(Profile profile, const WriterOptions& options, std::int64_t begun_ns) {
  Qos qos = profile_qos(profile, options.period);
  if (profile == Profile::kOrder) {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC,
                        options.lease ? options.lease->count() : kOrderLease);
    dds_qset_ownership_strength(qos.get(), options.strength);
  } else {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, options.lease ? options.lease->count() : kAutomaticLease);
  }
  // A writer that goes away has not unsaid what it said.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  // A budget above 0 leaves samples in the send queue until the next one.
  dds_qset_latency_budget(qos.get(), 0);
  if (!options.owner.empty()) {
    const std::string data = fmt::format("{}{}{}", options.owner, kBehindOwner, begun_ns);
    dds_qset_userdata(qos.get(), data.data(), data.size());
  }
  return qos;
}

Qos reader_qos(Profile profile, const ReaderOptions& options) {
  if (options.observer) return observer_qos(profile, options);
  Qos qos = profile_qos(profile, options.period);
  // The kind is demanded, the lease is the writer's to choose.
  dds_qset_liveliness(qos.get(), profile == Profile::kOrder ? DDS_LIVELINESS_MANUAL_BY_TOPIC : DDS_LIVELINESS_AUTOMATIC,
                      DDS_INFINITY);
  // Without resource limits: a full reader would stop all that this process receives.
  if (options.keep_all) dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  return qos;
}

bool is_observer(const dds_qos_t* qos) { return userdata_of(qos) == kObserver; }

std::string owner_of(const dds_qos_t* qos) {
  const std::string data = userdata_of(qos);
  return data.substr(0, data.find(kBehindOwner));
}

std::int64_t begun_ns_of(const dds_qos_t* qos) {
  const std::string data = userdata_of(qos);
  const auto end = data.find(kBehindOwner);
  std::int64_t begun_ns = 0;
  if (end != std::string::npos) std::from_chars(data.data() + end + 1, data.data() + data.size(), begun_ns);
  return begun_ns;
}

}  // namespace trivela::bus
