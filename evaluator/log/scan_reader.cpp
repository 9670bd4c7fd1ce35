#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "evaluator/log/log_file.hpp"
#include "evaluator/log/range_codec.hpp"
#include "evaluator/log/scan_log.hpp"

namespace trivela::evaluator::log {
namespace {

constexpr std::size_t kApplicationIdOffset = 68;  // in the header of an SQLite file, big-endian

/// The cells of a row one after the other. Throws std::bad_variant_access for another type, which a STRICT table does
/// not hold.
class Cells {
 public:
  explicit Cells(std::span<const Value> row) : row_(row) {}
  std::int64_t integer() { return std::get<std::int64_t>(row_[next_++]); }
  double number() { return std::get<double>(row_[next_++]); }
  const std::string& text() { return std::get<std::string>(row_[next_++]); }

 private:
  std::span<const Value> row_;
  std::size_t next_ = 0;
};

ScanSession session_of(Cells cells) {
  ScanSession session;
  session.started_t_ns = cells.integer();
  session.realtime_offset_ns = cells.integer();
  kicking::lob::ScannerIdentity& identity = session.identity;
  for (std::string* text :
       {&identity.vendor, &identity.product, &identity.serial, &identity.firmware, &identity.protocol}) {
    *text = cells.text();
  }
  kicking::lob::ScanGeometry& geometry = session.geometry;
  geometry.beams = static_cast<std::size_t>(cells.integer());
  for (double* number : {&geometry.first_angle_rad, &geometry.step_rad, &geometry.beam_period_s,
                         &geometry.scan_period_s, &geometry.min_range_m, &geometry.max_range_m}) {
    *number = cells.number();
  }
  for (double* number : {&session.mount.x_m, &session.mount.z_m, &session.mount.front_elevation_rad}) {
    *number = cells.number();
  }
  session.mount.mirrored = cells.integer() != 0;
  session.simulated = cells.integer() != 0;
  session.source = cells.text();
  session.software_version = cells.text();
  return session;
}

}  // namespace

struct ScanReader::Impl {
  struct Place {
    std::int64_t seq = 0;
    std::int64_t t_ns = 0;
  };

  explicit Impl(const std::filesystem::path& path) : file(path, kScanRecord) {
    bool found = false;
    file.query(
        "SELECT started_t_ns, realtime_offset_ns, vendor, product, serial, firmware, protocol, beams, first_angle_rad, "
        "step_rad, beam_period_s, scan_period_s, min_range_m, max_range_m, laser_x_m, laser_z_m, front_elevation_rad, "
        "mirrored, simulated, source, software_version FROM sessions",
        [&](std::span<const Value> row) {
          session = session_of(Cells(row));
          found = true;
        });
    if (!found) throw std::runtime_error(fmt::format("the scan record {} holds no session", file.path()));
    check(session.geometry);
    refresh();
  }

  [[noreturn]] void damaged(const std::string& how) const {
    throw std::runtime_error(fmt::format("the scan record {} is damaged: {}", file.path(), how));
  }

  void check(const kicking::lob::ScanGeometry& g) const {
    constexpr std::size_t kMostBeams = 10'000;
    if (g.beams == 0 || g.beams > kMostBeams) damaged(fmt::format("{} beams", g.beams));
    const auto within = [](double value, double most) { return value > 0.0 && value <= most; };
    if (!within(g.step_rad, 1.0) || !within(g.beam_period_s, 1.0) || !within(g.scan_period_s, 10.0) ||
        !within(g.max_range_m, 1000.0) || !std::isfinite(g.first_angle_rad) || !std::isfinite(g.min_range_m)) {
      damaged("its geometry is impossible");
    }
  }

