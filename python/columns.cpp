#include "python/columns.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace trivela::python {

void Column::add_cell(std::int64_t whole, double number, std::int32_t place, bool missing) {
  whole_.push_back(whole);
  numbers_.push_back(number);
  places_.push_back(place);
  missing_.push_back(missing);
}

void Column::add(std::nullopt_t) { add_cell(0, kNone, 0, true); }

void Column::add_whole(std::int64_t whole) {
  has_whole_ = true;
  add_cell(whole, static_cast<double>(whole), 0, false);
}

void Column::add(bool truth) {
  has_truths_ = true;
  add_cell(truth, truth, 0, false);
}

void Column::add(double number) {
  has_numbers_ = true;
  add_cell(0, number, 0, false);
}

void Column::add(std::string_view text) {
  auto place = texts_.find(text);
  if (place == texts_.end()) {
    in_order_.emplace_back(text);
    place = texts_.emplace(std::string(text), static_cast<std::int32_t>(in_order_.size())).first;
  }
  add_cell(0, kNone, place->second, false);
}

void Column::add(const log::Value& cell) {
  if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return add_whole(*whole);
  if (const auto* const number = std::get_if<double>(&cell)) return add(*number);
  if (const auto* const text = std::get_if<std::string>(&cell)) return add(std::string_view(*text));
  if (const auto* const bytes = std::get_if<log::Blob>(&cell)) {
    std::string digits;
    for (const auto byte : *bytes) digits += fmt::format("{:02x}", byte);
    return add(std::string_view(digits));
  }
  add(std::nullopt);
}

py::tuple Column::arrays() {
  const py::array missing = array_of_truths(std::move(missing_));
  if (!in_order_.empty()) {
    py::list texts;
    texts.append(py::none());
    for (const std::string& text : in_order_)
      texts.append(py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace")));
    return py::make_tuple("text", array_of(std::move(places_)), texts);
  }
  if (has_numbers_) return py::make_tuple("number", array_of(std::move(numbers_)), missing);
  if (has_whole_) return py::make_tuple("whole", array_of(std::move(whole_)), missing);
  if (has_truths_) return py::make_tuple("truth", array_of(std::move(whole_)), missing);
  return py::make_tuple("none", missing, missing);
}

py::dict Columns::arrays() {
  py::dict arrays;
  for (std::size_t i = 0; i < names_.size(); ++i) arrays[names_[i].c_str()] = columns_[i].arrays();
  return arrays;
}

}  // namespace trivela::python
