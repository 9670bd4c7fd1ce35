#include "emulators/scip/emulator.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "emulators/line/emulated_socket.hpp"
#include "emulators/scip/emulated_faults.hpp"
#include "emulators/scip/emulated_playback.hpp"
#include "emulators/scip/emulated_scanner.hpp"

namespace trivela::hal::scip {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr std::size_t kLongestRequest = 64;
constexpr std::size_t kLongestQueue = 32768;  // bytes; scans measured meanwhile are lost

std::unique_ptr<EmulatedSocket> open_socket(const EmulatorConfig& config) {
  return config.port == EmulatedPort::kTcp ? emulated_tcp("SCIP", config.tcp_port)
                                           : emulated_terminal("SCIP", "scanner");
}

}  // namespace

struct Emulator::Impl {
  Impl(const EmulatorConfig& config, ScanSource source)
      : paced(config.paced),
        socket(open_socket(config)),
        scanner(config.identity, parameters_for(config.geometry, config.first_step, config.identity.product)),
        playback(config, std::move(source), Clock::now()),
        wake(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (!wake) throw std::runtime_error{"SCIP emulator: cannot be woken: " + system_error(errno)};
  }

  void run();
  void change_cable();
  void wait_for_events(std::unique_lock<std::mutex>& lock);
  void read_requests();
  void take_request(std::string_view request);
  void play();
  void send_scan();
  void say(const std::string& text);
  void write_out();
  void client_gone();
  void poke() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake.get(), &one, sizeof one);
  }
  template <class Change>
  void change(Change change_faults) {
    const std::lock_guard lock{mutex};
    change_faults(faults);
  }

  const bool paced;
  const std::unique_ptr<EmulatedSocket> socket;
  EmulatedScanner scanner;
  EmulatedPlayback playback;
  const Descriptor wake;

  std::mutex mutex;  // of all but the constants; the thread lets go of it while it waits
  std::condition_variable changed;
  bool stopping = false;
  bool cable_wanted = true;
  bool cable = true;
  std::exception_ptr cable_error;
  EmulatedFaults faults;
  std::uint64_t scans_sent = 0;
  bool was_measuring = false;
  std::string in;
  std::string out;

  std::thread thread;
};

void Emulator::Impl::run() {
  std::unique_lock lock{mutex};
  while (!stopping) {
    if (cable_wanted != cable) change_cable();
    read_requests();
    play();
    write_out();
    wait_for_events(lock);
  }
}

void Emulator::Impl::change_cable() {
  client_gone();
  try {
    cable_wanted ? socket->plug() : socket->pull();
    cable = cable_wanted;
  } catch (const std::exception&) {
    cable_error = std::current_exception();
    cable_wanted = cable;
  }
  changed.notify_all();
}

void Emulator::Impl::wait_for_events(std::unique_lock<std::mutex>& lock) {
  const auto events = static_cast<short>(out.empty() ? POLLIN : POLLIN | POLLOUT);
  std::array<pollfd, 3> polled{{{wake.get(), POLLIN, 0},
                                {cable ? socket->listener() : -1, POLLIN, 0},
                                {cable ? socket->client() : -1, events, 0}}};
  timespec time_out{};
  timespec* limit = nullptr;
  if (scanner.measuring() && playback.has_next() && (paced || out.empty())) {
    const nanoseconds left = paced ? playback.complete() - Clock::now() : nanoseconds::zero();
    time_out.tv_nsec = std::clamp<std::int64_t>(left.count(), 0, 999'999'999);
    limit = &time_out;
  }
  lock.unlock();
  ::ppoll(polled.data(), polled.size(), limit, nullptr);
  std::uint64_t pokes = 0;
  [[maybe_unused]] const auto got = ::read(wake.get(), &pokes, sizeof pokes);
  lock.lock();
  if (cable && (polled[1].revents & POLLIN) != 0) socket->accept();
}

