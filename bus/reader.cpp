#include "bus/reader.hpp"

#include <dds/dds.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>

#include "bus/domain/qos.hpp"
#include "bus/domain/reader_health.hpp"

namespace trivela::bus {
namespace {

using Clock = std::chrono::steady_clock;

// A reader without a period is made again no more often than this, and its predecessor heard for as long.
constexpr std::chrono::seconds kPause{2};

// Of a topic without a period silence means nothing, or that its reader alone was broken.
constexpr std::chrono::seconds kEventSilence{10};

// RTPS: the participant's part of a GUID.
constexpr std::size_t kGuidPrefix_B = 12;

// FNV-1a
std::uint64_t hash_of(std::span<const unsigned char> bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  return hash;
}

struct DeleteListener {
  void operator()(dds_listener_t* listener) const noexcept { dds_delete_listener(listener); }
};

// Samples on loan from a reader, returned on every way out.
class Loan {
 public:
  /// Of at most `most` samples. Cyclone lends room for so many, and clears all of it when it is returned.
  Loan(dds_entity_t reader, std::size_t most) : reader_(reader), most_(static_cast<std::uint32_t>(most)) {}
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() {
    if (samples_[0] != nullptr) dds_return_loan(reader_, samples_.data(), count_);
  }

  std::int32_t take() {
    count_ = dds_take(reader_, samples_.data(), infos_.data(), most_, most_);
    return count_;
  }
  const void* sample(std::size_t i) const { return samples_[i]; }
  const dds_sample_info_t& info(std::size_t i) const { return infos_[i]; }

  static constexpr std::size_t kMost = 16;

