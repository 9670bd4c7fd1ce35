// vision DOMAIN_ID: what robot 1's own vision and a goal camera would write on the topics vision and flight_camera,
// here of a robot that stands at the centre spot with the ball before it. Your pictures go where MODEL stands; frames
// and units are in robot.idl, the rest in idl/README.md. To build it by hand, I being PREFIX/include/trivela/idl: for T
// in annotations robot; do idlc -x final -I $I $I/$T.idl; done; cc vision.c annotations.c robot.c -lddsc -o vision
#include <dds/dds.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "robot.h"

enum { kRobot = 1 };
static const int64_t kPeriod_ns = 33000000, kExposure_ns = 20000000;

static volatile sig_atomic_t g_ended;
static void end(int signal) { g_ended = signal; }

static int64_t now_ns(void) {  // the clock of every t_ns and t_exposure_ns
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "vision: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

static dds_entity_t writer(dds_entity_t bus, const dds_topic_descriptor_t* type, const char* topic) {
  const dds_entity_t on = checked(dds_create_topic(bus, type, topic, NULL, NULL), topic);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  return checked(dds_create_writer(bus, on, qos, NULL), topic);
}

int main(int argc, char** argv) {
  signal(SIGTERM, end);
  const dds_entity_t bus =
      checked(dds_create_participant(argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0, NULL, NULL), "bus");
  const dds_entity_t vision = writer(bus, &trivela_msg_VisionFrame_desc, "vision");
  const dds_entity_t camera = writer(bus, &trivela_msg_FlightFrame_desc, "flight_camera");
  for (uint64_t seq = 1; !g_ended; ++seq) {
    const int64_t exposure_ns = now_ns();
    const struct timespec working = {.tv_nsec = kExposure_ns}, rest = {.tv_nsec = kPeriod_ns - kExposure_ns};
    nanosleep(&working, NULL);  // MODEL: a picture is taken and understood; its instant is the exposure's
    trivela_msg_VisionFrame seen = {.robot_id = kRobot, .seq = seq, .t_ns = now_ns(), .t_exposure_ns = exposure_ns};
    seen.pose_seen = true;  // at the centre spot of the field, facing the opponents' goal
    seen.ball_seen = true;  // in the robot's frame: forward of its middle
    seen.ball_y_m = 0.3;
    seen.opponent_x_m = seen.opponent_y_m = NAN;  // none is seen
    for (int i = 0; i < 4; ++i) seen.further_x_m[i] = seen.further_y_m[i] = NAN;
    seen.keeper_x_m = seen.keeper_y_m = NAN;
    dds_write(vision, &seen);
    trivela_msg_FlightFrame goal = {.robot_id = kRobot, .seq = seq, .t_ns = now_ns(), .t_exposure_ns = exposure_ns};
    goal.ball_seen = true;  // the ball on the floor, in the field's frame
    goal.ball_y_m = 0.3;
    goal.ball_z_m = 0.11;
    dds_write(camera, &goal);
    nanosleep(&rest, NULL);
  }
  return dds_delete(bus) != DDS_RETCODE_OK;
}
