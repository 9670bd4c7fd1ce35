#include "bus/reader.hpp"

#include <dds/dds.h>

#include <array>

#include "bus/error.hpp"
#include "bus/qos.hpp"

namespace trivela::bus {
namespace {

using Clock = std::chrono::steady_clock;

struct DeleteListener {
  void operator()(dds_listener_t* listener) const noexcept { dds_delete_listener(listener); }
};

// Samples on loan from a reader, returned on every way out.
class Loan {
 public:
  explicit Loan(dds_entity_t reader) : reader_(reader) {}
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() {
    if (samples_[0] != nullptr) dds_return_loan(reader_, samples_.data(), count_);
  }

  std::int32_t take() {
    count_ = dds_take(reader_, samples_.data(), infos_.data(), kMost, kMost);
    return count_;
  }
  const void* sample(std::size_t i) const { return samples_[i]; }
  const dds_sample_info_t& info(std::size_t i) const { return infos_[i]; }

  static constexpr std::size_t kMost = 16;

 private:
  dds_entity_t reader_;
  std::int32_t count_ = 0;
  std::array<void*, kMost> samples_{};
  std::array<dds_sample_info_t, kMost> infos_;
};

}  // namespace

struct AnyReader::Callbacks {
  DataListener data;
  void* context;
  std::function<void(const Liveliness&)> liveliness;
};

void AnyReader::DeleteCallbacks::operator()(Callbacks* callbacks) const noexcept { delete callbacks; }

AnyReader::AnyReader(const Participant& participant, const dds_topic_descriptor& descriptor, std::string_view topic,
                     Profile profile, const ReaderOptions& options, DataListener listener, void* context)
    : participant_(participant), topic_(topic), callbacks_(new Callbacks{listener, context, options.on_liveliness}) {
  topic_entity_ = Entity(checked(dds_create_topic(participant.handle(), &descriptor, topic_.c_str(), nullptr, nullptr),
                                 "dds_create_topic", topic_));
  // Given at creation: a listener set later is not called for what arrived before.
  const std::unique_ptr<dds_listener_t, DeleteListener> listeners(dds_create_listener(callbacks_.get()));
  if (listener != nullptr) {
    dds_lset_data_available(listeners.get(), [](dds_entity_t, void* arg) noexcept {
      const auto& callbacks = *static_cast<const Callbacks*>(arg);
      callbacks.data(callbacks.context);
    });
  }
  if (options.on_liveliness) {
    dds_lset_liveliness_changed(
        listeners.get(), [](dds_entity_t, dds_liveliness_changed_status_t status, void* arg) noexcept {
          static_cast<const Callbacks*>(arg)->liveliness({status.alive_count, status.not_alive_count});
        });
  }
  const Qos qos = reader_qos(profile, options);
  reader_ = Entity(checked(dds_create_reader(participant.handle(), topic_entity_.handle(), qos.get(), listeners.get()),
                           "dds_create_reader", topic_));
  checked(dds_set_status_mask(reader_.handle(), DDS_SUBSCRIPTION_MATCHED_STATUS), "dds_set_status_mask", topic_);
}

std::size_t AnyReader::take_raw(Sink sink, void* context) {
  std::size_t taken = 0;
  for (;;) {
    Loan loan(reader_.handle());
    const auto count = static_cast<std::size_t>(checked(loan.take(), "dds_take", topic_));
    for (std::size_t i = 0; i < count; ++i) {
      const auto& info = loan.info(i);
      if (!info.valid_data) continue;  // a writer went away; no sample
      sink(context, loan.sample(i), {info.source_timestamp, info.publication_handle});
      ++taken;
    }
    if (count < Loan::kMost) return taken;
  }
}

std::int32_t AnyReader::condition() {
  // Level-triggered, unlike the reader's own status.
  if (condition_.handle() == 0)
    condition_ =
        Entity(checked(dds_create_readcondition(reader_.handle(), DDS_ANY_STATE), "dds_create_readcondition", topic_));
  return condition_.handle();
}

bool AnyReader::wait(std::chrono::nanoseconds timeout) {
  if (!waitset_) {
    waitset_ = std::make_unique<Waitset>(participant_);
    waitset_->attach(condition(), 0);
  }
  return !waitset_->wait(timeout).empty();
}

std::size_t AnyReader::writers() const {
  dds_subscription_matched_status_t status{};
  checked(dds_get_subscription_matched_status(reader_.handle(), &status), "dds_get_subscription_matched_status",
          topic_);
  return status.current_count;
}

bool AnyReader::wait_for_writers(std::size_t n, std::chrono::nanoseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  Waitset waitset(participant_);
  waitset.attach(reader_.handle(), 0);
  while (writers() < n) {
    const auto left = deadline - Clock::now();
    if (left <= left.zero()) return false;
    waitset.wait(left);
  }
  return true;
}

Liveliness AnyReader::liveliness() const {
  dds_liveliness_changed_status_t status{};
  checked(dds_get_liveliness_changed_status(reader_.handle(), &status), "dds_get_liveliness_changed_status", topic_);
  return {status.alive_count, status.not_alive_count};
}

ReaderCounts AnyReader::counts() const {
  dds_requested_deadline_missed_status_t missed{};
  dds_requested_incompatible_qos_status_t incompatible{};
  checked(dds_get_requested_deadline_missed_status(reader_.handle(), &missed),
          "dds_get_requested_deadline_missed_status", topic_);
  checked(dds_get_requested_incompatible_qos_status(reader_.handle(), &incompatible),
          "dds_get_requested_incompatible_qos_status", topic_);
  return {missed.total_count, incompatible.total_count};
}

}  // namespace trivela::bus
