// Carom: spheres under forces that collide with each other and with surfaces, exactly.
//
// Right-handed coordinate system, y up, SI units. docs/c.md is the guide.
//
// Almost every function returns a CaromStatus. After any status but CAROM_STATUS_OK the world is unchanged, and
// carom_last_error() returns the reason.
//
// Pointers: null is refused, unless a function states its meaning. Any other pointer must lead to what the function
// states: one value, a text that ends in a zero, or the stated number of rows with `stride` bytes from one to the next.
// It may be unaligned. The library uses it only during the call, and copies what it needs.
//
// Handles (CaromWorld, CaromSnapshot, CaromPath) are never reused: a freed one is refused.
//
// Made by `cargo xtask header`; do not edit.

#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

/// The version of the interface in this header. Within one version functions are only added:
/// structures, constants and parameters stay the same.
#define CAROM_ABI_VERSION 3

/// Result of a call. After any status but CAROM_STATUS_OK the world is unchanged, unless the
/// function states otherwise, and carom_last_error() returns the reason.
enum CaromStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// The call succeeded.
    CAROM_STATUS_OK = 0,
    /// A pointer is null, or a handle is zero.
    CAROM_STATUS_NULL = 1,
    /// A handle is unknown: its object was freed or never existed.
    CAROM_STATUS_HANDLE = 2,
    /// Another call is using the world: one of another thread, or the one that called the function
    /// of a force.
    CAROM_STATUS_BUSY = 3,
    /// A count, capacity or stride does not fit.
    CAROM_STATUS_LENGTH = 4,
    /// A text is not UTF-8, or a number is no constant of its enumeration.
    CAROM_STATUS_ARGUMENT = 5,
    /// A number is invalid: not finite, negative where it must not be, ...
    CAROM_STATUS_INVALID = 6,
    /// An id is unknown in this world, or no scene has this name.
    CAROM_STATUS_UNKNOWN = 7,
    /// The text of a scene is invalid; the message has line and field.
    CAROM_STATUS_SCENE = 8,
    /// The step was refused: a number would overflow, or there were more impacts than allowed.
    CAROM_STATUS_STEP = 9,
    /// carom_world_set_stop() stopped the step.
    CAROM_STATUS_STOPPED = 10,
    /// Bytes are no snapshot, or a snapshot cannot be written as bytes.
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
    /// Orientations: 4 numbers, a quaternion x, y, z, w.
    CAROM_QUANTITY_ORIENTATIONS = 5,
    /// Angular velocities [rad/s]: 3 numbers.
    CAROM_QUANTITY_ANGULAR_VELOCITIES = 6,
    /// Moments of inertia divided by m r^2: 1 number.
    CAROM_QUANTITY_INERTIA_FACTORS = 7,
    /// Coefficients of friction: 1 number, not a number if a sphere has none of its own.
    CAROM_QUANTITY_FRICTIONS = 8,
    /// Coefficients of rolling friction: 1 number, as for friction.
    CAROM_QUANTITY_ROLLING_FRICTIONS = 9,
    /// Coefficients of spinning friction: 1 number, as for friction.
    CAROM_QUANTITY_SPINNING_FRICTIONS = 10,
    /// Coefficients of tangential restitution: 1 number, as for friction.
    CAROM_QUANTITY_TANGENTIAL_RESTITUTIONS = 11,
    /// Applied forces [N]: 3 numbers. They act until they are set again or removed by writing no
    /// rows.
    CAROM_QUANTITY_APPLIED_FORCES = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromQuantity CaromQuantity;
#else
typedef int32_t CaromQuantity;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// The shape of a collider in its own frame.
enum CaromShape
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// A sphere of `radius`.
    CAROM_SHAPE_SPHERE = 0,
    /// A rectangle of size[0] by size[2] in the local xz plane, which faces local +y. Spheres pass
    /// through it from behind.
    CAROM_SHAPE_RECTANGLE = 1,
    /// Everything below the local xz plane.
    CAROM_SHAPE_HALF_SPACE = 2,
    /// A box of `size`.
    CAROM_SHAPE_BOX = 3,
    /// A hollow box of `size`: spheres bounce off its walls on both sides. The walls in
    /// `open_sides` are missing.
    CAROM_SHAPE_CONTAINER = 4,
    /// A shape that arrays or the text of a scene describe. carom_world_set_collider() keeps it.
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
    /// Spheres that emitters added in the last step, ascending.
    CAROM_LIST_EMITTED = 4,
    /// Spheres that emitters removed in the last step.
    CAROM_LIST_RETIRED = 5,
    /// Ids of spheres that emitters left out in the last step for lack of space; no sphere ever has
    /// them.
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

/// Where a predicted path ends.
enum CaromPathEnd
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// At the end of the time asked for.
    CAROM_PATH_END_HORIZON = 0,
    /// At the last impact asked for.
    CAROM_PATH_END_IMPACTS = 1,
    /// Where a step would take the sphere in a stepped zone.
    CAROM_PATH_END_NO_CLOSED_FORM = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum CaromPathEnd CaromPathEnd;
#else
typedef int32_t CaromPathEnd;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A handle of a world. It is never reused; zero is no world.
///
/// Only one thread at a time may use a world: a call during another one returns CAROM_STATUS_BUSY.
/// Different worlds are independent.
typedef struct {
    /// The handle.
    uint64_t id;
} CaromWorld;

/// Ids that carom_world_add_toml() has added. Ids of each kind are consecutive: those of the
/// spheres are first_sphere, first_sphere + 1, ...
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

