// The three profiles as Cyclone's QoS; for bus/ and its tests.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string>

#include "bus/domain/options.hpp"
#include "idl/meta.hpp"

namespace trivela::bus {

struct DeleteQos {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

/// How many samples of each robot an event topic keeps.
inline constexpr std::int32_t kEventDepth = 50;
/// After this long without a sign of life a writer of a state or event topic is gone, unless it says otherwise.
inline constexpr dds_duration_t kAutomaticLease = DDS_SECS(1);
/// The same without an order or the word that it is still there, of an order topic.
inline constexpr dds_duration_t kOrderLease = DDS_MSECS(100);

/// `begun_ns`: when the writer was made, by the steady clock of its machine; told to others beside its owner.
Qos writer_qos(Profile profile, const WriterOptions& options, std::int64_t begun_ns = 0);
Qos reader_qos(Profile profile, const ReaderOptions& options);

/// Whether a reader with this QoS merely looks on (ReaderOptions::observer).
bool is_observer(const dds_qos_t* qos);

/// WriterOptions::owner of a writer with this QoS; empty: none.
std::string owner_of(const dds_qos_t* qos);

/// When it was made, by the steady clock of its machine [ns]; 0: it does not say.
std::int64_t begun_ns_of(const dds_qos_t* qos);

}  // namespace trivela::bus
