#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace trivela::pages {

inline constexpr std::chrono::seconds kTimeout{30};

/// A browser that follows the events: the indices of the frames it got, and the newest of every other event.
class Viewer {
 public:
  /// `headers`: what it sends beside the request, such as a cookie.
  explicit Viewer(int port, httplib::Headers headers = {})
      : client_("127.0.0.1", port), headers_(std::move(headers)), thread_([this] { follow(); }) {}
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer() {
    leaving_ = true;
    client_.stop();
    thread_.join();
  }

  /// False: `condition` did not come true for kTimeout.
  template <typename Condition>
  bool wait(const Condition& condition) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kTimeout, condition);
  }

  /// Its newest event of a name; null: there was none.
  nlohmann::json newest_of(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return newest.contains(name) ? newest[name] : nlohmann::json();
  }

  // For conditions, or after the last wait.
  std::vector<std::size_t> frames;
  nlohmann::json lobs;
  nlohmann::json status;
  nlohmann::json setup;
  std::map<std::string, nlohmann::json> newest;  ///< of every event
  std::map<std::string, int> events;             ///< how many there were; "": comments
  int status_code = 0;                           ///< of the answer, where the server hung up
  bool ended = false;                            ///< the server hung up

 private:
  void follow() {
    client_.set_read_timeout(kTimeout);
    const auto answer = client_.Get("/api/events", headers_, [this](const char* data, std::size_t size) {
      text_.append(data, size);
      for (auto end = text_.find("\n\n"); end != std::string::npos; end = text_.find("\n\n")) {
        take(text_.substr(0, end));
        text_.erase(0, end + 2);
      }
      return !leaving_;
    });
    const std::lock_guard lock(mutex_);
    if (answer) status_code = answer->status;
    ended = true;
    changed_.notify_all();
  }

  void take(const std::string& event) {
    const auto data = event.find("\ndata: ");
    if (data == std::string::npos) {  // a comment, or when to come back
      const std::lock_guard lock(mutex_);
      if (event.starts_with(":")) ++events[""];
      changed_.notify_all();
      return;
    }
    const std::string name = event.substr(7, data - 7);  // after "event: "
    const auto json = nlohmann::json::parse(event.substr(data + 7));
    const std::lock_guard lock(mutex_);
    ++events[name];
    newest[name] = json;
    if (name == "frame") frames.push_back(json["i"]);
    if (name == "lobs") lobs = json;
    if (name == "status") status = json;
    if (name == "setup") setup = json;
    changed_.notify_all();
  }

  httplib::Client client_;
  const httplib::Headers headers_;
  std::atomic<bool> leaving_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string text_;
  std::thread thread_;
};

inline int post(int port, const std::string& command, const nlohmann::json& arguments, httplib::Headers headers = {},
                const std::string& type = "application/json", std::string* body = nullptr) {
  httplib::Client client("127.0.0.1", port);
  const auto answer = client.Post("/api/" + command, headers, arguments.dump(), type);
  if (answer && body != nullptr) *body = answer->body;
  return answer ? answer->status : -1;
}

inline std::string get(int port, const std::string& path) {
  httplib::Client client("127.0.0.1", port);
  const auto answer = client.Get(path);
  return answer ? answer->body : "";
}

}  // namespace trivela::pages
