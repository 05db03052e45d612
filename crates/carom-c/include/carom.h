// Carom: spheres under forces that collide with each other and with surfaces, exactly.
//
// Right-handed coordinate system, y up, SI units. docs/c.md is the guide.
//
// Every function but a few ends in a CaromStatus. After any status but CAROM_STATUS_OK, carom_last_error() says what
// was wrong, and the world is as it was before the call.
//
// Pointers: null is refused, unless a function says what it means. Any other pointer must lead to what the function says:
// to one value, to a text that ends in a zero, or to as many rows as are counted beside it, each `stride` bytes after the
// one before. It may be unaligned. Only during a call does the library use it; what it is given it copies.
//
// Handles (CaromWorld, CaromSnapshot) are never given twice: one that was freed is refused.
//
// Made by `cargo xtask header`; do not edit.

#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

/// The version of the interface that this header declares. Within one version functions are only added:
/// structures, constants and what functions take stay as they are.
#define CAROM_ABI_VERSION 2

/// How a call ended. After any status but CAROM_STATUS_OK the world is as it was before the call, unless
/// the function says otherwise, and carom_last_error() says what was wrong.
enum CaromStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Done.
    CAROM_STATUS_OK = 0,
    /// A pointer is null, or a handle is zero.
    CAROM_STATUS_NULL = 1,
    /// A handle names nothing: what it named was freed, or it was never given.
    CAROM_STATUS_HANDLE = 2,
    /// The world is in the middle of another call: of another thread, or of the one that called the
    /// function of a force.
    CAROM_STATUS_BUSY = 3,
    /// A count, capacity or stride does not fit.
    CAROM_STATUS_LENGTH = 4,
    /// A text is not UTF-8, or a constant is none of its enumeration.
    CAROM_STATUS_ARGUMENT = 5,
    /// A number makes no sense: not finite, negative where it must not be, ...
    CAROM_STATUS_INVALID = 6,
    /// An id names nothing in this world, or no scene has this name.
    CAROM_STATUS_UNKNOWN = 7,
    /// The text of a scene makes no sense; the message names line and field.
    CAROM_STATUS_SCENE = 8,
    /// The step was refused: a number would overflow, or there are more impacts than are allowed.
    CAROM_STATUS_STEP = 9,
    /// The step was stopped by carom_world_set_stop().
    CAROM_STATUS_STOPPED = 10,
    /// Bytes are no snapshot, or the snapshot has no bytes.
    CAROM_STATUS_SNAPSHOT = 11,
    /// There is not enough memory.
    CAROM_STATUS_MEMORY = 12,
    /// The program was compiled for another version of the interface.
    CAROM_STATUS_ABI = 13,
    /// A fault of the engine. The world can only be freed.
    CAROM_STATUS_PANIC = 14,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromStatus CaromStatus;
#else
typedef int32_t CaromStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A quantity that all spheres have.
enum CaromQuantity
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Centres [m]: 3 numbers.
    CAROM_QUANTITY_POSITIONS = 0,
    /// Velocities [m/s]: 3 numbers.
    CAROM_QUANTITY_VELOCITIES = 1,
    /// Radii [m]: 1 number.
    CAROM_QUANTITY_RADII = 2,
    /// Masses [kg]: 1 number.
    CAROM_QUANTITY_MASSES = 3,
    /// Coefficients of restitution: 1 number.
    CAROM_QUANTITY_RESTITUTIONS = 4,
    /// How spheres are turned: 4 numbers, a quaternion x, y, z, w.
    CAROM_QUANTITY_ORIENTATIONS = 5,
    /// Angular velocities [rad/s]: 3 numbers.
    CAROM_QUANTITY_ANGULAR_VELOCITIES = 6,
    /// Moments of inertia divided by m r^2: 1 number.
    CAROM_QUANTITY_INERTIA_FACTORS = 7,
    /// Coefficients of friction: 1 number, not a number where nothing is said.
    CAROM_QUANTITY_FRICTIONS = 8,
    /// Coefficients of rolling friction: 1 number, not a number where nothing is said.
    CAROM_QUANTITY_ROLLING_FRICTIONS = 9,
    /// Coefficients of spinning friction: 1 number, not a number where nothing is said.
    CAROM_QUANTITY_SPINNING_FRICTIONS = 10,
    /// Coefficients of tangential restitution: 1 number, not a number where nothing is said.
    CAROM_QUANTITY_TANGENTIAL_RESTITUTIONS = 11,
    /// Forces [N] of their own, which act until they are set again, or taken away by writing no rows: 3 numbers.
    CAROM_QUANTITY_APPLIED_FORCES = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromQuantity CaromQuantity;
