// Calls every function of carom.h correctly and with a mistake, together with every_query.c; `cargo xtask c --test`
// runs both under valgrind.

#include "expect.h"

#include <carom.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A row of a game, with more than a position.
struct Body {
    char name[12];
    float position[3];
    double velocity[3];
};

// A spring to the origin, and how often it was called and destroyed.
struct Spring {
    double stiffness;
    unsigned calls, destroyed;
    CaromWorld own_world;
    CaromStatus own_status;
};

static void pull(const CaromSphereState *sphere, double time, double *force, void *user_data) {
    struct Spring *spring = user_data;
    EXPECT(sphere->mass > 0.0 && time >= 0.0);
    for (int i = 0; i < 3; i++) {
        force[i] = -spring->stiffness * sphere->position[i];
    }
    spring->calls++;
    // The world that it acts in is being stepped.
    double now;
    spring->own_status = carom_world_time(spring->own_world, &now);
}

static double energy(const CaromSphereState *sphere, double time, void *user_data) {
    const struct Spring *spring = user_data;
    const double *x = sphere->position;
    (void)time;
    return 0.5 * spring->stiffness * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

static void destroy(void *user_data) {
    ((struct Spring *)user_data)->destroyed++;
}

static void versions(void) {
    OK(carom_check_abi(CAROM_ABI_VERSION));
    FAILS(CAROM_STATUS_ABI, carom_check_abi(CAROM_ABI_VERSION + 1));
    EXPECT(carom_abi_version() == CAROM_ABI_VERSION);
    EXPECT(strchr(carom_version(), '.') != NULL);
    EXPECT(strcmp(carom_status_name(CAROM_STATUS_OK), "ok") == 0);
    EXPECT(strcmp(carom_status_name(CAROM_STATUS_PANIC), "panic") == 0);
    EXPECT(strcmp(carom_status_name(-1), "unknown status") == 0);
}

static void worlds(void) {
    CaromWorld world, copy, none = {0};
    OK(carom_world_new(&world));
    FAILS(CAROM_STATUS_NULL, carom_world_new(NULL));
    OK(carom_world_copy(world, &copy));
    EXPECT(carom_world_is_valid(world) == 1 && carom_world_is_valid(none) == 0);
    FAILS(CAROM_STATUS_NULL, carom_world_copy(none, &copy));
    OK(carom_world_free(world));
    FAILS(CAROM_STATUS_HANDLE, carom_world_free(world));
    FAILS(CAROM_STATUS_HANDLE, carom_world_step(world, 0.1));
    EXPECT(carom_world_is_valid(copy) == 1);
    OK(carom_world_free(copy));
}

static void scenes(void) {
    size_t scenes = 0;
    while (carom_scene_name(scenes) != NULL) {
        scenes++;
    }
    EXPECT(scenes > 10);
    CaromWorld world;
    const char *overrides[] = {"simulation.rule=discrete", "simulation.frame_time=0.01"};
    OK(carom_world_from_scene("simtest1", overrides, 2, &world));
    double frame_time;
    OK(carom_world_frame_time(world, &frame_time));
    EXPECT(frame_time == 0.01);
    OK(carom_world_free(world));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_from_scene("simtest", NULL, 0, &world));
    EXPECT(strstr(carom_last_error(), "did you mean") != NULL);
    FAILS(CAROM_STATUS_NULL, carom_world_from_scene("simtest1", NULL, 2, &world));
    const char *toml = "spheres = [{ radius = 0.5 }]\n[[forces]]\ngravity = { acceleration = [0, -10, 0] }\n";
    FAILS(CAROM_STATUS_SCENE, carom_world_from_toml("name = \"a\"\nspheres = [{ radus = 1 }]", NULL, 0, &world));
    EXPECT(strstr(carom_last_error(), "scene:2: spheres[0].radus") != NULL);
    FAILS(CAROM_STATUS_ARGUMENT, carom_world_from_toml("name = \"\xff\"", NULL, 0, &world));
    const char *override = "simulation.duration=3";
    OK(carom_world_from_toml("name = \"fall\"\n", &override, 1, &world));
    CaromAdded added;
    OK(carom_world_add_toml(world, toml, &added));
    OK(carom_world_add_toml(world, toml, NULL));
    EXPECT(added.spheres == 1 && added.first_sphere == 0 && added.forces == 1 && added.colliders == 0);
    FAILS(CAROM_STATUS_SCENE, carom_world_add_toml(world, "spheres = 1", &added));
    OK(carom_world_set_simulation(world, "[simulation]\nrule = \"contact\"\nframe_time = 0.02\n"));
    FAILS(CAROM_STATUS_SCENE, carom_world_set_simulation(world, "[simulation]\nrule = \"contacts\"\n"));
    OK(carom_world_frame_time(world, &frame_time));
    EXPECT(frame_time == 0.02);
    OK(carom_world_free(world));
}

