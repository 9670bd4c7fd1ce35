#include "security/key_folder.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "security/rights.hpp"

namespace trivela::security {

void make_private_folder(const std::filesystem::path& folder) {
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST) return;
  throw std::system_error{errno, std::generic_category(), folder.string()};
}

void write_private_file(const std::filesystem::path& file, const std::string& text) {
  const std::string unfinished = file.string() + ".new";
  const int descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) throw std::system_error{errno, std::generic_category(), unfinished};
  const bool written = ::fchmod(descriptor, 0600) == 0 &&
                       ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  if (!written) throw std::system_error{reason, std::generic_category(), unfinished};
  std::filesystem::rename(unfinished, file);
}

std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost_B = 1 << 20;
  if (std::filesystem::exists(file) &&
      (!std::filesystem::is_regular_file(file) || std::filesystem::file_size(file) > kMost_B))
    throw std::runtime_error{fmt::format("{}: is no file of at most 1 MB: not read", file.string())};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error{fmt::format("{}: cannot be read", file.string())};
  return text.str();
}

namespace fs = std::filesystem;
namespace {

constexpr std::string_view kRobotPrefix = "robot_";
constexpr const char* kTeamAuthority = "identity_ca_team";
// Authorities outlive tournaments; what ends after a week is what they sign.
constexpr std::chrono::days kAuthorityLife{3650};

void write_authority(const fs::path& stem, std::string_view name, const Validity& validity) {
  const auto from = std::min(validity.from, days_from(this_second(), 0).from);
  const Key key = new_key();
  const Certificate certificate = new_authority(key, name, {from, from + kAuthorityLife});
  write_private_file(stem.string() + ".key", pem_of(key));
  write_private_file(stem.string() + ".pem", pem_of(certificate));
}

/// An authority as it lies in the folder.
struct Authority {
  explicit Authority(const fs::path& stem)
      : certificate(read_certificate(stem.string() + ".pem")), key(read_key(stem.string() + ".key")) {}
  Certificate certificate;
  Key key;
};

std::string identity_authority(std::uint32_t robot_id) { return fmt::format("identity_ca_{}", robot_id); }

}  // namespace

std::vector<std::string> usual_nodes(std::uint32_t robot_id) {
  std::vector<std::string> names;
  for (const Rights& rights : all_rights())
    if (robot_id == 0 ? rights.on_base : rights.on_robot) names.push_back(rights.node);
  return names;
}

fs::path KeyFolder::robot_folder(std::uint32_t robot_id) const {
  return folder_ / fmt::format("{}{}", kRobotPrefix, robot_id);
}

std::vector<std::uint32_t> KeyFolder::robots() const {
  std::vector<std::uint32_t> ids;
  if (!fs::exists(folder_)) return ids;
  for (const auto& entry : fs::directory_iterator{folder_}) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kRobotPrefix)) continue;
    std::uint32_t id = 0;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + kRobotPrefix.size(), end, id);
    if (read.ec == std::errc{} && read.ptr == end) ids.push_back(id);
  }
  std::ranges::sort(ids);
  return ids;
}

