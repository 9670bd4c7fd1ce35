#pragma once

#include <cstddef>
#include <istream>
#include <stdexcept>
#include <string>

namespace trivela::kicking {

/// What a file may hold that is read as a whole.
inline constexpr std::size_t kMostBytesOfText = 64 << 20;

/// All that comes from `in`, which is called `name`. Throws std::runtime_error where it is more than `most_bytes`, as
/// of a device that never ends.
inline std::string read_text(std::istream& in, const std::string& name, std::size_t most_bytes = kMostBytesOfText) {
  constexpr std::size_t kPiece_B = 1 << 16;
  std::string text, piece(kPiece_B, '\0');
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0) {
    text.append(piece, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes)
      throw std::runtime_error{name + ": more than " + std::to_string(most_bytes >> 20) + " MB: not read"};
  }
  return text;
}

/// As std::getline, but a line of more than `most_bytes` is an error: throws std::runtime_error naming `name` and
/// `line`, its number from 1.
inline bool get_line(std::istream& in, std::string& text, const std::string& name, std::size_t line,
                     std::size_t most_bytes = 1 << 20) {
  text.clear();
  if (in.peek() == std::istream::traits_type::eof()) {
    in.setstate(std::ios::eofbit | std::ios::failbit);
    return false;
  }
  std::streambuf& buffer = *in.rdbuf();
  for (int c = buffer.sbumpc(); c != std::istream::traits_type::eof() && c != '\n'; c = buffer.sbumpc()) {
    if (text.size() == most_bytes)
      throw std::runtime_error{name + ":" + std::to_string(line) + ": a line of more than " +
                               std::to_string(most_bytes >> 20) + " MB: not read"};
    text += static_cast<char>(c);
  }
  return true;
}

}  // namespace trivela::kicking
