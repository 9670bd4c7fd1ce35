// The chain in C on Cyclone alone, as its documentation would have it written: readers with listeners that take on loan
// and write on, types from stock idlc, and the quality of service of idl/README.md.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Of one process: any of the stages.
enum { kBareOdometry = 1, kBareWorldState = 2, kBareKickDecision = 4, kBareKickerDriver = 8 };

typedef void (*bare_arrived)(void* context, int64_t seq, int64_t t_ns);
typedef struct bare_chain bare_chain;

// Joins the domain with that configuration; `arrived` is called for each order where the last stage is one of `stages`.
// NULL where Cyclone refuses, which standard error then explains.
bare_chain* bare_chain_open(uint32_t domain_id, const char* xml, int stages, bare_arrived arrived, void* context);

// The sensor's sample, where the first stage is here. Returns 0, or Cyclone's error.
int bare_chain_write(const bare_chain* chain, int64_t seq, int64_t t_ns);

void bare_chain_close(bare_chain* chain);

#ifdef __cplusplus
}
#endif
