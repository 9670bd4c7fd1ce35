#include <fmt/format.h>

#include <mutex>
#include <stdexcept>

#include "log/schema/bind.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/scan_schema.sql.hpp"
#include "log/write/scan_log.hpp"
#include "log/write/session_writer.hpp"

namespace trivela::log {
namespace {

void create_record(SQLite::Database& database, const std::string& uuid, const ScanSession& session) {
  SQLite::Transaction transaction(database);
  database.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kScanRecord.application_id,
                            kScanRecord.version));
  database.exec(kScanSchemaSql);
  const kicking::lob::ScannerIdentity& identity = session.identity;
  const kicking::lob::ScanGeometry& geometry = session.geometry;
  const kicking::lob::LaserMount& mount = session.mount;
  run(database,
      "INSERT INTO sessions (session_id, uuid, started_t_ns, realtime_offset_ns, vendor, product, serial, firmware, "
      "protocol, beams, first_angle_rad, step_rad, beam_period_s, scan_period_s, min_range_m, max_range_m, laser_x_m, "
      "laser_z_m, front_elevation_rad, mirrored, simulated, source, software_version) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      session_id_of(uuid), uuid, session.started_t_ns, session.realtime_offset_ns, identity.vendor, identity.product,
      identity.serial, identity.firmware, identity.protocol, static_cast<std::int64_t>(geometry.beams),
      geometry.first_angle_rad, geometry.step_rad, geometry.beam_period_s, geometry.scan_period_s, geometry.min_range_m,
      geometry.max_range_m, mount.x_m, mount.z_m, mount.front_elevation_rad, mount.mirrored, session.simulated,
      session.source, session.software_version);
  transaction.commit();
}

NewLog scan_record(const ScanSession& session) {
  const std::string uuid = make_uuid();
  return {.kind = kScanRecord,
          .session_id = session_id_of(uuid),
          .started_t_ns = session.started_t_ns,
          .create = [=](SQLite::Database& database) { create_record(database, uuid, session); }};
}

}  // namespace

struct ScanWriter::Impl {
  std::size_t beams;
  Writer writer;
  TableId scans = writer.table("scans", {"seq", "t_ns", "ranges"});
  TableId set_points = writer.table("set_points", {"seq", "t_ns", "power", "kick_id"});
  TableId verdicts = writer.table("verdicts", {"seq", "launch_t_ns", "accepted", "why"});
  std::mutex mutex{};  // of the numbers, so that rows go into the queue in their order
  std::int64_t next_scan = 0;
  std::int64_t next_set_point = 0;
  std::int64_t next_verdict = 0;
};

ScanWriter::ScanWriter(const std::filesystem::path& path, const ScanSession& session, WriterOptions options)
    : impl_(new Impl{.beams = session.geometry.beams, .writer{path, scan_record(session), std::move(options)}}) {}

ScanWriter::~ScanWriter() = default;

bool ScanWriter::push(const kicking::lob::Scan& scan) {
  if (scan.range_mm.size() != impl_->beams) {
    throw std::invalid_argument(
        fmt::format("a scan of {} beams for a scan record of {} beams", scan.range_mm.size(), impl_->beams));
  }
  Blob ranges = encode_ranges(scan.range_mm);
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->writer.push(impl_->scans, {impl_->next_scan, scan.t_ns, std::move(ranges)})) return false;
  ++impl_->next_scan;
  return true;
}

void ScanWriter::set_point(const TestedSetPoint& tested) {
  const std::lock_guard lock(impl_->mutex);
  impl_->writer.push(impl_->set_points,
                     {impl_->next_set_point++, tested.t_ns, tested.power.value_or(0.0), tested.kick_id});
}

void ScanWriter::verdict(const Verdict& verdict) {
  const std::lock_guard lock(impl_->mutex);
  impl_->writer.push(impl_->verdicts,
                     {impl_->next_verdict++, verdict.launch_t_ns, std::int64_t{verdict.accepted ? 1 : 0}, verdict.why});
}

void ScanWriter::flush() { impl_->writer.flush(); }

std::optional<std::string> ScanWriter::health() const { return impl_->writer.health(); }

void ScanWriter::finalise() { impl_->writer.finalise(); }

}  // namespace trivela::log
