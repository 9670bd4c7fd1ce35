#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "config/robot.hpp"
#include "python/arrays.hpp"

namespace trivela::python {
namespace {

template <double kicking::SetPoint::*column>
py::array_t<double> set_points(const config::Robot& robot) {
  std::vector<double> values;
  for (const kicking::SetPoint& point : robot.model.table.set_points()) values.push_back(point.*column);
  return array_of(std::move(values));
}

}  // namespace

void add_robots(py::module_& module) {
  py::class_<config::Robot>(
      module, "Robot",
      "A robot's file, such as config/robots/cambada_1.toml. Raises ValueError naming file, line, key and value.")
      .def(py::init([](const std::filesystem::path& file) { return config::load_robot(file); }))
      .def_readonly("name", &config::Robot::name)
      .def_readonly("source", &config::Robot::source)
      .def_property_readonly("powers", set_points<&kicking::SetPoint::power>)
      .def_property_readonly("speeds_mps", set_points<&kicking::SetPoint::speed_mps>)
      .def_property_readonly("exit_angle_rad", [](const config::Robot& robot) { return robot.model.exit_angle_rad; })
      .def_property_readonly("delay_s", [](const config::Robot& robot) { return robot.model.delay_s; })
      .def_property_readonly("ball_offset_m", [](const config::Robot& robot) { return robot.model.ball_offset_m; });
}

}  // namespace trivela::python