  void refresh() {
    const std::int64_t last = places.empty() ? -1 : places.back().seq;
    file.query(fmt::format("SELECT seq, t_ns FROM scans WHERE seq > {} ORDER BY seq", last),
               [&](std::span<const Value> row) {
                 Cells cells(row);
                 const std::int64_t seq = cells.integer();
                 const std::int64_t t_ns = cells.integer();
                 if (!places.empty() && t_ns <= places.back().t_ns)
                   damaged(fmt::format("scan {} is not later than the one before", seq));
                 places.push_back({seq, t_ns});
               });
  }

  LogFile file;
  ScanSession session;
  std::vector<Place> places;
};

ScanReader::ScanReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
ScanReader::~ScanReader() = default;
ScanReader::ScanReader(ScanReader&&) noexcept = default;

const ScanSession& ScanReader::session() const { return impl_->session; }

std::size_t ScanReader::size() const { return impl_->places.size(); }

std::size_t ScanReader::refresh() {
  impl_->refresh();
  return size();
}

std::int64_t ScanReader::t_ns(std::size_t i) const { return impl_->places.at(i).t_ns; }

kicking::lob::Scan ScanReader::scan(std::size_t i) const {
  const Impl::Place& place = impl_->places.at(i);
  std::optional<std::vector<std::uint32_t>> ranges;
  impl_->file.query(fmt::format("SELECT ranges FROM scans WHERE seq = {}", place.seq),
                    [&](std::span<const Value> row) { ranges = decode_ranges(std::get<Blob>(row[0])); });
  const std::size_t beams = impl_->session.geometry.beams;
  if (!ranges || ranges->size() != beams) {
    throw std::runtime_error(fmt::format("the scan record {} is damaged: scan {} does not hold the ranges of {} beams",
                                         impl_->file.path(), place.seq, beams));
  }
  return {place.t_ns, std::move(*ranges)};
}

std::vector<TestedSetPoint> ScanReader::set_points() const {
  std::vector<TestedSetPoint> set_points;
  impl_->file.query("SELECT t_ns, power, kick_id FROM set_points ORDER BY seq", [&](std::span<const Value> row) {
    Cells cells(row);
    TestedSetPoint& tested = set_points.emplace_back();
    tested.t_ns = cells.integer();
    if (const double power = cells.number(); power != 0.0) tested.power = power;
    tested.kick_id = cells.integer();
  });
  return set_points;
}

std::vector<Verdict> ScanReader::verdicts() const {
  std::vector<Verdict> verdicts;
  impl_->file.query("SELECT launch_t_ns, accepted, why FROM verdicts ORDER BY seq", [&](std::span<const Value> row) {
    Cells cells(row);
    Verdict& verdict = verdicts.emplace_back();
    verdict.launch_t_ns = cells.integer();
    verdict.accepted = cells.integer() != 0;
    verdict.why = cells.text();
  });
  return verdicts;
}

std::vector<std::string> ScanReader::warnings() const {
  std::vector<std::string> warnings;
  impl_->file.query("SELECT uuid FROM sessions WHERE closed_t_ns IS NULL", [&](std::span<const Value> row) {
    warnings.push_back(fmt::format("session {} was not closed: {}", Cells(row).text(), impl_->file.not_closed()));
  });
  impl_->file.query(
      "SELECT stream, overflow + nan_refused + rejected AS missing FROM losses WHERE missing > 0 ORDER BY stream",
      [&](std::span<const Value> row) {
        Cells cells(row);
        const std::string stream = cells.text();
        warnings.push_back(fmt::format("{}: {} rows are missing", stream, cells.integer()));
      });
  return warnings;
}

bool is_scan_log(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, kApplicationIdOffset + 4> header{};
  in.read(header.data(), header.size());
  if (!in || std::memcmp(header.data(), "SQLite format 3", 16) != 0) return false;
  std::uint32_t id = 0;
  for (std::size_t i = kApplicationIdOffset; i < header.size(); ++i)
    id = id << 8 | static_cast<unsigned char>(header[i]);
  return id == static_cast<std::uint32_t>(kScanRecord.application_id);
}

}  // namespace trivela::evaluator::log
