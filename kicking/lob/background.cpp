#include "kicking/lob/background.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "kicking/estimate.hpp"

namespace trivela::kicking::lob {
namespace {

/// A beam has a background when it had a return in so many of the scans; a stray return or two is none.
constexpr double kLeastReturns = 0.1;

std::uint32_t to_mm(double range_m) { return static_cast<std::uint32_t>(std::lround(1000.0 * range_m)); }

}  // namespace

Background::Background(const ScanGeometry& geometry, const AnalyzerConfig& config)
    : config_(config),
      beams_(geometry.beams),
      first_mm_(std::max(kFirstRange_mm, to_mm(geometry.min_range_m))),
      last_mm_(to_mm(geometry.max_range_m)),
      nearer_than_mm_(geometry.beams, 0) {
  if (config.background_scans == 0) throw std::invalid_argument("lob analyzer: background_scans = 0 must be positive");
  learned_mm_.reserve(config.background_scans * beams_);
}

bool Background::learn(const Scan& scan) {
  learned_mm_.insert(learned_mm_.end(), scan.range_mm.begin(), scan.range_mm.end());
  if (++scans_ < config_.background_scans) return false;
  range_m_.resize(beams_);
  for (std::size_t i = 0; i < beams_; ++i) settle_beam(i);
  return true;
}

void Background::settle_beam(std::size_t i) {
  auto& values = one_beam_mm_;
  values.clear();
  for (std::size_t scan = 0; scan < scans_; ++scan) {
    const std::uint32_t value = learned_mm_[scan * beams_ + i];
    if (is_return(value)) values.push_back(value);
  }
  const auto returns = static_cast<double>(values.size()), scans = static_cast<double>(scans_);
  range_m_[i] = -1.0;
  nearer_than_mm_[i] = last_mm_ + 1;
  if (values.empty() || returns < kLeastReturns * scans) return;
  const std::uint32_t middle_mm = upper_median(std::span(values));
  if (returns > 0.5 * scans) range_m_[i] = middle_mm / 1000.0;
  for (std::uint32_t& value : values) value = std::max(value, middle_mm) - std::min(value, middle_mm);
  const double margin_m =
      std::max(config_.foreground_margin_m, config_.foreground_mads * upper_median(std::span(values)) / 1000.0);
  nearer_than_mm_[i] = middle_mm - std::min(middle_mm, to_mm(margin_m));
}

void Background::forget() {
  learned_mm_.clear();
  scans_ = 0;
  range_m_.clear();
  std::fill(nearer_than_mm_.begin(), nearer_than_mm_.end(), 0);
}

}  // namespace trivela::kicking::lob
