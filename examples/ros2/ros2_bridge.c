// ros2_bridge DOMAIN_ID: what a robot says, said again as ROS 2 Humble has it (rt/trivela/NAME, types
// trivela_msgs::msg::dds_::NAME_, @final and without keys), and what ROS 2 says for the robot, said again to it. Any
// DDS that reads plain CDR alone hears it, too. The copies of the types are made of our .idl by copy_idl.py: the C
// structs on both sides are the same, so that a sample goes through as it lies in memory. ../ros2.md says what it is
// for.
#include <dds/dds.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "kick.h"
#include "kick_ros2.h"
#include "robot.h"
#include "robot_ros2.h"

typedef enum { kToRos, kFromRos } Way;

typedef struct {
  Way way;
  bool state;  // the last word counts, and who comes late gets it; else an event
  const char *ours, *ros;
  const dds_topic_descriptor_t *our_type, *ros_type;
} Route;

#define ROUTE(way, state, topic, type) \
  { way, state, topic, "rt/trivela/" topic, &trivela_msg_##type##_desc, &trivela_msgs_msg_dds__##type##__desc }
static const Route kRoutes[] = {
    ROUTE(kToRos, true, "odometry", Odometry),           ROUTE(kToRos, true, "referee", Referee),
    ROUTE(kToRos, true, "world_state", WorldState),      ROUTE(kToRos, true, "kicker_status", KickerStatus),
    ROUTE(kToRos, false, "kick_decision", KickDecision), ROUTE(kToRos, false, "kick_receipt", KickReceipt),
    ROUTE(kToRos, false, "kick_outcome", KickOutcome),   ROUTE(kFromRos, true, "vision", VisionFrame),
    ROUTE(kFromRos, true, "flight_camera", FlightFrame), ROUTE(kFromRos, false, "team_drive", TeamDrive),
};
enum { kRouteCount = sizeof kRoutes / sizeof kRoutes[0], kEventDepth = 50, kMost = 16 };

static volatile sig_atomic_t g_ended;
static void end(int signal) { g_ended = signal; }

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "ros2_bridge: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

static dds_qos_t* quality(bool state) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, state ? 1 : kEventDepth);
  return qos;
}

static dds_entity_t reader(dds_entity_t bus, const Route* route) {
  const bool ours = route->way == kToRos;
  const char* const name = ours ? route->ours : route->ros;
  const dds_entity_t topic = dds_create_topic(bus, ours ? route->our_type : route->ros_type, name, NULL, NULL);
  dds_qos_t* qos = quality(route->state);
  // A publisher of ROS 2 keeps nothing for those who come late.
  if (ours && route->state) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t made = checked(dds_create_reader(bus, checked(topic, name), qos, NULL), name);
  dds_delete_qos(qos);
  return made;
}

static dds_entity_t writer(dds_entity_t bus, const Route* route) {
  const bool ours = route->way == kFromRos;
  const char* const name = ours ? route->ours : route->ros;
  const dds_entity_t topic = dds_create_topic(bus, ours ? route->our_type : route->ros_type, name, NULL, NULL);
  dds_qos_t* qos = quality(route->state);
  if (route->state) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  if (ours) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  dds_qset_writer_data_lifecycle(qos, false);
  const dds_entity_t made = checked(dds_create_writer(bus, checked(topic, name), qos, NULL), name);
  dds_delete_qos(qos);
  return made;
}

static void pass_on(dds_entity_t from, dds_entity_t to) {
  void* samples[kMost] = {NULL};
  dds_sample_info_t infos[kMost];
  for (int count = kMost; count == kMost;) {
    count = checked(dds_take(from, samples, infos, kMost, kMost), "take");
    for (int i = 0; i < count; ++i)
      if (infos[i].valid_data) checked(dds_write(to, samples[i]), "write");
    if (count > 0) dds_return_loan(from, samples, count);
  }
}

int main(int argc, char** argv) {
  signal(SIGINT, end);
  signal(SIGTERM, end);
  const dds_domainid_t domain = argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0;
  const dds_entity_t bus = checked(dds_create_participant(domain, NULL, NULL), "bus");
  const dds_entity_t arrivals = checked(dds_create_waitset(bus), "waitset");
  dds_entity_t from[kRouteCount], to[kRouteCount];
  for (int i = 0; i < kRouteCount; ++i) {
    to[i] = writer(bus, &kRoutes[i]);
    from[i] = reader(bus, &kRoutes[i]);
    const dds_entity_t condition = checked(dds_create_readcondition(from[i], DDS_ANY_STATE), kRoutes[i].ours);
    checked(dds_waitset_attach(arrivals, condition, i), kRoutes[i].ours);
  }
  printf("ros2_bridge: in domain %u\n", domain);
  fflush(stdout);
  while (!g_ended) {
    dds_attach_t ready[kRouteCount];
    const int count = checked(dds_waitset_wait(arrivals, ready, kRouteCount, DDS_MSECS(200)), "wait");
    for (int n = 0; n < count; ++n) pass_on(from[ready[n]], to[ready[n]]);
  }
  return dds_delete(bus) != DDS_RETCODE_OK;
}
