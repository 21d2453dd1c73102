// Every emitter, once: X(name, id). `name` is the scene language's type.
#ifndef FACET_SHARED_EMITTER_LIST_H
#define FACET_SHARED_EMITTER_LIST_H

#define FACET_EMITTER_LIST(X) \
  X(area, 0)                  \
  X(environment, 1)           \
  X(pointlight, 2)

#endif
