#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <numbers>
#include <optional>

#include "config/robot.hpp"
#include "kicking/alignment/alignment.hpp"
#include "kicking/alignment/release_predictor.hpp"
#include "kicking/ballistics/flight.hpp"
#include "kicking/ballistics/moving_kick.hpp"
#include "python/checks.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::python {
namespace {

/// A robot and where it was read, so that another process can read it again.
struct FileRobot : config::Robot {
  explicit FileRobot(const std::filesystem::path& path)
      : config::Robot(config::load_robot(path)), file(std::filesystem::absolute(path)) {}

  std::filesystem::path file;
};

template <double kicking::SetPoint::*column>
py::array_t<double> set_points(const FileRobot& robot) {
  std::vector<double> values;
  for (const kicking::SetPoint& point : robot.model.table.set_points()) values.push_back(point.*column);
  return array_of(std::move(values));
}

}  // namespace

void add_robots(py::module_& module) {
  py::class_<FileRobot>(
      module, "Robot",
      "A robot's file, such as config/robots/cambada_1.toml. Raises ValueError naming file, line, key and value.\n"
      "A pickle of it has the file's path, which is read again.")
      .def(py::init<const std::filesystem::path&>())
      .def(py::pickle([](const FileRobot& robot) { return robot.file; },
                      [](const std::filesystem::path& file) { return FileRobot(file); }))
      .def_readonly("name", &FileRobot::name)
      .def_readonly("source", &FileRobot::source)
      .def_property_readonly("powers", set_points<&kicking::SetPoint::power>)
      .def_property_readonly("speeds_mps", set_points<&kicking::SetPoint::speed_mps>)
      .def_property_readonly("exit_angle_rad", [](const FileRobot& robot) { return robot.model.exit_angle_rad; })
      .def_property_readonly("delay_s", [](const FileRobot& robot) { return robot.model.delay_s; })
      .def_property_readonly("ball_offset_m", [](const FileRobot& robot) { return robot.model.ball_offset_m; });
}

namespace {

using Numbers = Flat<double>;

struct Flight {
  Flight(double gravity, double ball_radius, double ball_mass, double air_density)
      : gravity_mps2(gravity), ball_radius_m(ball_radius), ball_mass_kg(ball_mass), air_density_kgpm3(air_density) {
    require_within("gravity_mps2", gravity_mps2, range_of<sim::BallPhysics>("gravity_mps2"));
    require_ball_radius(ball_radius_m);
    require_within("ball_mass_kg", ball_mass_kg, range_of<sim::BallPhysics>("mass_kg"));
    require_within("air_density_kgpm3", air_density_kgpm3, range_of<sim::BallPhysics>("air_density_kgpm3"));
  }

  double gravity_mps2, ball_radius_m, ball_mass_kg, air_density_kgpm3;

  kicking::Ball ball() const { return {.mass_kg = ball_mass_kg, .radius_m = ball_radius_m}; }
};

void require_all_finite(std::initializer_list<std::pair<const char*, std::span<const double>>> arguments) {
  for (const auto& argument : arguments) require_finite(argument.first, argument.second);
}

void require_acute(const char* name, std::span<const double> angles_rad) {
  require(name, angles_rad, "is not between 0 and pi / 2",
          [](double angle_rad) { return angle_rad > 0.0 && angle_rad < 0.5 * std::numbers::pi; });
}

/// Columns of solve(), of so many kicks.
struct Solutions {
  explicit Solutions(std::size_t kicks)
      : v0_mps(kicks, kNone),
        exact_mps(kicks, kNone),
        paper_mps(kicks, kNone),
        drag_mps(kicks, kNone),
        power(kicks, kNone),
        feasible(kicks),
        descending(kicks),
        range(kicks, -1) {}

  void set(std::size_t i, const kicking::KickSpeeds& speeds) {
    v0_mps[i] = speeds.v0_mps.to_message();
    exact_mps[i] = speeds.vk_exact_mps.to_message();
    paper_mps[i] = speeds.vk_paper_mps.to_message();
    feasible[i] = speeds.v0_mps.has_value();
    descending[i] = speeds.descending;
  }

