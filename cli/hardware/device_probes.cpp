#include "cli/hardware/device_probes.hpp"

#include <optional>

#include "hal/refbox/refbox_client.hpp"
#include "nodes/refbox/refbox_node.hpp"

namespace trivela::cli {
namespace {

/// A device that never runs dry, such as a recorded one, is left after so many samples of one look.
constexpr int kMostOfALook = 64;

/// One that is not opened: somebody else has it, or nobody wants it.
class Unopened final : public DeviceProbe {
 public:
  Unopened(const std::string& name, const std::string& device, std::string why, bool is_wanted)
      : DeviceProbe(name, device), why_(std::move(why)), wanted_(is_wanted) {}
  bool wanted() const override { return wanted_; }
  bool opened() const override { return !wanted_; }
  bool found() override { return wanted_; }
  std::string says() const override { return why_; }
  void look() override {}
  std::string values() override { return wanted_ ? "not opened" : "-"; }

 private:
  std::string why_;
  bool wanted_;
};

std::unique_ptr<DeviceProbe> not_wanted(const std::string& name, const std::string& why) {
  return std::make_unique<Unopened>(name, "none", why, false);
}

/// One that gives samples, which `text_of` writes for a person.
template <class Device, class Sample>
class SampledProbe : public DeviceProbe {
 public:
  SampledProbe(const std::string& name, std::unique_ptr<Device> opened, const std::string& device,
               std::string (*text_of)(const Sample&))
      : DeviceProbe(name, device), device_(std::move(opened)), text_of_(text_of) {}
  bool found() override { return device_->connected(std::chrono::nanoseconds{0}); }
  void look() override {
    for (int i = 0; i < kMostOfALook; ++i) {
      const auto sample = device_->read(std::chrono::nanoseconds{0});
      if (!sample) return;
      newest_ = sample;
      rate_.count();
    }
  }
  std::string values() override {
    const std::string rate = rate_.text();
    return newest_ ? fmt::format("{}; {}", text_of_(*newest_), rate) : "no sample";
  }

 protected:
  std::unique_ptr<Device> device_;
  std::optional<Sample> newest_;

 private:
  std::string (*text_of_)(const Sample&);
  Rate rate_;
};

class WheelsProbe final : public SampledProbe<hal::Wheels, hal::WheelSample> {
 public:
  WheelsProbe(std::unique_ptr<hal::Wheels> wheels, const std::string& device)
      : SampledProbe("wheels", std::move(wheels), device, wheels_text) {}
  std::string says() const override {
    std::string status = device_->status();
    if (!newest_) return status;
    return fmt::format("{} wheels, {} gyro{}{}", newest_->wheel_count, newest_->gyro_radps ? "a" : "no",
                       status.empty() ? "" : "; ", status);
  }
};

class KickerProbe final : public SampledProbe<hal::Kicker, hal::KickerSample> {
 public:
  KickerProbe(std::unique_ptr<hal::Kicker> kicker, const std::string& device)
      : SampledProbe("kicker", std::move(kicker), device, kicker_text) {}
  std::string says() const override {
    const hal::KickerCapabilities can = device_->capabilities();
    std::string text = device_->status();
    for (const auto& [is, what] :
         {std::pair{can.charge_control, "charging is controlled"}, std::pair{can.voltage, "volts are measured"},
          std::pair{can.discharge, "it can be discharged"}, std::pair{can.watchdog, "it has a watchdog"}}) {
      if (is) text += (text.empty() ? "" : ", ") + std::string{what};
    }
    return text;
  }
};

class GyroProbe final : public DeviceProbe {
 public:
  GyroProbe(std::unique_ptr<hal::Gyro> gyro, const std::string& device)
      : DeviceProbe("gyro", device), gyro_(std::move(gyro)) {}
  bool found() override {
    constexpr std::int64_t kFresh_ns = 500'000'000;
    const auto turn = gyro_->newest();
    return turn && age_ns(*turn) <= kFresh_ns;
  }
  std::string says() const override { return gyro_->status(); }
  void look() override {}  // it keeps the newest itself
  /// How old it is stands for a rate: of samples between two looks it keeps one.
  std::string values() override {
    const auto turn = gyro_->newest();
    if (!turn) return "no sample";
    return fmt::format("{:.2f} rad/s, {:.0f} ms old", turn->gyro_radps + 0.0,
                       1e-6 * static_cast<double>(age_ns(*turn)));
  }

 private:
  static std::int64_t age_ns(const hal::GyroSample& sample) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count() - sample.t_ns;
  }

