#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/mailbox.hpp"
#include "bus/reactions.hpp"
#include "bus/reader.hpp"
#include "bus/watchdog_hook.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"

namespace trivela::bus {

/// The topics of messages, for declaring what a reaction writes: writes<msg::Odometry, msg::StepDone>().
template <Message... Out>
std::vector<std::string> writes() {
  return {std::string(meta<Out>::topic)...};
}

/// A node's writer, to be copied into its reactions.
template <Message T>
class Output {
 public:
  explicit Output(std::shared_ptr<Writer<T>> writer) : writer_(std::move(writer)) {}

  /// Throws Error if Cyclone refuses, or if it is called in a reaction that does not declare that it writes T.
  void write(const T& sample) const {
    check_declared(writer_->topic());
    writer_->write(sample);
  }

  void assert_liveliness() const { writer_->assert_liveliness(); }
  std::size_t readers() const { return writer_->readers(); }
  const std::string& topic() const { return writer_->topic(); }
  [[nodiscard]] bool wait_for_readers(std::size_t n, std::chrono::nanoseconds timeout) const {
    return writer_->wait_for_readers(n, timeout);
  }
  [[nodiscard]] bool wait_until_received(std::chrono::nanoseconds timeout) const {
    return writer_->wait_until_received(timeout);
  }

  /// Whether another node of the same name and robot writes T.
  [[nodiscard]] bool other_writer_exists() const { return writer_->other_writer_exists(); }

  /// Whether another node of the same name and robot writes T, and is not the younger of two that begin together.
  [[nodiscard]] bool elder_writer_exists() const { return writer_->elder_writer_exists(); }

 private:
  std::shared_ptr<Writer<T>> writer_;
};

/// The owner of the writers of a robot's node: "kick_decision/1".
std::string owner_of_robot(std::string_view node, std::uint8_t robot_id);

/// A named set of reactions to samples and devices. It says what shall happen; an Executor makes it happen.
///
/// A reaction never runs twice at once, but two reactions of a node may: a device has a thread of its own, and in
/// listeners every topic comes in its writer's thread. What they share belongs behind the node's own mutex.
class Node {
 public:
  /// With a robot_id the node's reactions and mailboxes see that robot's samples only.
  Node(Participant participant, std::string name, std::optional<std::uint8_t> robot_id = {});

  /// The node's writer of T; an owner that is not named is "name/robot_id".
  template <Message T>
  Output<T> writer(WriterOptions options = {}) {
    if (options.owner.empty()) options.owner = owner();
    return Output<T>(std::make_shared<Writer<T>>(participant_, options));
  }

  /// T is merely kept when it arrives. Waits in the mailbox end when the executor stops.
  template <Message T>
  std::shared_ptr<Mailbox<T>> stores(const ReaderOptions& options = {}, typename Mailbox<T>::OnEach on_each = {}) {
    stored_.emplace_back(meta<T>::topic);
    auto mailbox = std::make_shared<Mailbox<T>>(participant_, robot_id_, options, interrupt_, std::move(on_each));
    // The mailbox goes with its owner, whom its reader may call.
    add_input(std::string(meta<T>::topic), meta<T>::period_s, [weak = std::weak_ptr(mailbox)](std::int64_t before_ns) {
      const auto owned = weak.lock();
      return owned ? owned->received_ns(before_ns) : std::int64_t{0};
    });
    mailboxes_.push_back([weak = std::weak_ptr(mailbox)] {
      if (const auto owned = weak.lock()) owned->keep_hearing();
    });
    return mailbox;
  }

