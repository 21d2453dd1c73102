// The records that host and kernels exchange. One definition each; of those that kernels see as
// they are, a test compares the offsets with C++'s. The scene's they read texel by texel
// (shaders/lib/records.glsl).
#ifndef FACET_SHARED_RECORDS_H
#define FACET_SHARED_RECORDS_H
#include "types.h"
FACET_SHARED_BEGIN

/// No triangle was hit; also: no emitter, no normals.
FACET_CONSTANT uint NONE = 0xffffffffu;

// The BVH is one array of items of 48 bytes, each a node or one or two triangles, fetched as three
// RGBA32UI texels. A node's four children are the items of one block, four in a row: inner nodes
// first, then triangles. So whether child c is a leaf, and where it lies, follows from the node's
// header alone. Item 0 is a triangle that no ray hits: what kernels without branches look at where
// there is nothing to look at.

FACET_CONSTANT uint ROOT_ITEM = 1u;

/// Levels of a tree, and its blocks, that the stack of a traversal has bits for.
FACET_CONSTANT uint LARGEST_STACK_SIZE = 32u;
FACET_CONSTANT uint LARGEST_BLOCK_COUNT = 1u << 22u;
FACET_CONSTANT uint BLOCK_SIZE = 4u;
/// A node's header: the block of its children above the number of those that are inner nodes.
FACET_CONSTANT uint HEADER_INNER_BITS = 3u;
FACET_CONSTANT uint HEADER_INNER_MASK = 7u;

/// An item: the bits of a node, or of the coordinates of four corners, world space. The corners'
/// triangles, which have an edge in common, are 0, 1, 2 and 0, 2, 3; where there is one triangle
/// only, corner 3 is corner 2 once more. Bits and no floats, since some, taken for floats, would be
/// denormals, which a device may flush.
struct BvhItem {
  uvec4 texels[3];
};

/// A node. A child's box along axis a is [origin[a] + lo * 2^e[a], origin[a] + hi * 2^e[a]], lo and
/// hi being bytes of `lower` and `upper`.
struct BvhNode {
  uvec4
      origin_exponents;  // x, y, z: bits of the floats; w: byte a is the biased exponent of axis a
  uvec4 lower_header;    // x, y, z: byte c is child c's lower plane; w: the header
  uvec4 upper;           // x, y, z: byte c is child c's upper plane; w: unused
};

/// What the two triangles of an item are in the scene; triangle h of item i has place 2 * i + h. A
/// name: a triangle's index in the scene, in order of reading, below two bits for each of its
/// vertices, in order of reading: which corner it is.
struct PairRecord {
  uint name0;
  uint name1;
  uint mesh0;
  uint mesh1;
};
FACET_CONSTANT uint NAME_INDEX_BITS = 26u;
FACET_CONSTANT uint NAME_INDEX_MASK = 0x03ffffffu;

struct MeshRecord {
  uint bsdf;
  uint emitter;     // NONE for a mesh that does not emit
  uint attributes;  // a triangle's index in the scene, less this, is that of its normals' and
                    // texture coordinates' indices; NONE without any
  uint unused0;
};

// Flags of a BSDF.
FACET_CONSTANT uint BSDF_DELTA = 1u;          // scatters into single directions only
FACET_CONSTANT uint BSDF_TRANSMITS = 2u;      // has a lower side
FACET_CONSTANT uint BSDF_GGX = 4u;            // GGX instead of Beckmann
FACET_CONSTANT uint BSDF_EXACT_MASKING = 8u;  // Smith's G1 instead of Walter's rational one
FACET_CONSTANT uint BSDF_CONDUCTOR = 16u;     // Fresnel term of a conductor instead of Schlick's
FACET_CONSTANT uint BSDF_MULTISCATTER = 32u;  // energy of multiple scattering is given back
/// Those that only rough BSDFs know.
FACET_CONSTANT uint BSDF_ROUGH_FLAGS = 60u;

// Tables of albedos (host/scene/bsdf/albedo_table.h), one after another.
FACET_CONSTANT uint ALBEDO_NODES = 32u;
FACET_CONSTANT uint ALBEDO_BECKMANN_RATIONAL = 0u;
FACET_CONSTANT uint ALBEDO_BECKMANN_EXACT = 1u;
FACET_CONSTANT uint ALBEDO_GGX = 2u;

// Where parameters lie in `a`, `b` and `c` follows from their declaration in host/scene
// (host/render/pack/record_layout.h); shaders read them by macros (roughsubstrate_kd).
/// A texture's value takes the place of the constant; NONE: none does.
struct BsdfRecord {
  uint type;  // id of bsdf_list.h
  uint flags;
  uint texture_a;      // for a.rgb
  uint texture_b;      // for b.rgb
  uint texture_alpha;  // its luminance for a.w
  uint unused0;
  uint unused1;
  uint unused2;
  vec4 a;
  vec4 b;
  vec4 c;
};

