#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pages/serve/site.hpp"

namespace trivela::pages {

/// A request that cannot be answered, with the status of the HTTP answer.
struct CommandError : std::runtime_error {
  CommandError(int http_status, const std::string& sentence) : std::runtime_error(sentence), status(http_status) {}
  int status;
};

/// A file of the page, built in.
struct Asset {
  std::string path;  ///< "/page.js"
  std::string_view text;
  const char* type;
};

/// What GET answers again each time.
struct Resource {
  using Parameter = std::function<std::string(const char* name)>;  ///< of the request; empty: it has none of the name

  std::string path;
  const char* type;
  std::function<std::string(const Parameter&)> make;  ///< throws CommandError
  std::string file_name{};                            ///< under which a browser keeps it; empty: it shows it
};

/// All that a server serves.
struct Page {
  std::vector<Asset> assets;
  std::vector<Resource> resources;

  /// POST /api/NAME with arguments: throws CommandError, or nlohmann::json::exception for arguments of a wrong type.
  /// None: the page orders nothing, and the server refuses every method but GET.
  std::function<void(const std::string& name, const nlohmann::json& arguments)> command{};

  /// Without it nothing is served; empty: to everybody.
  std::string token{};

  std::size_t most_viewers = 96;  ///< who follow the events at once; one more is refused
};

/// The newest message of each of a page's channels, encoded once and shared by all viewers: who is slow skips messages
/// and never sees an old one. Any thread.
class Broadcast {
 public:
  using Message = std::shared_ptr<const std::string>;
  using Seen = std::vector<std::uint64_t>;  ///< a viewer's last version of each channel; begins empty

  /// `channels`: their names as events, in the order in which a viewer is given them.
  explicit Broadcast(std::vector<std::string> channels);

  /// `json` becomes the newest server-sent event of the channel of that place in the list.
  void publish(std::size_t channel, const std::string& json);

  /// The newest message of each channel that `seen` does not have, in the order of the channels; waits for one up to
  /// `timeout`. Empty: none came, or closed().
  std::vector<Message> wait(Seen& seen, std::chrono::nanoseconds timeout);

  /// Lets go of all who wait.
  void close();
  bool closed() const;

 private:
  const std::vector<std::string> names_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> newest_;
  Seen versions_;
  bool closed_ = false;
};

/// Serves a page: its assets and resources, /api/events (server-sent events of the broadcast), and where it has
/// commands POST /api/COMMAND with JSON. A request that names another host than this one, or comes from another site's
/// page, is refused: somebody else's page must not read or work ours through a browser that can reach it. Where there
/// is a token it is asked of every request, as ?token=, as a bearer's, or as the cookie that the first answer sets.
/// Threads of its own; every viewer keeps one.
class PageServer {
 public:
  /// Listens. Throws std::runtime_error naming the address where that is refused. What the page refers to and the
  /// broadcast must outlive it.
  PageServer(Page page, Broadcast& broadcast, const ListenAddress& address);

  /// Closes the broadcast and hangs up; within a second, whatever the viewers do.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  int port() const;

  /// For a browser on this machine, or on another one where every address is listened on; with the token.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::pages
