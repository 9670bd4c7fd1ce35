#include "nodes/scan_recorder/scan_recorder_node.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "bus/executor.hpp"
#include "config/text/installation.hpp"
#include "hal/open.hpp"
#include "log/file/new_file.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {
namespace {

constexpr int kMostFiles = 99;

log::ScanSession session_of_scans(const NodeContext& context, const hal::RangeFinder& scanner, std::int64_t t_ns) {
  const config::ScanRecorder& settings = context.settings.scan_recorder;
  log::ScanSession session;
  session.identity = scanner.identity();
  session.geometry = scanner.geometry();
  session.mount = {.x_m = settings.mount_x_m,
                   .z_m = settings.mount_z_m,
                   .front_elevation_rad = settings.mount_front_elevation_rad,
                   .mirrored = settings.mount_mirrored};
  session.started_t_ns = t_ns;
  const bool of_the_world = std::holds_alternative<config::SimDevice>(settings.device);
  session.simulated = of_the_world || is_emulated(session.identity);
  const std::int64_t clock_ns = of_the_world ? t_ns : now_ns(std::chrono::steady_clock::now());
  session.realtime_offset_ns = now_ns(std::chrono::system_clock::now()) - clock_ns;
  session.source = of_the_world
                       ? "synthetic: scenario " + std::filesystem::path{context.settings.run.scenario}.stem().string()
                       : config::text_of(settings.device);
  session.software_version = config::software_version();
  return session;
}

}  // namespace

ScanRecorderNode::ScanRecorderNode(NodeContext& context, std::unique_ptr<hal::RangeFinder> scanner)
    : context_(context),
      scanner_(std::move(scanner)),
      node_(context.participant, "scan_recorder", context.robot_id()),
      emulation_(context, node_),
      file_(context.settings.scan_recorder.file),
      step_done_(step_done_writer(context, node_)) {
  node_.on_device(
      "range_finder", [this](std::chrono::nanoseconds timeout) { return next_scan(timeout); },
      [this](const kicking::lob::Scan& scan) { on_scan(scan); }, bus::writes<msg::StepDone, msg::DeviceEmulated>());
  bus::ReaderOptions everything;
  everything.keep_all = true;
  node_.on<msg::KickReceipt>([this](const msg::KickReceipt& receipt) { on_receipt(receipt); }, {}, everything);
}

std::optional<kicking::lob::Scan> ScanRecorderNode::next_scan(std::chrono::nanoseconds timeout) {
  if (!connected_) {
    connected_ = scanner_->connected(timeout);
    if (!connected_) {
      if (!std::exchange(waiting_, true)) context_.logger->info("waiting: {}", scanner_->status());
      return std::nullopt;
    }
    up_ = true;
    context_.logger->info("{}: {}", scanner_->identity().product, scanner_->status());
  }
  auto scan = scanner_->read(timeout);
  if (scanner_->up() != up_) {
    up_ = scanner_->up();
    if (up_) {
      context_.logger->info("{}", scanner_->status());
    } else {
      context_.logger->warn("{}", scanner_->status());
    }
  }
  return scan;
}

/// Throws std::runtime_error where the record cannot be made.
void ScanRecorderNode::open(std::int64_t t_ns) {
  log::WriterOptions options;
  options.warn = [logger = context_.logger](const std::string& line) { logger->warn(line); };
  const std::filesystem::path wanted = context_.settings.scan_recorder.file;
  const log::ScanSession session = session_of_scans(context_, *scanner_, t_ns);
  for (int n = 2; !log_; ++n) {
    try {
      log_.emplace(file_, session, options);
    } catch (const log::FileTaken& taken) {
      if (context_.settings.run.lockstep || n > kMostFiles) throw;
      const auto next = fmt::format("{}-{}{}", wanted.stem().string(), n, wanted.extension().string());
      context_.logger->warn("{}: recording to {}", taken.what(), (file_ = wanted.parent_path() / next).string());
    }
  }
  emulation_.see(msg::PART_RANGE_FINDER, is_emulated(scanner_->identity()), t_ns);
  for (const auto& tested : early_) log_->set_point(tested);
  early_.clear();
}

void ScanRecorderNode::on_scan(const kicking::lob::Scan& scan) {
  const std::lock_guard lock{mutex_};
  if (!log_) open(scan.t_ns);
  bool kept = log_->push(scan);
  if (!kept && context_.settings.run.lockstep) {  // the match waits for a slow disk
    log_->flush();
    kept = log_->push(scan);
  }
  if (kept) {
    ++scans_;
  } else if (++lost_ == 1) {
    context_.logger->warn("scans are lost: the disk does not keep up");
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_SCAN_RECORDER, scan.t_ns);
}

void ScanRecorderNode::on_receipt(const msg::KickReceipt& receipt) {
  if (!msg::begins_kick(receipt)) return;
  const log::TestedSetPoint tested{receipt.fired_t_ns, receipt.power, receipt.kick_id};
  const std::lock_guard lock{mutex_};
  if (log_) {
    log_->set_point(tested);
  } else {
    early_.push_back(tested);
  }
}

void ScanRecorderNode::finish() {
  const std::lock_guard lock{mutex_};
  if (log_) log_->finalise();
}

int scan_recorder_main(int argc, char** argv) {
  return node_main(argc, argv, "scan_recorder", [](NodeContext& context) {
    ScanRecorderNode node{context, hal::open_range_finder(context.settings.scan_recorder.device,
                                                          {context.participant, context.robot_id()})};
    bus::Executor{bus::Executor::kWaitset, context.stop, {&node.node()}, context.watchdog_hook()}.run();
    node.finish();
    context.logger->info("recorded {} scans: {}", node.scans(), node.file().string());
  });
}

}  // namespace trivela::nodes