#else
typedef int32_t CaromQuantity;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// The form of a collider in its own frame.
enum CaromShape
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// A sphere of `radius`.
    CAROM_SHAPE_SPHERE = 0,
    /// A rectangle of size[0] by size[2] in the local xz plane, which faces local +y; from behind spheres pass it.
    CAROM_SHAPE_RECTANGLE = 1,
    /// Everything below the local xz plane.
    CAROM_SHAPE_HALF_SPACE = 2,
    /// A box of `size`.
    CAROM_SHAPE_BOX = 3,
    /// A hollow box of `size`, off whose walls spheres bounce on either side; without the walls of `open_sides`.
    CAROM_SHAPE_CONTAINER = 4,
    /// A form that only the text of a scene can give. carom_world_set_collider() leaves it as it is.
    CAROM_SHAPE_OTHER = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromShape CaromShape;
#else
typedef int32_t CaromShape;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A side of a box in its own frame: a bit of `open_sides`.
enum CaromSide
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Towards -x.
    CAROM_SIDE_LEFT = 1,
    /// Towards +x.
    CAROM_SIDE_RIGHT = 2,
    /// Towards -y.
    CAROM_SIDE_BOTTOM = 4,
    /// Towards +y.
    CAROM_SIDE_TOP = 8,
    /// Towards -z.
    CAROM_SIDE_BACK = 16,
    /// Towards +z.
    CAROM_SIDE_FRONT = 32,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromSide CaromSide;
#else
typedef int32_t CaromSide;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A list of ids.
enum CaromList
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Spheres, ascending: the order of all arrays.
    CAROM_LIST_SPHERES = 0,
    /// Colliders, in their order.
    CAROM_LIST_COLLIDERS = 1,
    /// Forces, in the order in which they add up.
    CAROM_LIST_FORCES = 2,
    /// Emitters, in the order in which they emit.
    CAROM_LIST_EMITTERS = 3,
    /// Spheres that emitters put into the world in the last step, ascending.
    CAROM_LIST_EMITTED = 4,
    /// Spheres that emitters took out of the world in the last step.
    CAROM_LIST_RETIRED = 5,
    /// Ids of spheres that emitters left out in the last step, for there was no room: no sphere ever has them.
    CAROM_LIST_LEFT_OUT = 6,
    /// Springs, in the order in which their forces add up.
    CAROM_LIST_SPRINGS = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromList CaromList;
#else
typedef int32_t CaromList;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A world, by a handle that is never given twice. Zero is no world.
///
/// One thread at a time may use a world: a call while another is at work on it ends in CAROM_STATUS_BUSY. Different
/// worlds are independent.
typedef struct {
    /// The handle.
    uint64_t id;
} CaromWorld;

/// What carom_world_add_toml() has added. Ids of each kind follow one another: those of the spheres are
/// first_sphere, first_sphere + 1, ...
typedef struct {
    /// Id of the first sphere.
    uint64_t first_sphere;
    /// Number of spheres.
    uint64_t spheres;
    /// Id of the first collider.
    uint64_t first_collider;
    /// Number of colliders.
    uint64_t colliders;
    /// Id of the first force.
    uint64_t first_force;
    /// Number of forces.
    uint64_t forces;
    /// Id of the first emitter.
    uint64_t first_emitter;
    /// Number of emitters.
    uint64_t emitters;
} CaromAdded;

