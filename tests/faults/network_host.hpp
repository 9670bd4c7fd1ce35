#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace trivela::faults {

/// A computer of its own as far as the network goes: a network namespace with a loopback and one Ethernet interface
/// `tap0` (10.77.0.N/24), whose cable ends in our hands. It lives as long as the object and the processes in it.
class NetworkHost {
 public:
  /// `number`: 1..250, the last byte of address and MAC. Throws std::runtime_error naming the step that the kernel
  /// refuses.
  explicit NetworkHost(std::uint8_t number);
  NetworkHost(NetworkHost&& other) noexcept;
  NetworkHost& operator=(NetworkHost&&) = delete;
  ~NetworkHost();

  /// What stands in the way of hosts on this machine; empty: nothing.
  static std::string obstacle();

  /// Takes the interface's address away, and gives it back.
  void lose_address() const;
  void give_address() const;

  /// Takes the interface down, with its address, and up again.
  void lose_interface() const;
  void give_interface() const { give_address(); }

  /// The end of the cable: a read is a frame that the host sends, a write one that it receives. Does not block.
  int cable() const { return cable_; }

  /// For setns() of a process that shall run on this host.
  int network() const { return network_; }

 private:
  std::uint8_t number_ = 0;
  int cable_ = -1;
  int network_ = -1;
};

/// Does it on the host, in a thread of its own, to which a namespace belongs: sockets made there, and threads begun
/// there, stay on the host. Throws what it throws.
void on_host(const NetworkHost& host, const std::function<void()>& act);

}  // namespace trivela::faults
