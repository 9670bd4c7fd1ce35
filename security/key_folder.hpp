#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "security/certificates.hpp"

namespace trivela::security {

/// Makes a folder 0700, and those above it; leaves one alone that is there.
void make_private_folder(const std::filesystem::path& folder);

/// Writes a file 0600, whole or not at all. Throws std::system_error naming it.
void write_private_file(const std::filesystem::path& file, const std::string& text);

/// Throws std::runtime_error naming a file that cannot be read.
std::string read_text(const std::filesystem::path& file);

/// A team's keys, a folder that its owner alone may read:
///
///     authority/   permissions_ca.{pem,key}, identity_ca_N.{pem,key}, identity_ca_team.{pem,key}: never leaves the
///                  team's own machine
///     robot_N/     all that is copied to robot N: identity_ca.pem, permissions_ca.pem, governance.p7s,
///                  and NODE.pem, NODE.key, NODE.p7s of each node; robot_0 is the base's
///     robot_N/team the same for the bus between the machines, with team_bus.{pem,key,p7s} alone
///
/// Each robot has an identity authority of its own: a node of another robot is unknown there, whatever it may do at
/// home. On the team's bus all have one authority in common, which nobody asks anywhere else. Every function writes a
/// robot's folder again beside the old one and then puts it in its place; throws std::runtime_error,
/// std::invalid_argument (a kind of node that is none) or std::filesystem::filesystem_error.
class KeyFolder {
 public:
  explicit KeyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Makes the permissions authority, which holds for what begins then or later. Refuses a folder that has one.
  void init(const Validity& validity) const;

  /// Makes an identity for these nodes of the robot, beside those that it has; makes the robot's authority where there
  /// is none. Nodes that have one get another.
  void issue(std::uint32_t robot_id, const std::vector<std::string>& nodes, const Validity& validity) const;

  /// New keys, certificates and permissions for all that there are, under the same authorities.
  void renew(const Validity& validity) const;

  /// Another identity authority for the robot, and under it all of its nodes but `node`: what was signed before counts
  /// no more on this robot once its folder has been copied there.
  void revoke(std::uint32_t robot_id, const std::string& node, const Validity& validity) const;

  /// Forgets the robot, and gives all others another authority of the team's bus, which it was known by: their folders
  /// have to be copied. On their own buses none ever trusted it.
  void revoke_robot(std::uint32_t robot_id, const Validity& validity) const;

  std::vector<std::uint32_t> robots() const;
  /// Nodes of a robot that have an identity, sorted.
  std::vector<std::string> nodes(std::uint32_t robot_id) const;
  std::filesystem::path robot_folder(std::uint32_t robot_id) const;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path authority() const { return folder_ / "authority"; }
  void make_identity_authority(std::uint32_t robot_id, const Validity& validity) const;
  void require_authority() const;
  void make_team_authority(const Validity& validity) const;
  void write_robot(std::uint32_t robot_id, const std::vector<std::string>& nodes, const Validity& validity) const;

  std::filesystem::path folder_;
};

/// What a robot has by default: every kind of node but those that stand in for the world; the base (robot 0) those that
/// run there.
std::vector<std::string> usual_nodes(std::uint32_t robot_id);

/// What is wrong with the keys of every robot in the folder at that time, a sentence each; empty: nothing. Looks at
/// modes, owners of keys, chains, subjects, validity, signatures, authorities that are one, and whether permissions say
/// what the nodes' graph does. Needs no authority/: it works on a robot as it does at home.
std::vector<std::string> faults_of(const KeyFolder& folder, std::chrono::sys_seconds now);

}  // namespace trivela::security
