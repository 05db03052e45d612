// A ball falls on a floor: the smallest program.
//
//     cargo build --release -p carom-c
//     cc bouncing_ball.c -I crates/carom-c/include -L target/release -lcarom_c -o bouncing_ball
//     LD_LIBRARY_PATH=target/release ./bouncing_ball

#include <carom.h>
#include <stdio.h>
#include <stdlib.h>

// Ends the program unless a call succeeded.
static void check(CaromStatus status) {
    if (status != CAROM_STATUS_OK) {
        fprintf(stderr, "%s: %s\n", carom_status_name(status), carom_last_error());
        exit(1);
    }
}

int main(void) {
    check(carom_check_abi(CAROM_ABI_VERSION));
    CaromWorld world;
    check(carom_world_new(&world));
    const double gravity[3] = {0.0, -9.81, 0.0};
    check(carom_world_add_gravity(world, gravity, NULL));
    CaromCollider floor = carom_collider();
    floor.restitution = 0.8;
    check(carom_world_add_collider(world, &floor, NULL));
    CaromSphere ball = carom_sphere();
    ball.position[1] = 2.0;
    ball.radius = 0.5;
    check(carom_world_add_sphere(world, &ball, NULL));

    for (int frame = 0; frame < 120; frame++) {
        double start;
        check(carom_world_time(world, &start));
        check(carom_world_step(world, 1.0 / 60.0));
        CaromImpact impacts[16];
        size_t count;
        check(carom_world_impacts(world, impacts, 0, 16, &count));
        for (size_t i = 0; i < count; i++) {
            printf("at %.6f s it bounces with %.6f m/s\n", start + impacts[i].time, impacts[i].approach_speed);
        }
    }
    check(carom_world_free(world));
    return 0;
}
