#include "cli/import/row_writing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/text/installation.hpp"
#include "log/schema/digest.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::cli {

log::Session imported_session(const std::string& name, const std::vector<std::string>& sentences,
                              const std::string& source, std::int64_t realtime_offset_ns) {
  log::Session session;
  session.config_toml = fmt::format("{}{}\n\n{}", log::kImportMark, fmt::join(sentences, "\n"), source);
  const std::string sha256 = log::sha256(session.config_toml);
  session.uuid = fmt::format("{}-{}-8{}-8{}-{}", sha256.substr(0, 8), sha256.substr(8, 4), sha256.substr(12, 3),
                             sha256.substr(15, 3), sha256.substr(18, 12));
  session.realtime_offset_ns = realtime_offset_ns;
  session.software_version = config::software_version();
  session.scenario = name;
  session.idl = robot::idl_text();
  return session;
}

}  // namespace trivela::cli
