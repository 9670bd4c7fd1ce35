#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "bus/reader.hpp"
#include "bus/renewal.hpp"

namespace trivela::monitor {

/// One of the readers of who looks on.
class PassiveSubscriber {
 public:
  PassiveSubscriber() = default;
  PassiveSubscriber(const PassiveSubscriber&) = delete;
  PassiveSubscriber& operator=(const PassiveSubscriber&) = delete;
  virtual ~PassiveSubscriber() = default;

  /// In real time, to be called now and then: a topic that fell silent is listened to again.
  virtual void keep_hearing() = 0;
};

/// Every sample of a topic, as a reader that nobody waits for (bus::ReaderOptions::observer). Takes in the thread that
/// brings it, so that the instant is that of its reception.
template <bus::Message T>
class StreamSubscriber : public PassiveSubscriber {
 public:
  using OnSample = std::function<void(const T&, const bus::SampleInfo&)>;  ///< on Cyclone's threads, one call at a time

  /// `with_the_last`: what a state topic keeps for those who join late is heard, too. Throws bus::Error.
  StreamSubscriber(const bus::Participant& participant, OnSample receive, bool with_the_last = false)
      : on_sample_(std::move(receive)) {
    bus::ReaderOptions options;
    options.keep_all = true;
    options.observer = true;
    options.with_the_last = with_the_last;
    auto reader = std::make_unique<bus::Reader<T>>(
        participant, options, [](void* subscriber) noexcept { static_cast<StreamSubscriber*>(subscriber)->take(); },
        this);
    {
      const std::lock_guard lock{mutex_};
      reader_ = std::move(reader);
    }
    take();  // what came before there was a reader to take it from
  }
  ~StreamSubscriber() override {
    // Deleting a reader waits for its listener, which must find the mutex free.
    std::unique_ptr<bus::Reader<T>> reader;
    {
      const std::lock_guard lock{mutex_};
      reader.swap(reader_);
    }
  }

  void keep_hearing() override {
    bus::renew_if_silent(*reader_, mutex_, [] {});
  }

 private:
  void take() noexcept try {
    const std::lock_guard lock{mutex_};
    if (reader_) reader_->take(on_sample_);
  } catch (...) {  // the bus's thread goes on: what could not be taken is not counted
  }

  OnSample on_sample_;
  std::mutex mutex_;
  std::unique_ptr<bus::Reader<T>> reader_;
};

}  // namespace trivela::monitor