  void set_power(std::size_t i, const kicking::PowerReading& reading) {
    power[i] = reading.power;
    range[i] = static_cast<std::int8_t>(reading.range);
  }

  py::dict arrays(bool with_drag, bool with_power) {
    py::dict columns;
    columns["v0_mps"] = array_of(std::move(v0_mps));
    columns["vk_exact_mps"] = array_of(std::move(exact_mps));
    columns["vk_paper_mps"] = array_of(std::move(paper_mps));
    columns["feasible"] = array_of_truths(std::move(feasible));
    columns["descending"] = array_of_truths(std::move(descending));
    if (with_drag) columns["v0_drag_mps"] = array_of(std::move(drag_mps));
    if (with_power) columns["power"] = array_of(std::move(power));
    if (with_power) columns["power_range"] = array_of(std::move(range));
    return columns;
  }

  std::vector<double> v0_mps, exact_mps, paper_mps, drag_mps, power;
  std::vector<std::uint8_t> feasible, descending;
  std::vector<std::int8_t> range;
};

py::dict solve(const Numbers& distance_m, const Numbers& height_m, const Numbers& exit_angle_rad,
               const Numbers& v_front_mps, const Numbers& transfer, const std::optional<Numbers>& drag_coefficient,
               const std::optional<FileRobot>& robot, const Flight& flight) {
  const auto d = span_of(distance_m), h = span_of(height_m), angle = span_of(exit_angle_rad), v = span_of(v_front_mps),
             k = span_of(transfer), drag = drag_coefficient ? span_of(*drag_coefficient) : std::span<const double>();
  require_positive("distance_m", d);
  require_all_finite({{"height_m", h}, {"v_front_mps", v}});
  require_acute("exit_angle_rad", angle);
  require_up_to("transfer", k, 10.0);
  require_up_to("drag_coefficient", drag, 10.0);
  Solutions solutions(d.size());
  {
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const kicking::WantedKick wanted{{d[i], h[i]}, angle[i], v[i], k[i], flight.gravity_mps2};
      const kicking::KickSpeeds speeds = kicking::kick_speeds(wanted);
      solutions.set(i, speeds);
      if (!drag.empty()) {
        const double per_m = kicking::drag_per_m(flight.ball(), {flight.air_density_kgpm3, drag[i]});
        solutions.drag_mps[i] =
            kicking::crossing_speed_with_drag(wanted.point, angle[i], per_m, flight.gravity_mps2).to_message();
      }
      if (robot && speeds.vk_exact_mps) solutions.set_power(i, robot->model.table.power_for(*speeds.vk_exact_mps));
    }
  }
  return solutions.arrays(drag_coefficient.has_value(), robot.has_value());
}

py::dict align(const Numbers& x_m, const Numbers& y_m, const Numbers& heading_rad, const Numbers& alpha_rad,
               const Numbers& target_x_m, const Numbers& target_y_m, const Numbers& beta_rad,
               const Numbers& omega_radps, bool add) {
  const auto x = span_of(x_m), y = span_of(y_m), heading = span_of(heading_rad), alpha = span_of(alpha_rad),
             tx = span_of(target_x_m), ty = span_of(target_y_m), beta = span_of(beta_rad), omega = span_of(omega_radps);
  const auto within_turn = [](double turns) {
    return [most = turns * std::numbers::pi](double angle_rad) { return std::abs(angle_rad) <= most; };
  };
  require_all_finite({{"x_m", x},
                      {"y_m", y},
                      {"heading_rad", heading},
                      {"target_x_m", tx},
                      {"target_y_m", ty},
                      {"omega_radps", omega}});
  require("alpha_rad", alpha, "is not from -pi to pi", within_turn(1.0));
  require("beta_rad", beta, "is not from -2 pi to 2 pi", within_turn(2.0));
  std::vector<double> distance(x.size()), offset(x.size()), left(x.size()), right(x.size());
  std::vector<std::uint8_t> aligned(x.size());
  {
    const py::gil_scoped_release others;
    kicking::AlignmentRule rule;
    rule.extension = add ? kicking::Extension::kAdd : kicking::Extension::kMax;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const kicking::Alignment result =
          kicking::align({x[i], y[i], heading[i]}, alpha[i], beta[i], omega[i], {tx[i], ty[i]}, rule);
      distance[i] = result.centre_distance_m;
      offset[i] = result.offset_right_m.to_message();
      left[i] = result.left_m;
      right[i] = result.right_m;
      aligned[i] = result.aligned;
    }
  }
  py::dict columns;
  columns["distance_m"] = array_of(std::move(distance));
  columns["offset_right_m"] = array_of(std::move(offset));
  columns["left_m"] = array_of(std::move(left));
  columns["right_m"] = array_of(std::move(right));
  columns["aligned"] = array_of_truths(std::move(aligned));
  return columns;
}

