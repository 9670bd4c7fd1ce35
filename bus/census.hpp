#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/participant.hpp"
#include "bus/waitset.hpp"

namespace trivela::bus {

/// A process that is a member of the domain, as it told the others; what it did not tell is empty or 0.
struct Member {
  std::string host;
  std::string process;  ///< name of its program
  std::int64_t pid = 0;
  std::string addresses;  ///< where it is heard, e.g. "udp/10.0.0.3:7410@2"

  bool operator==(const Member&) const = default;
};

/// A writer or reader of a topic.
struct End {
  std::string topic;
  std::string owner;          ///< WriterOptions::owner of a writer
  std::int32_t strength = 0;  ///< of a writer; counts for order topics
  bool observer = false;      ///< a reader that merely looks on
  Member member;

  bool operator==(const End&) const = default;
};

/// Who is in the domain. Who is killed is forgotten as late as its lease ends (10 s unless configured otherwise).
struct Census {
  std::vector<Member> members;
  std::vector<End> writers;
  std::vector<End> readers;
};

/// Keeps the census of a participant's domain out of what discovery says anyway: nothing is sent for it. For one thread
/// at a time.
class CensusTaker {
 public:
  /// Throws Error if Cyclone refuses.
  explicit CensusTaker(const Participant& participant);

  /// Everybody who is known now but this participant itself, ordered by topic and owner.
  Census take();

  /// Waits until discovery has news that take() has not seen; false if the timeout came first.
  bool wait(std::chrono::nanoseconds timeout);

 private:
  struct Found {
    End end;
    std::string member;  // its key
  };
  using Handles = std::map<std::uint64_t, Found>;  // by Cyclone's instance

  void take_members();
  static void take_ends(std::int32_t reader, bool writers, Handles& ends);
  std::vector<End> ends_of(const Handles& ends) const;

  struct KnownMember {
    std::string key;
    Member member;
  };
  Participant participant_;
  std::string own_key_;
  Entity participants_;
  Entity publications_;
  Entity subscriptions_;
  std::vector<Entity> conditions_;
  Waitset waitset_;
  std::map<std::uint64_t, KnownMember> members_;
  Handles writers_;
  Handles readers_;
};

}  // namespace trivela::bus