/// A sphere. carom_sphere() returns one with default values.
typedef struct {
    /// Centre [m].
    double position[3];
    /// Velocity [m/s].
    double velocity[3];
    /// Radius [m], > 0.
    double radius;
    /// Mass [kg], > 0.
    double mass;
    /// Density [kg/m^3], from which the mass is computed; 0 if `mass` is given. Reading a sphere
    /// gives 0.
    double density;
    /// Coefficient of restitution in [0, 1].
    double restitution;
    /// Coefficient of friction, >= 0; not a number (NAN) if the touching body decides.
    double friction;
    /// Coefficient of rolling friction, as `friction`.
    double rolling_friction;
    /// Coefficient of spinning friction, as `friction`.
    double spinning_friction;
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    double tangential_restitution;
    /// Orientation: a quaternion x, y, z, w of any length but zero.
    double orientation[4];
    /// Angular velocity [rad/s].
    double angular_velocity[3];
    /// Moment of inertia divided by m r^2, > 0: 2/5 for a solid ball, 2/3 for a thin shell.
    double inertia_factor;
} CaromSphere;

/// A blow of a cue on a sphere, at one instant and one point, without loss of energy.
/// carom_strike() returns one with default values.
typedef struct {
    /// Speed of the cue [m/s], >= 0.
    double speed;
    /// Direction of the cue from above, from +x towards -z, counterclockwise [degrees].
    double azimuth_degrees;
    /// Angle by which the cue points down, in [0, 90] [degrees].
    double elevation_degrees;
    /// Offset of the cue from the centre to the right and up, as seen along it, in parts of the
    /// radius; its size is below 1.
    double offset[2];
    /// Mass of the cue [kg], > 0.
    double cue_mass;
} CaromStrike;

/// A collider: a shape that spheres do not move, at rest or in motion. carom_collider() returns one
/// with default values.
typedef struct {
    /// The shape (CaromShape).
    int32_t shape;
    /// 1 for a trigger, which reports spheres but does not deflect them; 0 for a solid collider.
    uint32_t trigger;
    /// Missing walls of a container: bits (CaromSide).
    uint32_t open_sides;
    /// Must be 0.
    uint32_t reserved;
    /// Radius of a sphere [m], > 0.
    double radius;
    /// Full lengths along local x, y, z [m], each > 0 if the shape has it.
    double size[3];
    /// Origin of the local frame [m].
    double position[3];
    /// Rotation from the local frame to the world: a quaternion x, y, z, w of any length but zero.
    double rotation[4];
    /// Velocity of the origin [m/s]; steps move the collider.
    double velocity[3];
    /// Angular velocity about the origin [rad/s].
    double angular_velocity[3];
    /// Coefficient of restitution in [0, 1].
    double restitution;
    /// Coefficient of friction, >= 0; not a number (NAN) if the touching body decides.
    double friction;
    /// Coefficient of rolling friction, as `friction`.
    double rolling_friction;
    /// Coefficient of spinning friction, as `friction`.
    double spinning_friction;
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    double tangential_restitution;
} CaromCollider;

/// A pose that a collider reaches at a time.
typedef struct {
    /// Time on the world's clock [s].
    double time;
    /// Displacement from the pose at rest [m], along the axes of the world.
    double position[3];
    /// Rotation from the pose at rest, about the axes of the world: a quaternion x, y, z, w of any
    /// length but zero.
    double rotation[4];
} CaromKeyframe;

/// A surface of triangles, in the coordinates of its collider.
typedef struct {
    /// Vertices [m]: three numbers each, without gaps in memory.
    const double *vertices;
    /// Number of vertices.
    size_t vertex_count;
    /// Triangles: the indices of three vertices each, counter-clockwise as seen from the front,
    /// without gaps in memory.
    const uint32_t *triangles;
    /// Number of triangles.
    size_t triangle_count;
    /// 1 if spheres pass an open mesh from behind, 0 if both sides deflect them. A closed mesh is
    /// always met from its front.
    uint32_t one_sided;
    /// Must be 0.
    uint32_t reserved;
} CaromMesh;

/// The state of a sphere that a force may depend on.
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

/// A function that writes the force [N] on a sphere in this state at this time [s] to the three
/// numbers of `force`.
typedef void (*CaromForceFunction)(const CaromSphereState *sphere, double time, double *force, void *user_data);

/// A function that returns the potential energy [J] of a sphere in this state at this time [s].
typedef double (*CaromPotentialFunction)(const CaromSphereState *sphere, double time, void *user_data);

/// A function that frees the data of a force.
typedef void (*CaromDestroyFunction)(void *user_data);

/// A force that is a function of the program. It may depend only on its arguments and `user_data`,
/// must return (no exception, no longjmp), and must not use the world that it acts in.
///
/// The thread that steps a world calls it; if the library was built with the feature `rayon`, other
/// threads do so, too. For the same bits everywhere it must not use functions whose result depends
/// on the platform (sin, exp, ...). The rule `exact` calls it some
/// tens of times in each step of a sphere, not in the order of time.
typedef struct {
    /// The function.
    CaromForceFunction force;
    /// The function of its potential energy, which accounts for all of its work, or null. Without one the work of
    /// the force is measured: carom_world_energy_account().
    CaromPotentialFunction potential_energy;
    /// Passed to the functions.
    void *user_data;
    /// Called once when no world and no snapshot uses the force any more; may be null. Called only
    /// for a force that was added.
    CaromDestroyFunction destroy;
} CaromForce;

