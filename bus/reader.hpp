#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/options.hpp"
#include "bus/domain/participant.hpp"
#include "bus/reconnect_backoff.hpp"
#include "bus/waitset.hpp"
#include "idl/meta.hpp"

namespace trivela::bus {

/// What comes with a sample.
struct SampleInfo {
  std::int64_t source_t_ns = 0;  // the writer's real-time clock when it was written
  std::uint64_t writer = 0;  // tells the writers of a topic apart: of its GUID, the same when it is lost and comes back
  std::uint64_t member = 0;  // the same of the participant that it belongs to
  std::string_view
      owner{};  // its WriterOptions::owner; empty: none, or it has gone. Valid while the sample is handed out
};

/// Counts since the reader was made. Lost samples are not among them: Cyclone 0.10 skips them without a word
/// (ros2/demos issue 642), so that gaps in `seq` are their only sign.
struct ReaderCounts {
  std::uint32_t deadline_missed = 0;  // periods without the sample that was demanded
  std::uint32_t incompatible = 0;     // writers that were turned away because their QoS does not fit
};

/// What all readers share; read a topic through Reader<T>.
class AnyReader {
 public:
  using DataListener = void (*)(void* context) noexcept;

  AnyReader(AnyReader&&) = default;

  /// Waits until there is something to take; false if the timeout came first. For one thread at a time.
  bool wait(std::chrono::nanoseconds timeout);

  /// Waits until at least n writers are matched; false if the timeout came first.
  [[nodiscard]] bool wait_for_writers(std::size_t n, std::chrono::nanoseconds timeout);

  /// How many matched writers carry this WriterOptions::owner. Not for listeners.
  std::size_t writers_of(std::string_view owner) const;

  /// How many writers are matched now.
  std::size_t writers() const;

  Liveliness liveliness() const;
  ReaderCounts counts() const;
  const std::string& topic() const { return topic_; }

  /// In real time: whether it has heard nothing for so long that it shall be made again, since what a packet broke in
  /// Cyclone's picture of a writer stays broken for the readers that it has. To be asked now and then by who takes;
  /// bus/renewal.hpp does what follows.
  bool time_to_renew();

  /// What goes when a reader is made again.
  struct Retired {
    Entity reader;
    Entity condition;
    std::unique_ptr<Waitset> waitset;
  };

  /// A second reader like this one, and this one with that in its place; for bus/ alone. A listener may not call them:
  /// Cyclone waits for it. Of a topic without a period, whose samples nobody says again, the predecessor is heard for
  /// two more seconds, until every writer knows its successor; outlived() gives it away then.
  Entity open() const;
  [[nodiscard]] Retired replace(Entity again);
  [[nodiscard]] Entity outlived();

  const Participant& participant() const { return participant_; }

  /// Cyclone's handle of the reader; for bus/ alone.
  std::int32_t handle() const { return reader_.handle(); }

  /// Cyclone's handle of "there is something to take", made when it is first asked for; for bus/ alone.
  std::int32_t condition();

 protected:
  using Sink = void (*)(void* context, const void* sample, const SampleInfo& info);

  /// period: after which a sample of the topic follows the last, if it has one.
  AnyReader(const Participant& participant, const dds_topic_descriptor& descriptor, std::string_view topic,
            Profile profile, std::chrono::nanoseconds period, const ReaderOptions& options, DataListener listener,
            void* context);
  std::size_t take_raw(Sink sink, void* context);

 private:
  bool is_new(std::uint64_t writer, std::int64_t source_t_ns);
  struct KnownWriter {
    std::uint64_t handle;  // Cyclone's, which changes when one comes back
    std::uint64_t number;
    std::uint64_t member;
    std::string owner;
  };
  const KnownWriter& writer_of(std::int32_t reader, std::uint64_t handle);
  std::size_t take_from(std::int32_t reader, Sink sink, void* context);

  struct Callbacks;  // what Cyclone's listeners point at: stays where it is when the reader moves
  struct DeleteCallbacks {
    void operator()(Callbacks* callbacks) const noexcept;
  };

  Participant participant_;
  std::string topic_;
  Profile profile_;
  ReaderOptions options_;
  bool periodic_;
  std::unique_ptr<Callbacks, DeleteCallbacks> callbacks_;
  Entity topic_entity_;
  Entity reader_;
  Entity condition_;
  std::unique_ptr<Waitset> waitset_;

  // The newest sample of each writer, who speaks for one robot: a reader made again is given it once more, and what two
  // readers hear is one sample.
  struct Newest {
    std::uint64_t writer;
    std::int64_t source_t_ns;
  };
  std::vector<Newest> newest_;
  std::vector<KnownWriter> writers_;
  KnownWriter gone_{};                       // the last one that had gone before its sample was taken
  std::optional<ReconnectBackoff> silence_;  // in real time
  std::uint64_t renewals_seen_ = 0;          // of the participant's readers that have a period
  std::chrono::steady_clock::time_point renewed_{};
  Entity predecessor_;  // of a topic without a period, for a while after it was made again
};

/// The period of T's topic; zero: it has none.
template <Message T>
constexpr std::chrono::nanoseconds period_of() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(meta<T>::period_s));
}

/// Receives T from its topic with its profile.
template <Message T>
class Reader : public AnyReader {
 public:
  /// The listener is called with the context in the thread that brings a sample: Cyclone's receive thread, or a
  /// writer's in this process. Throws Error if Cyclone refuses.
  explicit Reader(const Participant& participant, const ReaderOptions& options = {}, DataListener listener = nullptr,
                  void* context = nullptr)
      : AnyReader(participant, meta<T>::descriptor(), meta<T>::topic, meta<T>::profile, period_of<T>(), options,
                  listener, context) {}

  /// Hands everything that has arrived to f(sample, info) or f(sample) and returns how many samples that were. An
  /// exception of f passes through; what was taken with its sample is gone.
  template <class F>
  std::size_t take(F&& f) {
    return take_raw(
        [](void* context, const void* sample, const SampleInfo& info) {
          auto& call = *static_cast<std::remove_reference_t<F>*>(context);
          if constexpr (std::is_invocable_v<F&, const T&, const SampleInfo&>)
            call(*static_cast<const T*>(sample), info);
          else
            call(*static_cast<const T*>(sample));
        },
        const_cast<void*>(static_cast<const void*>(&f)));
  }
};

}  // namespace trivela::bus