 private:
  dds_entity_t reader_;
  std::uint32_t most_;
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
                     Profile profile, std::chrono::nanoseconds period, const ReaderOptions& options,
                     DataListener listener, void* context)
    : participant_(participant),
      topic_(topic),
      profile_(profile),
      options_(options),
      periodic_(period > period.zero()),
      callbacks_(new Callbacks{listener, context, options.on_liveliness}) {
  topic_entity_ = Entity(checked(dds_create_topic(participant.handle(), &descriptor, topic_.c_str(), nullptr, nullptr),
                                 "dds_create_topic", topic_));
  if (const ReaderHealth* hearing = participant_.hearing()) {
    silence_.emplace(periodic_ ? ReconnectBackoff::of_period(period) : kEventSilence);
    renewals_seen_ = hearing->renewals();
  }
  reader_ = open();
}

Entity AnyReader::open() const {
  // Given at creation: a listener set later is not called for what arrived before.
  const std::unique_ptr<dds_listener_t, DeleteListener> listeners(dds_create_listener(callbacks_.get()));
  if (callbacks_->data != nullptr) {
    dds_lset_data_available(listeners.get(), [](dds_entity_t, void* arg) noexcept {
      const auto& callbacks = *static_cast<const Callbacks*>(arg);
      callbacks.data(callbacks.context);
    });
  }
  if (callbacks_->liveliness) {
    dds_lset_liveliness_changed(
        listeners.get(), [](dds_entity_t, dds_liveliness_changed_status_t status, void* arg) noexcept {
          static_cast<const Callbacks*>(arg)->liveliness({status.alive_count, status.not_alive_count});
        });
  }
  const Qos qos = reader_qos(profile_, options_);
  Entity reader(checked(dds_create_reader(participant_.handle(), topic_entity_.handle(), qos.get(), listeners.get()),
                        "dds_create_reader", topic_));
  checked(dds_set_status_mask(reader.handle(), DDS_SUBSCRIPTION_MATCHED_STATUS), "dds_set_status_mask", topic_);
  return reader;
}

bool AnyReader::time_to_renew() {
  ReaderHealth* const hearing = participant_.hearing();
  if (hearing == nullptr) return false;
  const auto now = Clock::now();
  const bool due = silence_->due(now);
  if (!periodic_) {
    if (now - renewed_ < kPause || (!due && renewals_seen_ == hearing->renewals())) return false;
    renewed_ = now;
    renewals_seen_ = hearing->renewals();
    return true;
  }
  if (!due) return false;
  const double silent_s = std::chrono::duration<double>(silence_->silent_for(now)).count();
  const std::uint32_t alive = liveliness().alive;
  const std::uint32_t turned_away = counts().incompatible;
  const std::string misfits =
      turned_away > 0 ? fmt::format(", {} turned away since their QoS does not fit", turned_away) : "";
  hearing->renewed(fmt::format("{}: silent for {:.1f} s with {} live writers{}: the reader is made again", topic_,
                               silent_s, alive, misfits));
  // A writer that stands still or is gone lapses; one that is there and not heard lives on.
  constexpr std::size_t kHelpless = 4;  // 15 s: a node may live and have nothing to say
  if (alive > 0 && silence_->attempts() > kHelpless)
    hearing->give_up(topic_,
                     fmt::format("silent for {:.1f} s with {} live writers, and the reader was made again {} times",
                                 silent_s, alive, kHelpless));
  return true;
}

AnyReader::Retired AnyReader::replace(Entity again) {
  Retired old{std::exchange(reader_, std::move(again)), std::exchange(condition_, Entity()), std::move(waitset_)};
  if (!periodic_) std::swap(predecessor_, old.reader);
  return old;
}

Entity AnyReader::outlived() {
  return Clock::now() - renewed_ < kPause ? Entity() : std::exchange(predecessor_, Entity());
}

// A reader made again is given the last sample of each writer that still stands, and events by its predecessor as well.
bool AnyReader::is_new(std::uint64_t writer, std::int64_t source_t_ns) {
  const auto known =
      std::find_if(newest_.begin(), newest_.end(), [&](const Newest& newest) { return newest.writer == writer; });
  if (known == newest_.end()) {
    constexpr std::size_t kMost = 64;  // writers come and go
    if (newest_.size() == kMost) newest_.erase(newest_.begin());
    newest_.push_back({writer, source_t_ns});
    return true;
  }
  const bool twice =
      periodic_ ? source_t_ns == known->source_t_ns : predecessor_.handle() != 0 && source_t_ns <= known->source_t_ns;
  if (!twice) known->source_t_ns = source_t_ns;
  return !twice;
}

// A number made of the writer's GUID. One that has gone before its last sample is taken has its handle instead.
const AnyReader::KnownWriter& AnyReader::writer_of(std::int32_t reader, std::uint64_t handle) {
  const auto known = std::find_if(writers_.begin(), writers_.end(), [&](const auto& w) { return w.handle == handle; });
  if (known != writers_.end()) return *known;
  dds_builtintopic_endpoint_t* const endpoint = dds_get_matched_publication_data(reader, handle);
  if (endpoint == nullptr) return gone_ = {handle, handle, handle, {}};
  const std::span<const unsigned char> guid(endpoint->key.v);
  const std::uint64_t number = hash_of(guid), member = hash_of(guid.first(kGuidPrefix_B));
  std::string owner = owner_of(endpoint->qos);
  dds_builtintopic_free_endpoint(endpoint);
  constexpr std::size_t kMost = 64;  // writers come and go
  if (writers_.size() == kMost) writers_.erase(writers_.begin());
  return writers_.emplace_back(KnownWriter{handle, number, member, std::move(owner)});
}

std::size_t AnyReader::take_raw(Sink sink, void* context) {
  const std::size_t before = predecessor_.handle() != 0 ? take_from(predecessor_.handle(), sink, context) : 0;
  return before + take_from(reader_.handle(), sink, context);
}

std::size_t AnyReader::take_from(std::int32_t reader, Sink sink, void* context) {
  // As a rule one has come; whose reader keeps all is to catch up.
  const std::size_t most = options_.keep_all ? Loan::kMost : 2;
  std::size_t taken = 0;
  for (;;) {
    Loan loan(reader, most);
    const auto count = static_cast<std::size_t>(checked(loan.take(), "dds_take", topic_));
    for (std::size_t i = 0; i < count; ++i) {
      const auto& info = loan.info(i);
      if (!info.valid_data) continue;  // a writer went away; no sample
      const KnownWriter& writer = writer_of(reader, info.publication_handle);
      if (participant_.hearing() != nullptr) {
        if (!is_new(writer.number, info.source_timestamp)) continue;
        silence_->received(Clock::now());
      }
      sink(context, loan.sample(i), {info.source_timestamp, writer.number, writer.member, writer.owner});
      ++taken;
    }
    if (count < most) return taken;
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

std::size_t AnyReader::writers_of(std::string_view owner) const {
  std::vector<dds_instance_handle_t> handles(64);
  const auto found = dds_get_matched_publications(reader_.handle(), handles.data(), handles.size());
  handles.resize(std::min(handles.size(), static_cast<std::size_t>(std::max(found, dds_return_t{0}))));
  return static_cast<std::size_t>(std::ranges::count_if(handles, [&](dds_instance_handle_t handle) {
    dds_builtintopic_endpoint_t* const endpoint = dds_get_matched_publication_data(reader_.handle(), handle);
    if (endpoint == nullptr) return false;
    const bool same = owner_of(endpoint->qos) == owner;
    dds_builtintopic_free_endpoint(endpoint);
    return same;
  }));
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
