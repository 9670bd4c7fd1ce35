// Any bytes as a CSV file of kicks that somebody labelled: labels within their ranges, or a refusal that names the
// file. Read again out of its own text it says the same.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cli/import/kick_labels.hpp"
#include "tests/fuzz/script.hpp"

namespace {

using namespace trivela;
using trivela::tests::require;

constexpr double kLongestVideo_s = 86'400.0;

cli::KickLabels labels_of(const std::string& text) {
  std::istringstream in(text);
  return cli::read_kick_labels(in, "x.csv");
}

void check(const cli::KickLabels& labels, const std::string& text) {
  require(labels.file == "x.csv" && labels.text == text && !labels.kicks.empty());
  for (const cli::KickLabel& kick : labels.kicks) {
    require(!kick.time_s || (*kick.time_s >= 0.0 && *kick.time_s <= kLongestVideo_s));
    require(kick.half >= 1 && kick.half <= 4 && kick.robot_id >= 0 && kick.robot_id <= 255 && !kick.by.empty());
    require(!(kick.outside && kick.outcome == msg::OUTCOME_ON_TARGET));
  }
  require(!labels.labellers().empty() && labels.timed() <= static_cast<std::int64_t>(labels.kicks.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  try {
    const cli::KickLabels labels = labels_of(text);
    check(labels, text);
    require(labels_of(labels.text).kicks.size() == labels.kicks.size());
  } catch (const std::runtime_error& refused) {
    require(std::string_view(refused.what()).starts_with("x.csv"));
  }
  return 0;
}