/// A sphere. carom_sphere() makes one with usual values.
typedef struct {
    /// Centre [m].
    double position[3];
    /// Velocity [m/s].
    double velocity[3];
    /// Radius [m], > 0.
    double radius;
    /// Mass [kg], > 0.
    double mass;
    /// Density [kg/m^3], which makes the mass; 0 leaves it to `mass`. A world tells 0.
    double density;
    /// Coefficient of restitution in [0, 1].
    double restitution;
    /// Coefficient of friction, >= 0; not a number (NAN) leaves it to what the sphere touches.
    double friction;
    /// Coefficient of rolling friction, as `friction`.
    double rolling_friction;
    /// Coefficient of spinning friction, as `friction`.
    double spinning_friction;
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    double tangential_restitution;
    /// How it is turned: a quaternion x, y, z, w, of any length but zero.
    double orientation[4];
    /// Angular velocity, along the axis [rad/s].
    double angular_velocity[3];
    /// Moment of inertia divided by m r^2, > 0: 2/5 for a solid ball, 2/3 for a thin shell.
    double inertia_factor;
} CaromSphere;

/// A collider: a shape that never gives way, at rest or moved. carom_collider() makes one with usual values.
typedef struct {
    /// The form (CaromShape).
    int32_t shape;
    /// 1 for a trigger, which reports spheres and deflects none; 0 for a solid collider.
    uint32_t trigger;
    /// Walls that a container does not have: bits (CaromSide).
    uint32_t open_sides;
    /// 0.
    uint32_t reserved;
    /// Radius of a sphere [m], > 0.
    double radius;
    /// Full lengths along local x, y, z [m], each > 0 where the shape has it.
    double size[3];
    /// Origin of the local frame [m].
    double position[3];
    /// Rotation from the local frame to the world: a quaternion x, y, z, w, of any length but zero.
    double rotation[4];
    /// Velocity of the origin [m/s]: steps move the collider on.
    double velocity[3];
    /// Angular velocity about the origin, along the axis [rad/s].
    double angular_velocity[3];
    /// Coefficient of restitution in [0, 1].
    double restitution;
    /// Coefficient of friction, >= 0; not a number (NAN) leaves it to what touches the collider.
    double friction;
    /// Coefficient of rolling friction, as `friction`.
    double rolling_friction;
    /// Coefficient of spinning friction, as `friction`.
    double spinning_friction;
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    double tangential_restitution;
} CaromCollider;

/// What a force may depend on.
typedef struct {
    /// Centre [m].
    double position[3];
    /// Velocity [m/s].
    double velocity[3];
    /// Radius [m].
    double radius;
    /// Mass [kg].
    double mass;
} CaromSphereState;

/// Writes the force [N] on a sphere in this state, at this time [s], to the three numbers of `force`.
typedef void (*CaromForceFunction)(const CaromSphereState *sphere, double time, double *force, void *user_data);

/// The potential energy [J] of a sphere in this state, at this time [s].
typedef double (*CaromPotentialFunction)(const CaromSphereState *sphere, double time, void *user_data);

/// Lets go of what a force has used.
typedef void (*CaromDestroyFunction)(void *user_data);

/// A force that is a function of the program. It must depend on nothing but its arguments and `user_data`, must return
/// (no exception, no longjmp), and must not use the world that it acts in.
///
/// The thread that steps a world calls it; so do others where the library was built with the feature `rayon`. For the
/// same bits everywhere it must use no function whose result depends on the platform (sin, exp, ...). Under the rule
/// `exact` such a force is held constant from one force tick to the next.
typedef struct {
    /// The force.
    CaromForceFunction force;
    /// Its potential energy; null for none.
    CaromPotentialFunction potential_energy;
    /// What the functions get.
    void *user_data;
    /// Called once, when no world and no snapshot has the force any more; null for nothing to be done. Only a force
    /// that was added is destroyed.
    CaromDestroyFunction destroy;
} CaromForce;

/// A spring with a damper beside it, between the centres of two spheres or from one to a fixed point. At the length l
/// it pulls with stiffness (l - rest_length) + damping dl/dt. It goes with either sphere. carom_spring() makes one
/// with usual values.
typedef struct {
    /// Id of the sphere at its first end.
    uint64_t sphere;
    /// Id of the sphere at its second end, another one; not read where `to_point` is 1.
    uint64_t other;
    /// 1 for a spring that ends at `point`, 0 for one that ends at the sphere `other`.
    uint32_t to_point;
    /// 1 for a thread, which only pulls: it is slack up to its rest length; 0 for a spring that pushes, too.
    uint32_t only_pulls;
    /// The fixed point [m]; not read where `to_point` is 0.
    double point[3];
    /// Length without force [m], >= 0.
    double rest_length;
    /// Stiffness [N/m], >= 0.
    double stiffness;
    /// Damping [kg/s], >= 0.
    double damping;
} CaromSpring;

