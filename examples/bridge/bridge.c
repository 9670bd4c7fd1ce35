// bridge DOMAIN_ID: robot 1's base of three wheels and its kicker, neither of which exists, behind the topics device/*.
// Its contract is idl/README.md, "A bridge to devices". Your hardware goes where MODEL stands. To build it by hand, I
// being PREFIX/include/trivela/idl: for T in annotations kick device; do idlc -x final -I $I $I/$T.idl; done cc
// bridge.c annotations.c kick.c device.c -lddsc -lm -o bridge
#include <dds/dds.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "device.h"

enum { kRobot = 1, kPeriod_ns = 10000000, kDrive_ns = 200000000, kLate_ns = 50000000 };
static const double kAngle_rad[3] = {0.5235987755982988, 2.6179938779914944, 4.71238898038469};
static const double kDistance_m = 0.22, kRadius_m = 0.05, kFollow_ratio = 0.1, kCharge_s = 2.0;

static volatile sig_atomic_t g_ended;
static void end(int signal) { g_ended = signal; }

static int64_t now_ns(void) {  // the clock of every t_ns
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "bridge: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

static dds_entity_t endpoint(dds_entity_t bus, const dds_topic_descriptor_t* type, const char* topic, int written) {
  const dds_entity_t on = checked(dds_create_topic(bus, type, topic, NULL, NULL), topic);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, written ? 1 : 50);
  if (written) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  if (written) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  return checked(written ? dds_create_writer(bus, on, qos, NULL) : dds_create_reader(bus, on, qos, NULL), topic);
}

static dds_sample_info_t take(dds_entity_t reader, void* sample) {
  dds_sample_info_t info = {.valid_data = false};
  while (dds_take(reader, &sample, &info, 1, 1) > 0 && !info.valid_data) continue;
  return info;
}

// Whether `writer` is the one that calls itself the robot's driver. Where two do, neither is believed.
static bool is_driver(dds_entity_t fires, dds_instance_handle_t writer) {
  static const char kDriver[] = "kicker_driver/1\n";
  dds_instance_handle_t all[16];
  bool found = false;
  int drivers = 0;
  for (int i = dds_get_matched_publications(fires, all, 16) - 1; i >= 0; --i) {
    dds_builtintopic_endpoint_t* const endpoint = i < 16 ? dds_get_matched_publication_data(fires, all[i]) : NULL;
    void* name = NULL;
    size_t size = 0;
    const bool told = endpoint && dds_qget_userdata(endpoint->qos, &name, &size);
    const bool driver = told && size >= strlen(kDriver) && memcmp(name, kDriver, strlen(kDriver)) == 0;
    drivers += driver;
    found = found || (driver && all[i] == writer);
    dds_free(name);
    if (endpoint) dds_builtintopic_free_endpoint(endpoint);
  }
  return found && drivers == 1;
}

// MODEL: motors, below encoders. `v` is how it moves, m/s to the right, m/s forward, rad/s; beside it the gyro.
static trivela_msg_DeviceWheels turn(double v[3], const trivela_msg_DeviceDrive* drive, uint64_t seq, int64_t t_ns) {
  const double driven = t_ns - drive->t_ns <= kDrive_ns;  // else it stops, whoever died
  const double wanted[3] = {driven * drive->vx_mps, driven * drive->vy_mps, driven * drive->omega_radps};
  for (int i = 0; i < 3; ++i) v[i] += kFollow_ratio * (wanted[i] - v[i]);
  trivela_msg_DeviceWheels base = {.robot_id = kRobot, .seq = seq, .t_ns = t_ns, .wheel_count = 3, .emulated = true};
  base.gyro_radps = v[2];
  for (int i = 0; i < 3; ++i)
    base.wheel_radps[i] = (cos(kAngle_rad[i]) * v[1] - sin(kAngle_rad[i]) * v[0] + kDistance_m * v[2]) / kRadius_m;
  return base;
}

int main(int argc, char** argv) {
  signal(SIGTERM, end);
  const dds_domainid_t domain = argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0;
  const dds_entity_t bus = checked(dds_create_participant(domain, NULL, NULL), "bus");
  const dds_entity_t wheels = endpoint(bus, &trivela_msg_DeviceWheels_desc, "device/wheels", 1);
  const dds_entity_t kicker = endpoint(bus, &trivela_msg_DeviceKicker_desc, "device/kicker", 1);
  const dds_entity_t drives = endpoint(bus, &trivela_msg_DeviceDrive_desc, "device/drive", 0);
  const dds_entity_t fires = endpoint(bus, &trivela_msg_DeviceFire_desc, "device/fire", 0);
  const dds_entity_t wake = checked(dds_create_waitset(bus), "waitset");
  dds_set_status_mask(fires, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(wake, fires, 0);
  trivela_msg_DeviceDrive command, drive = {.t_ns = 0};
  trivela_msg_DeviceFire word, shot = {.kick_id = 0};  // 0: none is waited for
  double v[3] = {0};
  int64_t last_kick_id = 0, charging_ns = now_ns(), tick_ns = charging_ns;
  for (uint64_t seq = 0; !g_ended;) {
    const int64_t left_ns = (shot.kick_id && shot.t_ns < tick_ns ? shot.t_ns : tick_ns) - now_ns();
    if (left_ns > 0) dds_waitset_wait(wake, NULL, 0, left_ns);
    for (dds_sample_info_t info; (info = take(fires, &word)).valid_data;) {
      if (word.robot_id != kRobot || !(word.withdrawn || is_driver(fires, info.publication_handle))) continue;
      if (word.withdrawn && word.kick_id == shot.kick_id) shot.kick_id = 0;
      if (!word.withdrawn && word.kick_id != last_kick_id) shot = word;
    }
    const int64_t t_ns = now_ns(), late_ns = t_ns - shot.t_ns;
    if (shot.kick_id && late_ns >= 0) {
      if (late_ns <= kLate_ns) charging_ns = t_ns;  // MODEL: one pulse of shot.power, never tried again
      const char* done = late_ns > kLate_ns ? "dropped" : "shot";
      printf("%s %" PRId64 " of %g at %" PRId64 "\n", done, shot.kick_id, shot.power, t_ns);
      fflush(stdout);
      last_kick_id = shot.kick_id;
      shot.kick_id = 0;
    }
    if (t_ns < tick_ns) continue;
    tick_ns = t_ns + kPeriod_ns;
    while (take(drives, &command).valid_data) drive = command.robot_id == kRobot ? command : drive;
    const trivela_msg_DeviceWheels base = turn(v, &drive, ++seq, t_ns);
    dds_write(wheels, &base);
    trivela_msg_DeviceKicker board = {.robot_id = kRobot, .seq = seq, .t_ns = t_ns, .armed = true, .voltage_v = NAN};
    board.charge = fmin(1.0, 1e-9 * (double)(t_ns - charging_ns) / kCharge_s);  // MODEL: as the board says
    board.charge_modelled = board.emulated = true;
    dds_write(kicker, &board);
  }
  return dds_delete(bus) != DDS_RETCODE_OK;  // MODEL: the base stands, the capacitor is emptied where it can be
}