/// A spring with a damper, between the centres of two spheres or from one to a fixed point. At the
/// length l it pulls with stiffness (l - rest_length) + damping dl/dt. It is removed with either
/// sphere. carom_spring() returns one with default values.
typedef struct {
    /// Id of the sphere at the first end.
    uint64_t sphere;
    /// Id of the sphere at the second end, a different one; ignored if `to_point` is 1.
    uint64_t other;
    /// 1 for a spring that ends at `point`, 0 for one that ends at the sphere `other`.
    uint32_t to_point;
    /// 1 for a thread, which only pulls and is slack up to its rest length; 0 for a spring that
    /// pushes, too.
    uint32_t only_pulls;
    /// The fixed point [m]; ignored if `to_point` is 0.
    double point[3];
    /// Length without force [m], >= 0.
    double rest_length;
    /// Stiffness [N/m], >= 0.
    double stiffness;
    /// Damping [kg/s], >= 0.
    double damping;
} CaromSpring;

/// Counts and energies of the last step.
typedef struct {
    /// Number of impacts.
    uint64_t impacts;
    /// Under the rule `exact`: number of spheres in a stepped zone at the end of the step, which
    /// are not moved from impact to impact.
    uint64_t zone_spheres;
    /// Under the rule `exact`: 1 if any sphere was in a stepped zone in any step so far, else 0.
    uint64_t was_stepped;
    /// Under the rule `bisect`: number of groups in which two bodies met as often as a frame
    /// allows.
    uint64_t unfinished_islands;
    /// Under the rule `contact`: number of sleeping spheres at the end of the step.
    uint64_t asleep;
    /// Under the rule `contact`: how often a sphere was pressed into a surface by half its radius,
    /// summed over sub-steps.
    uint64_t squeezed;
    /// Work of contacts [J]: the energy change by restitution and friction.
    double contact_work;
    /// Work of moving colliders [J].
    double collider_work;
    /// Work of the correction of overlaps [J].
    double correction_work;
    /// Energy of emitted spheres minus that of removed ones [J]. carom_world_energy_account() has
    /// all that changes the total energy.
    double emission_energy;
    /// Under the rule `contact`: largest change of an impulse in the last sweep, relative to the
    /// largest impulse.
    double residual;
    /// Under the rule `contact`: largest overlap before its correction, relative to the sum of
    /// radii.
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
    /// Point on the surface of body 1 [m].
    double point[3];
    /// Unit normal from body 1 to body 2.
    double normal[3];
    /// Speed of approach along the normal before the impact [m/s], > 0.
    double approach_speed;
    /// Speed of separation along the normal after the impact and all simultaneous ones in its group
    /// [m/s].
    double separation_speed;
    /// Impulse along the normal [N s], on body 2; the opposite acts on body 1.
    double impulse;
    /// Impulse of friction across the normal [N s], on body 2; the opposite acts on body 1.
    double tangential_impulse[3];
} CaromImpact;

/// A contact that persists from step to step.
typedef struct {
    /// The two bodies.
    CaromBodyPair bodies;
    /// Point on the surface of body 1 [m].
    double point[3];
    /// Unit normal from body 1 to body 2.
    double normal[3];
    /// Distance of the two surfaces [m], negative if they overlap.
    double gap;
    /// Force along the normal on body 2 [N], >= 0; the opposite acts on body 1.
    double normal_force;
    /// Force of friction on body 2, across the normal [N].
    double tangential_force[3];
    /// 1 if the surfaces slide on each other, or would under the smallest tangential force; else 0.
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
    /// Point on the trigger's surface [m].
    double point[3];
} CaromTrigger;

/// A sphere that enters a trigger or leaves it.
typedef struct {
    /// Time since the start of the step [s].
    double time;
    /// Id of the trigger.
    uint64_t collider;
    /// Id of the sphere.
    uint64_t sphere;
    /// 1 if the sphere enters, 0 if it leaves.
    uint64_t enters;
    /// Point on the trigger's surface [m].
    double point[3];
    /// Unit normal from the trigger's surface to the sphere.
    double normal[3];
    /// Speed of the sphere relative to the trigger [m/s].
    double speed;
} CaromSensorEvent;

/// Two spheres at the edge of the well between them, which a pair potential of a scene makes.
typedef struct {
    /// Time since the start of the step [s].
    double time;
    /// Ids of the spheres, ascending.
    uint64_t spheres[2];
    /// 0 if they enter the well, 1 if they leave it, 2 if they turn back.
    uint64_t kind;
    /// Unit vector from the first centre to the second.
    double normal[3];
    /// Distance of the centres [m].
    double distance;
    /// Impulse that drives the spheres apart [N s]; negative if it draws them together.
    double impulse;
} CaromWellEvent;

/// Changes of the energy in the last step: the total energy changes by their sum, and by the error of
/// the integration.
typedef struct {
    /// Work of contacts [J]: the energy change by restitution and friction.
    double contacts;
    /// Work of moving colliders [J].
    double colliders;
    /// Work of the kicks of colliders [J].
    double kicks;
    /// Work of growing spheres [J].
    double growth;
    /// Work of the steady shear of a periodic box [J].
    double shear;
    /// Energy that a thermostat added [J]; < 0 where it took some.
    double thermostat;
    /// Work of forces without a potential [J]: drag, wind, vortices, dampers, forces of the program.
    double forces;
    /// Work of the forces applied to single spheres [J].
    double applied;
    /// Work of the correction of overlaps [J].
    double correction;
    /// Energy of emitted spheres minus that of removed ones [J].
    double emission;
} CaromEnergyAccount;

/// Impacts at one instant among bodies that touch each other, with their common momentum and energy.
typedef struct {
    /// Index of its first impact in the list of carom_world_impacts().
    uint64_t first;
    /// Number of its impacts.
    uint64_t count;
    /// Momentum of its spheres before [kg m/s].
    double momentum_before[3];
    /// Momentum after, less what colliders gave [kg m/s]: as before, up to rounding.
    double momentum_after[3];
    /// Kinetic energy of its spheres before [J].
    double energy_before;
    /// Kinetic energy after, less the work of moving colliders, of kicks and of growth [J].
    double energy_after;
    /// Change of the kinetic energy that the coefficients of restitution demand [J], <= 0.
    double energy_demanded;
    /// Work of moving colliders [J].
    double collider_work;
    /// Work of the kicks of colliders, and of spheres that grow [J].
    double kick_work;
} CaromImpactGroup;

