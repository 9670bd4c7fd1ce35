// fault_client DOMAIN_ID: somebody else's decision loop that insists: an order every 60 ms, each fresh and lawful by
// itself, with more strength than kick_decision's, so that the driver always has one before it, whatever befalls the
// chain behind it. SIGRTMIN with a value: 1 begins in kick_decision's name, 2 unauthorised, whose orders nobody may
// fire, 0 leaves off, as it is at first. Its clock is that of world_state.
#include <dds/dds.h>
#include <errno.h>
#include <inttypes.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "idl/kick.h"
#include "idl/robot.h"

enum { kPeriod_ms = 60, kLease_ms = 100, kStrength = 10, kRobot = 1 };

static const int64_t kValidity_ns = 50000000;
static const double kPower = 20.0;
static const char kDecision[] = "kick_decision/1";

static pthread_mutex_t g_mutex = PTHREAD_MUTEX_INITIALIZER;
static int64_t g_ahead_ns;  // world_state's clock against CLOCK_MONOTONIC; under the mutex
static bool g_heard;        // under the mutex

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "fault_client: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

static void on_world(dds_entity_t reader, void* context) {
  (void)context;
  void* samples[1] = {NULL};
  dds_sample_info_t info[1];
  while (dds_take(reader, samples, info, 1, 1) > 0) {
    if (info[0].valid_data) {
      pthread_mutex_lock(&g_mutex);
      g_ahead_ns = ((const trivela_msg_WorldState*)samples[0])->t_ns - now_ns();
      g_heard = true;
      pthread_mutex_unlock(&g_mutex);
    }
    dds_return_loan(reader, samples, 1);
    samples[0] = NULL;
  }
}

static void listen_to_world(dds_entity_t participant) {
  const dds_entity_t topic =
      checked(dds_create_topic(participant, &trivela_msg_WorldState_desc, "world_state", NULL, NULL), "world_state");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_listener_t* listener = dds_create_listener(NULL);
  dds_lset_data_available(listener, on_world);
  checked(dds_create_reader(participant, topic, qos, listener), "reader");
  dds_delete_listener(listener);
  dds_delete_qos(qos);
}

static dds_entity_t order_writer(dds_entity_t participant, dds_entity_t topic, bool unauthorised) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(kLease_ms));
  dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
  dds_qset_ownership_strength(qos, kStrength);
  dds_qset_writer_data_lifecycle(qos, false);
  if (!unauthorised) dds_qset_userdata(qos, kDecision, strlen(kDecision));
  const dds_entity_t writer = checked(dds_create_writer(participant, topic, qos, NULL), "writer");
  dds_delete_qos(qos);
  return writer;
}

static void order(dds_entity_t writer, uint64_t seq, bool unauthorised) {
  pthread_mutex_lock(&g_mutex);
  const bool heard = g_heard;
  const int64_t t_ns = now_ns() + g_ahead_ns;
  pthread_mutex_unlock(&g_mutex);
  if (!heard) return;
  const trivela_msg_KickOrder message = {
      .robot_id = kRobot,
      .seq = seq,
      .t_ns = t_ns,
      // session (15 bit), robot (8 bit), counter (40 bit); no session of kick_decision's is so high by much chance
      .kick_id = (int64_t)(unauthorised ? 0x7ffe : 0x7fff) << 48 | (int64_t)kRobot << 40 | (int64_t)seq,
      .power = kPower,
      .fire_t_ns = t_ns,
      .valid_until_t_ns = t_ns + kValidity_ns,
      .possession = true,
  };
  dds_write(writer, &message);
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: fault_client DOMAIN_ID\n");
    return 2;
  }
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, SIGRTMIN);           // of several, the first one comes first
  sigprocmask(SIG_BLOCK, &ours, NULL);  // before the bus's threads exist, which inherit it
  const dds_entity_t participant = checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "bus");
  const dds_entity_t topic =
      checked(dds_create_topic(participant, &trivela_msg_KickOrder_desc, "kick_order", NULL, NULL), "kick_order");
  listen_to_world(participant);
  const struct timespec period = {.tv_nsec = kPeriod_ms * 1000000L};
  dds_entity_t writer = 0;
  bool unauthorised = false;
  for (uint64_t seq = 0;;) {
    siginfo_t told;
    const bool asked = sigtimedwait(&ours, &told, &period) == SIGRTMIN;
    if (asked && told.si_value.sival_int > 0 && writer == 0) {
      unauthorised = told.si_value.sival_int == 2;
      writer = order_writer(participant, topic, unauthorised);
    } else if (asked && told.si_value.sival_int == 0 && writer > 0) {
      dds_delete(writer);
      writer = 0;
    } else if (writer > 0) {
      order(writer, ++seq, unauthorised);
    }
  }
}
