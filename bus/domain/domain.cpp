#include "bus/domain/domain.hpp"

#include <fmt/core.h>

#include <fstream>
#include <sstream>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/loopback_xml.hpp"

namespace trivela::bus {
namespace {

constexpr std::uint32_t kMaxDomainId = 100;

void check_domain_id(std::uint32_t domain_id) {
  if (domain_id > kMaxDomainId)
    throw Error("domain", fmt::format("domain id {}", domain_id), fmt::format("must be 0..{}", kMaxDomainId));
}

}  // namespace

DomainConfig loopback(std::uint32_t domain_id, std::string_view tag) {
  check_domain_id(domain_id);
  constexpr std::string_view kAllowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  if (tag.empty() || tag.find_first_not_of(kAllowed) != std::string_view::npos)
    throw Error("domain", fmt::format("tag \"{}\"", tag), "must be one or more of A-Z a-z 0-9 . _ -");
  constexpr std::string_view kPlaceholder = "${TRIVELA_TAG:-trivela}";
  static_assert(kLoopbackXml.find(kPlaceholder) != std::string_view::npos);
  std::string xml(kLoopbackXml);
  xml.replace(xml.find(kPlaceholder), kPlaceholder.size(), tag);
  return {domain_id, std::move(xml)};
}

DomainConfig from_file(std::uint32_t domain_id, const std::filesystem::path& file) {
  check_domain_id(domain_id);
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().empty()) throw Error("domain", file.string(), "cannot be read, or is empty");
  return {domain_id, text.str()};
}

namespace {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().empty())
    throw Error("security", file.string(), "cannot be read, or is empty: trivela keys issue makes it");
  return text.str();
}

/// Cyclone expands ${...} and its XML has no escapes for what a name of a file may hold.
void check_name(const fs::path& file) {
  if (file.string().find_first_of("$<>&\"'") != std::string::npos)
    throw Error("security", file.string(), "must be a name without $ < > & \" '");
}

void check_owner(const fs::path& key) {
  const auto others = fs::perms::group_all | fs::perms::others_all;
  if ((fs::status(key).permissions() & others) != fs::perms::none)
    throw Error("security", key.string(), "somebody else than its owner may read it: chmod 600");
}

std::string plugin(std::string_view name, std::string_view function) {
  return fmt::format(R"(<Library path="dds_security_{}" initFunction="init_{}" finalizeFunction="finalize_{}"/>)", name,
                     function, function);
}

}  // namespace

DomainConfig secured(DomainConfig config, const fs::path& robot_folder, std::string_view node) {
  const fs::path folder = fs::absolute(robot_folder);
  const auto file = [&](const std::string& name) { return folder / name; };
  const std::string own(node);
  check_name(folder);
  for (const std::string& name : {own + ".pem", own + ".p7s", std::string("governance.p7s")}) text_of_file(file(name));
  check_owner(file(own + ".key"));
  text_of_file(file(own + ".key"));
  if (text_of_file(file("identity_ca.pem")) == text_of_file(file("permissions_ca.pem")))
    throw Error("security", folder.string(),
                "identity and permissions authority are the same certificate: any node could sign permissions for "
                "itself (CVE-2023-24011)");
  const auto end = config.xml.rfind("</Domain>");
  if (end == std::string::npos || config.xml.find("<Security>") != std::string::npos)
    throw Error("security", "configuration of Cyclone", "must have a Domain without Security of its own");
  config.xml.insert(
      end, fmt::format("<Security><Authentication>{}<IdentityCA>file:{}</IdentityCA>"
                       "<IdentityCertificate>file:{}</IdentityCertificate><PrivateKey>file:{}</PrivateKey>"
                       "</Authentication><AccessControl>{}<PermissionsCA>file:{}</PermissionsCA>"
                       "<Governance>file:{}</Governance><Permissions>file:{}</Permissions></AccessControl>"
                       "<Cryptographic>{}</Cryptographic></Security>",
                       plugin("auth", "authentication"), file("identity_ca.pem").string(), file(own + ".pem").string(),
                       file(own + ".key").string(), plugin("ac", "access_control"), file("permissions_ca.pem").string(),
                       file("governance.p7s").string(), file(own + ".p7s").string(), plugin("crypto", "crypto")));
  return config;
}

}  // namespace trivela::bus
