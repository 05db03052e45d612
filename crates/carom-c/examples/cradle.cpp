// Newton's cradle in C++: a world that frees itself, errors as exceptions, and a force that is a lambda.

#include <carom.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

void check(CaromStatus status) {
    if (status != CAROM_STATUS_OK) {
        throw std::runtime_error(std::string(carom_status_name(status)) + ": " + carom_last_error());
    }
}

struct Vector {
    double x, y, z;
};

class World {
public:
    World() { check(carom_world_new(&world_)); }
    World(const World &other) { check(carom_world_copy(other.world_, &world_)); }
    World(World &&other) noexcept : world_(std::exchange(other.world_, CaromWorld{})) {}
    World &operator=(World other) noexcept {
        std::swap(world_, other.world_);
        return *this;
    }
    ~World() { carom_world_free(world_); }

    std::uint64_t add(const CaromSphere &sphere) {
        std::uint64_t id = 0;
        check(carom_world_add_sphere(world_, &sphere, &id));
        return id;
    }

    // Adds a force that is any function of state and time. It is destroyed with the last world that has it.
    using Force = std::function<Vector(const CaromSphereState &, double)>;
    void add(Force force) {
        auto held = std::make_unique<Force>(std::move(force));
        CaromForce function{};
        function.force = [](const CaromSphereState *sphere, double time, double *out, void *data) {
            // An exception must not leave this function. A value that is not finite makes the step fail.
            out[0] = out[1] = out[2] = NAN;
            try {
                const Vector force = (*static_cast<Force *>(data))(*sphere, time);
                out[0] = force.x, out[1] = force.y, out[2] = force.z;
            } catch (...) {
            }
        };
        function.destroy = [](void *data) { delete static_cast<Force *>(data); };
        function.user_data = held.get();
        check(carom_world_add_force(world_, &function, nullptr));
        held.release();
    }

    void step(double dt) { check(carom_world_step(world_, dt)); }

    std::vector<Vector> read(CaromQuantity quantity) const {
        std::size_t count = 0;
        check(carom_world_count(world_, &count));
        std::vector<Vector> rows(count);
        check(carom_world_read(world_, quantity, &rows.data()->x, sizeof(Vector), count));
        return rows;
    }

private:
    CaromWorld world_{};
};

void expect(bool holds, const std::string &what) {
    if (!holds) {
        throw std::runtime_error("it does not hold that " + what);
    }
}

// Five touching balls; the first arrives with 1 m/s.
void cradle() {
    World world;
    for (int i = 0; i < 5; i++) {
        CaromSphere ball = carom_sphere();
        ball.radius = 0.5;
        ball.position[0] = i - (i == 0 ? 0.5 : 0.0);
        ball.velocity[0] = i == 0 ? 1.0 : 0.0;
        world.add(ball);
    }
    World copy = world;
    world.step(1.0);
    for (const Vector &velocity : world.read(CAROM_QUANTITY_VELOCITIES)) {
        std::cout << velocity.x << ' ';
    }
    std::cout << '\n';
    const auto velocities = world.read(CAROM_QUANTITY_VELOCITIES);
    expect(velocities[0].x == 0.0 && velocities[4].x == 1.0, "the last ball takes it all");
    expect(copy.read(CAROM_QUANTITY_VELOCITIES)[0].x == 1.0, "the copy is where it was");
}

// A spring defined by a lambda: half a period later the ball is on the other side.
void spring() {
    World world;
    CaromSphere ball = carom_sphere();
    ball.position[0] = 1.0;
    world.add(ball);
    const double stiffness = 1.0;
    world.add([stiffness](const CaromSphereState &sphere, double) {
        const double *x = sphere.position;
        return Vector{-stiffness * x[0], -stiffness * x[1], -stiffness * x[2]};
    });
    World moved = std::move(world);
    for (int i = 0; i < 100; i++) {
        moved.step(std::acos(-1.0) / 100.0);
    }
    const double x = moved.read(CAROM_QUANTITY_POSITIONS)[0].x;
    std::cout << "half a period later: " << x << " m\n";
    expect(std::abs(x + 1.0) < 1e-3, "half a period later it is on the other side");
    // An error is an exception, also if the function of a force throws.
    moved.add([](const CaromSphereState &, double) -> Vector { throw std::runtime_error("no"); });
    try {
        moved.step(1.0);
    } catch (const std::runtime_error &error) {
        std::cout << error.what() << '\n';
        return;
    }
    expect(false, "a force that throws has the step refused");
}

} // namespace

int main() {
    try {
        check(carom_check_abi(CAROM_ABI_VERSION));
        cradle();
        spring();
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
