// Calls every query of carom.h, predicted paths, changes of single spheres, accounts and texts that change a world,
// correctly and with a mistake.

#include "expect.h"

#include <carom.h>
#include <math.h>
#include <string.h>

static void strikes(void) {
    CaromWorld world;
    uint64_t id;
    uint32_t has_spin;
    OK(carom_world_new(&world));
    CaromSphere ball = carom_sphere();
    OK(carom_world_add_sphere(world, &ball, &id));
    OK(carom_world_has_spin(world, &has_spin));
    EXPECT(has_spin == 0);
    CaromStrike strike = carom_strike();
    EXPECT(strike.speed == 0.0 && strike.cue_mass == 0.567);
    strike.speed = 3.0, strike.cue_mass = ball.mass, strike.azimuth_degrees = 90.0, strike.offset[1] = 0.5;
    OK(carom_world_strike(world, id, &strike));
    OK(carom_world_sphere(world, id, &ball));
    // 2 v / (1 + m / M + 5/2 b^2) along -z, and 5/2 b / r of it about -x.
    const double speed = 2.0 * 3.0 / (2.0 + 2.5 * 0.25);
    EXPECT(fabs(ball.velocity[2] + speed) < 1e-14 && fabs(ball.angular_velocity[0] + 1.25 * speed) < 1e-14);
    OK(carom_world_has_spin(world, &has_spin));
    EXPECT(has_spin == 1);
    strike.offset[1] = 1.0;
    FAILS(CAROM_STATUS_INVALID, carom_world_strike(world, id, &strike));
    FAILS(CAROM_STATUS_NULL, carom_world_strike(world, id, NULL));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_strike(world, id + 1, &strike));
    FAILS(CAROM_STATUS_NULL, carom_world_has_spin(world, NULL));
    OK(carom_world_free(world));
}

static void texts(void) {
    CaromWorld world;
    CaromAdded added;
    CaromSphere ball;
    const char *scene = "name = \"cup\"\n[materials]\nivory = {}\nslate = {}\n"
                        "[[colliders]]\nshape = \"half-space\"\nmaterial = \"slate\"\n"
                        "[[spheres]]\nradius = 1\nposition = [0, 2, 0]\nvelocity = [0, -4, 0]\nmaterial = \"ivory\"\n";
    OK(carom_world_from_toml(scene, NULL, 0, &world));
    const char *pair = "material_pairs = [{ materials = [\"ivory\", \"slate\"], restitution = 0.25 }]";
    OK(carom_world_set_material_pairs(world, pair));
    OK(carom_world_step(world, 0.5));
    OK(carom_world_sphere(world, 0, &ball));
    EXPECT(ball.velocity[1] == 1.0);
    CaromImpactGroup group;
    size_t count;
    OK(carom_world_impact_groups(world, &group, 0, 1, &count));
    EXPECT(count == 1 && group.first == 0 && group.count == 1);
    // The floor takes all but a sixteenth of the energy, as the restitution demands.
    EXPECT(group.energy_after == group.energy_before / 16.0);
    EXPECT(group.energy_demanded == group.energy_after - group.energy_before);
    EXPECT(group.momentum_before[1] == -4.0 * ball.mass && group.momentum_after[1] == group.momentum_before[1]);
    FAILS(CAROM_STATUS_LENGTH, carom_world_impact_groups(world, &group, 0, 0, &count));
    FAILS(CAROM_STATUS_NULL, carom_world_impact_groups(world, &group, 0, 1, NULL));
    FAILS(CAROM_STATUS_SCENE, carom_world_set_material_pairs(world, "material_pairs = [{ materials = [\"ivory\", \"cork\"] }]"));
    EXPECT(strstr(carom_last_error(), "material_pairs[0].materials") != NULL);
    FAILS(CAROM_STATUS_NULL, carom_world_set_material_pairs(world, NULL));
    const char *source = "emitters = [{ position = [0, 50, 0], period = 0.5, sphere = { radius = 0.1 } }]";
    const char *faster = "emitters = [{ position = [0, 50, 0], period = 0.25, sphere = { radius = 0.2 } }]";
    OK(carom_world_add_toml(world, source, &added));
    OK(carom_world_set_emitter(world, added.first_emitter, faster));
    OK(carom_world_step(world, 0.1));
    OK(carom_world_sphere(world, 1, &ball));
    EXPECT(ball.radius == 0.2);
    FAILS(CAROM_STATUS_SCENE, carom_world_set_emitter(world, added.first_emitter, "emitters = []"));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_set_emitter(world, 99, faster));
    FAILS(CAROM_STATUS_NULL, carom_world_set_emitter(world, added.first_emitter, NULL));
    OK(carom_world_free(world));
}