void Emulator::Impl::read_requests() {
  if (!cable || socket->client() < 0) return;
  std::array<char, 256> bytes;
  for (;;) {
    const ssize_t count = ::read(socket->client(), bytes.data(), bytes.size());
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
      client_gone();
      socket->hang_up();
      return;
    }
    if (count < 0) return;
    for (const char byte : std::string_view{bytes.data(), static_cast<std::size_t>(count)}) {
      if (byte != '\n' && byte != '\r') {
        if (in.size() < kLongestRequest) in += byte;
        continue;
      }
      if (!in.empty()) take_request(std::exchange(in, {}));
    }
  }
}

void Emulator::Impl::take_request(std::string_view request) {
  if (faults.silent) return;
  if (const std::string refusal = faults.refusal(request); !refusal.empty()) return say(refusal);
  say(scanner.answer(request));
  if (scanner.take_reset()) playback.reset_clock(Clock::now());
}

void Emulator::Impl::play() {
  const auto now = Clock::now();
  if (scanner.measuring() && !was_measuring) playback.begin(now);
  const auto due = [&] {
    return scanner.measuring() && playback.has_next() && (paced ? now >= playback.complete() : out.empty());
  };
  while (due()) {
    out.size() > kLongestQueue ? playback.postpone() : send_scan();
    if (!paced) break;
  }
  was_measuring = scanner.measuring();
}

void Emulator::Impl::send_scan() {
  std::string reply = scanner.next_scan(playback.range_mm(), playback.stamp_ms());
  if (!reply.empty()) reply = faults.spoil(std::move(reply));
  if (!reply.empty() && !faults.silent) ++scans_sent;
  say(reply);
  playback.advance();
}

void Emulator::Impl::say(const std::string& text) {
  if (!faults.silent) out += text;
}

void Emulator::Impl::write_out() {
  if (!cable || socket->client() < 0) return out.clear();
  while (!out.empty()) {
    ssize_t count = ::send(socket->client(), out.data(), out.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == ENOTSOCK) count = ::write(socket->client(), out.data(), out.size());
    if (count <= 0) return;  // the next read says whether the client is gone
    out.erase(0, static_cast<std::size_t>(count));
  }
}

void Emulator::Impl::client_gone() {
  scanner.stop();
  in.clear();
  out.clear();
}

Emulator::Emulator(const EmulatorConfig& config, ScanSource source)
    : impl_(std::make_unique<Impl>(config, std::move(source))) {
  impl_->thread = std::thread{[impl = impl_.get()] { impl->run(); }};
}

Emulator::~Emulator() {
  {
    const std::lock_guard lock{impl_->mutex};
    impl_->stopping = true;
  }
  impl_->poke();
  impl_->thread.join();
}

const std::string& Emulator::address() const { return impl_->socket->address(); }

void Emulator::pull_cable() {
  std::unique_lock lock{impl_->mutex};
  impl_->cable_wanted = false;
  impl_->poke();
  impl_->changed.wait(lock, [&] { return !impl_->cable; });
}

void Emulator::plug_cable() {
  std::unique_lock lock{impl_->mutex};
  impl_->cable_wanted = true;
  impl_->poke();
  impl_->changed.wait(lock, [&] { return impl_->cable || impl_->cable_error; });
  if (auto error = std::exchange(impl_->cable_error, nullptr)) std::rethrow_exception(error);
}

void Emulator::corrupt_sums(int scans) {
  impl_->change([&](EmulatedFaults& faults) { faults.sums_to_corrupt = scans; });
}

void Emulator::tear_lines(int scans) {
  impl_->change([&](EmulatedFaults& faults) { faults.lines_to_tear = scans; });
}

void Emulator::skip_scans(int scans) {
  impl_->change([&](EmulatedFaults& faults) { faults.scans_to_skip = scans; });
}

void Emulator::answer_with(const std::string& status, int replies) {
  impl_->change([&](EmulatedFaults& faults) {
    faults.status = status;
    faults.statuses = replies;
  });
}

void Emulator::be_silent(bool silent) {
  impl_->change([&](EmulatedFaults& faults) { faults.silent = silent; });
}

bool Emulator::laser_on() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->scanner.laser_on();
}

std::uint64_t Emulator::scans_sent() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->scans_sent;
}

}  // namespace trivela::hal::scip