static void time_passes(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    CaromCollider floor = carom_collider();
    OK(carom_world_add_collider(world, &floor, NULL));
    CaromSphere ball = carom_sphere();
    ball.position[1] = 3.0;
    ball.velocity[1] = -1.0;
    OK(carom_world_add_sphere(world, &ball, NULL));
    double time;
    OK(carom_world_next_event_time(world, 10.0, &time));
    EXPECT(time == 2.0);
    OK(carom_world_next_event_time(world, 1.0, &time));
    EXPECT(isinf(time));
    OK(carom_world_step_to_next_event(world, 10.0));
    OK(carom_world_time(world, &time));
    EXPECT(time == 2.0);
    FAILS(CAROM_STATUS_INVALID, carom_world_step(world, NAN));
    FAILS(CAROM_STATUS_INVALID, carom_world_step(world, 0.0));
    OK(carom_world_step(world, 1.0));
    uint64_t taken = 0, before, after;
    OK(carom_world_advance(world, 60, &taken));
    EXPECT(taken == 60);
    OK(carom_world_state_hash(world, &before));
    OK(carom_world_set_stop(world, 1));
    FAILS(CAROM_STATUS_STOPPED, carom_world_step(world, 1.0));
    FAILS(CAROM_STATUS_STOPPED, carom_world_advance(world, 1, &taken));
    EXPECT(taken == 0);
    OK(carom_world_state_hash(world, &after));
    EXPECT(before == after);
    OK(carom_world_set_stop(world, 0));
    OK(carom_world_set_time(world, 0.0));
    OK(carom_world_time(world, &time));
    EXPECT(time == 0.0);
    OK(carom_world_free(world));
}

static void spheres(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    CaromSphere balls[3];
    for (int i = 0; i < 3; i++) {
        balls[i] = carom_sphere();
        balls[i].position[0] = 3.0 * i;
    }
    uint64_t ids[3], id;
    OK(carom_world_add_spheres(world, balls, 0, 3, ids));
    EXPECT(ids[0] == 0 && ids[2] == 2);
    balls[1].radius = -1.0;
    FAILS(CAROM_STATUS_INVALID, carom_world_add_spheres(world, balls, sizeof balls[0], 3, NULL));
    EXPECT(strstr(carom_last_error(), "spheres[1]") != NULL);
    FAILS(CAROM_STATUS_LENGTH, carom_world_add_spheres(world, balls, 8, 3, NULL));
    size_t count, index;
    OK(carom_world_count(world, &count));
    EXPECT(count == 3);
    CaromSphere ball;
    OK(carom_world_sphere(world, 1, &ball));
    EXPECT(ball.position[0] == 3.0 && isnan(ball.friction));
    ball.density = 3.0;
    ball.friction = 0.5;
    OK(carom_world_set_sphere(world, 1, &ball));
    OK(carom_world_sphere(world, 1, &ball));
    EXPECT(fabs(ball.mass - 4.0 * acos(-1.0)) < 1e-14 && ball.friction == 0.5);
    OK(carom_world_remove_spheres(world, ids, 1));
    OK(carom_world_index_of(world, 1, &index));
    EXPECT(index == 0);
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_index_of(world, 0, &index));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_sphere(world, 0, &ball));
    OK(carom_world_ids(world, CAROM_LIST_SPHERES, NULL, 0, 0, &count));
    EXPECT(count == 2);
    OK(carom_world_ids(world, CAROM_LIST_SPHERES, ids, 0, 3, &count));
    EXPECT(count == 2 && ids[0] == 1 && ids[1] == 2);
    FAILS(CAROM_STATUS_LENGTH, carom_world_ids(world, CAROM_LIST_SPHERES, ids, 0, 1, &count));
    EXPECT(count == 2);
    FAILS(CAROM_STATUS_ARGUMENT, carom_world_ids(world, 8, ids, 0, 3, &count));
    OK(carom_world_add_sphere(world, &ball, &id));
    EXPECT(id == 3);
    OK(carom_world_free(world));
}

