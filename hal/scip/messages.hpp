#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/scip/reply.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// Requests without parameters. Each ends with a line feed on the line.
inline constexpr std::string_view kScip20 = "SCIP2.0";
inline constexpr std::string_view kVV = "VV";
inline constexpr std::string_view kPP = "PP";
inline constexpr std::string_view kII = "II";
inline constexpr std::string_view kBM = "BM";
inline constexpr std::string_view kQT = "QT";  ///< stop measuring, laser off
inline constexpr std::string_view kRS = "RS";  ///< as kQT; settings and clock as after switching on

/// Which steps of a revolution are asked for, both ends included, 0..9999. `cluster` neighbours, 0..99, become one
/// value, the nearest; 0 is 1.
struct Section {
  int first_step = 0;
  int last_step = 0;
  int cluster = 1;
};

std::size_t beams(const Section& section);

/// MD: scans as they are measured, `scans` of them, 0..99, with 0 for no end; after each, `skipped` are left out, 0..9.
std::string measure_request(const Section& section, int skipped = 0, int scans = 0);
/// GD: the latest scan. The laser must be on.
std::string get_request(const Section& section);
/// The characters of an MD's echo that stay the same in all its replies; the rest counts the scans that remain.
inline constexpr std::size_t kMeasureEchoStays = 13;

/// The answer to PP.
struct Parameters {
  std::string model;
  int min_range_mm = 0;    ///< DMIN
  int max_range_mm = 0;    ///< DMAX
  int steps_per_turn = 0;  ///< ARES
  int first_step = 0;      ///< AMIN
  int last_step = 0;       ///< AMAX
  int front_step = 0;      ///< AFRT
  int speed_rpm = 0;       ///< SCAN
};

/// The answer to II, as far as somebody reads it.
struct State {
  bool laser_on = false;    ///< LASR
  std::string measurement;  ///< MESM
  std::string condition;    ///< STAT
};

/// None: not the answer to VV, or it does not say who the scanner is.
std::optional<kicking::lob::ScannerIdentity> identity_of(const Reply& reply);

/// None: not the answer to PP, an entry is missing, is no number, or of no scanner: 0 <= AMIN <= AMAX <= 9999, no more
/// than one turn, AFRT 0..9999, 0 <= DMIN < DMAX, SCAN 300..60000.
std::optional<Parameters> parameters_of(const Reply& reply);

/// None: not the answer to II.
std::optional<State> state_of(const Reply& reply);

/// The ranges of an MD or GD reply in millimetres, values below kicking::lob::kFirstRange_mm as they are. None: there
/// are not `beams` values.
std::optional<std::vector<std::uint32_t>> ranges_of(const Reply& reply, std::size_t beams);

/// All steps that the scanner measures.
Section whole_section(const Parameters& parameters);

/// How its scans look when whole_section() is asked for.
kicking::lob::ScanGeometry geometry_of(const Parameters& parameters);

}  // namespace trivela::hal::scip
