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

}  // namespace trivela::bus
