#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "log/file/log_file.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::log {
namespace {

constexpr std::size_t kApplicationIdOffset = 68;  // in the header of an SQLite file, big-endian

/// The session of a record; none: it holds no session.
std::optional<ScanSession> session_of(const LogFile& file) {
  using kicking::lob::LaserMount, kicking::lob::ScanGeometry, kicking::lob::ScannerIdentity;
  using S = ScanSession;
  using I = ScannerIdentity;
  using G = ScanGeometry;
  using M = LaserMount;
  std::vector<S> sessions =
      file.rows<S>("SELECT started_t_ns, realtime_offset_ns, simulated, source, software_version FROM sessions",
                   &S::started_t_ns, &S::realtime_offset_ns, &S::simulated, &S::source, &S::software_version);
  if (sessions.empty()) return std::nullopt;
  S& session = sessions.back();
  session.identity = file.rows<I>("SELECT vendor, product, serial, firmware, protocol FROM sessions", &I::vendor,
                                  &I::product, &I::serial, &I::firmware, &I::protocol)
                         .back();
  session.geometry = file.rows<G>(
                             "SELECT beams, first_angle_rad, step_rad, beam_period_s, scan_period_s, min_range_m, "
                             "max_range_m FROM sessions",
                             &G::beams, &G::first_angle_rad, &G::step_rad, &G::beam_period_s, &G::scan_period_s,
                             &G::min_range_m, &G::max_range_m)
                         .back();
  session.mount = file.rows<M>("SELECT laser_x_m, laser_z_m, front_elevation_rad, mirrored FROM sessions", &M::x_m,
                               &M::z_m, &M::front_elevation_rad, &M::mirrored)
                      .back();
  return session;
}

}  // namespace

struct ScanReader::Impl {
  struct Place {
    std::int64_t seq = 0;
    std::int64_t t_ns = 0;
  };

  explicit Impl(const std::filesystem::path& path) : file(path, kScanRecord) {
    auto found = session_of(file);
    if (!found) throw std::runtime_error(fmt::format("the scan record {} holds no session", file.path()));
    session = std::move(*found);
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
               [&](std::int64_t seq, std::int64_t t_ns) {
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
                    [&](const Blob& packed) { ranges = decode_ranges(packed); });
  const std::size_t beams = impl_->session.geometry.beams;
  if (!ranges || ranges->size() != beams) {
    throw std::runtime_error(fmt::format("the scan record {} is damaged: scan {} does not hold the ranges of {} beams",
                                         impl_->file.path(), place.seq, beams));
  }
  return {place.t_ns, std::move(*ranges)};
}

std::vector<TestedSetPoint> ScanReader::set_points() const {
  return impl_->file.rows<TestedSetPoint>("SELECT t_ns, nullif(power, 0.0), kick_id FROM set_points ORDER BY seq",
                                          &TestedSetPoint::t_ns, &TestedSetPoint::power, &TestedSetPoint::kick_id);
}

std::vector<Verdict> ScanReader::verdicts() const {
  return impl_->file.rows<Verdict>("SELECT launch_t_ns, accepted, why FROM verdicts ORDER BY seq",
                                   &Verdict::launch_t_ns, &Verdict::accepted, &Verdict::why);
}

std::vector<std::string> ScanReader::warnings() const {
  std::vector<std::string> warnings;
  impl_->file.query("SELECT uuid FROM sessions WHERE closed_t_ns IS NULL", [&](const std::string& uuid) {
    warnings.push_back(fmt::format("session {} was not closed: {}", uuid, impl_->file.not_closed()));
  });
  impl_->file.query(
      "SELECT stream, overflow + nan_refused + rejected AS missing FROM losses WHERE missing > 0 ORDER BY stream",
      [&](const std::string& stream, std::int64_t missing) {
        warnings.push_back(fmt::format("{}: {} rows are missing", stream, missing));
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

std::vector<std::uint8_t> encode_ranges(std::span<const std::uint32_t> range_mm) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * range_mm.size());
  std::uint32_t before = 0;
  for (const std::uint32_t range : range_mm) {
    const std::uint32_t difference = range - before;
    const bool negative = (difference >> 31) != 0;
    std::uint32_t zigzag = (difference << 1) ^ (negative ? ~std::uint32_t{0} : 0);
    for (; zigzag > 0x7F; zigzag >>= 7) bytes.push_back(static_cast<std::uint8_t>(zigzag | 0x80));
    bytes.push_back(static_cast<std::uint8_t>(zigzag));
    before = range;
  }
  return bytes;
}

std::optional<std::vector<std::uint32_t>> decode_ranges(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint32_t> range_mm;
  range_mm.reserve(bytes.size());
  std::uint32_t range = 0;
  std::uint64_t zigzag = 0;
  int shift = 0;
  for (const std::uint8_t byte : bytes) {
    if (shift > 28) return std::nullopt;
    zigzag |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    shift += 7;
    if ((byte & 0x80) != 0) continue;
    if (zigzag > 0xFFFFFFFF) return std::nullopt;
    const auto folded = static_cast<std::uint32_t>(zigzag);
    range += (folded >> 1) ^ ((folded & 1) != 0 ? ~std::uint32_t{0} : 0);
    range_mm.push_back(range);
    zigzag = 0;
    shift = 0;
  }
  if (shift != 0) return std::nullopt;
  return range_mm;
}

}  // namespace trivela::log
