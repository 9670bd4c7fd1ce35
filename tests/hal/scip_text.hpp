#pragma once

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulators/scip/emulated_scanner.hpp"

namespace trivela::tests {

/// A complete MD reply as a scanner sends it: 48 beams in three blocks of data.
inline std::string recorded_scan() {
  std::ifstream file(std::string(TRIVELA_SOURCE_DIR) + "/tests/vectors/scip_md_block.txt");
  std::string text{std::istreambuf_iterator<char>{file}, {}};
  if (text.size() < 100) throw std::runtime_error("tests/vectors/scip_md_block.txt: missing or short");
  return text;
}

/// The answers of a URG-04LX to VV and PP.
inline std::string urg_version() {
  using hal::scip::text_line;
  return hal::scip::plain_reply(
      "VV", "00",
      text_line("VEND", "Hokuyo Automatic Co.,Ltd.") + text_line("PROD", "SOKUIKI Sensor URG-04LX") +
          text_line("FIRM", "3.3.00(16/Apr./2008)") + text_line("PROT", "SCIP 2.0") + text_line("SERI", "H0508486"));
}

inline std::string urg_parameters(std::string_view dmax = "5600", std::string_view amax = "725") {
  using hal::scip::text_line;
  return hal::scip::plain_reply("PP", "00",
                                text_line("MODL", "URG-04LX(Hokuyo Automatic Co.,Ltd.)") + text_line("DMIN", "20") +
                                    text_line("DMAX", dmax) + text_line("ARES", "1024") + text_line("AMIN", "44") +
                                    text_line("AMAX", amax) + text_line("AFRT", "384") + text_line("SCAN", "600"));
}

}  // namespace trivela::tests
