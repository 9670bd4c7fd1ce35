#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace trivela::bus {

/// Where a participant lives: a DDS domain (0..100: above, its ports lie where Linux gives out ephemeral ones) and
/// Cyclone's configuration of it. An empty xml leaves the configuration to the environment (CYCLONEDDS_URI).
struct DomainConfig {
  std::uint32_t domain_id = 0;
  std::string xml;

  bool operator==(const DomainConfig&) const = default;
};

/// config/cyclonedds/loopback.xml as built in: this machine alone, and of it only those with the same domain and tag.
/// Ignores the environment. Throws Error if the id is outside 0..100 or the tag has other characters than
/// [A-Za-z0-9._-].
DomainConfig loopback(std::uint32_t domain_id, std::string_view tag);

/// The configuration in a Cyclone XML file. Throws Error if the id is outside 0..100 or the file cannot be read.
DomainConfig from_file(std::uint32_t domain_id, const std::filesystem::path& file);

/// The same for the node whose identity lies in the folder (security/key_folder.hpp): DDS Security by Cyclone's
/// plug-ins, which come with the library (Debian: libddsc0debian). Throws Error naming the file if one of the node's is
/// missing, if others than its owner may read the key, if identity and permissions authority are one certificate, or if
/// the configuration has a Security element already.
DomainConfig secured(DomainConfig config, const std::filesystem::path& robot_folder, std::string_view node);

}  // namespace trivela::bus
