#pragma once

#include <filesystem>
#include <string>

namespace trivela::pages {

/// Where the page is served: an IP address or a host's name, and a port; 0: any free one.
struct ListenAddress {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// "ADDRESS", "ADDRESS:PORT", "[IPV6]:PORT". Throws config::BadArgument naming a port that is none, and the
/// address as `called`.
ListenAddress parse_listen(const std::string& text, int default_port, const std::string& called = "address");

/// The Host header names this machine in a way that no outsider's name server can: by an IP address, as localhost, or
/// by `own_name`, alone or as own_name.local.
bool names_this_machine(const std::string& host_header, const std::string& own_name);

/// No Origin (not sent by a page of another site), or that of the page itself.
bool same_origin(const std::string& origin_header, const std::string& host_header);

/// 32 hexadecimal digits that nobody can guess. Throws std::runtime_error where the system gives no random numbers.
std::string draw_token();

/// The first line of a file that its owner alone may read. Throws config::BadArgument naming the file where it cannot
/// be read, others may read it, or the line is not of 16 to 128 letters, digits, '-' and '_'.
std::string token_of_file(const std::filesystem::path& file);

/// Compares in a time that does not tell how much of it is right.
bool same_token(const std::string& given, const std::string& token);

/// The value of a cookie in a Cookie header; empty: it has none of the name.
std::string cookie_of(const std::string& header, const std::string& name);

}  // namespace trivela::pages