static void accounts(void) {
    CaromWorld world;
    CaromStageCounts work;
    CaromContactAccount contacts;
    CaromZoneAccount zones;
    CaromReport report;
    double longest;
    const char *rule = "simulation.rule=contact";
    OK(carom_world_from_scene("tutorial4", &rule, 1, &world));
    OK(carom_world_advance(world, 60, NULL));
    OK(carom_world_work(world, &work));
    OK(carom_world_contact_account(world, &contacts));
    OK(carom_world_zone_account(world, &zones));
    OK(carom_world_report(world, &report));
    EXPECT(work.searches > 0 && work.sweeps > 0 && work.predictions == 0);
    EXPECT(contacts.residual == report.residual && contacts.asleep == report.asleep);
    EXPECT(contacts.largest_overlap == report.largest_overlap && contacts.squeezed == report.squeezed);
    EXPECT(zones.spheres == 0 && zones.sphere_seconds == 0.0);
    OK(carom_world_longest_stable_frame(world, &longest));
    EXPECT(isinf(longest));
    OK(carom_world_set_simulation(world, "simulation = { rule = \"discrete\" }"));
    CaromSpring spring = carom_spring();
    spring.stiffness = 4.0;
    OK(carom_world_add_spring(world, &spring, NULL));
    CaromSphere ball;
    OK(carom_world_sphere(world, 0, &ball));
    OK(carom_world_longest_stable_frame(world, &longest));
    // Two over the frequency of the spring; rounding of a root and a quotient.
    EXPECT(fabs(longest - 2.0 / sqrt(4.0 / ball.mass)) < 1e-15 * longest);
    FAILS(CAROM_STATUS_NULL, carom_world_work(world, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_contact_account(world, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_zone_account(world, NULL));
    FAILS(CAROM_STATUS_NULL, carom_world_longest_stable_frame(world, NULL));
    OK(carom_world_free(world));
}

int main(void) {
    strikes();
    texts();
    accounts();
    CaromWorld world;
    uint64_t near, far, gate, data;
    OK(carom_world_new(&world));
    CaromSphere ball = carom_sphere();
    ball.radius = 0.5;
    OK(carom_world_add_sphere(world, &ball, &near));
    ball.position[0] = 5.0;
    OK(carom_world_add_sphere(world, &ball, &far));
    CaromCollider sheet = carom_collider();
    sheet.shape = CAROM_SHAPE_BOX;
    sheet.size[0] = 0.01, sheet.size[1] = sheet.size[2] = 9.0, sheet.position[0] = 2.0, sheet.trigger = 1;
    OK(carom_world_add_collider(world, &sheet, &gate));

    CaromQueryFilter filter = carom_query_filter();
    const CaromRay rays[2] = {{{-1.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, {{-1.0, 3.0, 0.0}, {8.0, 0.0, 0.0}}};
    CaromHit hits[2];
    OK(carom_world_cast_rays(world, rays, 2, NULL, hits));
    EXPECT(hits[0].is_hit && hits[0].body == near && hits[0].fraction == 0.0625 && !hits[1].is_hit);
    FAILS(CAROM_STATUS_NULL, carom_world_cast_rays(world, rays, 2, NULL, NULL));
    filter.leaves_out_sphere = 1, filter.without_sphere = near;
    CaromMovingSphere moving = {{-1.0, 0.0, 0.0}, 0.25, {8.0, 0.0, 0.0}};
    OK(carom_world_cast_spheres(world, &moving, 1, &filter, hits));
    EXPECT(hits[0].body == far && !hits[0].is_collider && hits[0].fraction == 5.25 / 8.0);
    CaromNearBody body;
    OK(carom_world_nearest(world, moving.center, INFINITY, &filter, &body));
    EXPECT(body.is_found && body.body == far && body.distance == 5.5);
    FAILS(CAROM_STATUS_INVALID, carom_world_nearest(world, moving.center, -1.0, NULL, &body));
    size_t count;
    moving.radius = 0.5;
    OK(carom_world_overlapping(world, &moving, NULL, &body, 1, &count));
    EXPECT(count == 1 && body.body == near && body.distance == 0.0);
    moving.radius = 0.0;
    FAILS(CAROM_STATUS_INVALID, carom_world_overlapping(world, &moving, NULL, NULL, 0, &count));
    FAILS(CAROM_STATUS_INVALID, carom_world_cast_spheres(world, &moving, 1, NULL, hits));

    const double impulse[3] = {1000.0, 0.0, 0.0}, top[3] = {0.0, 0.5, 0.0}, none[3] = {0.0, 0.0, 0.0};
    OK(carom_world_apply_impulse(world, near, impulse));
    OK(carom_world_apply_impulse_at(world, near, none, top));
    FAILS(CAROM_STATUS_UNKNOWN, carom_world_apply_impulse(world, 99, impulse));
    uint32_t groups, collides_with;
    OK(carom_world_set_groups(world, far, 2, 3));
    OK(carom_world_groups(world, far, &groups, &collides_with));
    EXPECT(groups == 2 && collides_with == 3);
    OK(carom_world_set_user_data(world, far, 77));
    OK(carom_world_user_data(world, far, &data));
    EXPECT(data == 77);

    CaromPath path;
    OK(carom_world_predict(world, near, 1.0, 100, &path));
    FAILS(CAROM_STATUS_INVALID, carom_world_predict(world, near, 0.0, 100, &path));
    OK(carom_world_step(world, 0.25));
    double position[3], velocity[3], time;
    OK(carom_path_at(path, 0.25, position, velocity));
    OK(carom_world_sphere(world, near, &ball));
    EXPECT(memcmp(position, ball.position, sizeof position) == 0 && velocity[0] == ball.velocity[0]);
    FAILS(CAROM_STATUS_INVALID, carom_path_at(path, 2.0, position, velocity));
    int32_t end;
    OK(carom_path_end(path, &end, &time));
    EXPECT(end == CAROM_PATH_END_HORIZON && time == 1.0);
    CaromImpact impact;
    CaromPathLeg legs[2];
    OK(carom_path_impacts(path, &impact, 0, 1, &count));
    EXPECT(count == 1 && impact.bodies.body_2 == far && fabs(impact.time - 0.004) < 1e-15);
    OK(carom_path_legs(path, legs, 0, 2, &count));
    EXPECT(count == 2 && legs[0].end == legs[1].start);
    OK(carom_path_free(path));
    FAILS(CAROM_STATUS_HANDLE, carom_path_free(path));
    CaromSensorEvent events[2];
    OK(carom_world_sensor_events(world, events, 0, 2, &count));
    EXPECT(count == 2 && events[0].collider == gate && events[0].enters && !events[1].enters);
    EXPECT(fabs(events[0].time - 1.495e-3) < 1e-15 && events[0].speed == 1000.0);

    CaromWellEvent of_wells;
    OK(carom_world_well_events(world, &of_wells, 0, 1, &count));
    EXPECT(count == 0);

    // A bumper adds 3 m/s to a ball of 1 kg that comes with 1 m/s.
    double work;
    OK(carom_world_kick_work(world, &work));
    EXPECT(work == 0.0);
    OK(carom_world_add_toml(world, "colliders = [{ shape = \"half-space\", position = [0, -50, 0], kick = 3.0 }]", NULL));
    ball = carom_sphere();
    ball.position[1] = -48.5, ball.velocity[1] = -1.0;
    OK(carom_world_add_sphere(world, &ball, NULL));
    OK(carom_world_step(world, 1.0));
    OK(carom_world_kick_work(world, &work));
    EXPECT(fabs(work - 7.5) < 1e-12);
    FAILS(CAROM_STATUS_NULL, carom_world_kick_work(world, NULL));
    double integration;
    OK(carom_world_integration_energy(world, &integration));
    EXPECT(integration == 0.0);
    FAILS(CAROM_STATUS_NULL, carom_world_integration_energy(world, NULL));
    CaromEnergyAccount account;
    OK(carom_world_energy_account(world, &account));
    EXPECT(account.kicks == work && account.forces == 0.0 && account.applied == 0.0);
    FAILS(CAROM_STATUS_NULL, carom_world_energy_account(world, NULL));
    OK(carom_world_free(world));
    printf("every query: ok\n");
    return 0;
}