/// The work of the last step by stage: counts that depend only on the world, not on the machine.
typedef struct {
    /// Under the rule `exact`: predictions of a sphere's next events.
    uint64_t predictions;
    /// Pairs of spheres tested for an impact, or under other rules for a contact.
    uint64_t pair_tests;
    /// Under the rule `exact`: events taken from the queue, with outdated ones.
    uint64_t events;
    /// Under the rule `exact`: cell crossings among these events.
    uint64_t cell_crossings;
    /// Under the rule `exact`: groups of touching bodies resolved as a whole.
    uint64_t groups;
    /// Iterations of the solvers of these groups, counted once per contact.
    uint64_t solver_iterations;
    /// Under the rule `contact`: neighbour searches.
    uint64_t searches;
    /// Under the rule `contact`: sweeps over all contacts.
    uint64_t sweeps;
    /// Under the rule `contact`: contacts per sweep at the end of the step.
    uint64_t contacts;
} CaromStageCounts;

/// Quality of the solution of the last step under the rule `contact`, and in stepped zones of `exact`.
typedef struct {
    /// Sub-steps in which impulses were reduced so that they add no energy.
    uint64_t limited_sub_steps;
    /// Sleeping spheres at the end of the step.
    uint64_t asleep;
    /// How often a sphere was pressed into a surface by half its radius, summed over sub-steps.
    uint64_t squeezed;
    /// Largest change of an impulse in the last sweep, relative to the largest impulse.
    double residual;
    /// Largest overlap before its correction, relative to the sum of radii.
    double largest_overlap;
} CaromContactAccount;

/// Spheres that the rule `exact` stepped in the last step instead of moving them from impact to impact.
typedef struct {
    /// Spheres in a zone at the end of the step.
    uint64_t spheres;
    /// Ticks at which a zone was stepped.
    uint64_t ticks;
    /// Spheres that joined a zone.
    uint64_t joined;
    /// Spheres that left a zone.
    uint64_t left;
    /// Total time of all spheres in zones [s].
    double sphere_seconds;
} CaromZoneAccount;

/// Sums over all spheres.
typedef struct {
    /// Kinetic energy, with rotation [J].
    double kinetic_energy;
    /// Kinetic energy of rotation [J].
    double rotational_energy;
    /// Potential energy in all forces that have one [J].
    double potential_energy;
    /// Momentum [kg m/s].
    double momentum[3];
    /// Angular momentum about the origin, with spin [kg m^2/s].
    double angular_momentum[3];
} CaromTotals;

/// Two bodies that overlap.
typedef struct {
    /// The two bodies.
    CaromBodyPair bodies;
    /// Depth of the overlap of their surfaces [m], > 0.
    double depth;
} CaromOverlap;

/// Which bodies a query finds. carom_query_filter() returns one with default values. Null in its
/// place stands for that one, too.
typedef struct {
    /// 1 to find spheres, else 0.
    uint32_t spheres;
    /// 1 to find colliders that deflect, else 0.
    uint32_t colliders;
    /// 1 to find triggers, else 0.
    uint32_t triggers;
    /// 1 to leave out the sphere `without_sphere`, else 0.
    uint32_t leaves_out_sphere;
    /// Id of the sphere that is left out.
    uint64_t without_sphere;
    /// Groups that the query is in, one bit for each, as if it were a body.
    uint32_t groups;
    /// Groups that the query collides with, one bit for each.
    uint32_t collides_with;
} CaromQueryFilter;

/// A ray.
typedef struct {
    /// Where it starts [m].
    double origin[3];
    /// From there to its end [m].
    double way[3];
} CaromRay;

/// What a ray or a moving sphere meets first.
typedef struct {
    /// 1 if it meets a body, 0 if it meets nothing; then all other fields are 0.
    uint32_t is_hit;
    /// 1 if the body is a collider, 0 if it is a sphere.
    uint32_t is_collider;
    /// Id of the body.
    uint64_t body;
    /// Point on the surface of the body [m].
    double point[3];
    /// Unit normal of the body there, out of it.
    double normal[3];
    /// Part of the way before, 0 to 1.
    double fraction;
} CaromHit;

/// A sphere that moves straight.
typedef struct {
    /// Centre where it starts [m].
    double center[3];
    /// Radius [m], > 0.
    double radius;
    /// From there to its end [m].
    double way[3];
} CaromMovingSphere;

/// A body near a place.
typedef struct {
    /// 1 if there is a body, 0 if there is none; then all other fields are 0.
    uint32_t is_found;
    /// 1 if the body is a collider, 0 if it is a sphere.
    uint32_t is_collider;
    /// Id of the body.
    uint64_t body;
    /// The nearest point of its surface [m].
    double point[3];
    /// Unit normal of the body there, out of it.
    double normal[3];
    /// Distance of the surfaces [m], negative if they overlap.
    double distance;
} CaromNearBody;

/// A handle of a predicted path. It is never reused; zero is no path.
typedef struct {
    /// The handle.
    uint64_t id;
} CaromPath;

/// A piece of a predicted path: a flight from an event to the next.
typedef struct {
    /// When it begins, on the world's clock [s].
    double start;
    /// When it ends, on the world's clock [s].
    double end;
    /// When the flight's own time is 0, on the world's clock [s]; it may be before `start`.
    double flight_start;
    /// Centre then [m].
    double position[3];
    /// Velocity then [m/s].
    double velocity[3];
    /// Acceleration by everything but drag [m/s^2]; along a round surface that of its beginning.
    double acceleration[3];
    /// Drag coefficient over mass [1/s], >= 0.
    double drag_rate;
} CaromPathLeg;