py::dict predict(const Numbers& x_m, const Numbers& y_m, const Numbers& heading_rad, const Numbers& vx_mps,
                 const Numbers& vy_mps, const Numbers& omega_radps, const Numbers& v_kick_mps,
                 const Numbers& exit_angle_rad, const Numbers& transfer, const Numbers& delay_s,
                 const Numbers& ball_offset_m, const Numbers& goal_y_m, const Flight& flight) {
  const auto x = span_of(x_m), y = span_of(y_m), heading = span_of(heading_rad), vx = span_of(vx_mps),
             vy = span_of(vy_mps), omega = span_of(omega_radps), speed = span_of(v_kick_mps),
             angle = span_of(exit_angle_rad), k = span_of(transfer), delay = span_of(delay_s),
             offset = span_of(ball_offset_m), goal = span_of(goal_y_m);
  require_all_finite({{"x_m", x},
                      {"y_m", y},
                      {"heading_rad", heading},
                      {"vx_mps", vx},
                      {"vy_mps", vy},
                      {"omega_radps", omega},
                      {"goal_y_m", goal}});
  require_positive("v_kick_mps", speed);
  require_acute("exit_angle_rad", angle);
  require_up_to("transfer", k, 10.0);
  require_up_to("delay_s", delay, 10.0);
  require_up_to("ball_offset_m", offset, 10.0);
  std::vector<double> x_cross(x.size(), kNone), z_cross(x.size(), kNone), t_flight(x.size(), kNone);
  {
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const kicking::KickAction kick{speed[i], angle[i], {k[i], k[i], k[i]}, delay[i], offset[i]};
      const auto crossing = kicking::predict_crossing({x[i], y[i], heading[i]}, {vx[i], vy[i], omega[i]}, kick, goal[i],
                                                      flight.ball_radius_m, flight.gravity_mps2);
      if (!crossing) continue;
      x_cross[i] = crossing->x_m;
      z_cross[i] = crossing->z_m;
      t_flight[i] = crossing->t_flight_s;
    }
  }
  py::dict columns;
  columns["x_cross_m"] = array_of(std::move(x_cross));
  columns["z_cross_m"] = array_of(std::move(z_cross));
  columns["t_flight_s"] = array_of(std::move(t_flight));
  return columns;
}

}  // namespace

void add_kicks(py::module_& module) {
  const kicking::Ball ball;
  py::class_<Flight>(module, "Flight",
                     "What a flight depends on beside its kick: gravity, the ball and the air.\n"
                     "Raises ValueError for a number outside the range that a scenario allows.")
      .def(py::init<double, double, double, double>(), py::kw_only(), py::arg("gravity_mps2") = kicking::kGravity_mps2,
           py::arg("ball_radius_m") = ball.radius_m, py::arg("ball_mass_kg") = ball.mass_kg,
           py::arg("air_density_kgpm3") = kicking::Air{}.density_kgpm3)
      .def(py::pickle(
          [](const Flight& flight) {
            return std::tuple(flight.gravity_mps2, flight.ball_radius_m, flight.ball_mass_kg, flight.air_density_kgpm3);
          },
          [](const std::tuple<double, double, double, double>& state) { return std::make_from_tuple<Flight>(state); }))
      .def_readonly("ball_radius_m", &Flight::ball_radius_m);
  module.def("solve", solve);
  module.def("align", align);
  module.def("predict", predict);
}

}  // namespace trivela::python