  std::unique_ptr<hal::Gyro> gyro_;
};

class RangeFinderProbe final : public DeviceProbe {
 public:
  RangeFinderProbe(std::unique_ptr<hal::RangeFinder> finder, const std::string& device)
      : DeviceProbe("range finder", device), finder_(std::move(finder)) {}
  bool found() override { return finder_->connected(std::chrono::nanoseconds{0}); }
  std::string says() const override {
    if (!finder_->up()) return finder_->status();
    const auto identity = finder_->identity();
    return fmt::format("{} {}, {} beams; {}", identity.vendor, identity.product, finder_->geometry().beams,
                       finder_->status());
  }
  void look() override {
    const auto scan = finder_->read(std::chrono::nanoseconds{0});
    if (!scan) return;
    rate_.count();
    const std::size_t middle = scan->range_mm.size() / 2;
    middle_mm_ = scan->range_mm.empty() ? 0 : scan->range_mm[middle];
  }
  std::string values() override {
    const std::string rate = rate_.text();
    if (!middle_mm_) return "no scan";
    if (*middle_mm_ < kicking::lob::kFirstRange_mm) return fmt::format("nothing in front; {}", rate);
    return fmt::format("{:.2f} m in front; {}", *middle_mm_ / 1000.0, rate);
  }

 private:
  std::unique_ptr<hal::RangeFinder> finder_;
  std::optional<std::uint32_t> middle_mm_;
  Rate rate_;
};

class RefereeBoxProbe final : public DeviceProbe {
 public:
  explicit RefereeBoxProbe(std::shared_ptr<nodes::RefboxLink> link)
      : DeviceProbe("referee box", link->client->box()), link_(std::move(link)) {}
  bool found() override { return link_->client->connected(); }
  std::string says() const override { return why_; }
  void look() override {
    for (int i = 0; i < kMostOfALook; ++i) {
      const auto event = link_->client->next(std::chrono::nanoseconds{0});
      if (!event) return;
      std::visit([this](const auto& what) { take(what); }, *event);
    }
  }
  std::string values() override { return word_.empty() ? "no command yet" : "last command " + word_; }

 private:
  void take(const hal::refbox::Connected&) { why_.clear(); }
  void take(const hal::refbox::Command& command) { word_ = hal::refbox::name(command.kind); }
  void take(const hal::refbox::NoCommand& word) { why_ = word.why; }
  void take(const hal::refbox::Lost& lost) { why_ = lost.why; }
  void take(const hal::refbox::Unreachable& failure) { why_ = failure.why; }

  std::shared_ptr<nodes::RefboxLink> link_;
  std::string why_;
  std::string word_;
};

}  // namespace

std::string Rate::text() {
  const auto now = std::chrono::steady_clock::now();
  const double passed_s = std::chrono::duration<double>(now - since_).count();
  const double rate_hz = passed_s > 0.0 ? static_cast<double>(now_) / passed_s : 0.0;
  since_ = now;
  now_ = 0;
  return fmt::format("{:.0f}/s", rate_hz);
}

std::string kicker_text(const hal::KickerSample& sample) {
  static constexpr const char* kFaults[] = {"", ", fault of the charger", ", fault of the coil", ", link lost"};
  return fmt::format("charge {:.2f}{}{}, {}{}", sample.charge, sample.charge_modelled ? " (modelled)" : "",
                     sample.voltage_v ? fmt::format(", {:.0f} V", *sample.voltage_v) : "",
                     sample.armed ? "armed" : "not armed", kFaults[static_cast<std::size_t>(sample.fault)]);
}

std::string wheels_text(const hal::WheelSample& sample) {
  std::string text;
  for (int i = 0; i < sample.wheel_count; ++i)
    text += fmt::format("{}wheel {} {:.2f}", i == 0 ? "" : ", ", i + 1,
                        sample.wheel_radps[static_cast<std::size_t>(i)] + 0.0);
  text += " rad/s";
  return sample.gyro_radps ? text + fmt::format("; gyro {:.2f} rad/s", *sample.gyro_radps + 0.0) : text;
}

std::unique_ptr<DeviceProbe> held_by(const std::string& name, const std::string& device, const std::string& node) {
  return std::make_unique<Unopened>(name, device, node + " or another trivela hardware has it", true);
}

std::unique_ptr<DeviceProbe> wheels_probe(std::unique_ptr<hal::Wheels> wheels, const std::string& device) {
  return std::make_unique<WheelsProbe>(std::move(wheels), device);
}

std::unique_ptr<DeviceProbe> kicker_probe(std::unique_ptr<hal::Kicker> kicker, const std::string& device) {
  return std::make_unique<KickerProbe>(std::move(kicker), device);
}

std::unique_ptr<DeviceProbe> gyro_probe(std::unique_ptr<hal::Gyro> gyro, const std::string& device) {
  return std::make_unique<GyroProbe>(std::move(gyro), device);
}

std::unique_ptr<DeviceProbe> range_finder_probe(const config::ScanRecorder& settings, const hal::Owner& owner) {
  if (!settings.enabled) return not_wanted("range finder", "scan_recorder.enabled = false");
  return std::make_unique<RangeFinderProbe>(hal::open_range_finder(settings.device, owner),
                                            config::text_of(settings.device));
}

bool is_wanted(const config::Refbox& settings) { return !settings.group.empty() || settings.letters; }

std::unique_ptr<DeviceProbe> referee_box_probe(const config::Refbox& settings) {
  if (!is_wanted(settings)) return not_wanted("referee box", "refbox.group is empty");
  return std::make_unique<RefereeBoxProbe>(nodes::open_refbox(settings));
}

}  // namespace trivela::cli
