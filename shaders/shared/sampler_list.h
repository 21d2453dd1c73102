// Every sampler: its name in the scene language and its id; where the numbers of a sample come
// from.
#ifndef FACET_SHARED_SAMPLER_LIST_H
#define FACET_SHARED_SAMPLER_LIST_H

#define FACET_SAMPLER_LIST(SAMPLER) \
  SAMPLER(independent, 0)           \
  SAMPLER(sobol, 1)                 \
  SAMPLER(zsobol, 2)

#endif
