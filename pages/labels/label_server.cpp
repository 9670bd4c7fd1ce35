#include "pages/labels/label_server.hpp"

// Before httplib.h, whose macro _res Eigen's headers would meet.
#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "config/text/parse_number.hpp"
#include "log/schema/digest.hpp"
#include "pages/labels/label_page.css.hpp"
#include "pages/labels/label_page.html.hpp"
#include "pages/labels/label_page.js.hpp"
#include "pages/serve/connections.hpp"
#include "pages/serve/site.hpp"

namespace trivela::pages {
namespace {

using evaluator::NamedKick;
using httplib::Request;
using httplib::Response;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kHost = "127.0.0.1";

void answer(Response& response, int status, const json& body) {
  response.status = status;
  response.set_content(body.dump(-1, ' ', true, json::error_handler_t::replace), "application/json");
}

std::string text_at(const json& command, const char* key) {
  const auto value = command.find(key);
  if (value == command.end() || !value->is_string()) throw LabelRefused{fmt::format("the command has no {}", key)};
  return value->get<std::string>();
}

ordered_json json_of(const NamedKick& kick, std::int64_t utc_ms) {
  return {{"kick", kick.name()},
          {"session_id", fmt::format("{}", kick.session_id)},
          {"kick_id", fmt::format("{}", kick.kick_id)},
          {"robot", kick.robot_id},
          {"uuid", kick.uuid},
          {"at_s", kick.at_s},
          {"utc_ms", utc_ms},
          {"policy", kick.policy},
          {"observed", kick.observed},
          {"by_hand", kick.by_hand ? ordered_json(*kick.by_hand) : ordered_json()},
          {"labelled_by", kick.labelled_by.value_or("")}};
}

}  // namespace

LabelStore::LabelStore(std::filesystem::path log) : log_(std::move(log)), additions_(log_) {
  log::Reader reader(log_);
  evaluator::read_opportunities(reader, log_.string(), false);  // from here on each kick once
  std::map<std::tuple<std::int64_t, int, std::int64_t>, std::pair<std::int64_t, std::string>> timelines;
  for (evaluator::KickTimeline& timeline : evaluator::kick_timelines(reader)) {
    timeline.truth.reset();
    timelines[{timeline.session_id, timeline.robot_id, timeline.kick_id}] = {
        timeline.utc_ns / 1'000'000, evaluator::json_of(timeline).dump(-1, ' ', true, json::error_handler_t::replace)};
  }
  kicks_ = evaluator::named_kicks(reader);
  for (const NamedKick& kick : kicks_) {
    auto& [utc_ms, text] = timelines[{kick.session_id, kick.robot_id, kick.kick_id}];
    utc_ms_.push_back(utc_ms);
    timelines_.push_back(std::move(text));
  }
}

ordered_json LabelStore::state() const {
  const std::lock_guard lock(mutex_);
  ordered_json state{{"log", log_.filename().string()}, {"outcomes", log::kLabels}};
  ordered_json& kicks = state["kicks"] = ordered_json::array();
  for (std::size_t i = 0; i < kicks_.size(); ++i) kicks.push_back(json_of(kicks_[i], utc_ms_[i]));
  return state;
}

std::string LabelStore::timeline(std::size_t place) const {
  if (place >= timelines_.size() || timelines_[place].empty())
    throw LabelRefused{fmt::format("there is no kick {}", place)};
  return timelines_[place];
}

void LabelStore::add(const json& command, std::int64_t now_utc_ns) {
  if (!command.is_object()) throw LabelRefused{"a command is an object"};
  const std::string session_id = text_at(command, "session_id"), kick_id = text_at(command, "kick_id");
  const std::lock_guard lock(mutex_);
  const auto kick = std::ranges::find_if(kicks_, [&](const NamedKick& one) {
    return fmt::format("{}", one.session_id) == session_id && fmt::format("{}", one.kick_id) == kick_id &&
           command.value("robot", json()) == json(one.robot_id);
  });
  if (kick == kicks_.end()) throw LabelRefused{"the log has no such kick"};
  log::Label label{.session_id = kick->session_id,
                   .robot_id = kick->robot_id,
                   .kick_id = kick->kick_id,
                   .t_ns = kick->t_ns,
                   .outcome = std::nullopt,
                   .who = text_at(command, "who"),
                   .note = text_at(command, "note")};
  if (!command.contains("outcome")) throw LabelRefused{"the command has no outcome"};
  if (!command["outcome"].is_null()) label.outcome = text_at(command, "outcome");
  if (!label.outcome && !kick->by_hand) throw LabelRefused{"the kick has no label to withdraw"};
  additions_.add(label, now_utc_ns);
  kick->by_hand = label.outcome;
  kick->labelled_by = label.outcome ? std::optional(label.who) : std::nullopt;
}

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
