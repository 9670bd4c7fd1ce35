#include "pages/serve/page_server.hpp"

#include <fmt/core.h>
#include <httplib.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <utility>

#include "pages/serve/connections.hpp"

namespace trivela::pages {

Broadcast::Broadcast(std::vector<std::string> channels)
    : names_(std::move(channels)), newest_(names_.size()), versions_(names_.size()) {}

void Broadcast::publish(std::size_t channel, const std::string& json) {
  auto message = std::make_shared<const std::string>("event: " + names_[channel] + "\ndata: " + json + "\n\n");
  {
    const std::lock_guard lock(mutex_);
    newest_[channel] = std::move(message);
    ++versions_[channel];
  }
  changed_.notify_all();
}

std::vector<Broadcast::Message> Broadcast::wait(Seen& seen, std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  seen.resize(names_.size());
  changed_.wait_for(lock, timeout, [&] { return closed_ || seen != versions_; });
  std::vector<Message> messages;
  if (closed_) return messages;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (seen[i] != versions_[i]) messages.push_back(newest_[i]);
  }
  seen = versions_;
  return messages;
}

void Broadcast::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Broadcast::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr std::size_t kOtherConnections = 512;  // beside those of viewers, who take a stream of events
constexpr int kSendBuffer_bytes = 32 * 1024;    // some messages: a slow viewer skips some instead of seeing old ones
constexpr std::chrono::milliseconds kStalled{700};  // a viewer that takes nothing for so long is hung up; it comes back
constexpr std::chrono::seconds kStillHere{1};

std::string own_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Counts a viewer while it lives.
class Seat {
 public:
  Seat(std::atomic<std::size_t>& viewers, std::size_t most) : viewers_(viewers), taken_(++viewers <= most) {}
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  ~Seat() { --viewers_; }
  bool taken() const { return taken_; }

 private:
  std::atomic<std::size_t>& viewers_;
  const bool taken_;
};

}  // namespace

struct PageServer::Impl {
  Page page;
  Broadcast& broadcast;
  std::string host;
  std::string name = own_name();
  std::atomic<std::size_t> viewers = 0;
  HttpServer server{};

  void follow(Response& response) {
    auto seat = std::make_shared<Seat>(viewers, page.most_viewers);
    if (!seat->taken()) return refuse(response, 503, fmt::format("{} viewers are here already", page.most_viewers));
    auto seen = std::make_shared<Broadcast::Seen>();
    response.set_header("Cache-Control", "no-store");
    response.set_chunked_content_provider(
        "text/event-stream", [this, seat, seen](std::size_t, httplib::DataSink& sink) {
          std::string text = seen->empty() ? "retry: 500\n\n" : "";  // ms, where the line broke
          const auto messages = broadcast.wait(*seen, kStillHere);
          if (broadcast.closed()) return false;
          if (messages.empty()) text += ":\n\n";
          for (const Broadcast::Message& message : messages) text += *message;
          return sink.write(text.data(), text.size());
        });
  }

  void post(const Request& request, Response& response) {
    if (!request.get_header_value("Content-Type").starts_with("application/json")) {
      return refuse(response, 415, "commands are JSON: Content-Type must be application/json");
    }
    try {
      page.command(request.matches[1], json::parse(request.body));
      response.set_content(json{{"ok", true}}.dump(), "application/json");
    } catch (const CommandError& error) {
      refuse(response, error.status, error.what());
    } catch (const json::exception& error) {
      refuse(response, 400, fmt::format("the command makes no sense: {}", error.what()));
    }
  }

  void answer(const Resource& resource, const Request& request, Response& response) {
    try {
      const std::string text = resource.make([&](const char* parameter) { return request.get_param_value(parameter); });
      if (!resource.file_name.empty())
        response.set_header("Content-Disposition", "attachment; filename=\"" + resource.file_name + "\"");
      response.set_content(text, resource.type);
    } catch (const CommandError& error) {
      refuse(response, error.status, error.what());
    }
  }

  std::string cookie() const {
    return fmt::format("trivela_{}", server.port());
  }  // a browser gives one to all ports of a host

  // Whoever shows the token is given the cookie, by which the page's own requests show it.
  bool has_token(const Request& request, Response& response) const {
    if (page.token.empty()) return true;
    const bool shown = same_token(request.get_param_value("token"), page.token);
    if (shown)
      response.set_header("Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Lax", cookie(), page.token));
    return shown || same_token(request.get_header_value("Authorization"), "Bearer " + page.token) ||
           same_token(cookie_of(request.get_header_value("Cookie"), cookie()), page.token);
  }

  // What nobody is answered who does not belong here.
  bool refused(const Request& request, Response& response) const {
    if (!names_this_machine(request.get_header_value("Host"), name)) {
      refuse(response, 403, "the page is asked for by a name that is not this machine's");
    } else if (!same_origin(request.get_header_value("Origin"), request.get_header_value("Host"))) {
      refuse(response, 403, "a page of another site may not work this one");
    } else if (!has_token(request, response)) {
      refuse(response, 401, "the page needs its token: open the address that it was announced with");
    } else if (!page.command && request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET");
      refuse(response, 405, "this page orders nothing");
    } else {
      return false;
    }
    return true;
  }

  void route() {
    for (const Asset& asset : page.assets) {
      server.routes.Get(asset.path, [&asset](const Request&, Response& response) {
        response.set_content(asset.text.data(), asset.text.size(), asset.type);
      });
    }
    for (const Resource& resource : page.resources) {
      server.routes.Get(resource.path,
                        [&, this](const Request& request, Response& response) { answer(resource, request, response); });
    }
    server.routes.Get("/api/events", [this](const Request&, Response& response) { follow(response); });
    if (page.command)
      server.routes.Post(R"(/api/([a-z-]+))",
                         [this](const Request& request, Response& response) { post(request, response); });
    server.routes.set_pre_routing_handler([this](const Request& request, Response& response) {
      return refused(request, response) ? httplib::Server::HandlerResponse::Handled
                                        : httplib::Server::HandlerResponse::Unhandled;
    });
  }

  void listen(int port) {
    server.listen(
        {.host = host,
         .port = port,
         .most_connections = page.most_viewers + kOtherConnections,
         .timeout = kStalled,
         .send_buffer_bytes = kSendBuffer_bytes,
         .headers = {{"Content-Security-Policy", "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'"},
                     {"X-Content-Type-Options", "nosniff"},
                     {"Referrer-Policy", "no-referrer"}}});
  }
};

PageServer::PageServer(Page page, Broadcast& broadcast, const ListenAddress& address)
    : impl_(new Impl{.page = std::move(page), .broadcast = broadcast, .host = address.host}) {
  impl_->route();
  impl_->listen(address.port);
}

PageServer::~PageServer() { impl_->broadcast.close(); }

int PageServer::port() const { return impl_->server.port(); }

std::string PageServer::url() const {
  const bool everywhere = impl_->host == "0.0.0.0" || impl_->host == "::";
  const std::string host = everywhere ? impl_->name : impl_->host;
  const std::string& token = impl_->page.token;
  return fmt::format("http://{}:{}/{}", host.find(':') == std::string::npos ? host : "[" + host + "]",
                     impl_->server.port(), token.empty() ? "" : "?token=" + token);
}

}  // namespace trivela::pages
