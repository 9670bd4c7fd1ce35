#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace trivela::pages {

/// Asks for the events and never reads them.
class StalledViewer {
 public:
  explicit StalledViewer(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    const std::string request = "GET /api/events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
    const int small = 4096;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
                 ::send(socket_, request.data(), request.size(), 0) == static_cast<ssize_t>(request.size());
  }
  StalledViewer(const StalledViewer&) = delete;
  StalledViewer& operator=(const StalledViewer&) = delete;
  ~StalledViewer() { ::close(socket_); }
  bool connected() const { return connected_; }

 private:
  int socket_;
  bool connected_ = false;
};

}  // namespace trivela::pages