/// The last step in numbers.
typedef struct {
    /// Impacts.
    uint64_t impacts;
    /// Under the rule `exact`: spheres that were in a stepped zone at the end of the step, not moved from impact to
    /// impact.
    uint64_t zone_spheres;
    /// Under the rule `exact`: 1 if spheres were in stepped zones in any step so far, or 0.
    uint64_t was_stepped;
    /// Under the rule `bisect`: groups of spheres in which two bodies met as often as they may in a frame.
    uint64_t unfinished_islands;
    /// Under the rule `contact`: spheres that sleep at the end of the step.
    uint64_t asleep;
    /// Under the rule `contact`: how often a sphere was pressed into a surface by half its radius, in each sub-step.
    uint64_t squeezed;
    /// Work of contacts [J]: what restitution and friction took.
    double contact_work;
    /// Work of moving colliders [J].
    double collider_work;
    /// Work of moving spheres out of what they overlap [J].
    double correction_work;
    /// Energy of emitted spheres, less that of those taken out [J]. The total energy changes by these four, by the
    /// work of forces without a potential, and by the error of the integration.
    double emission_energy;
    /// Under the rule `contact`: largest change of an impulse in the last sweep, as a part of the largest impulse.
    double residual;
    /// Under the rule `contact`: largest overlap before it was corrected, as a part of the sum of radii.
    double largest_overlap;
} CaromReport;

/// Two bodies: two spheres, or a collider and a sphere.
typedef struct {
    /// Id of body 1: a collider, or the sphere with the smaller id.
    uint64_t body_1;
    /// Id of body 2: a sphere.
    uint64_t body_2;
    /// 1 if body 1 is a collider, 0 if it is a sphere.
    uint64_t body_1_is_collider;
} CaromBodyPair;

/// One impact.
typedef struct {
    /// Time since the start of the step [s].
    double time;
    /// The two bodies.
    CaromBodyPair bodies;
    /// Where on the surface of body 1 [m].
    double point[3];
    /// Unit normal from body 1 to body 2.
    double normal[3];
    /// Speed of approach along the normal before the impact [m/s], > 0.
    double approach_speed;
    /// Speed of separation along the normal after it, and after all others at the same instant in its group [m/s].
    double separation_speed;
    /// Impulse on body 2 along the normal, and against it on body 1 [N s].
    double impulse;
    /// Impulse of friction on body 2, and against it on body 1, across the normal [N s].
    double tangential_impulse[3];
} CaromImpact;

/// A contact that persists from step to step.
typedef struct {
    /// The two bodies.
    CaromBodyPair bodies;
    /// Where on the surface of body 1 [m].
    double point[3];
    /// Unit normal from body 1 to body 2.
    double normal[3];
    /// Distance of the two surfaces [m], negative where they overlap.
    double gap;
    /// Force along the normal on body 2 [N], >= 0; body 1 feels the opposite one.
    double normal_force;
    /// Force of friction on body 2, across the normal [N].
    double tangential_force[3];
    /// 1 if the surfaces slide on each other, or would at the least touch; or 0.
    uint64_t is_sliding;
} CaromContact;

/// A sphere inside a trigger at the end of the last step.
typedef struct {
    /// Id of the trigger.
    uint64_t collider;
    /// Id of the sphere.
    uint64_t sphere;
    /// Unit normal from the trigger's surface to the sphere.
    double normal[3];
    /// Where on the trigger's surface [m].
    double point[3];
} CaromTrigger;

/// Sums over all spheres.
typedef struct {
    /// Kinetic energy [J], that of rotation included.
    double kinetic_energy;
    /// Kinetic energy of rotation [J].
    double rotational_energy;
    /// Potential energy [J] in all forces that have one.
    double potential_energy;
    /// Momentum [kg m/s].
    double momentum[3];
    /// Angular momentum about the origin [kg m^2/s], that of spin included.
    double angular_momentum[3];
} CaromTotals;