/// A handle of a snapshot, the state of a world at one time. It is never reused; zero is no
/// snapshot.
typedef struct {
    /// The handle.
    uint64_t id;
} CaromSnapshot;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// Returns the version of Carom, for example "0.1.0".
const char *carom_version(void);

/// Returns the version of the library's interface.
uint32_t carom_abi_version(void);

/// Checks that the library has the interface that the program was compiled for. Call it first, with
/// CAROM_ABI_VERSION.
CaromStatus carom_check_abi(uint32_t version);

/// Returns the message of the last refused call of this thread, in UTF-8; empty if none was
/// refused. The text is valid until the next refused call of this thread.
const char *carom_last_error(void);

/// Returns the name of a status: "ok" for CAROM_STATUS_OK, "null", ...; "unknown status" for any
/// other number.
const char *carom_status_name(int32_t status);

/// Makes an empty world at time 0 under the rule `exact`.
CaromStatus carom_world_new(CaromWorld *world);

/// Makes an independent copy of a world in the same state. Forces that are functions act on both.
CaromStatus carom_world_copy(CaromWorld world, CaromWorld *copy);

/// Frees a world, and stops a step of another thread on it.
CaromStatus carom_world_free(CaromWorld world);

/// Returns 1 if a handle is that of a world, else 0.
int32_t carom_world_is_valid(CaromWorld world);

/// With `stop` 1, stops the step in progress on a world, within milliseconds under the rule
/// `exact`, and refuses further ones with CAROM_STATUS_STOPPED. With 0, allows steps again. Any
/// thread can call this at any time.
CaromStatus carom_world_set_stop(CaromWorld world, int32_t stop);

/// Returns the name of a built-in scene in the order of `carom scenes`; null after the last one.
const char *carom_scene_name(size_t index);

/// Makes the world of a built-in scene, found by name or title, or of a scene file, found by its
/// path. Overrides are texts like "simulation.rule=contact" that replace values of the scene; they
/// may be null.
CaromStatus carom_world_from_scene(const char *name, const char *const *overrides, size_t override_count, CaromWorld *world);

/// Makes the world of a scene file's text (TOML), with overrides as in carom_world_from_scene().
/// The message of an error has the line of the fault.
CaromStatus carom_world_from_toml(const char *toml, const char *const *overrides, size_t override_count, CaromWorld *world);

/// Adds the spheres, generators, springs, colliders, forces and emitters of a text in the format of
/// scene files (TOML). Spheres may overlap others; springs join spheres of the text. Writes the ids
/// to `added`, which may be null.
CaromStatus carom_world_add_toml(CaromWorld world, const char *toml, CaromAdded *added);

/// Sets the simulation settings from the table `[simulation]` of a scene file (TOML):
/// "[simulation]\nrule = \"contact\"". Missing settings get their defaults.
CaromStatus carom_world_set_simulation(CaromWorld world, const char *toml);

/// Sets the pairs of materials from the tables of a scene file (TOML):
/// "material_pairs = [{ materials = [\"ivory\", \"slate\"], restitution = 0.9 }]". The materials are
/// those of the scene; an empty text removes all pairs.
CaromStatus carom_world_set_material_pairs(CaromWorld world, const char *toml);

/// Advances a world by `dt` [s], > 0. If the step is refused, the state before it is kept.
CaromStatus carom_world_step(CaromWorld world, double dt);

/// Advances a world by `frames` frames of its frame time (carom_world_frame_time()). If a frame is
/// refused, those before it are kept. Writes the number of frames taken to `taken`, which may be
/// null.
CaromStatus carom_world_advance(CaromWorld world, uint64_t frames, uint64_t *taken);

/// Advances a world to its next impact and resolves it with all others at that time, at most by
/// `within` [s]. Only under the rule `exact`.
CaromStatus carom_world_step_to_next_event(CaromWorld world, double within);

/// Reads the time of the next impact [s]; infinity if none comes within `within` [s]. Only under
/// the rule `exact`; the world does not change.
CaromStatus carom_world_next_event_time(CaromWorld world, double within, double *time);

/// Reads the time since the start [s]: the sum of all steps.
CaromStatus carom_world_time(CaromWorld world, double *time);

/// Sets the time [s], for forces that depend on it. Refused for a world with emitters.
CaromStatus carom_world_set_time(CaromWorld world, double time);

/// Reads the frame time [s] of the scene; the default is 1/60 s.
CaromStatus carom_world_frame_time(CaromWorld world, double *frame_time);

/// Reads the longest frame [s] in which motion on springs is certainly stable; infinity without
/// springs, and under the rule `exact`. The other rules refuse longer frames.
CaromStatus carom_world_longest_stable_frame(CaromWorld world, double *longest);

/// Reads the state hash of a world, equal for equal states on every platform and in every language.
/// `carom run` prints it in hexadecimal digits.
CaromStatus carom_world_state_hash(CaromWorld world, uint64_t *hash);

/// Returns a solid ball of 1 kg and radius 1 m at rest at the origin, with restitution 1 and
/// without its own friction.
CaromSphere carom_sphere(void);

/// Adds a sphere, which may overlap others. Writes its id, which is never reused, to `id`, which
/// may be null.
CaromStatus carom_world_add_sphere(CaromWorld world, const CaromSphere *sphere, uint64_t *id);

