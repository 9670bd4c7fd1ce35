#include "hal/scip/emulator.hpp"

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
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "hal/scip/emulated_scanner.hpp"
#include "hal/scip/emulated_socket.hpp"

namespace trivela::hal::scip {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr std::size_t kLongestRequest = 64;
constexpr std::size_t kLongestQueue = 32768;                  // bytes; scans measured meanwhile are lost
constexpr nanoseconds kLongestGap = std::chrono::seconds(1);  // of a source; another recording begins

nanoseconds seconds(double s) { return nanoseconds{static_cast<std::int64_t>(s * 1e9)}; }

bool count_down(int& left) { return left > 0 && left-- > 0; }

std::unique_ptr<EmulatedSocket> open_socket(const EmulatorConfig& config) {
  return config.port == EmulatedPort::kTcp ? emulated_tcp(config.tcp_port) : emulated_terminal();
}

// One sum, in the middle of the scan.
void corrupt(std::string& reply) {
  const std::size_t end = reply.find('\n', reply.size() / 2);
  if (end != std::string::npos && end > 0) reply[end - 1] = reply[end - 1] == '0' ? '1' : '0';
}

// Some bytes in the middle, with a line's end among them.
void tear(std::string& reply) {
  const std::size_t end = reply.find('\n', reply.size() / 2);
  if (end != std::string::npos && end > 20) reply.erase(end - 20, 40);
}

}  // namespace

struct Emulator::Impl {
  Impl(const EmulatorConfig& what, ScanSource scans)
      : config(what),
        source(std::move(scans)),
        socket(open_socket(config)),
        scanner(config.identity, parameters_for(config.geometry, config.first_step, config.identity.product)),
        measuring_takes(seconds(static_cast<double>(config.geometry.beams) * config.geometry.beam_period_s)),
        wake(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

  void run();
  void change_cable();
  void wait_for_events(std::unique_lock<std::mutex>& lock);
  void read_requests();
  void take_request(std::string_view request);
  void play();
  void fetch();
  void send_scan();
  void say(std::string text);
  void write_out();
  void client_gone();
  bool scan_due(Clock::time_point now) const;
  void poke() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake.get(), &one, sizeof one);
  }

  const EmulatorConfig config;
  const ScanSource source;
  const std::unique_ptr<EmulatedSocket> socket;
  EmulatedScanner scanner;
  const nanoseconds measuring_takes;
  const Descriptor wake;

  std::mutex mutex;  // of all below; the thread lets go of it while it waits
  std::condition_variable changed;
  bool stopping = false;
  bool cable_wanted = true;
  bool cable = true;
  std::exception_ptr cable_error;
  bool silent = false;
  int sums_to_corrupt = 0;
  int lines_to_tear = 0;
  int scans_to_skip = 0;
  int statuses = 0;
  std::string status;
  std::uint64_t scans_sent = 0;

  std::string in;
  std::string out;
  bool was_measuring = false;
  bool source_ended = false;
  std::optional<kicking::lob::Scan> next;
  Clock::time_point switched_on = Clock::now();
  std::uint32_t first_stamp_ms = config.first_stamp_ms;
  Clock::time_point next_starts = switched_on;  // beam 0 of `next`

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
  const auto now = Clock::now();
  timespec time_out{};
  timespec* limit = nullptr;
  if (scanner.measuring() && next && (config.paced || out.empty())) {
    const nanoseconds left = config.paced ? next_starts + measuring_takes - now : nanoseconds::zero();
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
  if (silent) return;
  if (count_down(statuses)) return say(plain_reply(request, status));
  say(scanner.answer(request));
  if (scanner.take_reset()) {
    switched_on = next_starts = Clock::now();
    first_stamp_ms = 0;
  }
}

bool Emulator::Impl::scan_due(Clock::time_point now) const {
  return scanner.measuring() && next && (config.paced ? now >= next_starts + measuring_takes : out.empty());
}

void Emulator::Impl::play() {
  const auto now = Clock::now();
  if (scanner.measuring() && !was_measuring) {
    next_starts = std::max(next_starts, now);
    if (!next) fetch();
  }
  while (scan_due(now)) {
    if (out.size() > kLongestQueue) {
      next_starts += seconds(config.geometry.scan_period_s);
    } else {
      send_scan();
    }
    if (!config.paced) break;
  }
  was_measuring = scanner.measuring();
}

void Emulator::Impl::send_scan() {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(next_starts - switched_on);
  const auto stamp_ms = first_stamp_ms + static_cast<std::uint32_t>(since.count());
  std::string reply = scanner.next_scan(next->range_mm, stamp_ms);
  if (!reply.empty() && !count_down(scans_to_skip)) {
    if (count_down(statuses)) reply = plain_reply(reply.substr(0, reply.find('\n')), status);
    if (count_down(sums_to_corrupt)) corrupt(reply);
    if (count_down(lines_to_tear)) tear(reply);
    if (!silent) ++scans_sent;
    say(std::move(reply));
  }
  fetch();
}

void Emulator::Impl::fetch() {
  const auto last_t_ns = next ? std::optional{next->t_ns} : std::nullopt;
  next = source_ended ? std::nullopt : source();
  source_ended = !next;
  if (!next || !last_t_ns) return;
  const nanoseconds gap{next->t_ns - *last_t_ns};
  const bool goes_on = gap > nanoseconds::zero() && gap <= kLongestGap;
  next_starts += goes_on ? gap : seconds(config.geometry.scan_period_s);
}

void Emulator::Impl::say(std::string text) {
  if (!silent) out += text;
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
  const std::lock_guard lock{impl_->mutex};
  impl_->sums_to_corrupt = scans;
}

void Emulator::tear_lines(int scans) {
  const std::lock_guard lock{impl_->mutex};
  impl_->lines_to_tear = scans;
}

void Emulator::skip_scans(int scans) {
  const std::lock_guard lock{impl_->mutex};
  impl_->scans_to_skip = scans;
}

void Emulator::answer_with(const std::string& status, int replies) {
  const std::lock_guard lock{impl_->mutex};
  impl_->status = status;
  impl_->statuses = replies;
}

void Emulator::be_silent(bool silent) {
  const std::lock_guard lock{impl_->mutex};
  impl_->silent = silent;
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