static void arrays(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    CaromSphere ball = carom_sphere();
    OK(carom_world_add_sphere(world, &ball, NULL));
    ball.position[2] = 4.0;
    OK(carom_world_add_sphere(world, &ball, NULL));
    struct Body bodies[2] = {{"one", {0}, {0}}, {"two", {0}, {0}}};
    OK(carom_world_read_f32(world, CAROM_QUANTITY_POSITIONS, bodies[0].position, sizeof bodies[0], 2));
    EXPECT(bodies[1].position[2] == 4.0f && strcmp(bodies[1].name, "two") == 0);
    bodies[1].velocity[0] = 1.5;
    OK(carom_world_write(world, CAROM_QUANTITY_VELOCITIES, bodies[0].velocity, sizeof bodies[0], 2));
    double velocities[6], orientations[8], radii[2] = {0.5, 0.25};
    OK(carom_world_read(world, CAROM_QUANTITY_VELOCITIES, velocities, 0, 2));
    EXPECT(velocities[3] == 1.5 && velocities[0] == 0.0);
    OK(carom_world_read(world, CAROM_QUANTITY_ORIENTATIONS, orientations, 0, 2));
    EXPECT(orientations[3] == 1.0 && orientations[7] == 1.0);
    OK(carom_world_write(world, CAROM_QUANTITY_RADII, radii, 0, 2));
    float forces[6] = {0.0f, 2.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    OK(carom_world_write_f32(world, CAROM_QUANTITY_APPLIED_FORCES, forces, 0, 2));
    OK(carom_world_step(world, 1.0));
    OK(carom_world_read(world, CAROM_QUANTITY_VELOCITIES, velocities, 0, 2));
    EXPECT(velocities[1] == 2.0 && velocities[3] == 1.5);
    FAILS(CAROM_STATUS_LENGTH, carom_world_read(world, CAROM_QUANTITY_RADII, radii, 0, 1));
    FAILS(CAROM_STATUS_NULL, carom_world_read(world, CAROM_QUANTITY_RADII, NULL, 0, 2));
    FAILS(CAROM_STATUS_ARGUMENT, carom_world_read(world, 13, radii, 0, 2));
    radii[1] = 0.0;
    FAILS(CAROM_STATUS_INVALID, carom_world_write(world, CAROM_QUANTITY_RADII, radii, 0, 2));
    EXPECT(strstr(carom_last_error(), "radii[1]") != NULL);
    OK(carom_world_read(world, CAROM_QUANTITY_RADII, radii, 0, 2));
    EXPECT(radii[0] == 0.5 && radii[1] == 0.25);
    OK(carom_world_free(world));
}

static void colliders_and_reports(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    const double gravity[3] = {0.0, -10.0, 0.0};
    uint64_t id, force;
    OK(carom_world_add_gravity(world, gravity, &force));
    CaromCollider floor = carom_collider(), trigger = carom_collider();
    floor.restitution = 0.0;
    OK(carom_world_add_collider(world, &floor, &id));
    trigger.shape = CAROM_SHAPE_BOX;
    trigger.size[0] = trigger.size[1] = trigger.size[2] = 4.0;
    trigger.trigger = 1;
    OK(carom_world_add_collider(world, &trigger, NULL));
    CaromSphere ball = carom_sphere();
    ball.position[1] = 1.5;
    OK(carom_world_add_sphere(world, &ball, NULL));
    OK(carom_world_step(world, 1.0));
    CaromImpact impact;
    CaromContact contact;
    CaromTrigger inside;
    CaromReport report;
    CaromTotals totals;
    size_t count;
    OK(carom_world_impacts(world, &impact, 0, 1, &count));
    EXPECT(count == 1 && impact.bodies.body_1_is_collider == 1 && impact.bodies.body_1 == id);
    EXPECT(fabs(impact.approach_speed - sqrt(10.0)) < 1e-12);
    OK(carom_world_contacts(world, &contact, 0, 1, &count));
    EXPECT(count == 1 && fabs(contact.normal_force - 10.0) < 1e-12 && contact.normal[1] == 1.0);
    OK(carom_world_triggers(world, &inside, 0, 1, &count));
    EXPECT(count == 1 && inside.collider == id + 1 && inside.sphere == 0);
    OK(carom_world_report(world, &report));
    EXPECT(report.impacts == 1 && report.was_stepped == 0);
    OK(carom_world_totals(world, &totals));
    EXPECT(totals.kinetic_energy == 0.0 && fabs(totals.potential_energy - 10.0) < 1e-12);
    // The floor rises by 0.25 m.
    OK(carom_world_collider(world, id, &floor));
    floor.position[1] = 0.25;
    OK(carom_world_set_collider(world, id, &floor));
    CaromOverlap overlap;
    OK(carom_world_overlaps(world, 1e-9, &overlap, 0, 1, &count));
    EXPECT(count == 1 && fabs(overlap.depth - 0.25) < 1e-12);
    FAILS(CAROM_STATUS_INVALID, carom_world_overlaps(world, NAN, &overlap, 0, 1, &count));
    const double along[3] = {0.5, 0.0, 0.0}, nowhere[3] = {NAN, 0.0, 0.0};
    OK(carom_world_set_surface_velocity(world, id, along));
    FAILS(CAROM_STATUS_INVALID, carom_world_set_surface_velocity(world, id, nowhere));
    FAILS(CAROM_STATUS_NULL, carom_world_set_surface_velocity(world, id, NULL));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_set_surface_velocity(world, 999, along));
    const double pivot[3] = {0.0, 0.0, 0.0};
    CaromKeyframe keyframes[2] = {{0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}},
                                  {1.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
    OK(carom_world_set_keyframes(world, id, keyframes, 2, pivot, 0));
    FAILS(CAROM_STATUS_INVALID, carom_world_set_keyframes(world, id, keyframes, 2, pivot, 1));
    FAILS(CAROM_STATUS_INVALID, carom_world_set_keyframes(world, id, keyframes, 1, pivot, 0));
    FAILS(CAROM_STATUS_NULL, carom_world_set_keyframes(world, id, NULL, 2, pivot, 0));
    OK(carom_world_set_keyframes(world, id, NULL, 0, pivot, 0));
    OK(carom_world_set_motion(world, id, "[{ steady = { velocity = [0, 1, 0] } }, { turn = { rate = 2.0 } }]"));
    FAILS(CAROM_STATUS_SCENE, carom_world_set_motion(world, id, "{ turns = { rate = 2.0 } }"));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_set_motion(world, 999, "[]"));
    FAILS(CAROM_STATUS_NULL, carom_world_set_motion(world, id, NULL));
    OK(carom_world_set_motion(world, id, "[]"));
    const double level[4] = {0.0, 0.0, 0.0, 1.0};
    OK(carom_world_set_next_pose(world, id, pivot, level, 0.5));
    FAILS(CAROM_STATUS_INVALID, carom_world_set_next_pose(world, id, nowhere, level, 0.5));
    FAILS(CAROM_STATUS_INVALID, carom_world_set_next_pose(world, id, pivot, level, 0.0));
    FAILS(CAROM_STATUS_NULL, carom_world_set_next_pose(world, id, pivot, NULL, 0.5));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_set_next_pose(world, 999, pivot, level, 0.5));
    floor.shape = 17;
    FAILS(CAROM_STATUS_ARGUMENT, carom_world_set_collider(world, id, &floor));
    floor.shape = CAROM_SHAPE_CONTAINER;
    floor.open_sides = 63;
    FAILS(CAROM_STATUS_INVALID, carom_world_add_collider(world, &floor, NULL));
    floor.open_sides = CAROM_SIDE_TOP;
    OK(carom_world_add_collider(world, &floor, NULL));
    OK(carom_world_remove_collider(world, id));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_collider(world, id, &floor));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_remove_collider(world, id));
    OK(carom_world_remove_force(world, force));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_remove_force(world, force));
    CaromAdded added;
    OK(carom_world_add_toml(world, "emitters = [{ position = [0, 9, 0], period = 0.5, sphere = { radius = 0.1 } }]", &added));
    OK(carom_world_step(world, 0.25));
    uint64_t emitted;
    OK(carom_world_ids(world, CAROM_LIST_EMITTED, &emitted, 0, 1, &count));
    EXPECT(count == 1 && emitted == 1);
    OK(carom_world_remove_emitter(world, added.first_emitter));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_remove_emitter(world, added.first_emitter));
    OK(carom_world_free(world));
}

