#include "bus/qos.hpp"

namespace trivela::bus {
namespace {

constexpr int kPeriodsPerDeadline = 3;

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

Qos writer_qos(Profile profile, const WriterOptions& options) {
  Qos qos = profile_qos(profile, options.period);
  if (profile == Profile::kOrder) {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, options.lease.count());
    dds_qset_ownership_strength(qos.get(), options.strength);
  } else {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, kAutomaticLease);
  }
  // A writer that goes away has not unsaid what it said.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  // A budget above 0 leaves samples in the send queue until the next one.
  dds_qset_latency_budget(qos.get(), 0);
  if (!options.owner.empty()) dds_qset_userdata(qos.get(), options.owner.data(), options.owner.size());
  return qos;
}

Qos reader_qos(Profile profile, const ReaderOptions& options) {
  Qos qos = profile_qos(profile, options.period);
  // The kind is demanded, the lease is the writer's to choose.
  dds_qset_liveliness(qos.get(), profile == Profile::kOrder ? DDS_LIVELINESS_MANUAL_BY_TOPIC : DDS_LIVELINESS_AUTOMATIC,
                      DDS_INFINITY);
  // Without resource limits: a full reader would stop all that this process receives.
  if (options.keep_all) dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  return qos;
}

std::string owner_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size)) return {};
  std::string owner(static_cast<const char*>(data), size);
  dds_free(data);
  return owner;
}

}  // namespace trivela::bus