/// Two bodies that overlap.
typedef struct {
    /// The two bodies.
    CaromBodyPair bodies;
    /// How far their surfaces overlap [m], > 0.
    double depth;
} CaromOverlap;

/// The state of a world at one moment, by a handle that is never given twice. Zero is no snapshot.
typedef struct {
    /// The handle.
    uint64_t id;
} CaromSnapshot;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// The version of Carom, like "0.1.0".
const char *carom_version(void);

/// The version of the interface that the library has.
uint32_t carom_abi_version(void);

/// Checks that the library has the interface that a program was compiled for: call it first, with
/// CAROM_ABI_VERSION.
CaromStatus carom_check_abi(uint32_t version);

/// What was wrong in the last call of this thread that was refused, in UTF-8; empty if none was. The text
/// holds until the next refused call of this thread.
const char *carom_last_error(void);

/// The name of a status, as in CAROM_STATUS_OK: "ok", "null", ...; "unknown status" for any other number.
const char *carom_status_name(int32_t status);

/// Makes an empty world at time 0, stepped by the rule `exact`.
CaromStatus carom_world_new(CaromWorld *world);

/// Makes a copy of a world, which goes on from the same state by itself. Forces that are functions act on
/// both.
CaromStatus carom_world_copy(CaromWorld world, CaromWorld *copy);

/// Frees a world. A step that is at work on it in another thread is stopped.
CaromStatus carom_world_free(CaromWorld world);

/// Whether a handle is that of a world: 1, or 0.
int32_t carom_world_is_valid(CaromWorld world);

/// Stops the step that is at work on a world, within milliseconds under the rule `exact`, and refuses further ones
/// with CAROM_STATUS_STOPPED: 1. Lets it step again: 0. This can be called from any thread, at any time.
CaromStatus carom_world_set_stop(CaromWorld world, int32_t stop);

/// The name of a built-in scene, in the order in which `carom scenes` lists them; null past the last one.
const char *carom_scene_name(size_t index);

/// Makes the world of a scene: a built-in one by its name or title, or a scene file by its path. Overrides
/// are texts like "simulation.rule=contact", which change values of the scene; null for none.
CaromStatus carom_world_from_scene(const char *name, const char *const *overrides, size_t override_count, CaromWorld *world);

/// Makes the world of the text of a scene file (TOML), with overrides as carom_world_from_scene() takes them. The
/// message of an error has the line of what is wrong.
CaromStatus carom_world_from_toml(const char *toml, const char *const *overrides, size_t override_count, CaromWorld *world);

/// Adds the spheres, generators, springs, colliders, forces and emitters that a text describes as scene files do
/// (TOML). Spheres may overlap others; springs join spheres of the text. What was added goes to `added`, which may be
/// null.
CaromStatus carom_world_add_toml(CaromWorld world, const char *toml, CaromAdded *added);

/// Steps a world from now on as the table `[simulation]` of a scene file says (TOML): "[simulation]\nrule =
/// \"contact\"". What the text does not say is as in a scene file that does not say it.
CaromStatus carom_world_set_simulation(CaromWorld world, const char *toml);

/// Advances a world by `dt` [s], > 0. If the step is refused, the state before it is kept.
CaromStatus carom_world_step(CaromWorld world, double dt);

/// Advances a world by so many frames of its own frame time (carom_world_frame_time()). If a frame is refused, those
/// before it are kept; `taken`, which may be null, gets their number.
CaromStatus carom_world_advance(CaromWorld world, uint64_t frames, uint64_t *taken);

/// Advances a world to its next impact and answers it, with all others at that instant; by `within` [s] if none
/// comes before. Only under the rule `exact`.
CaromStatus carom_world_step_to_next_event(CaromWorld world, double within);

/// The time of the next impact [s], infinity if none comes within so many seconds. Only under the rule `exact`; the
/// world stays as it is.
CaromStatus carom_world_next_event_time(CaromWorld world, double within, double *time);

/// Time since the beginning [s]: the sum of all steps.
CaromStatus carom_world_time(CaromWorld world, double *time);

