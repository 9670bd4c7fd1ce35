#include "tests/bench/chain/secured_chain.hpp"

#include <fmt/core.h>
#include <stdlib.h>

#include <regex>
#include <stdexcept>
#include <system_error>

#include "security/certificates.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"
#include "tests/bench/chain/domains.hpp"

namespace trivela::bench {
namespace {

namespace fs = std::filesystem;

std::string with_kind(const std::string& governance, const char* of, const char* kind) {
  const std::string element = fmt::format("{}_protection_kind", of);
  return std::regex_replace(governance, std::regex(fmt::format("<{}>[A-Z]+<", element)),
                            fmt::format("<{}>{}<", element, kind));
}

std::string governance_of(const Protection& protection) {
  const std::string usual = security::governance_xml(security::Bus::kRobot);
  return with_kind(with_kind(with_kind(usual, "rtps", protection.packet), "metadata", protection.parts), "data",
                   protection.payload);
}

}  // namespace

TemporaryKeys::TemporaryKeys() {
  std::string pattern = (fs::temp_directory_path() / "chain_bench_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder for keys");
  folder_ = pattern;
}

TemporaryKeys::~TemporaryKeys() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

DomainOf secured(int index, const fs::path& folder, const Protection* protection) {
  const security::KeyFolder keys{folder};
  const security::Validity today = security::days_from(security::this_second(), 1);
  keys.init(today);
  keys.issue(1, {"odometry", "world_state", "kick_decision", "kicker_driver"}, today);
  const fs::path robot = keys.robot_folder(1);
  if (protection != nullptr) {
    const fs::path authority = folder / "authority" / "permissions_ca";
    security::write_private_file(
        robot / "governance.p7s",
        security::signed_document(governance_of(*protection), security::read_certificate(authority.string() + ".pem"),
                                  security::read_key(authority.string() + ".key")));
  }
  return [config = own_domain(index), robot](const std::string& node) { return bus::secured(config, robot, node); };
}

}  // namespace trivela::bench
