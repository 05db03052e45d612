// Runs scenes and prints their state hashes: equal to those of every other language.
//
//     state_hashes SECONDS SCENE...

#include <carom.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(CaromStatus status) {
    if (status != CAROM_STATUS_OK) {
        fprintf(stderr, "%s: %s\n", carom_status_name(status), carom_last_error());
        exit(1);
    }
}

int main(int argument_count, char **arguments) {
    if (argument_count < 3) {
        fprintf(stderr, "usage: state_hashes SECONDS SCENE...\n");
        return 2;
    }
    const double seconds = atof(arguments[1]);
    for (int i = 2; i < argument_count; i++) {
        CaromWorld world;
        check(carom_world_from_scene(arguments[i], NULL, 0, &world));
        double frame_time;
        check(carom_world_frame_time(world, &frame_time));
        check(carom_world_advance(world, (uint64_t)round(seconds / frame_time), NULL));
        uint64_t hash;
        check(carom_world_state_hash(world, &hash));
        printf("%s %016" PRIx64 "\n", arguments[i], hash);
        check(carom_world_free(world));
    }
    return 0;
}