/// Adds `count` spheres, with `stride` bytes from one to the next (0: sizeof(CaromSphere)), all or
/// none. Writes their ids to `ids`, `count` of them without gaps; it may be null.
CaromStatus carom_world_add_spheres(CaromWorld world, const CaromSphere *spheres, size_t stride, size_t count, uint64_t *ids);

/// Reads a sphere by its id.
CaromStatus carom_world_sphere(CaromWorld world, uint64_t id, CaromSphere *sphere);

/// Replaces a sphere, which keeps its id and its applied force.
CaromStatus carom_world_set_sphere(CaromWorld world, uint64_t id, const CaromSphere *sphere);

/// Removes `count` spheres by their ids, which are without gaps: all or none. Later spheres move up
/// in the arrays.
CaromStatus carom_world_remove_spheres(CaromWorld world, const uint64_t *ids, size_t count);

/// Reads the index of a sphere in all arrays. It changes when earlier spheres are removed.
CaromStatus carom_world_index_of(CaromWorld world, uint64_t id, size_t *index);

/// Reads the number of spheres, which is the number of rows in every array.
CaromStatus carom_world_count(CaromWorld world, size_t *count);

/// Reads a quantity (CaromQuantity) of all spheres into rows in ascending order of id, with
/// `stride` bytes from one row to the next (0: no gaps). `count` must be the number of spheres.
CaromStatus carom_world_read(CaromWorld world, int32_t quantity, double *values, size_t stride, size_t count);

/// Reads a quantity as carom_world_read() does, in 32-bit numbers for drawing.
CaromStatus carom_world_read_f32(CaromWorld world, int32_t quantity, float *values, size_t stride, size_t count);

/// Writes a quantity (CaromQuantity) of all spheres from rows in the layout of carom_world_read().
/// If a number is refused, none is written.
CaromStatus carom_world_write(CaromWorld world, int32_t quantity, const double *values, size_t stride, size_t count);

/// Writes a quantity as carom_world_write() does, from 32-bit numbers.
CaromStatus carom_world_write_f32(CaromWorld world, int32_t quantity, const float *values, size_t stride, size_t count);

/// Applies an impulse, three numbers [N s], to a sphere at its centre: its velocity changes by the
/// impulse over its mass.
CaromStatus carom_world_apply_impulse(CaromWorld world, uint64_t sphere, const double *impulse);

/// Applies an impulse [N s] to a sphere at a point [m], three numbers each: its velocity changes as
/// by carom_world_apply_impulse(), its angular velocity by (point - centre) x impulse over its
/// moment of inertia.
CaromStatus carom_world_apply_impulse_at(CaromWorld world, uint64_t sphere, const double *impulse, const double *point);

/// Reads the groups that a sphere is in and those that it collides with, one bit for each of 32.
CaromStatus carom_world_groups(CaromWorld world, uint64_t sphere, uint32_t *groups, uint32_t *collides_with);

/// Sets the groups that a sphere is in and those that it collides with, one bit for each of 32. Two
/// bodies collide if each is in a group that the other collides with.
CaromStatus carom_world_set_groups(CaromWorld world, uint64_t sphere, uint32_t groups, uint32_t collides_with);

/// Reads the number of a sphere for programs; 0 unless it was set.
CaromStatus carom_world_user_data(CaromWorld world, uint64_t sphere, uint64_t *user_data);

/// Sets the number of a sphere for programs; it is no part of the physics.
CaromStatus carom_world_set_user_data(CaromWorld world, uint64_t sphere, uint64_t user_data);

/// Returns a level strike at the middle along +x with the speed 0 by a cue of 0.567 kg.
CaromStrike carom_strike(void);

/// Strikes a sphere with a cue: changes its velocity and its angular velocity at once. A part that
/// presses it onto a table is answered by the table in the next step.
CaromStatus carom_world_strike(CaromWorld world, uint64_t sphere, const CaromStrike *strike);

/// Returns a solid half-space below y = 0, at rest, with restitution 1 and without its own
/// friction. Its `radius` and `size` are 1 m.
CaromCollider carom_collider(void);

/// Adds a collider. Writes its id to `id`, which may be null.
CaromStatus carom_world_add_collider(CaromWorld world, const CaromCollider *collider, uint64_t *id);

/// Reads a collider in its present pose by its id.
CaromStatus carom_world_collider(CaromWorld world, uint64_t id, CaromCollider *collider);

/// Replaces all properties of a collider, which keeps its id; it moves at once.
CaromStatus carom_world_set_collider(CaromWorld world, uint64_t id, const CaromCollider *collider);

/// Sets the velocity of the material of a collider along its surface, three numbers [m/s] in its own
/// coordinates, as of a conveyor belt: friction feels it, and the shape stays.
CaromStatus carom_world_set_surface_velocity(CaromWorld world, uint64_t collider, const double *velocity);

/// Removes a collider.
CaromStatus carom_world_remove_collider(CaromWorld world, uint64_t id);

/// Moves a collider through two or more poses, ascending by time and without gaps in memory;
/// velocities are continuous, and it rests before and after. It turns about `pivot`, three numbers
/// [m] from the position at rest, along the axes of the world. If `repeats` is 1, the motion repeats
/// before and after; the last pose has to be the first. The pose at rest is the one that the
/// collider had without a motion. A `count` of 0 removes any motion, and the collider is at rest.
CaromStatus carom_world_set_keyframes(CaromWorld world, uint64_t collider, const CaromKeyframe *keyframes, size_t count, const double *pivot, uint32_t repeats);

/// Sets the motion of a collider from the field `motion` of a scene file (TOML), such as
/// "{ turn = { rate = 2.0 } }", or several in brackets; "[]" removes any motion, and the collider is at
/// rest. The pose at rest is the one that the collider had without a motion.
CaromStatus carom_world_set_motion(CaromWorld world, uint64_t collider, const char *motion);

