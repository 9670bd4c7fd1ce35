#include "hal/scip/reply.hpp"

#include <array>

namespace trivela::hal::scip {
namespace {

struct Meaning {
  std::string_view status;
  std::string_view text;
};

constexpr std::array kOfAnyRequest{
    Meaning{"00", "done"},
    Meaning{"0A", "the scanner cannot make an answer"},
    Meaning{"0B", "the scanner's buffer is full, or the request was repeated"},
    Meaning{"0C", "the request has too few parameters"},
    Meaning{"0D", "the scanner does not know the request"},
    Meaning{"0E", "the scanner does not know the request"},
    Meaning{"0F", "the request has too few parameters"},
    Meaning{"0G", "the request's text has more than 16 characters"},
    Meaning{"0H", "the request's text has characters that are not allowed"},
    Meaning{"0I", "the scanner waits for new firmware"},
};
constexpr std::array kOfMeasuring{
    Meaning{"01", "the start step is no number"},         Meaning{"02", "the end step is no number"},
    Meaning{"03", "the cluster count is no number"},      Meaning{"04", "the end step is out of range"},
    Meaning{"05", "the end step is before the start"},    Meaning{"06", "the scan interval is no number"},
    Meaning{"07", "the number of scans is no number"},    Meaning{"10", "the laser is off"},
    Meaning{"98", "the laser works again after a check"}, Meaning{"99", "a scan"},
};
constexpr std::array kOfLaser{
    Meaning{"01", "the laser does not work"},
    Meaning{"02", "the laser was on already"},
};

template <class Table>
std::string_view find(const Table& table, std::string_view status) {
  for (const Meaning& row : table) {
    if (row.status == status) return row.text;
  }
  return {};
}

}  // namespace

std::string meaning(std::string_view request, std::string_view status) {
  std::string_view text;
  if (request.starts_with("MD") || request.starts_with("GD")) {
    text = find(kOfMeasuring, status);
    if (text.empty() && status >= "21" && status <= "49") text = "the scanner stopped to look into a fault";
    if (text.empty() && status >= "50" && status <= "97") text = "the scanner has a fault in its hardware";
  } else if (request.starts_with("BM")) {
    text = find(kOfLaser, status);
  }
  if (text.empty()) text = find(kOfAnyRequest, status);
  return text.empty() ? "status " + std::string{status} : std::string{text};
}

}  // namespace trivela::hal::scip
