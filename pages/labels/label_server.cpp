#include "pages/labels/label_server.hpp"

#include <fmt/core.h>
#include <httplib.h>

#include <string_view>

#include "config/text/parse_number.hpp"
#include "evaluator/timeline/replay.hpp"
#include "log/schema/digest.hpp"
#include "pages/labels/label_page.css.hpp"
#include "pages/labels/label_page.html.hpp"
#include "pages/labels/label_page.js.hpp"
#include "pages/serve/connections.hpp"
#include "pages/serve/site.hpp"

namespace trivela::pages {
namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr const char* kHost = "127.0.0.1";

void answer(Response& response, int status, const json& body) {
  response.status = status;
  response.set_content(body.dump(-1, ' ', true, json::error_handler_t::replace), "application/json");
}

}  // namespace

struct LabelServer::Impl {
  LabelStore& store;
  std::string token = log::make_uuid();
  HttpServer server{};

  /// Names of this server that no name server decides about.
  bool is_named(const std::string& host) const {
    return host == fmt::format("{}:{}", kHost, server.port()) || host == fmt::format("localhost:{}", server.port());
  }

  void label(const Request& request, Response& response) {
    if (request.get_header_value("Origin") != "http://" + request.get_header_value("Host"))
      return refuse(response, 403, "a page of another site may not label");
    if (!same_token(request.get_header_value("X-Trivela-Token"), token))
      return refuse(response, 403, "open the address that trivela label --serve printed: it has the token for labels");
    if (!request.get_header_value("Content-Type").starts_with("application/json"))
      return refuse(response, 415, "labels are JSON: Content-Type must be application/json");
    try {
      store.add(json::parse(request.body), log::utc_now_ns());
      answer(response, 200, store.state());
    } catch (const LabelRefused& error) {
      refuse(response, 400, error.what());
    } catch (const log::BadAddition& error) {
      refuse(response, 400, error.what());
    } catch (const json::exception& error) {
      refuse(response, 400, fmt::format("the label makes no sense: {}", error.what()));
    }
  }

  void timeline(const Request& request, Response& response) const {
    const auto place = config::parse_integer(request.get_param_value("i"));
    if (!place || *place < 0) return refuse(response, 400, "i must be a number");
    try {
      response.set_content(store.timeline(static_cast<std::size_t>(*place)), "application/json");
    } catch (const LabelRefused& error) {
      refuse(response, 404, error.what());
    }
  }

  void route() {
    const auto page = [&](const char* path, std::string_view text, const char* type) {
      server.routes.Get(path, [text, type](const Request&, Response& response) {
        response.set_content(text.data(), text.size(), type);
      });
    };
    page("/", kLabelPageHtml, "text/html; charset=utf-8");
    page("/label.js", kLabelPageJs, "text/javascript; charset=utf-8");
    page("/label.css", kLabelPageCss, "text/css; charset=utf-8");
    page("/replay.js", evaluator::replay_script(), "text/javascript; charset=utf-8");
    page("/replay.css", evaluator::replay_style(), "text/css; charset=utf-8");
    server.routes.Get("/api/kicks",
                      [this](const Request&, Response& response) { answer(response, 200, store.state()); });
    server.routes.Get("/api/timeline",
                      [this](const Request& request, Response& response) { timeline(request, response); });
    server.routes.Post("/api/label", [this](const Request& request, Response& response) { label(request, response); });
    server.routes.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (is_named(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
      refuse(response, 403, "the page is asked for by a name that is not this machine's");
      return httplib::Server::HandlerResponse::Handled;
    });
  }

  void listen(int port) {
    server.listen({.host = kHost,
                   .port = port,
                   .headers = {{"Content-Security-Policy",
                                "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src "
                                "data:; media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
                               {"X-Content-Type-Options", "nosniff"},
                               {"Referrer-Policy", "no-referrer"},
                               {"Cross-Origin-Resource-Policy", "same-origin"},
                               {"Cache-Control", "no-store"}}});
  }
};

LabelServer::LabelServer(LabelStore& store, int port) : impl_(new Impl{.store = store}) {
  impl_->route();
  impl_->listen(port);
}

LabelServer::~LabelServer() = default;

int LabelServer::port() const { return impl_->server.port(); }

const std::string& LabelServer::token() const { return impl_->token; }

std::string LabelServer::url() const {
  return fmt::format("http://{}:{}/#{}", kHost, impl_->server.port(), impl_->token);
}

}  // namespace trivela::pages
