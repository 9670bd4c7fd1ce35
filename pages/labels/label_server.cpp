#include "pages/labels/label_server.hpp"

#include <fmt/core.h>
#include <httplib.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>
#include <thread>

#include "config/text/parse_number.hpp"
#include "evaluator/story/replay.hpp"
#include "log/schema/digest.hpp"
#include "pages/labels/label_page.css.hpp"
#include "pages/labels/label_page.html.hpp"
#include "pages/labels/label_page.js.hpp"
#include "pages/serve/connections.hpp"

namespace trivela::pages {
namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr const char* kHost = "127.0.0.1";
constexpr std::chrono::seconds kTimeout{2};
constexpr std::size_t kMostConnections = 512;

void answer(Response& response, int status, const json& body) {
  response.status = status;
  response.set_content(body.dump(-1, ' ', true, json::error_handler_t::replace), "application/json");
}

void refuse(Response& response, int status, const std::string& sentence) {
  answer(response, status, {{"error", sentence}});
}

/// As long for a wrong token as for the right one.
bool same_token(std::string_view given, std::string_view own) {
  unsigned char different = given.size() == own.size() ? 0 : 1;
  for (std::size_t i = 0; i < own.size(); ++i)
    different |= static_cast<unsigned char>(own[i] ^ (i < given.size() ? given[i] : '\0'));
  return different == 0;
}

void set_socket_options(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

std::int64_t now_utc_ns() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

struct LabelServer::Impl {
  LabelStore& desk;
  std::string token = log::make_uuid();
  int port = 0;
  httplib::Server server{};
  std::atomic<bool> ended = false;
  std::thread thread{};

  /// Names of this server that no name server decides about.
  bool is_named(const std::string& host) const {
    return host == fmt::format("{}:{}", kHost, port) || host == fmt::format("localhost:{}", port);
  }

  void label(const Request& request, Response& response) {
    if (request.get_header_value("Origin") != "http://" + request.get_header_value("Host"))
      return refuse(response, 403, "a page of another site may not label");
    if (!same_token(request.get_header_value("X-Trivela-Token"), token))
      return refuse(response, 403, "open the address that trivela label --serve printed: it has the token for labels");
    if (!request.get_header_value("Content-Type").starts_with("application/json"))
      return refuse(response, 415, "labels are JSON: Content-Type must be application/json");
    try {
      desk.add(json::parse(request.body), now_utc_ns());
      answer(response, 200, desk.state());
    } catch (const LabelRefused& error) {
      refuse(response, 400, error.what());
    } catch (const log::BadAddition& error) {
      refuse(response, 400, error.what());
    } catch (const json::exception& error) {
      refuse(response, 400, fmt::format("the label makes no sense: {}", error.what()));
    }
  }

  void story(const Request& request, Response& response) const {
    const auto place = config::parse_integer(request.get_param_value("i"));
    if (!place || *place < 0) return refuse(response, 400, "i must be a number");
    try {
      response.set_content(desk.story(static_cast<std::size_t>(*place)), "application/json");
    } catch (const LabelRefused& error) {
      refuse(response, 404, error.what());
    }
  }

  void route() {
    const auto page = [&](const char* path, std::string_view text, const char* type) {
      server.Get(path, [text, type](const Request&, Response& response) {
        response.set_content(text.data(), text.size(), type);
      });
    };
    page("/", kLabelPageHtml, "text/html; charset=utf-8");
    page("/label.js", kLabelPageJs, "text/javascript; charset=utf-8");
    page("/label.css", kLabelPageCss, "text/css; charset=utf-8");
    page("/replay.js", evaluator::replay_script(), "text/javascript; charset=utf-8");
    page("/replay.css", evaluator::replay_style(), "text/css; charset=utf-8");
    server.Get("/api/kicks", [this](const Request&, Response& response) { answer(response, 200, desk.state()); });
    server.Get("/api/story", [this](const Request& request, Response& response) { story(request, response); });
    server.Post("/api/label", [this](const Request& request, Response& response) { label(request, response); });
    server.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (is_named(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
      refuse(response, 403, "the page is asked for by a name that is not this machine's");
      return httplib::Server::HandlerResponse::Handled;
    });
    server.set_exception_handler([](const Request&, Response& response, const std::exception_ptr& failure) {
      try {
        std::rethrow_exception(failure);
      } catch (const std::exception& error) {
        refuse(response, 500, error.what());
      }
    });
  }

  void listen(int wanted_port) {
    server.new_task_queue = [] { return new Connections(kMostConnections); };
    server.set_socket_options(set_socket_options);
    server.set_tcp_nodelay(true);
    server.set_keep_alive_max_count(1);  // an idle connection would hold up the end
    server.set_read_timeout(kTimeout);
    server.set_write_timeout(kTimeout);
    server.set_payload_max_length(std::size_t{64} * 1024);
    server.set_default_headers({{"Content-Security-Policy",
                                 "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src "
                                 "data:; media-src blob:; "
                                 "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
                                {"X-Content-Type-Options", "nosniff"},
                                {"Referrer-Policy", "no-referrer"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Cache-Control", "no-store"}});
    errno = 0;
    port = wanted_port == 0 ? server.bind_to_any_port(kHost)
                            : (server.bind_to_port(kHost, wanted_port) ? wanted_port : -1);
    if (port <= 0) {
      const int reason = errno;
      throw std::runtime_error{fmt::format("cannot listen on {}:{}: {}", kHost, wanted_port,
                                           reason != 0 ? std::strerror(reason) : "it is taken")};
    }
    thread = std::thread([this] {
      server.listen_after_bind();
      ended = true;
    });
  }
};

LabelServer::LabelServer(LabelStore& desk, int port) : impl_(new Impl{.desk = desk}) {
  impl_->route();
  impl_->listen(port);
}

LabelServer::~LabelServer() {
  // stop() is lost on a server that has not begun
  while (!impl_->server.is_running() && !impl_->ended) std::this_thread::yield();
  impl_->server.stop();
  hang_up_all(impl_->port);
  impl_->thread.join();
}

int LabelServer::port() const { return impl_->port; }

const std::string& LabelServer::token() const { return impl_->token; }

std::string LabelServer::url() const { return fmt::format("http://{}:{}/#{}", kHost, impl_->port, impl_->token); }

}  // namespace trivela::pages