std::vector<std::string> KeyFolder::nodes(std::uint32_t robot_id) const {
  std::vector<std::string> names;
  if (!fs::exists(robot_folder(robot_id))) return names;
  for (const auto& entry : fs::directory_iterator{robot_folder(robot_id)})
    if (entry.path().extension() == ".key") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

void KeyFolder::init(const Validity& validity) const {
  if (fs::exists(authority() / "permissions_ca.key"))
    throw std::runtime_error{
        fmt::format("{}: has a permissions authority; its robots are added by issue, renewed by "
                    "renew",
                    folder_.string())};
  make_private_folder(folder_);
  make_private_folder(authority());
  write_authority(authority() / "permissions_ca", "Permissions CA", validity);
}

void KeyFolder::require_authority() const {
  if (!fs::exists(authority() / "permissions_ca.key"))
    throw std::runtime_error{
        fmt::format("{}: has no authority/permissions_ca.key; trivela keys init makes one", folder_.string())};
}

void KeyFolder::make_identity_authority(std::uint32_t robot_id, const Validity& validity) const {
  write_authority(authority() / identity_authority(robot_id), fmt::format("Identity CA of robot {}", robot_id),
                  validity);
}

void KeyFolder::make_team_authority(const Validity& validity) const {
  write_authority(authority() / kTeamAuthority, "Identity CA of the team's bus", validity);
}

void KeyFolder::issue(std::uint32_t robot_id, const std::vector<std::string>& nodes, const Validity& validity) const {
  require_authority();
  std::set<std::string> all(nodes.begin(), nodes.end());
  for (const std::string& node : this->nodes(robot_id)) all.insert(node);
  for (const std::string& node : all) rights_of(node);
  if (!fs::exists(authority() / (identity_authority(robot_id) + ".key"))) make_identity_authority(robot_id, validity);
  write_robot(robot_id, {all.begin(), all.end()}, validity);
}

void KeyFolder::renew(const Validity& validity) const {
  require_authority();
  for (const std::uint32_t robot_id : robots()) write_robot(robot_id, nodes(robot_id), validity);
}

void KeyFolder::revoke(std::uint32_t robot_id, const std::string& node, const Validity& validity) const {
  require_authority();
  std::vector<std::string> left = nodes(robot_id);
  if (std::erase(left, node) == 0)
    throw std::runtime_error{fmt::format("{}: has no identity of {}", robot_folder(robot_id).string(), node)};
  make_identity_authority(robot_id, validity);
  write_robot(robot_id, left, validity);
}

void KeyFolder::revoke_robot(std::uint32_t robot_id, const Validity& validity) const {
  require_authority();
  if (!fs::exists(robot_folder(robot_id)))
    throw std::runtime_error{fmt::format("{}: is not there", robot_folder(robot_id).string())};
  for (const char* ending : {".key", ".pem"}) fs::remove(authority() / (identity_authority(robot_id) + ending));
  fs::remove_all(robot_folder(robot_id));
  make_team_authority(validity);
  renew(validity);
}

namespace {

/// The folder of one bus: whom its nodes believe.
void write_bus(const fs::path& folder, Bus bus, const Authority& identity, const Authority& permissions) {
  if (same_public_key(identity.certificate, permissions.certificate))
    throw std::runtime_error{
        fmt::format("{}: identity and permissions authority are the same (CVE-2023-24011)", folder.string())};
  make_private_folder(folder);
  write_private_file(folder / "identity_ca.pem", pem_of(identity.certificate));
  write_private_file(folder / "permissions_ca.pem", pem_of(permissions.certificate));
  write_private_file(folder / "governance.p7s",
                     signed_document(governance_xml(bus), permissions.certificate, permissions.key));
}

void write_identity(const fs::path& folder, const Rights& rights, std::uint32_t robot_id, const Authority& identity,
                    const Authority& permissions, const Validity& validity) {
  const Key key = new_key();
  const Certificate certificate =
      new_identity(key, common_name(rights.node, robot_id), validity, identity.certificate, identity.key);
  write_private_file(folder / (rights.node + ".key"), pem_of(key));
  write_private_file(folder / (rights.node + ".pem"), pem_of(certificate));
  write_private_file(folder / (rights.node + ".p7s"), signed_document(permissions_xml(rights, robot_id, validity),
                                                                      permissions.certificate, permissions.key));
}

}  // namespace

void KeyFolder::write_robot(std::uint32_t robot_id, const std::vector<std::string>& nodes,
                            const Validity& validity) const {
  if (!fs::exists(authority() / fmt::format("{}.key", kTeamAuthority))) make_team_authority(validity);
  const Authority identity{authority() / identity_authority(robot_id)};
  const Authority of_team{authority() / kTeamAuthority};
  const Authority permissions{authority() / "permissions_ca"};
  const fs::path made = folder_ / fmt::format(".new_{}{}", kRobotPrefix, robot_id);
  fs::remove_all(made);
  write_bus(made, Bus::kRobot, identity, permissions);
  for (const std::string& node : nodes)
    write_identity(made, rights_of(node), robot_id, identity, permissions, validity);
  write_bus(made / "team", Bus::kTeam, of_team, permissions);
  write_identity(made / "team", rights_on_team_bus(robot_id), robot_id, of_team, permissions, validity);
  fs::remove_all(robot_folder(robot_id));
  fs::rename(made, robot_folder(robot_id));
}

}  // namespace trivela::security