static void meshes(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    CaromCollider surface = carom_collider();
    surface.shape = CAROM_SHAPE_OTHER;
    const double vertices[] = {-1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, -1.0};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    CaromMesh sheet = {vertices, 4, triangles, 2, 1, 0};
    uint64_t id;
    OK(carom_world_add_mesh(world, &surface, &sheet, &id));
    // A ball from behind passes it, one from the front does not.
    CaromSphere ball = carom_sphere();
    ball.radius = 0.25;
    ball.position[1] = -1.0;
    ball.velocity[1] = 2.0;
    OK(carom_world_add_sphere(world, &ball, NULL));
    OK(carom_world_step(world, 2.0));
    CaromCollider same;
    OK(carom_world_collider(world, id, &same));
    EXPECT(same.shape == CAROM_SHAPE_OTHER);
    ball.velocity[1] = -2.0;
    ball.position[1] = 2.25;
    OK(carom_world_set_sphere(world, 0, &ball));
    OK(carom_world_step(world, 2.0));
    OK(carom_world_sphere(world, 0, &ball));
    EXPECT(ball.position[1] == 2.25 && ball.velocity[1] == 2.0);
    sheet.one_sided = 2;
    FAILS(CAROM_STATUS_INVALID, carom_world_add_mesh(world, &surface, &sheet, NULL));
    sheet.one_sided = 0;
    sheet.vertex_count = 3;
    FAILS(CAROM_STATUS_INVALID, carom_world_add_mesh(world, &surface, &sheet, NULL));
    sheet.vertices = NULL;
    FAILS(CAROM_STATUS_NULL, carom_world_add_mesh(world, &surface, &sheet, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_add_mesh(world, &surface, NULL, NULL));
    const double heights[] = {0.0, 1.0, 0.0, 0.0, 1.0, 0.0};
    surface.size[0] = surface.size[2] = 4.0;
    surface.position[1] = -5.0;
    OK(carom_world_add_height_field(world, &surface, heights, 2, 3, NULL));
    FAILS(CAROM_STATUS_INVALID, carom_world_add_height_field(world, &surface, heights, 1, 6, NULL));
    FAILS(CAROM_STATUS_INVALID, carom_world_add_height_field(world, &surface, heights, 0, 0, NULL));
    FAILS(CAROM_STATUS_LENGTH, carom_world_add_height_field(world, &surface, heights, SIZE_MAX, 2, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_add_height_field(world, &surface, NULL, 2, 3, NULL));
    surface.shape = CAROM_SHAPE_BOX;
    FAILS(CAROM_STATUS_ARGUMENT, carom_world_add_height_field(world, &surface, heights, 2, 3, NULL));
    OK(carom_world_free(world));
}

static void forces(void) {
    CaromWorld world, copy;
    OK(carom_world_new(&world));
    struct Spring spring = {1.0, 0, 0, {0}, CAROM_STATUS_OK};
    spring.own_world = world;
    CaromForce force = {pull, energy, &spring, destroy};
    uint64_t id;
    OK(carom_world_add_force(world, &force, &id));
    OK(carom_world_add_drag(world, 0.0, NULL));
    FAILS(CAROM_STATUS_INVALID, carom_world_add_drag(world, -1.0, NULL));
    CaromSphere ball = carom_sphere();
    ball.position[0] = 1.0;
    OK(carom_world_add_sphere(world, &ball, NULL));
    for (int i = 0; i < 100; i++) {
        OK(carom_world_step(world, acos(-1.0) / 100.0));
    }
    EXPECT(spring.calls >= 100 && spring.own_status == CAROM_STATUS_BUSY);
    OK(carom_world_sphere(world, 0, &ball));
    EXPECT(fabs(ball.position[0] + 1.0) < 1e-3);
    CaromTotals totals;
    OK(carom_world_totals(world, &totals));
    EXPECT(fabs(totals.kinetic_energy + totals.potential_energy - 0.5) < 1e-3);
    // The copy and the snapshot have the force, too.
    CaromSnapshot snapshot;
    size_t size;
    OK(carom_world_copy(world, &copy));
    OK(carom_world_snapshot(world, &snapshot));
    FAILS(CAROM_STATUS_SNAPSHOT, carom_snapshot_to_bytes(snapshot, NULL, 0, &size));
    OK(carom_world_free(world));
    OK(carom_world_remove_force(copy, id));
    EXPECT(spring.destroyed == 0);
    OK(carom_snapshot_free(snapshot));
    EXPECT(spring.destroyed == 1);
    // A refused force is not destroyed.
    force.force = NULL;
    FAILS(CAROM_STATUS_NULL, carom_world_add_force(copy, &force, NULL));
    force.force = pull;
    FAILS(CAROM_STATUS_HANDLE, carom_world_add_force(world, &force, NULL));
    EXPECT(spring.destroyed == 1);
    OK(carom_world_free(copy));
}

static void springs(void) {
    CaromWorld world;
    OK(carom_world_new(&world));
    CaromSphere ball = carom_sphere();
    ball.position[0] = 3.0;
    uint64_t first, second, id;
    OK(carom_world_add_sphere(world, &ball, &first));
    ball.position[0] = 6.0;
    OK(carom_world_add_sphere(world, &ball, &second));
    CaromSpring spring = carom_spring();
    EXPECT(spring.to_point == 1 && spring.stiffness == 1.0 && spring.damping == 0.0);
    spring.sphere = first;
    OK(carom_world_add_spring(world, &spring, NULL));
    spring.to_point = 0;
    spring.other = second;
    spring.rest_length = 2.0;
    spring.only_pulls = 1;
    OK(carom_world_add_spring(world, &spring, &id));
    CaromTotals totals;
    OK(carom_world_totals(world, &totals));
    // The sum of k (l - l0)^2 / 2.
    EXPECT(totals.potential_energy == 4.5 + 0.5);
    CaromSpring read;
    OK(carom_world_spring(world, id, &read));
    EXPECT(read.other == second && read.rest_length == 2.0 && read.only_pulls == 1);
    read.stiffness = 3.0;
    OK(carom_world_set_spring(world, id, &read));
    OK(carom_world_totals(world, &totals));
    EXPECT(totals.potential_energy == 4.5 + 1.5);
    read.damping = -1.0;
    FAILS(CAROM_STATUS_INVALID, carom_world_set_spring(world, id, &read));
    read.other = first;
    FAILS(CAROM_STATUS_INVALID, carom_world_add_spring(world, &read, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_add_spring(world, NULL, NULL));
    OK(carom_world_remove_spring(world, id));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_remove_spring(world, id));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_spring(world, id, &read));
    size_t count;
    OK(carom_world_ids(world, CAROM_LIST_SPRINGS, NULL, 0, 0, &count));
    EXPECT(count == 1);
    // Springs are removed with their spheres.
    OK(carom_world_remove_spheres(world, &first, 1));
    OK(carom_world_ids(world, CAROM_LIST_SPRINGS, NULL, 0, 0, &count));
    EXPECT(count == 0);
    OK(carom_world_free(world));
}

static void snapshots(void) {
    CaromWorld world, other;
    OK(carom_world_from_scene("tutorial1", NULL, 0, &world));
    OK(carom_world_advance(world, 10, NULL));
    CaromSnapshot snapshot, read, none = {0};
    OK(carom_world_snapshot(world, &snapshot));
    uint64_t then, later, again;
    double time, taken;
    OK(carom_world_time(world, &time));
    OK(carom_snapshot_time(snapshot, &taken));
    EXPECT(time == taken);
    OK(carom_world_state_hash(world, &then));
    OK(carom_world_advance(world, 50, NULL));
    OK(carom_world_state_hash(world, &later));
    EXPECT(then != later);
    size_t size, written;
    OK(carom_snapshot_to_bytes(snapshot, NULL, 0, &size));
    uint8_t *bytes = malloc(size);
    FAILS(CAROM_STATUS_LENGTH, carom_snapshot_to_bytes(snapshot, bytes, size - 1, &written));
    OK(carom_snapshot_to_bytes(snapshot, bytes, size, &written));
    EXPECT(written == size);
    OK(carom_snapshot_from_bytes(bytes, size, &read));
    OK(carom_world_new(&other));
    OK(carom_world_restore(other, read));
    OK(carom_world_state_hash(other, &again));
    EXPECT(again == then);
    OK(carom_world_advance(other, 50, NULL));
    OK(carom_world_state_hash(other, &again));
    EXPECT(again == later);
    bytes[size / 2] ^= 1;
    FAILS(CAROM_STATUS_SNAPSHOT, carom_snapshot_from_bytes(bytes, size, &read));
    FAILS(CAROM_STATUS_SNAPSHOT, carom_snapshot_from_bytes(bytes, 3, &read));
    free(bytes);
    OK(carom_world_restore(world, snapshot));
    OK(carom_world_state_hash(world, &again));
    EXPECT(again == then);
    OK(carom_world_snapshot_into(other, snapshot));
    OK(carom_world_restore(world, snapshot));
    OK(carom_world_state_hash(world, &again));
    EXPECT(again == later);
    FAILS(CAROM_STATUS_NULL, carom_world_snapshot_into(world, none));
    FAILS(CAROM_STATUS_NULL, carom_world_restore(world, none));
    // The handle of a world is no handle of a snapshot.
    none.id = world.id;
    FAILS(CAROM_STATUS_HANDLE, carom_world_restore(world, none));
    OK(carom_snapshot_free(snapshot));
    FAILS(CAROM_STATUS_HANDLE, carom_snapshot_free(snapshot));
    OK(carom_snapshot_free(read));
    OK(carom_world_free(world));
    OK(carom_world_free(other));
}

int main(void) {
    versions();
    worlds();
    scenes();
    time_passes();
    spheres();
    arrays();
    colliders_and_reports();
    meshes();
    forces();
    springs();
    snapshots();
    printf("every function: ok\n");
    return 0;
}
