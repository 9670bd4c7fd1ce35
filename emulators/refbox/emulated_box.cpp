#include "emulators/refbox/emulated_box.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <list>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "hal/line/descriptor.hpp"

namespace trivela::hal::refbox {
namespace {

using Clock = std::chrono::steady_clock;

// So long after the first half of an object its second one leaves: a client reads them one by one.
constexpr std::chrono::milliseconds kBetweenHalves{30};
// A client's unread bytes find no place beyond this: the box's deafness shows soon.
constexpr int kReceiveBuffer_B = 4096;

Descriptor listen_on(std::uint16_t& port, bool on_network) {
  Descriptor listener{::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  const int reuse = 1;
  ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
  ::setsockopt(listener.get(), SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer_B, sizeof kReceiveBuffer_B);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(port);
  own.sin_addr.s_addr = htonl(on_network ? INADDR_ANY : INADDR_LOOPBACK);
  socklen_t size = sizeof own;
  auto* const address = reinterpret_cast<sockaddr*>(&own);
  if (::bind(listener.get(), address, size) != 0 || ::listen(listener.get(), 8) != 0 ||
      ::getsockname(listener.get(), address, &size) != 0) {
    throw std::runtime_error{fmt::format("referee box: port {}: {}", port, system_error(errno))};
  }
  port = ntohs(own.sin_port);
  return listener;
}

}  // namespace

struct EmulatedBox::State {
  struct Client {
    Descriptor socket;
    std::size_t team = 0;
    Framing framing{};
  };

  struct Received {
    TeamReport report;
    Clock::time_point first{};
    Clock::time_point last{};
  };

  explicit State(const BoxConfig& wanted)
      : config(wanted),
        listener(listen_on(config.port, config.on_network)),
        wake(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (!wake) throw std::runtime_error{fmt::format("referee box: {}", system_error(errno))};
    thread = std::thread{[this] { serve(); }};
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    {
      const std::lock_guard lock{mutex};
      over = true;
    }
    poke();
    thread.join();
  }

  void poke() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake.get(), &one, sizeof one);
  }

  // The thread: accepts, reads, sends second halves.

  void serve() {
    while (true) {
      std::vector<pollfd> watched{{wake.get(), POLLIN, 0}, {listener.get(), POLLIN, 0}};
      int timeout_ms = -1;
      {
        const std::lock_guard lock{mutex};
        if (over) return;
        for (const Client& client : clients) watched.push_back({client.socket.get(), short(deaf ? 0 : POLLIN), 0});
        if (!second_half.empty()) timeout_ms = static_cast<int>(kBetweenHalves.count());
      }
      ::poll(watched.data(), watched.size(), timeout_ms);
      std::uint64_t count = 0;
      [[maybe_unused]] const auto emptied = ::read(wake.get(), &count, sizeof count);
      const std::lock_guard lock{mutex};
      if (!second_half.empty() && Clock::now() >= half_due) write_all(std::exchange(second_half, {}));
      if ((watched[1].revents & POLLIN) != 0) accept();
      std::erase_if(clients, [this](Client& client) { return !receive(client); });
      changed.notify_all();
    }
  }

  void accept() {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    Descriptor socket{
        ::accept4(listener.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC)};
    if (!socket) return;
    const int at_once = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    const auto team = place_for((ntohl(from.sin_addr.s_addr) >> 8) & 0xFFU);
    if (!team) {
      write_to(socket, wire_text({.kind = CommandKind::kReset}, config));
      ::shutdown(socket.get(), SHUT_RDWR);
      return;
    }
    received[*team].report.connected = true;
    clients.push_back({.socket = std::move(socket), .team = *team});
    const std::string welcome = wire_text({.kind = CommandKind::kWelcome, .team = team}, config);
    write_all(welcome.empty() ? wire_text({.kind = CommandKind::kWelcome}, config) : welcome);
  }

  /// The team of a client by the third number of its address; none: there is no place.
  std::optional<std::size_t> place_for(std::uint32_t number) const {
    const auto free = [this](std::size_t team) {
      return std::ranges::none_of(clients, [team](const Client& client) { return client.team == team; });
    };
    for (std::size_t team = 0; team < config.groups.size(); ++team) {
      if (config.groups[team].ends_with(fmt::format(".{}", number)))
        return free(team) ? std::optional{team} : std::nullopt;
    }
    for (std::size_t team = 0; team < config.groups.size(); ++team) {
      if (free(team)) return team;
    }
    return std::nullopt;
  }

  /// Takes what a client says; false: it is gone.
  bool receive(Client& client) {
    if (deaf && (client.socket.wait(0, Clock::now()) & (POLLERR | POLLHUP)) == 0) return true;
    std::array<char, 8192> bytes;
    std::string why;
    const auto count = client.socket.read(bytes, Clock::now(), why);
    if (!count) received[client.team].report.connected = false;
    for (const Framed& object : client.framing.add({bytes.data(), count.value_or(0)})) note(client.team, object);
    return count.has_value();
  }