/// Moves a collider to a pose that it reaches `dt` [s] from now, at a steady velocity that strikes
/// spheres on the way: the position is three numbers [m], the rotation a quaternion x, y, z, w. Call it
/// before each step of `dt`; after that time the collider moves on.
CaromStatus carom_world_set_next_pose(CaromWorld world, uint64_t collider, const double *position, const double *rotation, double dt);

/// Adds a collider of triangles. The `shape` of `collider` must be CAROM_SHAPE_OTHER. Writes its id to
/// `id`, which may be null.
CaromStatus carom_world_add_mesh(CaromWorld world, const CaromCollider *collider, const CaromMesh *mesh, uint64_t *id);

/// Adds ground over a rectangle of size[0] by size[2] of `collider` in the local xz plane about its
/// origin; spheres pass it from below. Heights [m] are `rows` of `columns` numbers along x, without
/// gaps in memory, the first row at the lowest z. Each cell is split from its corner at the lowest x
/// and z to the opposite corner. The `shape` of `collider` must be CAROM_SHAPE_OTHER. Writes its id
/// to `id`, which may be null.
CaromStatus carom_world_add_height_field(CaromWorld world, const CaromCollider *collider, const double *heights, size_t rows, size_t columns, uint64_t *id);

/// Adds a force that is a function of the program. Writes its id to `id`, which may be null.
CaromStatus carom_world_add_force(CaromWorld world, const CaromForce *force, uint64_t *id);

/// Adds gravity: the same acceleration [m/s^2], three numbers, for every sphere. Writes its id to
/// `id`, which may be null.
CaromStatus carom_world_add_gravity(CaromWorld world, const double *acceleration, uint64_t *id);

/// Adds viscous drag: a force against the velocity, in proportion to a coefficient [kg/s], >= 0.
/// Writes its id to `id`, which may be null.
CaromStatus carom_world_add_drag(CaromWorld world, double coefficient, uint64_t *id);

/// Removes a force.
CaromStatus carom_world_remove_force(CaromWorld world, uint64_t id);

/// Returns a spring of 1 N/m without damping and with rest length 0, from sphere 0 to the origin.
CaromSpring carom_spring(void);

/// Adds a spring. Writes its id, which is never reused, to `id`, which may be null.
CaromStatus carom_world_add_spring(CaromWorld world, const CaromSpring *spring, uint64_t *id);

/// Reads a spring by its id.
CaromStatus carom_world_spring(CaromWorld world, uint64_t id, CaromSpring *spring);

/// Replaces a spring, which keeps its id.
CaromStatus carom_world_set_spring(CaromWorld world, uint64_t id, const CaromSpring *spring);

/// Removes a spring; its spheres stay.
CaromStatus carom_world_remove_spring(CaromWorld world, uint64_t id);

/// Replaces an emitter, which keeps its id, by the one of a text in the format of scene files (TOML):
/// "emitters = [{ sphere = { radius = 0.1 }, period = 0.5 }]". With another period it starts again now.
CaromStatus carom_world_set_emitter(CaromWorld world, uint64_t id, const char *toml);

/// Removes an emitter; its spheres stay.
CaromStatus carom_world_remove_emitter(CaromWorld world, uint64_t id);

/// Reads a list of ids (CaromList), with `stride` bytes from one to the next (0: no gaps), and
/// writes their number to `count`. If `ids` is null, only the number is written. More than
/// `capacity` ids are an error.
CaromStatus carom_world_ids(CaromWorld world, int32_t list, uint64_t *ids, size_t stride, size_t capacity, size_t *count);

/// Reads counts and energies of the last step; all are 0 after carom_world_restore().
CaromStatus carom_world_report(CaromWorld world, CaromReport *report);

/// Reads the work of the kicks of colliders in the last step [J]; 0 after carom_world_restore().
CaromStatus carom_world_kick_work(CaromWorld world, double *work);

/// Reads the energy that held forces added in the last step under the rule `exact` [J], besides
/// carom_world_energy_account(); 0 after carom_world_restore().
CaromStatus carom_world_integration_energy(CaromWorld world, double *energy);

/// Reads the impacts of the last step in order of time, in the way of carom_world_ids().
CaromStatus carom_world_impacts(CaromWorld world, CaromImpact *impacts, size_t stride, size_t capacity, size_t *count);

/// Reads the persistent contacts with their forces, in the way of carom_world_ids(). They exist
/// under the rules `exact` and `contact` after a step.
CaromStatus carom_world_contacts(CaromWorld world, CaromContact *contacts, size_t stride, size_t capacity, size_t *count);

/// Reads which spheres are inside triggers at the end of the last step, in the way of
/// carom_world_ids().
CaromStatus carom_world_triggers(CaromWorld world, CaromTrigger *triggers, size_t stride, size_t capacity, size_t *count);

/// Reads which spheres entered and left triggers in the last step, in order of time, in the way of
/// carom_world_ids(): all of them, however small the trigger and however fast the sphere.
CaromStatus carom_world_sensor_events(CaromWorld world, CaromSensorEvent *events, size_t stride, size_t capacity, size_t *count);

/// Reads which spheres entered wells, left them or turned back at their edge in the last step, in order
/// of time, in the way of carom_world_ids().
CaromStatus carom_world_well_events(CaromWorld world, CaromWellEvent *events, size_t stride, size_t capacity, size_t *count);

/// Reads the changes of the energy in the last step; all are 0 after carom_world_restore().
CaromStatus carom_world_energy_account(CaromWorld world, CaromEnergyAccount *account);

