#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/options.hpp"
#include "bus/domain/participant.hpp"
#include "idl/meta.hpp"

namespace trivela::bus {

/// What all writers share; write to a topic through Writer<T>. May be used from several threads at once.
class AnyWriter {
 public:
  AnyWriter(AnyWriter&&) = default;

  /// Says "still here" for an order topic without an order. A writer that has lapsed returns with its next write only.
  void assert_liveliness();

  /// How many readers are matched now; those that merely look on (ReaderOptions::observer) are not counted.
  std::size_t readers() const;

  /// Waits until at least n readers are matched; false if the timeout came first.
  [[nodiscard]] bool wait_for_readers(std::size_t n, std::chrono::nanoseconds timeout) const;

  /// Waits until every reader that is reliable has received all that was written; false if the timeout came first.
  [[nodiscard]] bool wait_until_received(std::chrono::nanoseconds timeout) const;

  /// Whether another writer of this topic carries the same WriterOptions::owner. Looks until this member has been
  /// in the domain for so long, and for 50 ms at least: what others write is known by then. One that is heard of counts
  /// once it has stayed for 200 ms: a process that is leaving is none.
  static constexpr std::chrono::milliseconds kSinceJoining{300};
  bool other_writer_exists(std::chrono::nanoseconds since_joining = kSinceJoining) const;

  /// The same, but of two that begin within kTogether of each other the younger one does not count, so that one of them
  /// stays. By the steady clock, which processes of one machine share.
  static constexpr std::chrono::seconds kTogether{2};
  bool elder_writer_exists() const;

  const std::string& topic() const { return topic_; }

  /// Cyclone's handle, for bus/ alone.
  std::int32_t handle() const { return writer_.handle(); }

 protected:
  AnyWriter(const Participant& participant, const dds_topic_descriptor& descriptor, std::string_view topic,
            Profile profile, const WriterOptions& options);
  void write_raw(const void* sample);

 private:
  using Counts = bool (*)(std::int64_t own_begun_ns, std::int64_t other_begun_ns);
  bool writer_exists(std::chrono::nanoseconds since_joining, Counts counts) const;

  Participant participant_;
  std::string topic_;
  std::string owner_;
  std::int64_t begun_ns_ = 0;  // by the steady clock
  Entity topic_entity_;
  Entity writer_;
};

/// Publishes T on its topic with its profile. Never blocks: no profile lets a writer keep all.
template <Message T>
class Writer : public AnyWriter {
 public:
  /// Throws Error if Cyclone refuses.
  explicit Writer(const Participant& participant, const WriterOptions& options = {})
      : AnyWriter(participant, meta<T>::descriptor(), meta<T>::topic, meta<T>::profile, options) {}

  /// Readers in this process that run in listeners run to completion in here. Throws Error if Cyclone refuses.
  void write(const T& sample) { write_raw(&sample); }
};

/// Whether several programs write one stream of one robot. One that takes another's place is no second one; one that
/// comes back within kWindow_ns after another has written is.
class WriterWatch {
 public:
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;

  /// A sample of `writer` came at `now_ns`. True: from here on several write, which was not so before.
  bool see(std::uint64_t writer, std::int64_t now_ns) {
    if (writer == last_) return false;
    const bool back = writer == before_ && now_ns - changed_ns_ < kWindow_ns;
    const bool begins = back && !contested(now_ns);
    if (back) contested_until_ns_ = now_ns + kWindow_ns;
    before_ = last_;
    last_ = writer;
    changed_ns_ = now_ns;
    return begins;
  }

  bool contested(std::int64_t now_ns) const { return now_ns < contested_until_ns_; }

  /// Who wrote last; 0: nobody yet.
  std::uint64_t last() const { return last_; }

 private:
  std::uint64_t last_ = 0;
  std::uint64_t before_ = 0;
  std::int64_t changed_ns_ = 0;
  std::int64_t contested_until_ns_ = 0;
};

}  // namespace trivela::bus
