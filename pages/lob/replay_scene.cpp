#include "pages/lob/replay_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "calibration/rows/lobs_of_scans.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::pages {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

constexpr std::chrono::milliseconds kTick{4};  // a tenth of the shortest scan period and less
constexpr double kFastest = 1000.0;

std::vector<std::int64_t> times_of(const log::ScanReader& record, const std::filesystem::path& path) {
  std::vector<std::int64_t> t_ns;
  for (std::size_t i = 0; i < record.size(); ++i) t_ns.push_back(record.t_ns(i));
  if (t_ns.empty()) throw std::runtime_error{fmt::format("{} holds no scans", path.string())};
  return t_ns;
}

std::vector<log::Verdict> verdicts_of(const log::ScanReader& record, const std::filesystem::path& path) {
  auto verdicts = record.verdicts();
  for (const auto& later : calibration::verdicts_beside(path)) verdicts.push_back(later);
  return verdicts;
}

}  // namespace

Player::Player(std::vector<std::int64_t> t_ns) : t_ns_(std::move(t_ns)) {}

void Player::play() {
  const auto last = static_cast<std::int64_t>(t_ns_.size()) - 1;
  if (speed_ > 0.0 && position_ + 1 == t_ns_.size()) seek(0);
  if (speed_ < 0.0 && position_ == 0) seek(last);
  playing_ = true;
}

void Player::seek(std::int64_t position) {
  position_ =
      static_cast<std::size_t>(std::clamp<std::int64_t>(position, 0, static_cast<std::int64_t>(t_ns_.size()) - 1));
  now_s_ = kicking::seconds(t_ns_[position_] - t_ns_.front());
}

void Player::advance(double passed_s) {
  if (!playing_) return;
  const double end_s = kicking::seconds(t_ns_.back() - t_ns_.front());
  now_s_ = std::clamp(now_s_ + passed_s * speed_, 0.0, end_s);
  // Rounded: the start of a scan, in seconds and back, is that scan.
  const std::int64_t now_ns = t_ns_.front() + kicking::nanoseconds(now_s_);
  position_ = static_cast<std::size_t>(std::upper_bound(t_ns_.begin(), t_ns_.end(), now_ns) - t_ns_.begin()) - 1;
  const bool at_end = now_ns == (speed_ > 0.0 ? t_ns_.back() : t_ns_.front());
  if (at_end) playing_ = false;
}

ReplayScene::ReplayScene(const std::filesystem::path& record, const kicking::lob::AnalyzerConfig& config,
                         const CalibrationPlan& plan, Broadcast& broadcast)
    : path_(record),
      broadcast_(broadcast),
      record_(record),
      lob_session_(plan, record_.set_points(), verdicts_of(record_, record)),
      player_(times_of(record_, record)),
      setup_(setup_json("replay", record.string(), record_.session(), config)) {
  setup_["scans"] = record_.size();
  setup_["warnings"] = record_.warnings();
  kicking::lob::Analyzer analyzer(record_.session().geometry, record_.session().mount, config);
  for (std::size_t i = 0; i < record_.size(); ++i) {
    auto lob = analyzer.add(record_.scan(i));
    views_.push_back(scene_of(analyzer.view()));
    if (lob) lob_session_.add(std::move(*lob), i);
  }
  if (auto lob = analyzer.finish()) lob_session_.add(std::move(*lob), record_.size() - 1);
  broadcast_.publish(Channel::kSetup, setup_.dump());
  publish_lobs();
  player_.play();
  publish_place();
  thread_ = std::thread([this] { run(); });
}

ReplayScene::~ReplayScene() { finish(); }