/// A texture: a checker, or an image.
struct TextureRecord {
  vec4 a;
  vec4 b;
  uint width;  // texels; 0: a checker
  uint height;
  uint first_texel;  // index into the texels, each 0x00bbggrr, or three words of the bits of floats
  uint decoding;     // index of the image's table of 256 values of a byte; NONE: floats
};

struct EmitterRecord {
  vec4 a;
  vec4 b;
  uint type;        // id of emitter_list.h
  uint cumulative;  // the emitter is chosen by the words below this and not below its predecessor's
                    // (docs/reference/sampling.md)
  uint first_triangle;  // range of emitter_triangles or, where there is a light tree, of
                        // emitter_places: all triangles of the mesh, in order of reading
  uint triangle_count;
  float probability;  // of being chosen
  uint texture_a;     // its value is a factor on a.rgb; NONE: none
  uint first_index;   // index in the scene of the mesh's first triangle
  uint unused1;
};

/// One triangle of an area emitter's mesh, in the order of reading or, where there is a light tree,
/// of its leaves. Two that are sampled as one are chosen by the second's words; the first has
/// none.
struct EmitterTriangle {
  uint cumulative;  // it is chosen by the words below this and not below its predecessor's
  uint triangle;    // its place in the BVH
  float density;    // of its points, m^-2: the probability of its choice over its area; with a
                    // light tree, once its leaf is chosen
  uint corner;      // of two, the one that their common edge misses, of the first of them with
                    // FIRST_OF_TWO beside it; NO_CORNER: sampled by itself
};
FACET_CONSTANT uint NO_CORNER = 3u;
FACET_CONSTANT uint FIRST_OF_TWO = 4u;
FACET_CONSTANT uint CORNER_MASK = 3u;

// Solid angles, sr, between which the points of a piece of an emitting mesh are sampled by it: of
// smaller pieces, area is as good, and larger ones are those that the point all but lies on.
FACET_CONSTANT float SMALLEST_SEEN = 0.001f;
FACET_CONSTANT float LARGEST_SEEN = 6.0f;

/// Where a triangle of an area emitter is in the light tree's order.
struct EmitterPlace {
  uint triangle;  // index of its record among emitter_triangles
  uint leaf;      // index of its node
  uint unused0;
  uint unused1;
};

/// A node of the light tree; the root is the first, and siblings lie side by side.
struct LightNode {
  vec4 sphere;   // xyz: centre, w: radius of a sphere that holds what emits, world space
  vec4 cone;     // xyz: axis, w: cosine of the half angle of a cone that holds its normals
  float energy;  // share of the whole tree's
  uint parent;   // NONE: the root
  uint first;  // of a leaf's emitter triangles, or its point light's emitter; else the first child
  uint count;  // of a leaf's emitter triangles; LIGHT_POINT: a point light; 0: an inner node
};
FACET_CONSTANT uint LIGHT_POINT = 0xffffffffu;
/// Most levels below the root.
FACET_CONSTANT uint LIGHT_TREE_DEPTH = 60u;
/// Added to the cosines of an importance: room for rounding, so that nothing that contributes is 0.
FACET_CONSTANT float LIGHT_SLACK = 1e-4f;
/// The fill of a level of the tree is the one above it times this, and this more.
FACET_CONSTANT uint LIGHT_FILL_FACTOR = 747796405u;
FACET_CONSTANT uint LIGHT_FILL_STEP = 2891336453u;

/// A row of cells of the environment's sampling density; y is the direction's y.
struct EnvironmentRow {
  uint cumulative;
  float y_begin;
  float y_end;
  uint unused0;
};

/// What stays the same for a whole render.
struct FrameRecord {
  vec4 camera_origin;  // world space; w: nearClip
  vec4 camera_corner;  // direction through the image's upper left corner, camera's z = 1, world
                       // space; w: farClip
  vec4 camera_dx;      // change of that direction per pixel to the right
  vec4 camera_dy;      // change per pixel downwards
  uint width;          // of the whole image, pixels
  uint height;
  uint crop_x;
  uint crop_y;
  uint crop_width;
  uint crop_height;
  float environment_irradiance;  // on a surface that sees all of the half above it, W m^-2, over
                                 // the energy of the light tree
  uint max_depth;                // surface interactions, NONE: unlimited
  uint emitter_count;
  uint environment_emitter;  // index of the environment, NONE without
  uint environment_width;    // texels
  uint environment_height;
  uint filter_intervals;
  float filter_crossing;  // |offset| beyond which the filter is negative, pixels
  float filter_scale;     // integral of |f| over integral of f, along one axis
  float square_scale;     // power of two that values are multiplied by before they are squared:
                          // squares stay in range
  vec4 simple_position;   // of the `simple` integrator's light, world space
  vec4 simple_energy;     // rgb: its energy over 4 pi^2
};