/// Sets the clock [s], for forces that depend on time. A world with emitters refuses it.
CaromStatus carom_world_set_time(CaromWorld world, double time);

/// Length of a frame [s], as the scene says; 1/60 s unless it does.
CaromStatus carom_world_frame_time(CaromWorld world, double *frame_time);

/// The state of a world as one number, equal for equal states on every platform and in every language: what `carom
/// run` prints, in hexadecimal digits.
CaromStatus carom_world_state_hash(CaromWorld world, uint64_t *hash);

/// A solid ball of 1 kg and radius 1 m at rest at the origin, with restitution 1, that leaves friction to what it
/// touches.
CaromSphere carom_sphere(void);

/// Adds a sphere, which may overlap others. Its id, which is never given twice, goes to `id`, which may be null.
CaromStatus carom_world_add_sphere(CaromWorld world, const CaromSphere *sphere, uint64_t *id);

/// Adds `count` spheres, each `stride` bytes after the one before (0: sizeof(CaromSphere)), all or none. Their ids go
/// to `ids`, `count` of them one after another, which may be null.
CaromStatus carom_world_add_spheres(CaromWorld world, const CaromSphere *spheres, size_t stride, size_t count, uint64_t *ids);

/// One sphere, by its id.
CaromStatus carom_world_sphere(CaromWorld world, uint64_t id, CaromSphere *sphere);

/// Changes a sphere to another one, which keeps the id and the force applied to it.
CaromStatus carom_world_set_sphere(CaromWorld world, uint64_t id, const CaromSphere *sphere);

/// Takes spheres out of a world by their ids, `count` of them one after another: all or none. Spheres after them move
/// up in the arrays.
CaromStatus carom_world_remove_spheres(CaromWorld world, const uint64_t *ids, size_t count);

/// The index of a sphere in all arrays, which changes when spheres before it are removed.
CaromStatus carom_world_index_of(CaromWorld world, uint64_t id, size_t *index);

/// The number of spheres: the number of rows in every array.
CaromStatus carom_world_count(CaromWorld world, size_t *count);

/// Reads a quantity (CaromQuantity) of all spheres, in ascending order of id: a row for each, `stride` bytes after the one
/// before (0: rows without gaps). `count` must be the number of spheres.
CaromStatus carom_world_read(CaromWorld world, int32_t quantity, double *values, size_t stride, size_t count);

/// Reads a quantity as carom_world_read() does, in numbers of 32 bits, to draw.
CaromStatus carom_world_read_f32(CaromWorld world, int32_t quantity, float *values, size_t stride, size_t count);

/// Writes a quantity (CaromQuantity) of all spheres from rows that lie as carom_world_read() writes them. If a number is
/// refused, none is written.
CaromStatus carom_world_write(CaromWorld world, int32_t quantity, const double *values, size_t stride, size_t count);

/// Writes a quantity as carom_world_write() does, from numbers of 32 bits.
CaromStatus carom_world_write_f32(CaromWorld world, int32_t quantity, const float *values, size_t stride, size_t count);

/// A solid half-space below y = 0, at rest, with restitution 1, that leaves friction to what touches it. Its `radius` and
/// `size` are 1 m.
CaromCollider carom_collider(void);

/// Adds a collider. Its id goes to `id`, which may be null.
CaromStatus carom_world_add_collider(CaromWorld world, const CaromCollider *collider, uint64_t *id);

/// One collider, where it is now, by its id.
CaromStatus carom_world_collider(CaromWorld world, uint64_t id, CaromCollider *collider);

/// Changes a collider, which keeps its id: its place, at once, and all else.
CaromStatus carom_world_set_collider(CaromWorld world, uint64_t id, const CaromCollider *collider);

/// Takes a collider out of a world.
CaromStatus carom_world_remove_collider(CaromWorld world, uint64_t id);

/// Adds a force that is a function of the program. Its id goes to `id`, which may be null.
CaromStatus carom_world_add_force(CaromWorld world, const CaromForce *force, uint64_t *id);

/// Adds gravity: the same acceleration [m/s^2], three numbers, for every sphere. Its id goes to `id`, which may be null.
CaromStatus carom_world_add_gravity(CaromWorld world, const double *acceleration, uint64_t *id);

