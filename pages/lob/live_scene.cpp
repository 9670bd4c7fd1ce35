#include "pages/lob/live_scene.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cmath>

#include "calibration/scanner_session.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::pages {
namespace {

using nlohmann::json;

constexpr std::chrono::milliseconds kLook{100};  // between two looks at the link

json link_json(const hal::RangeFinder& finder) {
  const hal::LinkCounters counters = finder.counters();
  return {{"up", finder.up()},
          {"text", finder.status()},
          {"scans", counters.scans},
          {"torn_lines", counters.torn_lines},
          {"wrong_sums", counters.wrong_sums},
          {"error_replies", counters.error_replies},
          {"error_ranges", counters.error_ranges},
          {"lost_scans", counters.lost_scans},
          {"time_outs", counters.time_outs},
          {"reconnects", counters.reconnects}};
}

}  // namespace

LiveScene::LiveScene(std::unique_ptr<hal::RangeFinder> finder, LiveOptions options, Broadcast& broadcast)
    : finder_(std::move(finder)),
      options_(std::move(options)),
      broadcast_(broadcast),
      setup_{{"mode", "live"}, {"file", options_.record.string()}, {"source", options_.device}},
      link_(link_json(*finder_)),
      lob_session_(options_.plan) {
  broadcast_.publish(Channel::kSetup, setup_.dump());
  broadcast_.publish(Channel::kLobs, lobs().dump());
  thread_ = std::thread([this] { run(); });
}

LiveScene::~LiveScene() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void LiveScene::finish() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  check();
}

void LiveScene::run() {
  try {
    while (!stopping_ && !writer_) {
      if (finder_->connected(kLook)) begin();
      look_at_link();
    }
    auto next_look = std::chrono::steady_clock::now();
    while (!stopping_) {
      if (const auto scan = finder_->read(kLook)) take(*scan);
      if (std::chrono::steady_clock::now() < next_look) continue;
      look_at_link();
      next_look = std::chrono::steady_clock::now() + kLook;
    }
    {
      const std::lock_guard lock(back_mutex_);
      back_.reset();  // a reader would keep the write-ahead log beside the record
    }
    if (writer_) writer_->finalise();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

void LiveScene::begin() {
  const log::ScanSession session = calibration::scanner_session(*finder_, options_.mount, options_.device);
  auto writer = std::make_unique<log::ScanWriter>(options_.record, session);
  const std::lock_guard lock(mutex_);
  writer_ = std::move(writer);
  analyzer_.emplace(session.geometry, session.mount, options_.analyzer);
  max_range_m_ = session.geometry.max_range_m;
  setup_ = setup_json("live", options_.record.string(), session, options_.analyzer);
  broadcast_.publish(Channel::kSetup, setup_.dump());
  if (!power_ && !options_.plan.powers.empty()) power_ = options_.plan.powers.front();
  if (!power_) return;
  const log::TestedSetPoint tested{.t_ns = session.started_t_ns, .power = power_};
  writer_->set_point(tested);
  lob_session_.set_point(tested);
}

void LiveScene::take(const kicking::lob::Scan& scan) {
  const std::lock_guard lock(mutex_);
  if (scan.range_mm.size() != setup_["beams"].get<std::size_t>() || !writer_->push(scan)) {
    ++refused_;
    return;
  }
  auto lob = analyzer_->add(scan);
  views_.push_back(scene_of(analyzer_->view()));
  const std::size_t i = views_.size() - 1;
  const double t_s = kicking::seconds(scan.t_ns - start_t_ns());
  broadcast_.publish(Channel::kFrame, frame_json(i, t_s, scan.range_mm, max_range_m_, views_.back()));
  if (!lob) return;
  lob_session_.add(std::move(*lob), i);
  const auto all = lob_session_.lobs(views_.size());
  const bool accepted = all.back().refusal == kicking::lob::Refusal::kNone;
  if (power_ && accepted) set_power(next_power(options_.plan, kicks_done(options_.plan, all), *power_));
  broadcast_.publish(Channel::kLobs, lobs().dump());
}

void LiveScene::set_power(std::optional<double> power) {
  if (power_ == power) return;
  power_ = power;
  if (!writer_) return broadcast_.publish(Channel::kStatus, status().dump());
  const std::int64_t now_ns = views_.empty() ? 0 : views_.back().t_ns;
  const log::TestedSetPoint tested{.t_ns = now_ns, .power = power};
  writer_->set_point(tested);
  lob_session_.set_point(tested);
  broadcast_.publish(Channel::kStatus, status().dump());
}

void LiveScene::look_at_link() {
  json link = link_json(*finder_);
  const std::lock_guard lock(mutex_);
  if (link == link_) return;
  link_ = std::move(link);
  broadcast_.publish(Channel::kStatus, status().dump());
}

json LiveScene::status() const {
  json status{{"link", link_}, {"scans", views_.size()}, {"refused", refused_}, {"power", nullptr}, {"trouble", ""}};
  if (power_) status["power"] = *power_;
  if (writer_) status["trouble"] = writer_->health().value_or("");
  return status;
}

json LiveScene::lobs() const { return lob_session_.to_json(views_.size(), start_t_ns()); }

json LiveScene::state() const {
  const std::lock_guard lock(mutex_);
  json state = lobs();
  state["setup"] = setup_;
  state["status"] = status();
  return state;
}

std::string LiveScene::frame(std::size_t i) {
  SceneView view;
  double t_s = 0.0;
  {
    const std::lock_guard lock(mutex_);
    if (i >= views_.size()) throw CommandError{404, fmt::format("there is no scan {} among {}", i, views_.size())};
    view = views_[i];
    t_s = kicking::seconds(view.t_ns - start_t_ns());
  }
  const std::lock_guard lock(back_mutex_);
  if (!back_) back_.emplace(options_.record);
  if (i >= back_->size()) {
    writer_->flush();
    back_->refresh();
  }
  return frame_json(i, t_s, back_->scan(i).range_mm, max_range_m_, view);
}

std::string LiveScene::table_csv() const {
  const std::lock_guard lock(mutex_);
  return lob_session_.table_csv(views_.size());
}

void LiveScene::command(const std::string& name, const json& arguments) {
  const std::lock_guard lock(mutex_);
  if (name == "verdict") return judge(arguments);
  if (name == "background") {
    if (analyzer_) analyzer_->forget_background();
    return;
  }
  if (name != "set-point") throw CommandError{404, fmt::format("a live scanner has no command '{}'", name)};
  const double power = arguments.at("power").get<double>();
  if (!(std::isfinite(power) && power > 0.0)) throw CommandError{400, fmt::format("{} is no power", power)};
  set_power(power);
}

void LiveScene::judge(const json& arguments) {
  const auto lob = arguments.at("lob").get<std::size_t>();
  if (lob >= lob_session_.count(views_.size())) throw CommandError{404, fmt::format("there is no lob {}", lob)};
  writer_->verdict(lob_session_.judge(lob, arguments.at("accepted").get<bool>(), arguments.value("why", "")));
  if (!power_ && !options_.plan.powers.empty()) {  // the plan was done, and may lack a kick now
    const auto done = kicks_done(options_.plan, lob_session_.lobs(views_.size()));
    for (std::size_t i = 0; i < done.size() && !power_; ++i) {
      if (done[i] < options_.plan.trials) set_power(options_.plan.powers[i]);
    }
  }
  broadcast_.publish(Channel::kLobs, lobs().dump());
}

void LiveScene::check() const {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace trivela::pages
