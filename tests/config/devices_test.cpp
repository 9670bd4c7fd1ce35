// A device is a variant of config structs: what a file may say of one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/settings_fields.hpp"
#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::config {
namespace {

using ::testing::HasSubstr;

/// A backend with settings of its own.
struct CanKicker {
  static constexpr std::string_view kName = "can";
  double bit_rate_hz = 1e6;
};

struct Devices {
  std::variant<SimDevice, CanKicker> kicker;
};

template <class V>
void fields(V& v, CanKicker& c) {
  v("bit_rate_hz", c.bit_rate_hz, Range{1e3, 1e7});
}

template <class V>
void fields(V& v, Devices& d) {
  v("kicker", d.kicker);
}

Devices read(const std::string& text, Devices devices = {}) {
  read_into(parse_text(text, "devices.toml"), devices);
  return devices;
}

std::string problem(const std::string& text) try {
  read(text);
  return "accepted";
} catch (const Error& error) {
  return error.what();
}

TEST(Device, IsTheBackendThatItsKeyNames) {
  EXPECT_TRUE(std::holds_alternative<SimDevice>(read("").kicker));
  EXPECT_TRUE(std::holds_alternative<CanKicker>(read("kicker = \"can\"").kicker));
}

TEST(Device, ReadsItsSettingsFromTheTableOfItsName) {
  const Devices devices = read("kicker = \"can\"\n[can]\nbit_rate_hz = 5e5\n");
  EXPECT_EQ(std::get<CanKicker>(devices.kicker).bit_rate_hz, 5e5);
  EXPECT_THAT(problem("kicker = \"can\"\n[can]\nbit_rate_hz = 1.0\n"),
              HasSubstr("devices.toml:3: can.bit_rate_hz = 1"));
  EXPECT_THAT(problem("kicker = \"sim\"\n[can]\nbit_rate_hz = 5e5\n"), HasSubstr("unknown key"));
}

TEST(Device, KeepsItsSettingsWhereALaterFileNamesItAgain) {
  const Devices once = read("kicker = \"can\"\n[can]\nbit_rate_hz = 5e5\n");
  EXPECT_EQ(std::get<CanKicker>(read("kicker = \"can\"", once).kicker).bit_rate_hz, 5e5);
}

TEST(Device, IsWrittenAsItIsRead) {
  const std::string text = to_toml(read("kicker = \"can\"\n[can]\nbit_rate_hz = 5e5\n"));
  EXPECT_EQ(text, "kicker = \"can\"\n\n[can]\nbit_rate_hz = 500000.0\n");
  EXPECT_EQ(to_toml(read(text)), text);
}

Settings with(const std::vector<std::string>& lines) {
  Settings settings;
  override_settings(settings, lines);
  return settings;
}

std::string refusal(const std::vector<std::string>& lines) try {
  with(lines);
  return "accepted";
} catch (const Error& error) {
  return error.what();
}

TEST(IoBoard, HasItsSettingsInATableOfItsName) {
  const Settings settings = with({"hal.kicker = \"ioboard\"", "hal.ioboard.port = \"/dev/ttyS4\"",
                                  "hal.ioboard.lever = 120", "hal.ioboard.charge_time_s = 2.5"});
  const auto board = std::get<IoBoardDevice>(settings.hal.kicker);
  EXPECT_EQ(board.port, "/dev/ttyS4");
  EXPECT_EQ(board.lever, 120);
  EXPECT_EQ(board.charge_time_s, 2.5);
  EXPECT_EQ(board.pulse_us_per_power, 128.0);
  EXPECT_EQ(std::get<IoBoardDevice>(with({"hal.kicker = \"ioboard\""}).hal.kicker).lever, std::nullopt);
}

TEST(IoBoard, IsRefusedWithALeverThatItDoesNotHaveAndWhereItIsNotTheKicker) {
  EXPECT_THAT(refusal({"hal.kicker = \"ioboard\"", "hal.ioboard.lever = 206"}),
              HasSubstr("hal.ioboard.lever = 206: must lie in [0, 205]"));
  EXPECT_THAT(refusal({"hal.kicker = \"sim\"", "hal.ioboard.lever = 20"}), HasSubstr("unknown key"));
}

TEST(Lockstep, IsForDevicesWithoutATimeOfTheirOwn) {
  for (const std::string device : {"ioboard", "rekick"})
    EXPECT_THAT(refusal({"run.lockstep = true", "hal.kicker = \"" + device + "\""}),
                HasSubstr("run.lockstep = true, but hal.kicker = \"" + device + "\" has a time of its own"));
  EXPECT_THAT(refusal({"run.lockstep = true", "hal.wheels = \"cia402\""}),
              HasSubstr("run.lockstep = true, but hal.wheels = \"cia402\" has a time of its own"));
  EXPECT_THAT(refusal({"run.lockstep = true", "hal.gyro = \"mti\""}), HasSubstr("but hal.gyro = \"mti\" has a time"));
  EXPECT_THAT(refusal({"run.lockstep = true", "hal.wheels = \"cia402\""}),
              HasSubstr("hal.wheels = \"cia402\" has a time"));
  EXPECT_THAT(refusal({"run.lockstep = true", "hal.gyro = \"mti\""}), HasSubstr("hal.gyro = \"mti\" has a time"));
  EXPECT_THAT(
      refusal({"run.lockstep = true", "scan_recorder.enabled = true", "scan_recorder.device = \"/dev/ttyACM0\""}),
      HasSubstr("scan_recorder.device = \"/dev/ttyACM0\" has a time"));
  EXPECT_TRUE(with({"run.lockstep = true"}).run.lockstep);
  EXPECT_NO_THROW(with({"hal.kicker = \"ioboard\""}));
}

TEST(ReKick, HasItsSettingsInATableOfItsName) {
  const Settings settings = with({"hal.kicker = \"rekick\"", "hal.rekick.port = \"can1\"",
                                  "hal.rekick.pulse_us_per_power = 1.0", "hal.rekick.max_voltage_v = 200"});
  const auto board = std::get<ReKickDevice>(settings.hal.kicker);
  EXPECT_EQ(board.port, "can1");
  EXPECT_EQ(board.pulse_us_per_power, 1.0);
  EXPECT_EQ(board.max_voltage_v, 200);
  EXPECT_THAT(refusal({"hal.kicker = \"rekick\"", "hal.rekick.max_voltage_v = 331"}),
              HasSubstr("hal.rekick.max_voltage_v = 331: must lie in [1, 330]"));
}

TEST(Cia402, HasItsSettingsInATableOfItsName) {
  const Settings settings =
      with({"hal.wheels = \"cia402\"", "hal.cia402.nodes = [4, 5, 6, 7]", "hal.cia402.reversed = [5]",
            "hal.cia402.gear = 23.0", "hal.cia402.ramp = 20000", "hal.cia402.heartbeat_s = 0.1"});
  const auto drives = std::get<Cia402Device>(settings.hal.wheels);
  EXPECT_EQ(drives.nodes, (std::vector<std::uint8_t>{4, 5, 6, 7}));
  EXPECT_EQ(drives.reversed, std::vector<std::uint8_t>{5});
  EXPECT_EQ(drives.gear, 23.0);
  EXPECT_EQ(drives.rpm_per_unit, std::nullopt);
  EXPECT_EQ(drives.ramp, 20000u);
  EXPECT_EQ(drives.heartbeat_s, 0.1);
  EXPECT_EQ(drives.port, "can0");
  EXPECT_THAT(refusal({"hal.wheels = \"cia402\"", "hal.cia402.nodes = [0, 1, 2]"}),
              HasSubstr("hal.cia402.nodes = [ 0, 1, 2 ]: must lie in [1, 127]"));
  EXPECT_THAT(refusal({"hal.wheels = \"cia402\"", "hal.cia402.heartbeat_s = 2.0"}),
              HasSubstr("hal.cia402.heartbeat_s = 2.0: must lie in [0.1, 1]"));
}

TEST(Gyro, IsThatOfTheWheelsUnlessTheFileNamesOneOfItsOwn) {
  EXPECT_TRUE(std::holds_alternative<WheelsGyro>(with({}).hal.gyro));
  const Settings settings =
      with({"hal.gyro = \"mti\"", "hal.mti.port = \"/dev/ttyUSB3\"", "hal.mti.upside_down = true"});
  EXPECT_EQ(std::get<MtiDevice>(settings.hal.gyro).port, "/dev/ttyUSB3");
  EXPECT_TRUE(std::get<MtiDevice>(settings.hal.gyro).upside_down);
  EXPECT_THAT(refusal({"hal.gyro = \"bno055\""}), HasSubstr("expected one of: wheels, mti"));
}

TEST(Scanner, IsSimulatedOrAnAddress) {
  const auto of = [](const std::string& device) {
    Settings settings;
    override_settings(settings, {"scan_recorder.device = \"" + device + "\""});
    return settings.scan_recorder.device;
  };
  EXPECT_TRUE(std::holds_alternative<SimDevice>(of("sim")));
  const auto tcp = std::get<ScipDevice>(of("tcp://[fe80::1]:10940"));
  EXPECT_EQ(tcp.host, "fe80::1");
  EXPECT_EQ(tcp.port, 10940);
  EXPECT_EQ(std::get<ScipDevice>(of("/dev/ttyACM0")).port, 0);
  EXPECT_EQ(text_of(of("/dev/ttyACM0")), "/dev/ttyACM0");
}

}  // namespace
}  // namespace trivela::config
