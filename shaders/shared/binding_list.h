// Every binding, once: X(number, kind, names, name, Record). From it follow the numbers
// (bindings.h), the kernels' buffers and how they read records (shaders/lib/bindings.glsl;
// `fetch_name(i)`), the host's arrays (host/render/pack/packed_scene.h), layouts and uploads
// (host/render/bindings.h). `names` is the array, `name` one record of it.
//
// Kinds:
// - scene: read only. Texel buffers of four words, or storage buffers where a device's texel
// buffers are too
//   small.
// - uniform: one record. The one kind that lavapipe reads once for all lanes.
// - state: written as storage, and read as texels through a second binding of the same memory,
// where texel
//   buffers are large enough. (Written as texels they were slower.) A kernel therefore reads a
//   record before it writes it, and never after.
// - storage: read and written as storage.
#ifndef FACET_SHARED_BINDING_LIST_H
#define FACET_SHARED_BINDING_LIST_H

#define FACET_BINDING_LIST(X)                                       \
  X(0, scene, items, item, BvhItem)                                 \
  X(1, scene, pairs, pair, PairRecord)                              \
  X(2, scene, normal_indices, normal_indices, uvec4)                \
  X(3, scene, normals, normal, vec4)                                \
  X(4, scene, meshes, mesh, MeshRecord)                             \
  X(5, scene, bsdfs, bsdf, BsdfRecord)                              \
  X(6, scene, emitters, emitter, EmitterRecord)                     \
  X(7, scene, emitter_triangles, emitter_triangle, EmitterTriangle) \
  X(8, scene, environment_texels, environment_texel, vec4)          \
  X(9, scene, environment_rows, environment_row, EnvironmentRow)    \
  X(10, scene, environment_columns, environment_column, uint)       \
  X(11, scene, filter_intervals, filter_interval, vec4)             \
  X(12, scene, texcoord_indices, texcoord_indices, uvec4)           \
  X(13, scene, texcoords, texcoord, vec2)                           \
  X(14, scene, textures, texture, TextureRecord)                    \
  X(15, scene, texels, image_word, uint)                            \
  X(16, scene, albedos, albedo, float)                              \
  X(17, scene, light_nodes, light_node, LightNode)                  \
  X(18, scene, emitter_places, emitter_place, EmitterPlace)         \
  X(19, uniform, frames, frame, FrameRecord)                        \
  X(20, state, rays, ray, RayRecord)                                \
  X(21, state, hits, hit, HitRecord)                                \
  X(22, state, paths, path, PathRecord)                             \
  X(23, state, film, film, FilmRecord)                              \
  X(24, state, film_squares, film_squares, FilmRecord)              \
  X(25, state, listed_pixels, listed_pixel, uint)                   \
  X(26, storage, queues, queue, uint)                               \
  X(27, storage, counters, counter, uint)                           \
  X(28, uniform, evaluations, evaluation, EvaluationRecord)         \
  X(29, storage, queries, query, QueryRecord)                       \
  X(30, storage, values, value, vec4)                               \
  X(31, storage, weights, weight, vec4)

#endif
