#include "sim/world.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::sim {

World::World(const Scenario& scenario) : scenario_(scenario), body_(scenario.robot), kicker_(scenario.kicker) {}

void World::place(const Opportunity& opportunity, double speed_scale_ratio, const kicking::Draws& draws) {
  playing_ = false;
  shot_.reset();
  draws_ = draws;
  attempts_ = 0;
  kicker_.reset(speed_scale_ratio);
  body_.place(opportunity.start, {});
  opponents_.place(body_.ball_point_m(), opportunity);
}

void World::start_play(const Opportunity& opportunity) {
  playing_ = true;
  body_.place(opportunity.start, opportunity.velocity);
}

void World::stop_play() {
  playing_ = false;
  body_.follow({});
}

void World::command(const Commands& commands) {
  if (playing_) body_.follow(commands.drive);
  kicker_.lever(commands.lever_kind, t_ns_);
  if (commands.fire) kicker_.order(*commands.fire);
}

void World::advance_to(std::int64_t t_ns) {
  coil_events();
  while (t_ns_ < t_ns) {
    const auto event = kicker_.next_event_t_ns();
    move(event ? std::clamp(*event, t_ns_ + 1, t_ns) : t_ns);
    coil_events();
  }
}

void World::coil_events() {
  const bool live = playing_ && !shot_;
  const bool was_idle = !kicker_.stroke();
  kicker_.energise_due(t_ns_, live, draws_, attempts_);
  if (was_idle && kicker_.stroke()) ++attempts_;
  const auto stroke = kicker_.take_released(t_ns_);
  if (!stroke || !stroke->live || shot_) return;
  shot_.emplace(scenario_,
                release(*stroke, body_.pose(), body_.twist(), scenario_.kicker, scenario_.robot.ball_offset_m,
                        scenario_.ball.radius_m),
                t_ns_, draws_);
  shot_kick_id_ = stroke->kick_id;
}

void World::move(std::int64_t t_ns) {
  const double dt_s = kicking::seconds(t_ns - t_ns_);
  t_ns_ = t_ns;
  body_.advance(dt_s);
  kicker_.recharge(dt_s);
  if (shot_) {
    shot_->advance_to(t_ns, opponents_.all());
  } else {
    opponents_.close_in(body_.ball_point_m(), playing_ ? dt_s : 0.0);
  }
}

Eigen::Vector3d World::ball_m() const {
  if (shot_) return shot_->ball().position_m;
  Eigen::Vector3d held = body_.ball_point_m();
  held.z() = scenario_.ball.radius_m;
  return held;
}

}  // namespace trivela::sim
