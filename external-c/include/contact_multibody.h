/* contact_multibody.h - the contact engine's C interface.
 *
 * Scenes are immutable once interned and shared by all threads; queries keep no state.
 * Every function may be called from any thread at any time.
 * SI units. All arrays and structures belong to the caller, arrays are row-major; no pointer is kept after a call, and none may be
 * NULL unless it is said so. Bodies and pairs are numbered from 1, as the Modelica library numbers them. */
#ifndef CONTACT_MULTIBODY_H
#define CONTACT_MULTIBODY_H

#include <stddef.h>

/* Visible outside of the shared library that the engine is linked into; the static archive defines it empty. */
#ifndef CMB_API
#if defined(__GNUC__) && !defined(_WIN32)
#define CMB_API __attribute__((visibility("default")))
#else
#define CMB_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* C++ compilers may take for granted that an enumeration holds its enumerators only, unless it has a base. */
#ifdef __cplusplus
#define CMB_ENUM(name) enum name : int
#else
#define CMB_ENUM(name) enum name
#endif

typedef CMB_ENUM(cmb_status) {
  CMB_OK = 0,
  CMB_ERROR_ARGUMENT = 1,   /* a NULL pointer, a wrong size, an unknown scene */
  CMB_ERROR_DESCRIPTOR = 2, /* a descriptor does not parse or its geometry is bad */
  CMB_ERROR_POSE = 3,       /* a pose is not finite or a rotation not orthonormal */
  CMB_ERROR_MEMORY = 4,
  CMB_ERROR_INTERNAL = 5    /* a back end failed and no other could answer */
} cmb_status;

/* Libraries are modules of their own (libContactMultiBodyLibccd.so, ...Fcl.so, ...Coal.so), loaded when a scene names them
 * first: from the folders of the environment variable CMB_MODULE_PATH, from the folder of the binary that holds the engine, or
 * from where the system looks for libraries. Where one is missing interning fails and says so. */
typedef CMB_ENUM(cmb_backend) {
  CMB_BACKEND_AUTO = 0,
  CMB_BACKEND_ANALYTIC = 1, /* the engine's own exact paths */
  CMB_BACKEND_LIBCCD = 2,
  CMB_BACKEND_FCL = 3,
  CMB_BACKEND_COAL = 4
} cmb_backend;

/* Handle of an interned scene. One that cmb_intern did not give, or whose scene is released, is refused. */
typedef struct cmb_scene {
  int number; /* positive; 0 is no scene */
} cmb_scene;

/* How many scenes there can be at a time. */
#define CMB_SCENE_LIMIT 65536

/* The distance, in m, of pairs that never touch: of a body without shape, of two half-spaces. */
#define CMB_DISTANCE_NONE 1e9

/* What a scene is made of. */
typedef struct cmb_scene_source {
  const char *const *geometry; /* [body_count] descriptors, none NULL; an empty one is a body without shape */
  size_t body_count;
  const int *pairs;            /* [pair_count][2] numbers of bodies; may be NULL if pair_count is 0 */
  size_t pair_count;
  cmb_backend backend;
  /* What file names in descriptors are relative to; no file outside of it is read, links resolved. "/" allows all files.
   * NULL or empty: descriptors that name files are refused. */
  const char *folder;
} cmb_scene_source;

/* Interns a scene: equal sources give the same handle, in every thread. Files are read now, once each; a scene that is
 * known already is not read again, even if its files have changed.
 * scene  receives the handle; unchanged on error. Not NULL.
 * The scene lives until it is released as often as it was interned, or the library is unloaded. */
CMB_API cmb_status cmb_intern(const cmb_scene_source *source, cmb_scene *scene);

/* Takes back one cmb_intern of this scene; after the last one its memory is freed, its handle is refused, and its place
 * can be taken by another scene. Broad phases keep their scenes. No other call may use the scene meanwhile.
 * Programs that make scenes without end need this; others need not release anything. */
CMB_API cmb_status cmb_release_scene(cmb_scene scene);

/* Writes a descriptor with the contents of the files it names in their place, for scenes that are to be interned where
 * the files are not. Geometry that cannot be interned is refused.
 * folder    as in cmb_scene_source
 * text      [capacity] receives the descriptor with its final NUL; unchanged where capacity is too small. May be NULL
 *           if capacity is 0.
 * length    receives the capacity needed. Not NULL. */
CMB_API cmb_status cmb_inline_files(const char *geometry, const char *folder, char *text, size_t capacity,
                                    size_t *length);

/* Where the bodies of a scene are. */
typedef struct cmb_poses {
  size_t body_count;
  const double *position; /* [body_count][3] m, of the frames' origins; may be NULL if body_count is 0 */
  const double *rotation; /* [body_count][3][3] world to body, Modelica's R.T; may be NULL if body_count is 0 */
} cmb_poses;