  void note(std::size_t team, const Framed& object) {
    Received& of = received[team];
    of.report.last = object.text;
    const auto problem =
        object.overlong ? std::optional<std::string>{"it is too long"} : worldstate_problem(object.text);
    if (problem) {
      ++of.report.problems;
      of.report.last_problem = *problem;
      return;
    }
    of.last = Clock::now();
    if (++of.report.objects == 1) of.first = of.last;
    const double span_s = std::chrono::duration<double>(of.last - of.first).count();
    if (span_s > 0.0) of.report.rate_hz = static_cast<double>(of.report.objects - 1) / span_s;
  }

  // What it says, with the mutex held.

  static void write_to(const Descriptor& socket, std::string_view bytes) {
    std::string why;
    [[maybe_unused]] const bool sent = socket.write(bytes, Clock::now() + std::chrono::milliseconds{100}, why);
  }
  void write_all(std::string_view bytes) const {
    for (const Client& client : clients) write_to(client.socket, bytes);
  }

  void say(const std::string& bytes) {
    if (silent || bytes.empty()) return;
    write_all(std::exchange(second_half, {}));  // nothing overtakes it
    if (merging > 0) {
      merged += bytes;
      if (--merging == 0) write_all(std::exchange(merged, {}));
    } else if (std::exchange(splitting, false)) {
      write_all(std::string_view{bytes}.substr(0, bytes.size() / 2));
      second_half = bytes.substr(bytes.size() / 2);
      half_due = Clock::now() + kBetweenHalves;
      poke();
    } else {
      write_all(bytes);
    }
  }

  void drop(bool reset) {
    for (Client& client : clients) {
      const linger at_once{1, 0};
      if (reset) ::setsockopt(client.socket.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
      received[client.team].report.connected = false;
    }
    clients.clear();
    poke();
  }

  void suffer(BoxFault fault) {
    const auto say_object = [this](std::string text) { say(text.append(1, '\0')); };
    switch (fault) {
      case BoxFault::kMerge:
        merging = 2;
        return;
      case BoxFault::kSplit:
        splitting = true;
        return;
      case BoxFault::kUnknown:
        return say_object(R"({"command":"DANCE","targetTeam":""})");
      case BoxFault::kBroken:
        return say_object(R"({"command":"START",)");
      case BoxFault::kStatus:
        return say_object(R"({"status":"connected"})");
      case BoxFault::kOverlong:
        return say_object(R"({"command":")" + std::string(200'000, 'x') + R"("})");
      case BoxFault::kClose:
      case BoxFault::kReset:
        return drop(fault == BoxFault::kReset);
      case BoxFault::kSilent:
        silent = true;
        return;
      case BoxFault::kDeaf:
        deaf = true;
        return poke();
      case BoxFault::kHeal:
        silent = deaf = false;
        return poke();
    }
  }

  BoxConfig config;
  Descriptor listener;
  Descriptor wake;
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  std::list<Client> clients;
  std::array<Received, 2> received;
  int merging = 0;
  std::string merged;
  bool splitting = false;
  std::string second_half;
  Clock::time_point half_due{};
  bool silent = false;
  bool deaf = false;
  bool over = false;
  std::thread thread;
};

EmulatedBox::EmulatedBox(const BoxConfig& config) : state_(std::make_unique<State>(config)) {}
EmulatedBox::~EmulatedBox() = default;

std::uint16_t EmulatedBox::port() const { return state_->config.port; }

void EmulatedBox::act(const BoxAct& act) {
  const std::lock_guard lock{state_->mutex};
  if (const auto* const fault = std::get_if<BoxFault>(&act)) return state_->suffer(*fault);
  state_->say(wire_text(std::get<BoxCommand>(act), state_->config));
}

void EmulatedBox::send(std::string_view bytes) {
  const std::lock_guard lock{state_->mutex};
  state_->write_all(bytes);
}

TeamReport EmulatedBox::report(std::size_t team) const {
  const std::lock_guard lock{state_->mutex};
  return state_->received.at(team).report;
}

bool EmulatedBox::wait_for_teams(std::size_t n, std::chrono::nanoseconds timeout) const {
  std::unique_lock lock{state_->mutex};
  return state_->changed.wait_for(lock, timeout, [&] { return state_->clients.size() >= n; });
}

bool EmulatedBox::wait_for_objects(std::size_t team, std::uint64_t n, std::chrono::nanoseconds timeout) const {
  std::unique_lock lock{state_->mutex};
  return state_->changed.wait_for(lock, timeout, [&] { return state_->received.at(team).report.objects >= n; });
}

}  // namespace trivela::hal::refbox
