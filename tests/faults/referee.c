// fault_referee DOMAIN_ID: a referee box on a machine of its own. It says what the simulator's referee says, with a
// writer of its own, so that the referee can be killed, paused and cut off while the rest of the world goes on. On
// standard output: "writer GUID" for each writer of the simulator's words, in hexadecimal digits, for the hub that
// keeps those words from everybody else. SIGRTMIN with a value: 1 silent from now on, 0 no longer. SIGTERM: deletes its
// writer and ends. Where it hears no word for long it joins the bus again, as a node of ours does: garbled packets leave
// readers deaf.
#include <dds/dds.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "idl/robot.h"

enum { kDeaf_ms = 2000 };

static dds_entity_t g_writer;
static atomic_bool g_silent;
static atomic_llong g_heard_ms;  // of CLOCK_MONOTONIC

static long long now_ms(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000LL + now.tv_nsec / 1000000;
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "fault_referee: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

// Reliable, the last word for late joiners, the lease of a state: as the simulator says it.
static dds_qos_t* state_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

static void on_match(dds_entity_t reader, const dds_subscription_matched_status_t status, void* context) {
  (void)context;
  if (status.current_count_change <= 0) return;
  dds_builtintopic_endpoint_t* writer = dds_get_matched_publication_data(reader, status.last_publication_handle);
  if (writer == NULL) return;
  char line[64];
  int length = snprintf(line, sizeof line, "writer ");
  for (size_t i = 0; i < sizeof writer->key.v; ++i)
    length += snprintf(line + length, sizeof line - (size_t)length, "%02x", writer->key.v[i]);
  line[length++] = '\n';
  dds_builtintopic_free_endpoint(writer);
  if (write(STDOUT_FILENO, line, (size_t)length) != length) _exit(1);
}

static void on_word(dds_entity_t reader, void* context) {
  (void)context;
  void* samples[1] = {NULL};
  dds_sample_info_t info[1];
  while (dds_take(reader, samples, info, 1, 1) > 0) {
    atomic_store(&g_heard_ms, now_ms());
    if (info[0].valid_data && !atomic_load(&g_silent)) dds_write(g_writer, samples[0]);
    dds_return_loan(reader, samples, 1);
    samples[0] = NULL;
  }
}

static dds_entity_t join(dds_domainid_t domain_id) {
  const dds_entity_t participant = checked(dds_create_participant(domain_id, NULL, NULL), "bus");
  const dds_entity_t topic =
      checked(dds_create_topic(participant, &trivela_msg_Referee_desc, "referee", NULL, NULL), "topic");
  dds_qos_t* qos = state_qos();
  dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
  dds_listener_t* listener = dds_create_listener(NULL);
  dds_lset_subscription_matched(listener, on_match);
  dds_lset_data_available(listener, on_word);
  dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  dds_qset_writer_data_lifecycle(qos, false);
  g_writer = checked(dds_create_writer(participant, topic, qos, NULL), "writer");
  dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_INFINITY);
  checked(dds_create_reader(participant, topic, qos, listener), "reader");
  dds_delete_listener(listener);
  dds_delete_qos(qos);
  atomic_store(&g_heard_ms, now_ms());
  return participant;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: fault_referee DOMAIN_ID\n");
    return 2;
  }
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, SIGRTMIN);
  sigaddset(&ours, SIGTERM);
  sigprocmask(SIG_BLOCK, &ours, NULL);  // before the bus's threads exist, which inherit it
  const dds_domainid_t domain_id = (dds_domainid_t)atoi(argv[1]);
  const struct timespec look = {.tv_nsec = 250000000};
  dds_entity_t participant = join(domain_id);
  siginfo_t told;
  for (int signal = 0; signal != SIGTERM;) {
    signal = sigtimedwait(&ours, &told, &look);  // -1 after a pause, or a quarter of a second
    if (signal == SIGRTMIN) atomic_store(&g_silent, told.si_value.sival_int == 1);
    if (now_ms() - atomic_load(&g_heard_ms) <= kDeaf_ms) continue;
    dds_delete(participant);
    participant = join(domain_id);
  }
  dds_delete(participant);
  return 0;
}
