#pragma once

#include <fmt/core.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace trivela::pages {

/// Answers each connection in a thread of its own, up to `most`, and keeps threads for the next ones: connections that
/// say nothing, or a byte a second, hold up nobody else.
class Connections final : public httplib::TaskQueue {
 public:
  explicit Connections(std::size_t most) : most_(most) {}

  void enqueue(std::function<void()> connection) override {
    const std::lock_guard lock{mutex_};
    waiting_.push_back(std::move(connection));
    if (waiting_.size() > idle_ && threads_.size() < most_) start_thread();
    changed_.notify_one();
  }

  void shutdown() override {
    {
      const std::lock_guard lock{mutex_};
      over_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  /// Where the system has no more threads, those that are there do the work.
  void start_thread() try {
    threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
  }

  void work() {
    std::unique_lock lock{mutex_};
    for (;;) {
      ++idle_;
      changed_.wait(lock, [this] { return over_ || !waiting_.empty(); });
      --idle_;
      if (waiting_.empty()) return;
      const auto connection = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      connection();
      lock.lock();
    }
  }

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::size_t idle_ = 0;
  bool over_ = false;
  std::vector<std::thread> threads_;
};

/// Hangs up every connection of this process to its own port, so that none holds up the end. For a server that stops.
inline void hang_up_all(int port) {
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator{"/proc/self/fd", gone}) {
    const int socket = std::atoi(entry.path().filename().c_str());
    sockaddr_storage own{}, other{};
    socklen_t own_size = sizeof own, other_size = sizeof other;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &own_size) != 0 ||
        getpeername(socket, reinterpret_cast<sockaddr*>(&other), &other_size) != 0)
      continue;
    const in_port_t bound = own.ss_family == AF_INET    ? reinterpret_cast<const sockaddr_in&>(own).sin_port
                            : own.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(own).sin6_port
                                                        : in_port_t{0};
    if (ntohs(bound) == port) ::shutdown(socket, SHUT_RDWR);
  }
}

inline void refuse(httplib::Response& response, int status, const std::string& sentence) {
  using nlohmann::json;
  response.status = status;
  response.set_content(json{{"error", sentence}}.dump(-1, ' ', false, json::error_handler_t::replace),
                       "application/json");
}

/// How a server listens.
struct Listening {
  std::string host;
  int port = 0;  ///< 0: any free one
  std::size_t most_connections = 512;
  std::chrono::milliseconds timeout{2000};  ///< of a connection that says or takes nothing
  int send_buffer_bytes = 0;                ///< 0: the system's
  httplib::Headers headers{};               ///< of every answer
};

/// Routes, and the thread that answers them. It ends at once, whatever clients do. What the routes refer to must
/// outlive it.
class HttpServer {
 public:
  httplib::Server routes{};

  HttpServer() {
    routes.set_exception_handler([](const auto&, httplib::Response& response, const std::exception_ptr& failure) {
      try {
        std::rethrow_exception(failure);
      } catch (const std::exception& error) {
        refuse(response, 500, error.what());
      }
    });
  }
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  ~HttpServer() {
    if (!thread_.joinable()) return;
    // stop() is lost on a server that has not begun
    while (!routes.is_running() && !ended_) std::this_thread::yield();
    routes.stop();
    hang_up_all(port_);
    thread_.join();
  }

  /// Throws std::runtime_error naming the address where it is refused.
  void listen(const Listening& how) {
    routes.new_task_queue = [most = how.most_connections] { return new Connections(most); };
    // Not httplib's: with SO_REUSEPORT two servers would share a port unnoticed.
    routes.set_socket_options([bytes = how.send_buffer_bytes](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
      if (bytes > 0) setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
    });
    routes.set_tcp_nodelay(true);
    routes.set_keep_alive_max_count(1);  // an idle connection would hold up the end,
    routes.set_keep_alive_timeout(1);    // and so would one that never says anything
    routes.set_read_timeout(how.timeout);
    routes.set_write_timeout(how.timeout);
    routes.set_payload_max_length(std::size_t{64} * 1024);
    routes.set_default_headers(how.headers);
    errno = 0;
    port_ =
        how.port == 0 ? routes.bind_to_any_port(how.host) : (routes.bind_to_port(how.host, how.port) ? how.port : -1);
    if (port_ <= 0) {
      const int reason = errno;
      throw std::runtime_error{fmt::format("cannot listen on {}:{}: {}", how.host, how.port,
                                           reason != 0 ? std::strerror(reason) : "the address is not this machine's")};
    }
    thread_ = std::thread([this] {
      routes.listen_after_bind();
      ended_ = true;
    });
  }

  int port() const { return port_; }

 private:
  int port_ = 0;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace trivela::pages
