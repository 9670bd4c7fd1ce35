#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bus/census.hpp"
#include "bus/domain/participant.hpp"
#include "monitor/bus_picture.hpp"
#include "monitor/subscriber.hpp"

namespace trivela::cli {

/// Listens to every topic of the IDL and writes none; its readers look on (bus::ReaderOptions::observer).
class Listening {
 public:
  /// Joins the domain. Throws bus::Error.
  Listening(const bus::DomainConfig& domain, std::optional<std::uint8_t> only);
  ~Listening();

  /// The bus as it is now.
  monitor::BusPicture look();

 private:
  void receive(const std::string& topic, std::uint8_t robot_id, const monitor::ReceivedSample& received_sample);

  bus::Participant participant_;
  bus::CensusTaker census_;
  std::mutex mutex_;  // of the board: samples come on the bus's threads
  monitor::BusSnapshot board_;
  std::vector<std::unique_ptr<monitor::PassiveSubscriber>> subscribers_;
};

/// The bus as tables: topics, then processes. What nobody writes and nobody said is left out but for a line that names
/// it.
std::string top_table(const monitor::BusPicture& picture);

/// The whole picture as one line of JSON; a number that is not known is null.
std::string top_json(const monitor::BusPicture& picture, unsigned domain_id);

}  // namespace trivela::cli
