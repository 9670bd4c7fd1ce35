// fault_witness DOMAIN_ID: hears the bus as a program of somebody else would - stock idlc types, no code of the stack -
// and says on standard output what came when, by CLOCK_MONOTONIC at arrival. CYCLONEDDS_URI says where the bus is. A
// line:
//   ARRIVAL_NS order T_NS KICK_ID FIRE_T_NS VALID_UNTIL_T_NS
//   ARRIVAL_NS decision T_NS KICK_ID FIRE_T_NS VALID_UNTIL_T_NS    what kick_decision says that it has ordered
//   ARRIVAL_NS fire T_NS KICK_ID WITHDRAWN
//   ARRIVAL_NS truth RELEASE_T_NS KICK_ID
//   ARRIVAL_NS outcome KICK_ID RELEASE_LATE_S
//   ARRIVAL_NS estimate SEQ KICK_ID KICKS SPEED_LN DELAY_S
//   ARRIVAL_NS referee PLAYING
//   ARRIVAL_NS sample TOPIC                      a topic that is heard for its rhythm alone
// It never takes the driver's word: kicker_status is a rhythm, kick_receipt is not read.
#include <dds/dds.h>
#include <inttypes.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "idl/device.h"
#include "idl/kick.h"
#include "idl/robot.h"
#include "idl/sim.h"

enum { kSamplesAtOnce = 64, kLongestLine = 200 };

static const int64_t kValidity_ns = 50000000;  // kick_decision.order_validity_s of the campaign

// 0: there is nothing to say of it.
typedef int (*Describe)(char* line, size_t size, const char* topic, const void* sample);

struct Stream {
  const char* topic;
  const dds_topic_descriptor_t* type;
  Describe describe;
  bool order;  // QoS of an order, not of a state or an event
};

static int describe_order(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_KickOrder* order = sample;
  (void)topic;
  return snprintf(line, size, "order %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64, order->t_ns, order->kick_id,
                  order->fire_t_ns, order->valid_until_t_ns);
}

static int describe_decision(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_KickDecision* decision = sample;
  (void)topic;
  if (decision->kick_id == 0) return 0;
  return snprintf(line, size, "decision %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64, decision->t_ns,
                  decision->kick_id, decision->t_ns + (int64_t)(decision->fire_after_s * 1e9),
                  decision->t_ns + kValidity_ns);
}

static int describe_fire(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_DeviceFire* fire = sample;
  (void)topic;
  return snprintf(line, size, "fire %" PRId64 " %" PRId64 " %d", fire->t_ns, fire->kick_id, fire->withdrawn);
}

static int describe_truth(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_KickTruth* truth = sample;
  (void)topic;
  return snprintf(line, size, "truth %" PRId64 " %" PRId64, truth->release_t_ns, truth->kick_id);
}

static int describe_outcome(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_KickOutcome* outcome = sample;
  (void)topic;
  return snprintf(line, size, "outcome %" PRId64 " %.17g", outcome->kick_id, outcome->release_late_s);
}

static int describe_estimate(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_KickerEstimate* estimate = sample;
  (void)topic;
  return snprintf(line, size, "estimate %" PRIu64 " %" PRId64 " %" PRIu32 " %.17g %.17g", estimate->seq,
                  estimate->kick_id, estimate->kicks, estimate->speed_ln, estimate->delay_s);
}

static int describe_referee(char* line, size_t size, const char* topic, const void* sample) {
  const trivela_msg_Referee* word = sample;
  (void)topic;
  return snprintf(line, size, "referee %d", word->playing);
}

static int describe_rhythm(char* line, size_t size, const char* topic, const void* sample) {
  (void)sample;
  return snprintf(line, size, "sample %s", topic);
}

static const struct Stream kStreams[] = {
    {"kick_order", &trivela_msg_KickOrder_desc, describe_order, true},
    {"kick_decision", &trivela_msg_KickDecision_desc, describe_decision, false},
    {"device/fire", &trivela_msg_DeviceFire_desc, describe_fire, false},
    {"sim/kick_truth", &trivela_msg_KickTruth_desc, describe_truth, false},
    {"kick_outcome", &trivela_msg_KickOutcome_desc, describe_outcome, false},
    {"kicker_estimate", &trivela_msg_KickerEstimate_desc, describe_estimate, false},
    {"referee", &trivela_msg_Referee_desc, describe_referee, false},
    {"vision", &trivela_msg_VisionFrame_desc, describe_rhythm, false},
    {"odometry", &trivela_msg_Odometry_desc, describe_rhythm, false},
    {"world_state", &trivela_msg_WorldState_desc, describe_rhythm, false},
    {"drive", &trivela_msg_DriveCommand_desc, describe_rhythm, false},
    {"kicker_status", &trivela_msg_KickerStatus_desc, describe_rhythm, false},
    {"device/drive", &trivela_msg_DeviceDrive_desc, describe_rhythm, false},
};

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void fail(const char* what, const char* topic, dds_return_t code) {
  fprintf(stderr, "fault_witness: %s %s: %s\n", what, topic, dds_strretcode(-code));
  exit(1);
}

// One write a line, shorter than a pipe's atomic size: listeners of several threads do not mix.
static void say(int64_t arrival_ns, const struct Stream* stream, const void* sample) {
  char line[kLongestLine];
  int length = snprintf(line, sizeof line, "%" PRId64 " ", arrival_ns);
  const int described = stream->describe(line + length, sizeof line - (size_t)length - 1, stream->topic, sample);
  if (described == 0) return;
  length += described;
  line[length++] = '\n';
  if (write(STDOUT_FILENO, line, (size_t)length) != length) exit(1);  // nobody listens any more
}

static void on_data(dds_entity_t reader, void* context) {
  const int64_t arrival_ns = now_ns();
  void* samples[kSamplesAtOnce];
  dds_sample_info_t infos[kSamplesAtOnce];
  for (;;) {
    samples[0] = NULL;
    const dds_return_t taken = dds_take(reader, samples, infos, kSamplesAtOnce, kSamplesAtOnce);
    if (taken <= 0) return;
    for (dds_return_t i = 0; i < taken; ++i) {
      if (infos[i].valid_data) say(arrival_ns, context, samples[i]);
    }
    dds_return_loan(reader, samples, taken);
  }
}

static void listen_to(dds_entity_t participant, const struct Stream* stream) {
  const dds_entity_t topic = dds_create_topic(participant, stream->type, stream->topic, NULL, NULL);
  if (topic < 0) fail("topic", stream->topic, topic);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  if (stream->order) {
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
    dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_INFINITY);
  }
  dds_listener_t* listener = dds_create_listener((void*)(uintptr_t)stream);
  dds_lset_data_available(listener, on_data);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, listener);
  if (reader < 0) fail("reader of", stream->topic, reader);
  dds_delete_listener(listener);
  dds_delete_qos(qos);
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: fault_witness DOMAIN_ID\n");
    return 2;
  }
  // Before the bus's threads exist, which inherit it: what a busy machine keeps waiting, comes late by the witness's
  // fault.
  const struct sched_param priority = {.sched_priority = 10};
  sched_setscheduler(0, SCHED_FIFO, &priority);
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) fail("participant in domain", argv[1], participant);
  for (size_t i = 0; i < sizeof kStreams / sizeof *kStreams; ++i) listen_to(participant, &kStreams[i]);
  for (;;) pause();
}