struct RayRecord {
  vec4 origin;     // world space; w: t_min
  vec4 direction;  // world space; w: t_max
};

struct HitRecord {
  float t;        // in lengths of the ray's direction
  uint triangle;  // NONE: a miss
  float b1;       // barycentric weights of v1 and v2
  float b2;
};

/// Stands for the density of a delta lobe.
FACET_CONSTANT float DELTA_PDF = -1.0f;

struct PathRecord {
  vec4 throughput;  // rgb; w: pdf of the BSDF sample that made the ray, sr^-1, or DELTA_PDF
  vec4 radiance;    // rgb, W sr^-1 m^-2; w: eta^2, what refraction has taken from the throughput
};

/// One pixel: sums over samples, each as an unevaluated sum hi + lo of two floats.
struct FilmRecord {
  float hi_r;
  float hi_g;
  float hi_b;
  uint samples;
  float lo_r;
  float lo_g;
  float lo_b;
  uint nonzero;  // samples whose value is not zero
};

/// A pass: which pixels and samples the slots stand for (push constants).
struct PassConstants {
  uint first_pixel;  // within the crop or, where pixels are listed, the list
  uint pixel_count;
  uint first_sample;
  uint sample_count;  // per pixel
  uint bounce;        // 0: rays from the camera
  uint queue;         // 0 or 1: which half of the queues is read
  uint stride;  // of the permutation that spreads the pixels' tiles over the dispatch, coprime to
                // their number
  uint film_first;  // crop pixel of the film's first record
  uint film_begin;  // samples of the pass that film.comp adds: [film_begin, film_end)
  uint film_end;
  uint emitter;     // that a round of a bounce samples, where every emitter is sampled
  uint seed;        // of the random numbers
  uint order_bits;  // of the sampler's nets: zsobol
};

/// What is asked of one BSDF (evaluate.comp, sample.comp).
struct EvaluationRecord {
  vec4 wo;            // of all samples, shading frame
  uint count;         // queries or samples
  uint first_sample;  // their numbers are those of pixel 0 and of the samples from here on,
  uint seed;
  uint given;  // unless this is 1: then the queries hold numbers and wo of each
};

/// A pair of directions in the shading frame, or what a sample is made from.
struct QueryRecord {
  vec4 first;   // wo; or the numbers lobe, u, v
  vec4 second;  // wi; or wo
};

/// Counters, one buffer. The three words at INDIRECT_PATHS are a VkDispatchIndirectCommand.
FACET_CONSTANT uint COUNTER_ACTIVE = 0u;        // two words: paths in each queue
FACET_CONSTANT uint COUNTER_CLOSEST_RAYS = 3u;  // rays traced since the pass began
FACET_CONSTANT uint COUNTER_ANY_RAYS = 4u;
FACET_CONSTANT uint COUNTER_BOUND_HITS = 5u;
FACET_CONSTANT uint COUNTER_BAD_SAMPLES = 6u;
FACET_CONSTANT uint INDIRECT_PATHS = 8u;
FACET_CONSTANT uint COUNTER_WORDS = 12u;

FACET_SHARED_END

#ifdef __cplusplus
namespace facet::shared {
static_assert(sizeof(BvhNode) == 48 && sizeof(PairRecord) == 16 && sizeof(BvhItem) == 48 &&
              sizeof(MeshRecord) == 16);
static_assert(sizeof(BsdfRecord) == 80 && sizeof(EmitterRecord) == 64 &&
              sizeof(EmitterTriangle) == 16 && sizeof(LightNode) == 48 &&
              sizeof(EmitterPlace) == 16);
static_assert(sizeof(TextureRecord) == 48);
static_assert(sizeof(EnvironmentRow) == 16 && sizeof(FrameRecord) == 160 &&
              sizeof(RayRecord) == 32);
static_assert(sizeof(HitRecord) == 16 && sizeof(PathRecord) == 32);
static_assert(sizeof(FilmRecord) == 32 && sizeof(PassConstants) == 52);
static_assert(sizeof(EvaluationRecord) == 32 && sizeof(QueryRecord) == 32);
static_assert(offsetof(FrameRecord, width) == 64 && offsetof(FrameRecord, emitter_count) == 96);
static_assert(offsetof(EmitterRecord, type) == 32 && offsetof(EmitterRecord, probability) == 48);
}  // namespace facet::shared
#endif
#endif
