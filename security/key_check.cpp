#include "security/key_folder.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <exception>

#include "security/rights.hpp"

namespace trivela::security {
namespace fs = std::filesystem;
namespace {

using Faults = std::vector<std::string>;

void check_modes(const fs::path& folder, Faults& faults) {
  const auto check = [&](const fs::path& path) {
    const auto others = fs::perms::group_all | fs::perms::others_all;
    if ((fs::status(path).permissions() & others) != fs::perms::none)
      faults.push_back(
          fmt::format("{}: somebody else than its owner may read or change it: chmod go= it", path.string()));
  };
  check(folder);
  for (const auto& entry : fs::directory_iterator{folder}) check(entry.path());
}

void check_clock(const fs::path& file, const Validity& validity, std::chrono::sys_seconds now, Faults& faults) {
  if (validity.holds(now)) return;
  constexpr const char* kTime = "{:%Y-%m-%d %H:%M:%S}";
  faults.push_back(fmt::format("{}: holds from {} to {} UTC, and this machine's clock says {}", file.string(),
                               fmt::format(kTime, fmt::gmtime(validity.from)),
                               fmt::format(kTime, fmt::gmtime(validity.to)), fmt::format(kTime, fmt::gmtime(now))));
}

void check_document(const fs::path& file, const Certificate& authority, const std::string& expected, Faults& faults) {
  const auto text = verified_text(read_text(file), authority);
  if (!text) {
    faults.push_back(fmt::format("{}: is not signed by the permissions authority's own key", file.string()));
  } else if (*text != expected) {
    faults.push_back(
        fmt::format("{}: does not say what this version of Trivela writes: trivela keys renew", file.string()));
  }
}

/// The authorities of one robot.
struct Authorities {
  explicit Authorities(const fs::path& folder)
      : identity(read_certificate(folder / "identity_ca.pem")),
        permissions(read_certificate(folder / "permissions_ca.pem")) {}
  Certificate identity;
  Certificate permissions;
};

void check_node(const fs::path& folder, std::uint32_t robot_id, const Rights& rights, const Authorities& authorities,
                std::chrono::sys_seconds now, Faults& faults) {
  const std::string& node = rights.node;
  const fs::path file = folder / (node + ".pem");
  const Certificate certificate = read_certificate(file);
  if (!belongs(read_key(folder / (node + ".key")), certificate))
    faults.push_back(fmt::format("{}: is not of the key beside it", file.string()));
  if (!is_signed_by(certificate, authorities.identity))
    faults.push_back(fmt::format("{}: is not signed by the identity authority beside it", file.string()));
  const std::string subject = "O=Trivela,CN=" + common_name(node, robot_id);
  if (subject_of(certificate) != subject)
    faults.push_back(fmt::format("{}: is of {}, must be of {}", file.string(), subject_of(certificate), subject));
  const Validity validity = validity_of(certificate);
  check_clock(file, validity, now, faults);
  check_document(folder / (node + ".p7s"), authorities.permissions, permissions_xml(rights, robot_id, validity),
                 faults);
}

void check_authorities(const fs::path& folder, const Authorities& authorities, Bus bus, std::chrono::sys_seconds now,
                       Faults& faults) {
  if (same_public_key(authorities.identity, authorities.permissions))
    faults.push_back(
        fmt::format("{}: identity and permissions authority are the same: Cyclone 0.10.2 would take "
                    "permissions that any node signs for itself (CVE-2023-24011)",
                    folder.string()));
  check_clock(folder / "identity_ca.pem", validity_of(authorities.identity), now, faults);
  check_clock(folder / "permissions_ca.pem", validity_of(authorities.permissions), now, faults);
  check_document(folder / "governance.p7s", authorities.permissions, governance_xml(bus), faults);
}

/// Runs the check; what is missing or no PEM at all is a fault too.
void noting(Faults& faults, const auto& check) try { check(); } catch (const std::exception& error) {
  faults.emplace_back(error.what());
}

/// The keys of one bus: a robot's own, or the team's.
void check_bus(const fs::path& folder, Bus bus, std::uint32_t robot_id, const std::vector<Rights>& nodes,
               std::chrono::sys_seconds now, Faults& faults) {
  noting(faults, [&] {
    check_modes(folder, faults);
    const Authorities authorities{folder};
    check_authorities(folder, authorities, bus, now, faults);
    for (const Rights& rights : nodes)
      noting(faults, [&] { check_node(folder, robot_id, rights, authorities, now, faults); });
  });
}

}  // namespace

std::vector<std::string> faults_of(const KeyFolder& folder, std::chrono::sys_seconds now) {
  if (!fs::is_directory(folder.path())) return {fmt::format("{}: there is no such folder", folder.path().string())};
  Faults faults;
  const auto robots = folder.robots();
  if (const auto mode = fs::status(folder.path()).permissions();
      (mode & (fs::perms::group_write | fs::perms::others_write)) != fs::perms::none)
    faults.push_back(fmt::format("{}: somebody else than its owner may put other keys into it: chmod go-w it",
                                 folder.path().string()));
  if (robots.empty()) faults.push_back(fmt::format("{}: has no keys of a robot", folder.path().string()));
  for (const std::uint32_t robot_id : robots) {
    const fs::path of_robot = folder.robot_folder(robot_id);
    std::vector<Rights> of_nodes;
    for (const std::string& node : folder.nodes(robot_id)) noting(faults, [&] { of_nodes.push_back(rights_of(node)); });
    check_bus(of_robot, Bus::kRobot, robot_id, of_nodes, now, faults);
    check_bus(of_robot / "team", Bus::kTeam, robot_id, {rights_on_team_bus(robot_id)}, now, faults);
  }
  return faults;
}

}  // namespace trivela::security