void ReplayScene::finish() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ReplayScene::check() const {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

void ReplayScene::run() {
  std::unique_lock lock(mutex_);
  try {
    play_on(lock);
  } catch (...) {  // the record can no longer be read: check() says so
    failure_ = std::current_exception();
  }
}

void ReplayScene::play_on(std::unique_lock<std::mutex>& lock) {
  while (!stopping_) {
    changed_.wait(lock, [&] { return stopping_ || player_.playing(); });
    const Clock::time_point before = Clock::now();
    changed_.wait_for(lock, kTick, [&] { return stopping_; });
    const std::size_t place = player_.position();
    const bool was_playing = player_.playing();
    player_.advance(std::chrono::duration<double>(Clock::now() - before).count());
    if (player_.position() != place || player_.playing() != was_playing) publish_place();
  }
}

json ReplayScene::status() const {
  json status{{"playing", player_.playing()},
              {"speed", player_.speed()},
              {"position", player_.position()},
              {"scans", views_.size()},
              {"power", nullptr}};
  if (const auto power = lob_session_.power_at(views_[player_.position()].t_ns)) status["power"] = *power;
  return status;
}

std::string ReplayScene::frame_now(std::size_t i) const {
  const double t_s = kicking::seconds(views_[i].t_ns - views_.front().t_ns);
  return frame_json(i, t_s, record_.scan(i).range_mm, record_.session().geometry.max_range_m, views_[i]);
}

void ReplayScene::publish_lobs() {
  shown_lobs_ = lob_session_.count(player_.position());
  broadcast_.publish(Channel::kLobs, lob_session_.to_json(shown_lobs_, views_.front().t_ns).dump());
}

void ReplayScene::publish_place() {
  if (lob_session_.count(player_.position()) != shown_lobs_) publish_lobs();
  broadcast_.publish(Channel::kStatus, status().dump());
  broadcast_.publish(Channel::kFrame, frame_now(player_.position()));
}

json ReplayScene::state() const {
  const std::lock_guard lock(mutex_);
  json state = lob_session_.to_json(shown_lobs_, views_.front().t_ns);
  state["setup"] = setup_;
  state["status"] = status();
  return state;
}

std::string ReplayScene::frame(std::size_t i) {
  const std::lock_guard lock(mutex_);
  if (i >= views_.size()) throw CommandError{404, fmt::format("there is no scan {} among {}", i, views_.size())};
  return frame_now(i);
}

std::string ReplayScene::table_csv() const {
  const std::lock_guard lock(mutex_);
  return lob_session_.table_csv(shown_lobs_);
}

void ReplayScene::command(const std::string& name, const json& arguments) {
  const std::lock_guard lock(mutex_);
  if (name == "player") return play(arguments);
  if (name == "verdict") return judge(arguments);
  throw CommandError{409, fmt::format("a replay has no command '{}': a finished record is never changed", name)};
}

void ReplayScene::play(const json& arguments) {
  if (arguments.contains("speed")) {
    const double speed = arguments["speed"].get<double>();
    if (!(std::abs(speed) >= 0.01 && std::abs(speed) <= kFastest)) {
      throw CommandError{400,
                         fmt::format("a speed of {} is not within 0.01 to {} or their negatives", speed, kFastest)};
    }
    player_.set_speed(speed);
  }
  if (arguments.contains("position")) player_.seek(arguments["position"].get<std::int64_t>());
  if (arguments.contains("step")) {
    player_.pause();
    const std::int64_t step = arguments["step"].get<std::int64_t>();
    const auto scans = static_cast<std::int64_t>(views_.size());
    player_.seek(static_cast<std::int64_t>(player_.position()) + std::clamp(step, -scans, scans));
  }
  if (arguments.contains("playing")) arguments["playing"].get<bool>() ? player_.play() : player_.pause();
  publish_place();
  changed_.notify_all();
}

void ReplayScene::judge(const json& arguments) {
  const auto lob = arguments.at("lob").get<std::size_t>();
  if (lob >= shown_lobs_) throw CommandError{404, fmt::format("there is no lob {}", lob)};
  auto verdicts = calibration::verdicts_beside(path_);
  verdicts.push_back(lob_session_.judge(lob, arguments.at("accepted").get<bool>(), arguments.value("why", "")));
  publish_lobs();
  try {
    calibration::write_verdicts(path_, verdicts);
  } catch (const std::runtime_error& error) {
    throw CommandError{500, fmt::format("the verdict holds for now, but {}", error.what())};
  }
}

}  // namespace trivela::pages