  /// Calls react(sample) or react(sample, info) for each T that arrives; react may write the declared outputs only.
  template <Message T, class F>
  void on(F react, std::vector<std::string> outputs = {}, const ReaderOptions& options = {}) {
    Slot& slot = add(std::string(meta<T>::topic), std::string(meta<T>::topic), std::move(outputs));
    slot.to_the_last = options.keep_all;
    slot.open = [this, options](AnyReader::DataListener listener, void* context) -> std::unique_ptr<AnyReader> {
      return std::make_unique<Reader<T>>(participant_, options, listener, context);
    };
    const auto received = listen(std::string(meta<T>::topic), meta<T>::period_s);
    slot.take = [react = std::move(react), robot_id = robot_id_, received](AnyReader& reader) mutable {
      static_cast<Reader<T>&>(reader).take([&](const T& sample, const SampleInfo& info) {
        if (robot_id && sample.robot_id != *robot_id) return;
        received->now();
        if constexpr (std::is_invocable_v<F&, const T&, const SampleInfo&>)
          react(sample, info);
        else
          react(sample);
      });
    };
  }

  /// Calls react(value) for each value of a device, in a thread of its own. The source,
  /// std::optional<Value>(std::chrono::nanoseconds timeout), waits for the next value no longer than the timeout.
  template <class Source, class F>
  void on_device(const std::string& device, Source source, F react, std::vector<std::string> outputs = {}) {
    Slot& slot = add(device, "device:" + device, std::move(outputs));
    const auto received = listen(slot.reaction.input, 0.0);
    slot.poll = [source = std::move(source), react = std::move(react),
                 received](std::chrono::nanoseconds timeout) mutable {
      auto value = source(timeout);
      if (!value) return;
      received->now();
      react(*value);
    };
  }

  /// Calls react() once, as soon as the executor's stop is requested and while it still runs; from the thread of run().
  void on_stop(std::function<void()> react) { on_stop_ = std::move(react); }

  /// Calls react() again and again, a period apart, in a thread of its own; one that comes late puts off the next ones.
  template <class F>
  void every(std::chrono::nanoseconds period, const std::string& name, F react, std::vector<std::string> outputs = {}) {
    const auto tick = [period, react = std::move(react)]() mutable {
      react();
      return period;
    };
    when_due(period, name, tick, std::move(outputs));
  }

  /// The same, where react() says how long after this call's instant the next one is due.
  template <class F>
  void when_due(std::chrono::nanoseconds first, const std::string& name, F react,
                std::vector<std::string> outputs = {}) {
    Slot& slot = add(name, "timer:" + name, std::move(outputs));
    slot.first = first;
    slot.tick = std::move(react);
  }

  /// What was declared: the node's part of the graph.
  std::vector<Reaction> reactions() const;

  /// What comes to the node, with the instant at which it came last.
  const std::vector<Input>& inputs() const { return inputs_; }

  /// The topics that are merely stored.
  const std::vector<std::string>& stored() const { return stored_; }

  const std::string& name() const { return name_; }
  const Participant& participant() const { return participant_; }

 private:
  friend class Executor;

  // A reaction with what runs it: open and take for a topic, poll for a device, tick for a timer.
  struct Slot {
    Reaction reaction;
    std::function<std::unique_ptr<AnyReader>(AnyReader::DataListener, void*)> open;
    std::function<void(AnyReader&)> take;
    std::function<void(std::chrono::nanoseconds)> poll;
    std::function<std::chrono::nanoseconds()> tick;  // how long after its instant the next one is due
    std::chrono::nanoseconds first{};                // of a timer
    bool to_the_last = false;                        // what has arrived when the run ends still counts
    std::unique_ptr<AnyReader> reader;
    std::mutex running;
    Deadline deadline;  // of its thread, or of the reaction that runs
    class Executor* executor = nullptr;
  };

  std::string owner() const;
  Slot& add(const std::string& what, std::string input, std::vector<std::string> outputs);
  void add_input(std::string name, double period_s, std::function<std::int64_t(std::int64_t)> received_ns);
  std::shared_ptr<LastReceived> listen(std::string input, double period_s);

  Participant participant_;
  std::string name_;
  std::optional<std::uint8_t> robot_id_;
  std::shared_ptr<Guard> interrupt_;
  Deadline deadline_;  // of the thread that waits for its topics
  std::vector<std::unique_ptr<Slot>> slots_;
  std::vector<std::string> stored_;
  std::vector<Input> inputs_;
  std::function<void()> on_stop_;
  std::vector<std::function<void()>> mailboxes_;  // each call looks whether one has fallen silent
};

}  // namespace trivela::bus
