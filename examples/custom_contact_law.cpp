// A contact law of your own: a restitution e = 1/(1 + a u) that falls with the impact speed u, as
// for real materials. A disc that bounces between two walls at rest then follows a closed form:
// each collision adds a to its inverse speed, so after n collisions the speed is 1/(1/u_0 + n a).
#include <cmath>
#include <cstdio>

#include "swirl/engine/own_law.hpp"
#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"

struct Softening {
    double a;
    swirl::Surface operator()(swirl::Surface surface, const swirl::Impact& impact) const {
        surface.restitution = 1.0 / (1.0 + a * impact.speed);
        return surface;
    }
};

int main() {
    // One disc in a container at rest.
    swirl::InitialState scene = swirl::paper_scene(1, 1.0, 1);
    scene.path = swirl::still_path(swirl::paper_period);
    scene.discs[0].position = {0.0, 0.0};
    scene.discs[0].velocity = {1.0, 0.0};
    scene.law = swirl::own_law(Softening{.a = 0.5});
    swirl::Simulation bouncing(scene);
    std::puts("collisions  speed   closed form");
    for (int n = 1; n <= 5;) {
        if (bouncing.step().kind != swirl::EventKind::disc_wall) continue;
        const swirl::Vec2 v = bouncing.disc(0).velocity;
        std::printf("%10d  %.4f  %.4f\n", n, std::hypot(v.x, v.y), 1.0 / (1.0 + 0.5 * n));
        ++n;
    }

    // The law of constants gives the built-in trajectory, bit by bit.
    scene = swirl::paper_scene(48, 1.0, 1);
    swirl::Simulation built_in(scene);
    scene.law =
        swirl::own_law([](const swirl::Surface& surface, const swirl::Impact&) { return surface; });
    swirl::Simulation own(scene);
    built_in.run(10000);
    own.run(10000);
    const auto hash = [](const swirl::Simulation& s) {
        return static_cast<unsigned long long>(s.state_hash());
    };
    std::printf("state %016llx, with the law of constants %016llx\n", hash(built_in), hash(own));
}
