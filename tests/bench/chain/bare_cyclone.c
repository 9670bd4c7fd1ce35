#include "tests/bench/chain/bare_cyclone.h"

#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "idl/kick.h"
#include "idl/robot.h"

struct bare_chain {
  dds_entity_t domain, bus, odometry_out, world_out, order_out;
  bare_arrived arrived;
  void* context;
};

enum { kState, kOrder, kMost = 2 };

static dds_qos_t* agreed(int profile) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  if (profile == kState) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  if (profile == kOrder) dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
  return qos;
}

static dds_entity_t told(dds_entity_t made, const char* what) {
  if (made < 0) fprintf(stderr, "bare_cyclone: %s: %s\n", what, dds_strretcode(-made));
  return made;
}

static dds_entity_t writer(dds_entity_t bus, const dds_topic_descriptor_t* type, const char* name, int profile) {
  dds_qos_t* qos = agreed(profile);
  if (profile == kOrder) {
    dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(100));
    dds_qset_ownership_strength(qos, 0);
  } else {
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
  }
  dds_qset_writer_data_lifecycle(qos, false);
  dds_qset_latency_budget(qos, 0);
  const dds_entity_t made =
      told(dds_create_writer(bus, told(dds_create_topic(bus, type, name, NULL, NULL), name), qos, NULL), name);
  dds_delete_qos(qos);
  return made;
}

static dds_entity_t reader(bare_chain* chain, const dds_topic_descriptor_t* type, const char* name, int profile,
                           dds_on_data_available_fn on_data) {
  dds_qos_t* qos = agreed(profile);
  dds_qset_liveliness(qos, profile == kOrder ? DDS_LIVELINESS_MANUAL_BY_TOPIC : DDS_LIVELINESS_AUTOMATIC, DDS_INFINITY);
  dds_listener_t* listener = dds_create_listener(chain);
  dds_lset_data_available(listener, on_data);
  const dds_entity_t topic = told(dds_create_topic(chain->bus, type, name, NULL, NULL), name);
  const dds_entity_t made = told(dds_create_reader(chain->bus, topic, qos, listener), name);
  dds_delete_listener(listener);
  dds_delete_qos(qos);
  return made;
}

// Takes what there is, on loan, and hands each sample to `use`.
static void take(dds_entity_t from, bare_chain* chain, void (*use)(bare_chain*, const void*)) {
  void* samples[kMost] = {NULL};
  dds_sample_info_t infos[kMost];
  for (int count = kMost; count == kMost;) {
    count = dds_take(from, samples, infos, kMost, kMost);
    for (int i = 0; i < count; ++i)
      if (infos[i].valid_data) use(chain, samples[i]);
    if (count > 0) dds_return_loan(from, samples, count);
  }
}

static void judge_odometry(bare_chain* chain, const void* sample) {
  const trivela_msg_Odometry* in = sample;
  const trivela_msg_WorldState out = {.robot_id = 1, .seq = in->seq, .t_ns = in->t_ns};
  dds_write(chain->world_out, &out);
}

static void judge_world(bare_chain* chain, const void* sample) {
  const trivela_msg_WorldState* in = sample;
  const trivela_msg_KickOrder out = {.robot_id = 1, .seq = in->seq, .t_ns = in->t_ns};
  dds_write(chain->order_out, &out);
}

static void obey(bare_chain* chain, const void* sample) {
  const trivela_msg_KickOrder* in = sample;
  chain->arrived(chain->context, (int64_t)in->seq, in->t_ns);
}

static void on_odometry(dds_entity_t from, void* chain) { take(from, chain, judge_odometry); }
static void on_world(dds_entity_t from, void* chain) { take(from, chain, judge_world); }
static void on_order(dds_entity_t from, void* chain) { take(from, chain, obey); }

// Writers first: a listener may be called before its reader's creation returns.
static int open_stages(bare_chain* chain, int stages) {
  dds_entity_t last = 0;
  if (stages & kBareOdometry)
    last = chain->odometry_out = writer(chain->bus, &trivela_msg_Odometry_desc, "odometry", kState);
  if (last >= 0 && (stages & kBareWorldState))
    last = chain->world_out = writer(chain->bus, &trivela_msg_WorldState_desc, "world_state", kState);
  if (last >= 0 && (stages & kBareKickDecision))
    last = chain->order_out = writer(chain->bus, &trivela_msg_KickOrder_desc, "kick_order", kOrder);
  if (last >= 0 && (stages & kBareWorldState))
    last = reader(chain, &trivela_msg_Odometry_desc, "odometry", kState, on_odometry);
  if (last >= 0 && (stages & kBareKickDecision))
    last = reader(chain, &trivela_msg_WorldState_desc, "world_state", kState, on_world);
  if (last >= 0 && (stages & kBareKickerDriver))
    last = reader(chain, &trivela_msg_KickOrder_desc, "kick_order", kOrder, on_order);
  return last >= 0;
}

bare_chain* bare_chain_open(uint32_t domain_id, const char* xml, int stages, bare_arrived arrived, void* context) {
  bare_chain* chain = calloc(1, sizeof *chain);
  if (chain == NULL) return NULL;
  chain->arrived = arrived;
  chain->context = context;
  chain->domain = told(dds_create_domain(domain_id, xml), "domain");
  chain->bus = chain->domain < 0 ? chain->domain : told(dds_create_participant(domain_id, NULL, NULL), "participant");
  if (chain->bus >= 0 && open_stages(chain, stages)) return chain;
  bare_chain_close(chain);
  return NULL;
}

int bare_chain_write(const bare_chain* chain, int64_t seq, int64_t t_ns) {
  const trivela_msg_Odometry sample = {.robot_id = 1, .seq = (uint64_t)seq, .t_ns = t_ns};
  return dds_write(chain->odometry_out, &sample);
}

void bare_chain_close(bare_chain* chain) {
  if (chain->domain > 0) dds_delete(chain->domain);
  free(chain);
}
