#include "nodes/recorder/recorder_node.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <type_traits>

#include "bus/executor.hpp"
#include "kicking/geometry/time.hpp"
#include "log/write/additions.hpp"
#include "nodes/recorder/log_place.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"
#include "robot/recording/message_row.hpp"

namespace trivela::nodes {

std::size_t SilenceRecord::add(const std::string& table, double period_s) {
  const double longest_s = std::max(period_s, cycle_s_);
  const std::lock_guard lock{mutex_};
  const auto known = std::ranges::find(tables_, table);
  if (known != tables_.end()) return static_cast<std::size_t>(known - tables_.begin());
  tables_.push_back(table);
  return watch_.add(kicking::nanoseconds(longest_s));
}

void SilenceRecord::received(std::size_t stream, std::uint8_t robot_id, std::int64_t t_ns) {
  if (robot_id == 0) return;  // there is no such robot; in the log it stands for all of them
  const std::lock_guard lock{mutex_};
  watch_.received(stream, robot_id, t_ns);
}

void SilenceRecord::look(std::int64_t now_ns) {
  const std::lock_guard lock{mutex_};
  for (const robot::SilenceEdge& edge : watch_.look(now_ns)) {
    write(edge);
    lines_.note(edge, fmt::format("{} of robot {}", tables_[edge.stream], edge.robot_id));
  }
  for (const std::string& line : lines_.due(now_ns)) logger_->warn("{}", line);
}

void SilenceRecord::write(const robot::SilenceEdge& edge) {
  const log::Silence silence{tables_[edge.stream], edge.robot_id, edge.from_ns, edge.to_ns};
  if (edge.was_delay()) {
    log_.withdraw(silence);
  } else {
    log_.silence(silence);
  }
}

constexpr double kTeamPeriod_s = 0.35;  // a second without a state is a silence: on the air a few are lost in a row

using log::LossKind;
using log::TableId;

RecorderNode::RecorderNode(NodeContext& context, log::Writer& log, std::shared_ptr<RecordingState> state)
    : context_(context),
      log_(log),
      node_(context.participant, "recorder"),
      shadows_(log.table(robot::table_of<msg::ShadowDecision>(), robot::shadow_columns())),
      assignments_(log.table("assignments", robot::assignment_columns())),
      clocks_(log),
      step_done_(step_done_writer(context, node_)),
      state_(std::move(state)) {
  if (!context.settings.run.lockstep) {
    if (!state_->silences)
      state_->silences = std::make_shared<SilenceRecord>(context.logger, context.settings.run.cycle_s, log);
    node_.every(SilenceRecord::kStep, "silence", [this] { note_silences(); });
  }
  bus::for_each_message([this]<class T>() {
    if constexpr (requires(T sample) { sample.seq; }) {
      if (const auto table = log::table_of_message(bus::meta<T>::name)) record<T>(*table);
    }
  });
  if (state_->silences) {
    bus::ReaderOptions everything;
    everything.keep_all = true;
    node_.on<msg::TeamHeard>([this](const msg::TeamHeard& received) { store_received(received); }, {}, everything);
  }
  // With keys a kicker_driver alone says it, and they do not let the recorder hear it.
  if (state_->silences && context_.keys.empty()) fires_.emplace(context.participant);
  node_.on<msg::DeviceEmulated>([this](const msg::DeviceEmulated&) { note_simulation(false); }, bus::writes<>());
}

void RecorderNode::note_simulation(bool truth) {
  std::atomic<bool>& noted = truth ? state_->truth_told : state_->emulated;
  if (noted.exchange(true)) return;
  if (!log_.simulated(truth ? std::optional{simulation_of(context_.settings)} : std::nullopt)) noted = false;
}

void RecorderNode::note_silences() {
  if (!state_->silences) return;
  state_->silences->look(now_ns(std::chrono::steady_clock::now()));
  if (fires_) fires_->take([this](const msg::DeviceFire& fire) { state_->fires.fired(fire, context_.steady_ns()); });
  note_fires(state_->fires.unanswered(context_.steady_ns()));
}

/// The streams have no row of it: a note has.
void RecorderNode::note_fires(const std::vector<msg::DeviceFire>& fires) {
  if (fires.empty()) return;
  const msg::DeviceFire& fire = fires.front();
  std::string text = fmt::format(
      "robot {}: a program ordered the coil (device/fire) to kick {} with power {:g} at t {:.3f} s, and no "
      "kicker_driver "
      "answers for it: on a bus without keys any program can say that (trivela keys)",
      fire.robot_id, fire.kick_id, fire.power, kicking::seconds(fire.t_ns));
  if (fires.size() > 1) text += fmt::format("; {} more kicks were ordered in this way", fires.size() - 1);
  context_.logger->error(text);
  try {
    log::Additions{state_->log}.add(
        log::Note{.session_id = log_.session_id(), .kind = "note", .text = text, .who = "recorder"},
        now_ns(std::chrono::system_clock::now()));
  } catch (const std::exception& error) {
    context_.logger->error("the log has no note of that: {}", error.what());
  }
}

template <class T>
std::optional<std::int64_t> RecorderNode::store(const std::string& table, TableId id, StreamWatch& watch, T sample,
                                                std::uint64_t writer) {
  if (watch.repeats(sample.robot_id, sample.seq, sample.t_ns)) return std::nullopt;
  if (watch.writers[sample.robot_id].see(writer, now_ns(std::chrono::steady_clock::now())))
    context_.logger->warn("several programs write {} of robot {}: the log has the rows of all of them", table,
                          sample.robot_id);
  robot::SequenceWatch::Finding finding{.believed = false};
  if (context_.settings.run.lockstep) {
    finding = watch.numbers.see(sample.robot_id, sample.seq, writer);
  } else if (context_.participant.believes(sample.t_ns) && watch.instants.believes(writer, sample.t_ns)) {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    finding = watch.numbers.see(sample.robot_id, sample.seq, writer, now.count(), kicking::seconds(sample.t_ns));
  }
  if (!finding.believed) {
    log_.add_loss(table, LossKind::kRejected);
    return std::nullopt;
  }
  if (finding.out_of_order) log_.add_loss(table, LossKind::kOutOfOrder);
  if (finding.repeated) return std::nullopt;  // a writer that comes back says again what it keeps
  if (finding.filled) log_.add_loss(table, LossKind::kGaps, -1);
  if (finding.gap > 0) {
    log_.add_loss(table, LossKind::kGaps, finding.gap);
    const auto before = watch.latest.find(sample.robot_id);
    if (watch.events && before != watch.latest.end() && before->second.second < sample.t_ns)
      log_.silence({table, sample.robot_id, before->second.second, sample.t_ns});
  }
  if (!finding.out_of_order) watch.latest[sample.robot_id] = {sample.seq, sample.t_ns};
  sample.seq = static_cast<std::uint64_t>(finding.seq);
  log_.push(id, robot::row_of(sample));
  return finding.seq;
}

template <class T>
void RecorderNode::record(const std::string& table) {
  const TableId id = log_.table(table, robot::columns_of<T>());
  bus::ReaderOptions everything;
  everything.keep_all = true;
  if constexpr (std::is_same_v<T, msg::KickTruth> || std::is_same_v<T, msg::PossessionTruth>) {
    everything.on_liveliness = [this](const bus::Liveliness& writers) {
      if (writers.alive > 0) note_simulation(true);
    };
  }
  // State streams that come regularly have a sample a cycle in lockstep.
  std::optional<std::size_t> cycle_stream;
  if (bus::meta<T>::profile == bus::Profile::kState && bus::meta<T>::period_s > 0.0) cycle_stream = cycles_.add();
  std::optional<std::size_t> place;
  state_->streams[table].events = state_->silences && bus::meta<T>::period_s <= 0.0;
  if (state_->silences && bus::meta<T>::period_s > 0.0) place = state_->silences->add(table, bus::meta<T>::period_s);
  node_.on<T>(
      [this, table, id, cycle_stream, place, &watch = state_->streams[table]](const T& sample,
                                                                              const bus::SampleInfo& info) {
        const auto seq = store(table, id, watch, sample, info.writer);
        if (!seq) return;
        if constexpr (std::is_same_v<T, msg::KickDecision>) store_beside(sample, *seq);
        if constexpr (std::is_same_v<T, msg::KickReceipt>) state_->fires.answered(sample);
        if (place) state_->silences->received(*place, sample.robot_id, sample.t_ns);
        if (cycle_stream && sample.robot_id == context_.robot_id()) report_cycle(*cycle_stream, sample.t_ns);
      },
      bus::writes<msg::StepDone>(), everything);
}

/// The other's clock once a second, and its silences: of a robot by its number, of the base by that of the receiver.
void RecorderNode::store_received(const msg::TeamHeard& received) {
  constexpr std::int64_t kEvery_ns = 1'000'000'000;
  if (!context_.participant.believes(received.t_ns)) return;
  const std::int64_t other = received.other_robot_id;
  if (other > 0) {
    const std::size_t place = state_->silences->add("team_state", kTeamPeriod_s);
    state_->silences->received(place, received.other_robot_id, received.t_ns);
  } else {
    const std::size_t place = state_->silences->add("team_state of the base", kTeamPeriod_s);
    state_->silences->received(place, received.robot_id, received.t_ns);
  }
  const auto last = state_->clocks.find(received.other_robot_id);
  if (!received.clock_known || (last != state_->clocks.end() && received.t_ns - last->second < kEvery_ns)) return;
  state_->clocks[received.other_robot_id] = received.t_ns;
  clocks_.push({.robot_id = received.robot_id,
                .other_robot_id = received.other_robot_id,
                .t_ns = received.t_ns,
                .offset_ns = received.offset_ns,
                .error_ns = std::max<std::int64_t>(received.error_ns, 0)});
}

void RecorderNode::report_cycle(std::size_t stream, std::int64_t t_ns) {
  if (!step_done_) return;
  const std::lock_guard lock{mutex_};
  const auto complete = cycles_.see(stream, t_ns);
  if (!complete) return;
  // The match waits for a disk that does not keep up, so that a full queue costs time and not rows.
  if (log_.waiting() > context_.settings.recorder.queue_capacity / 2) log_.flush();
  step_done(step_done_, context_.robot_id(), msg::STEP_RECORDER, *complete);
}

void RecorderNode::store_beside(const msg::KickDecision& decision, std::int64_t seq) {
  const bool in_play = decision.reason != msg::REASON_NOT_PLAYING;
  if (in_play && state_->assigned.insert({decision.robot_id, decision.half, decision.possession_id}).second) {
    robot::RowCells row;
    robot::write_assignment(row, decision.robot_id, decision.half, decision.possession_id, msg::policy_name(decision),
                            decision.assignment_probability, decision.t_ns);
    log_.push(assignments_, std::move(row.cells));
  }
  const auto count = std::min<std::int64_t>(decision.shadow_count, std::ssize(decision.shadows));
  for (std::int64_t i = 0; i < count; ++i) {
    robot::RowCells row;
    robot::write_shadow(row, decision.robot_id, seq, i, decision.shadows[i]);
    log_.push(shadows_, std::move(row.cells));
  }
}

int recorder_main(int argc, char** argv) {
  // One log with what is known of it, also where the recorder joins the bus again.
  std::optional<PlacedLog> placed;
  const auto state = std::make_shared<RecordingState>();
  return node_main(argc, argv, "recorder", [&placed, &state](NodeContext& context) {
    const config::Recorder& settings = context.settings.recorder;
    log::WriterOptions options;
    options.queue_capacity = settings.queue_capacity;
    options.group_commit_s = settings.group_commit_s;
    options.warn_late = !context.settings.run.lockstep;  // where nobody looks at a clock
    options.warn = [logger = context.logger](const std::string& line) { logger->warn(line); };
    if (!placed) placed.emplace(place_log(context, options));
    log::Writer& log = *placed->writer;
    state->log = placed->path;
    RecorderNode node{context, log, state};
    // Its own thread takes the samples: the bus's receive thread must never wait for the log.
    bus::Executor{bus::Executor::kWaitset, context.stop, {&node.node()}, context.watchdog_hook()}.run();
    node.note_silences();
    log.finalise();
    const auto stats = log.stats();
    fmt::print("recorded {} rows, {:.0f} a second, queue high-water {} of {}, {} missing: {}\n", stats.rows_written,
               stats.rows_per_s, stats.queue_high_water, settings.queue_capacity, stats.samples_missing,
               placed->path.string());
  });
}

}  // namespace trivela::nodes
