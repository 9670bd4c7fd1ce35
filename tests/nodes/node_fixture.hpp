#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <latch>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bus/executor.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "nodes/runtime/node_context.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/nodes/fake_device.hpp"

namespace trivela::nodes {

/// Lines that a node logged.
class LogLines : public spdlog::sinks::base_sink<std::mutex> {
 public:
  /// Waits for a line that contains the text.
  bool wait_for(const std::string& text) {
    std::unique_lock lock{lines_mutex_};
    return changed_.wait_for(lock, kPlenty, [&] {
      for (const auto& line : lines_)
        if (line.find(text) != std::string::npos) return true;
      return false;
    });
  }

  /// Lines so far that contain the text.
  std::size_t count(const std::string& text) {
    const std::lock_guard lock{lines_mutex_};
    std::size_t n = 0;
    for (const auto& line : lines_) n += line.find(text) != std::string::npos ? 1 : 0;
    return n;
  }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::lock_guard lock{lines_mutex_};
    lines_.emplace_back(message.payload.data(), message.payload.size());
    changed_.notify_all();
  }
  void flush_() override {}

  std::mutex lines_mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

/// Runs nodes in a thread of its own while it lives. From its making on they listen: what came earlier on a topic that
/// keeps one sample may have been replaced by the next.
class Running {
 public:
  Running(bus::Executor::Kind kind, bus::Stop& stop, std::vector<bus::Node*> nodes)
      : stop_(stop), probe_(nodes.front()->participant(), "probe"), wakes_(nodes.front()->participant()) {
    wakes_.write({});
    // Of one executor the last node's readers are served last.
    probe_.on<msg::DeviceKicker>([this](const msg::DeviceKicker&) { listening_.count_down(); });
    nodes.push_back(&probe_);
    thread_ = std::thread{[this, kind, nodes = std::move(nodes)] { run(kind, nodes); }};
    listening_.wait();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    stop_.request();
    thread_.join();
    EXPECT_EQ(failure_, "");
  }

 private:
  void run(bus::Executor::Kind kind, const std::vector<bus::Node*>& nodes) {
    try {
      bus::Executor{kind, stop_, nodes}.run();
    } catch (const std::exception& error) {
      failure_ = error.what();
    }
    if (!listening_.try_wait()) listening_.count_down();
  }

  bus::Stop& stop_;
  std::latch listening_{1};
  bus::Node probe_;
  bus::Writer<msg::DeviceKicker> wakes_;
  std::string failure_;
  std::thread thread_;
};

/// Everything that is written on T's topic from now on.
template <bus::Message T>
class Received {
 public:
  explicit Received(const bus::Participant& participant)
      : reader_(participant, {.period = {}, .keep_all = true, .on_liveliness = {}}) {}

  /// The first n samples, fewer if they do not come.
  const std::vector<T>& first(std::size_t n) {
    take();
    while (samples_.size() < n && reader_.wait(kPlenty)) take();
    EXPECT_GE(samples_.size(), n) << reader_.topic();
    return samples_;
  }
  /// The nth sample, counted from 1.
  T nth(std::size_t n) {
    first(n);
    return samples_.size() >= n ? samples_[n - 1] : T{};
  }
  /// What has come so far.
  const std::vector<T>& now() {
    take();
    return samples_;
  }

 private:
  void take() {
    reader_.take([this](const T& sample) { samples_.push_back(sample); });
  }
  bus::Reader<T> reader_;
  std::vector<T> samples_;
};

/// The test's own writer of T, of the fixture's robot; counts seq.
template <bus::Message T>
class Says {
 public:
  explicit Says(const bus::Participant& participant, std::uint8_t robot_id = 1, const std::string& owner = {},
                std::int32_t strength = 0)
      : writer_(participant, {.period = {}, .lease = std::chrono::hours{1}, .strength = strength, .owner = owner}),
        robot_id_(robot_id) {}

  void operator()(T sample) {
    sample.robot_id = robot_id_;
    if constexpr (requires { sample.seq; }) sample.seq = ++seq_;
    writer_.write(sample);
  }
  /// Waits until a node listens.
  void expect_reader(std::size_t n = 1) { ASSERT_TRUE(writer_.wait_for_readers(n, kPlenty)) << writer_.topic(); }

 private:
  bus::Writer<T> writer_;
  std::uint8_t robot_id_;
  std::uint64_t seq_ = 0;
};

/// A domain of its own and what a node's main gives it. The nodes' settings may be changed before one is made.
class NodeTest : public testing::Test {
 protected:
  NodeTest() {
    context.settings.domain.domain_id = domain.domain_id;
    context.settings.domain.tag = fmt::format("nodes-{}", getpid());
    context.settings.run.session = 5;
    context.steady_ns = [this] { return clock_ns.load(); };
  }

  std::unique_ptr<FakeWheels> fake_wheels() { return std::make_unique<FakeWheels>(wheels); }
  std::unique_ptr<FakeKicker> fake_kicker() { return std::make_unique<FakeKicker>(kicker); }

  /// The steady clock of the nodes: time goes on when the test says so, however slow this machine is.
  std::atomic<std::int64_t> clock_ns = 1'000'000'000;
  bus::DomainConfig domain = bus::fresh_domain();
  bus::Participant participant{domain};
  bus::Stop stop;
  std::shared_ptr<LogLines> log_lines = std::make_shared<LogLines>();
  NodeContext context{{}, {}, participant, std::make_shared<spdlog::logger>("test", log_lines), stop};
  std::shared_ptr<WheelsFarSide> wheels = std::make_shared<WheelsFarSide>();
  std::shared_ptr<KickerFarSide> kicker = std::make_shared<KickerFarSide>();
};

}  // namespace trivela::nodes