/* The caller's arrays for what a query finds; may be NULL if pair_count is 0. */
typedef struct cmb_contact_points {
  size_t pair_count;
  size_t point_capacity; /* slots per pair, >= 1; where a contact has more points they are merged so that the
                            force-carrying sums stay the same */
  double *distance;      /* [pair_count]                    signed distance, m; negative when penetrating */
  double *depth;         /* [pair_count][point_capacity]    m, >= 0; 0 in unused slots */
  double *weight;        /* [pair_count][point_capacity]    1, >= 0; 0 in unused slots */
  double *normal;        /* [pair_count][point_capacity][3] unit, world axes, from the second body towards the first */
  double *point;         /* [pair_count][point_capacity][3] m, world axes */
} cmb_contact_points;

/* Evaluates all pairs of a scene. The arrays are unchanged where an argument or the first pose that is wrong is refused.
 * exact_within  a length in m, > 0; HUGE_VAL: distances are exact everywhere. A finite one is cheaper for pairs that are far
 *               apart. With g, the larger of the gaps between the bounding spheres and between the bounding boxes of two
 *               shapes (or of a shape and a half-space), which is never more than their distance d where they are apart,
 *               such a pair's distance counts as
 *                 d                     where g <= exact_within,
 *                 g                     where g >= 2 exact_within,
 *                 d + s (g - d)         between, s = 3 x^2 - 2 x^3 with x = g/exact_within - 1;
 *               the normal and the point of unused slots fade to the line of the spheres' centres. Of compounds without
 *               half-spaces the same holds once more, with the bounds of the whole bodies in the place of g, and in the place of
 *               d what their shapes give: far apart no shape is looked at. The distance is
 *               continuous, never more than d, and its sign is that of d: contacts, and events at the crossing of zero,
 *               are the exact ones. What it is not is a clearance to be read off. */
CMB_API cmb_status cmb_query_scene(cmb_scene scene, const cmb_poses *poses, double exact_within,
                                   const cmb_contact_points *points);

/* The same for one pair of a scene, exactly; points->pair_count is 1. */
CMB_API cmb_status cmb_query_pair(cmb_scene scene, size_t pair, const cmb_poses *poses,
                                  const cmb_contact_points *points);

/* Which back end answers for the nearest shapes of a pair at these poses; CMB_BACKEND_AUTO where
 * a body has no shape. The engine asks the scene's back end, whose answer counts as it is, and answers itself
 * (CMB_BACKEND_ANALYTIC) where that is missing or contradicts itself. backend is unchanged on error. Not NULL. */
CMB_API cmb_status cmb_query_backend(cmb_scene scene, size_t pair, const cmb_poses *poses, cmb_backend *backend);

/* How often, in all threads since the scene was interned, the library it names as back end gave an answer that
 * held, and how often that was missing or contradicted itself; 0 for the engine's own back end, which is not counted.
 * answered, refused: unchanged on error. Not NULL. */
CMB_API cmb_status cmb_backend_counts(cmb_scene scene, unsigned long long *answered, unsigned long long *refused);

/* The thickness of the thinner body of a pair, in m: the least extent along its own axes of the thinnest of its shapes. Contacts deeper than
 * half of it may push the bodies out on the other side. CMB_DISTANCE_NONE where neither body has one: half-spaces, open
 * meshes and bodies without shape. thickness is unchanged on error. Not NULL. */
CMB_API cmb_status cmb_pair_thickness(cmb_scene scene, size_t pair, double *thickness);

/* The overlap of a pair as a solid. Parts of compounds are added up. */
typedef struct cmb_overlap {
  int known;                /* 1, or 0 where a mesh that is not closed, as height fields are, touches: sheets have no volume.
                               Everything is 0 then, and where nothing overlaps. */
  double volume;            /* m3 */
  double centroid[3];       /* m, world axes */
  double patch_area;        /* m2, of the overlap seen along the contact normal; where a line along it enters the
                               overlap of a mesh several times it counts as often */
  double patch_centroid[3]; /* m, world axes; along the normal half way between the overlap's two sides */
  double patch_moment[9];   /* m4, row-major: integral of r r^T over that patch, r in its plane from patch_centroid */
} cmb_overlap;

/* The overlap of one pair. overlap is unchanged on error. Not NULL. Slower than a contact query. */
CMB_API cmb_status cmb_query_overlap(cmb_scene scene, size_t pair, const cmb_poses *poses, cmb_overlap *overlap);

/* Text of a status; never NULL, static storage. */
CMB_API const char *cmb_status_text(cmb_status status);

/* What went wrong in this thread's last failed call, with descriptor and column where it applies;
 * never NULL, valid until this thread's next failing call. */
CMB_API const char *cmb_last_error(void);

/* "major.minor.patch", static storage. */
CMB_API const char *cmb_version(void);

#ifdef __cplusplus
}
#endif

#endif