/// Reads the groups of impacts of the last step in order of time, in the way of carom_world_ids(); none
/// under the rules `discrete` and `bisect`.
CaromStatus carom_world_impact_groups(CaromWorld world, CaromImpactGroup *groups, size_t stride, size_t capacity, size_t *count);

/// Reads the work of the last step; all counts are 0 after carom_world_restore().
CaromStatus carom_world_work(CaromWorld world, CaromStageCounts *work);

/// Reads the account of contacts of the last step; all is 0 after carom_world_restore().
CaromStatus carom_world_contact_account(CaromWorld world, CaromContactAccount *account);

/// Reads the account of zones of the last step; all is 0 after carom_world_restore().
CaromStatus carom_world_zone_account(CaromWorld world, CaromZoneAccount *account);

/// Reads the total energies and momenta of all spheres.
CaromStatus carom_world_totals(CaromWorld world, CaromTotals *totals);

/// Reads whether spheres are rotated or rotate, or may start to by friction: 1, else 0. Otherwise a
/// program need not draw their orientations.
CaromStatus carom_world_has_spin(CaromWorld world, uint32_t *has_spin);

/// Reads which spheres overlap each other (if spheres collide) or a solid collider by more than
/// `tolerance` [m], in the way of carom_world_ids().
CaromStatus carom_world_overlaps(CaromWorld world, double tolerance, CaromOverlap *overlaps, size_t stride, size_t capacity, size_t *count);

/// Returns a filter that finds spheres and colliders, but no triggers.
CaromQueryFilter carom_query_filter(void);

/// Reads what `count` rays meet first into `hits`, which has room for as many; both are without
/// gaps. A rectangle is met from its front only. One call with many rays is much faster than as
/// many calls.
CaromStatus carom_world_cast_rays(CaromWorld world, const CaromRay *rays, size_t count, const CaromQueryFilter *filter, CaromHit *hits);

/// Reads what `count` moving spheres meet first into `hits`, in the way of carom_world_cast_rays().
CaromStatus carom_world_cast_spheres(CaromWorld world, const CaromMovingSphere *spheres, size_t count, const CaromQueryFilter *filter, CaromHit *hits);

/// Reads the body nearest to a point, three numbers [m], if its surface is at most `within` [m]
/// away, which may be infinite.
CaromStatus carom_world_nearest(CaromWorld world, const double *point, double within, const CaromQueryFilter *filter, CaromNearBody *nearest);

/// Reads the bodies that touch or overlap a sphere, whose `way` is not used: spheres first, then
/// colliders, in the order of ids. Writes their number to `count`; if `bodies` is null, only that.
/// More than `capacity` bodies, which are without gaps, are an error.
CaromStatus carom_world_overlapping(CaromWorld world, const CaromMovingSphere *sphere, const CaromQueryFilter *filter, CaromNearBody *bodies, size_t capacity, size_t *count);

/// Predicts the path of a sphere for `horizon` [s], or up to its impact number `most_impacts`, and
/// writes its handle. The world does not change. The other spheres keep to their flights, but for
/// those that the sphere strikes. While nothing else interferes, steps under the rule `exact` give
/// the same to the bit. Springs, and forces that are not linear, are refused.
CaromStatus carom_world_predict(CaromWorld world, uint64_t sphere, double horizon, size_t most_impacts, CaromPath *path);

/// Frees a path.
CaromStatus carom_path_free(CaromPath path);

/// Reads where a path ends (CaromPathEnd), and when, on the world's clock [s].
CaromStatus carom_path_end(CaromPath path, int32_t *end, double *time);

/// Reads centre [m] and velocity [m/s], three numbers each, at a time on the world's clock [s]; at
/// an event those after it. In a periodic box the centre is within it. A time outside of the path
/// is CAROM_STATUS_INVALID.
CaromStatus carom_path_at(CaromPath path, double time, double *position, double *velocity);

/// Reads the impacts of the sphere on its way in the way of carom_world_ids(). Their times are from
/// the prediction on.
CaromStatus carom_path_impacts(CaromPath path, CaromImpact *impacts, size_t stride, size_t capacity, size_t *count);

/// Reads the legs of a path, one after the other without gaps in time, in the way of
/// carom_world_ids().
CaromStatus carom_path_legs(CaromPath path, CaromPathLeg *legs, size_t stride, size_t capacity, size_t *count);

/// Takes a snapshot of everything that the future of a world depends on.
CaromStatus carom_world_snapshot(CaromWorld world, CaromSnapshot *snapshot);

/// Takes a snapshot into the memory of an earlier one, which is overwritten and keeps its handle: for a
/// game that goes back, and takes one in each frame.
CaromStatus carom_world_snapshot_into(CaromWorld world, CaromSnapshot snapshot);

/// Restores a snapshot of this or another world, bit for bit. The report of the last step is
/// removed.
CaromStatus carom_world_restore(CaromWorld world, CaromSnapshot snapshot);

/// Frees a snapshot.
CaromStatus carom_snapshot_free(CaromSnapshot snapshot);

/// Reads the time of a snapshot [s].
CaromStatus carom_snapshot_time(CaromSnapshot snapshot, double *time);

/// Writes a snapshot as bytes, which are the same on every platform, and their number to `size`. If
/// `bytes` is null, only the number is written. The same version of Carom can read them, in Python
/// and Rust, too. A snapshot with a force that is a function cannot be written.
CaromStatus carom_snapshot_to_bytes(CaromSnapshot snapshot, uint8_t *bytes, size_t capacity, size_t *size);

/// Makes a snapshot from bytes of carom_snapshot_to_bytes(). A checksum detects damage, but not
/// malicious bytes: read only bytes that you trust.
CaromStatus carom_snapshot_from_bytes(const uint8_t *bytes, size_t size, CaromSnapshot *snapshot);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* CAROM_H */