/// Adds viscous drag: a force against the velocity, proportional to it by a coefficient [kg/s], >= 0. Its id goes to
/// `id`, which may be null.
CaromStatus carom_world_add_drag(CaromWorld world, double coefficient, uint64_t *id);

/// Takes a force out of a world.
CaromStatus carom_world_remove_force(CaromWorld world, uint64_t id);

/// A spring of 1 N/m without damping, of no length without force, from sphere 0 to the origin.
CaromSpring carom_spring(void);

/// Adds a spring. Its id, which is never given twice, goes to `id`, which may be null.
CaromStatus carom_world_add_spring(CaromWorld world, const CaromSpring *spring, uint64_t *id);

/// One spring, by its id.
CaromStatus carom_world_spring(CaromWorld world, uint64_t id, CaromSpring *spring);

/// Changes a spring to another one, which keeps the id.
CaromStatus carom_world_set_spring(CaromWorld world, uint64_t id, const CaromSpring *spring);

/// Takes a spring out of a world; its spheres stay.
CaromStatus carom_world_remove_spring(CaromWorld world, uint64_t id);

/// Reads a list of ids (CaromList), `stride` bytes from one to the next (0: no gaps), and their number to `count`. Null for
/// `ids` reads the number only. Ids that do not fit into `capacity` places are an error.
CaromStatus carom_world_ids(CaromWorld world, int32_t list, uint64_t *ids, size_t stride, size_t capacity, size_t *count);

/// Takes an emitter out of a world; its spheres stay.
CaromStatus carom_world_remove_emitter(CaromWorld world, uint64_t id);

/// The last step in numbers: counts, and what became of energy. It is empty after carom_world_restore().
CaromStatus carom_world_report(CaromWorld world, CaromReport *report);

/// Reads the impacts of the last step in order of time, as carom_world_ids() reads ids.
CaromStatus carom_world_impacts(CaromWorld world, CaromImpact *impacts, size_t stride, size_t capacity, size_t *count);

/// Reads the contacts that persist, with their forces, as carom_world_ids() reads ids. They are known under the rules
/// `exact` and `contact` after a step.
CaromStatus carom_world_contacts(CaromWorld world, CaromContact *contacts, size_t stride, size_t capacity, size_t *count);

/// Reads which spheres are inside triggers at the end of the last step, as carom_world_ids() reads ids.
CaromStatus carom_world_triggers(CaromWorld world, CaromTrigger *triggers, size_t stride, size_t capacity, size_t *count);

/// Energies and momenta of all spheres together.
CaromStatus carom_world_totals(CaromWorld world, CaromTotals *totals);

/// Reads which spheres overlap each other (where spheres collide) or a solid collider by more than `tolerance` [m], as
/// carom_world_ids() reads ids.
CaromStatus carom_world_overlaps(CaromWorld world, double tolerance, CaromOverlap *overlaps, size_t stride, size_t capacity, size_t *count);

/// Takes a snapshot: everything the future of a world depends on.
CaromStatus carom_world_snapshot(CaromWorld world, CaromSnapshot *snapshot);

/// Returns a world to a snapshot, of itself or of another world, bit for bit. What happened in the last step is
/// forgotten.
CaromStatus carom_world_restore(CaromWorld world, CaromSnapshot snapshot);

/// Frees a snapshot.
CaromStatus carom_snapshot_free(CaromSnapshot snapshot);

/// When a snapshot was taken [s].
CaromStatus carom_snapshot_time(CaromSnapshot snapshot, double *time);

/// Writes a snapshot as bytes, the same ones on every platform, and their number to `size`; null for `bytes` gives the
/// number only. The same version of Carom reads them, in Python and Rust, too. A force that is a function has no bytes.
CaromStatus carom_snapshot_to_bytes(CaromSnapshot snapshot, uint8_t *bytes, size_t capacity, size_t *size);

/// Makes the snapshot that carom_snapshot_to_bytes() wrote. A checksum notices damage, but not what was made to mislead: read
/// only bytes that you trust.
CaromStatus carom_snapshot_from_bytes(const uint8_t *bytes, size_t size, CaromSnapshot *snapshot);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* CAROM_H */
