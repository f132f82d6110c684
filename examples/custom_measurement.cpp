// A custom measurement: the mean distance of discs from the container's centre. It takes only
// snapshots, so it also works for recordings and for tracks of a camera.
#include <cmath>
#include <cstdio>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"

class MeanDistance {
  public:
    void sample(const swirl::Snapshot& snapshot) {
        for (std::size_t i = 0; i < snapshot.size(); ++i) {
            const swirl::Vec2 from_centre = snapshot.position(i) - snapshot.container_centre;
            sum_ += std::hypot(from_centre.x, from_centre.y);
            ++samples_;
        }
    }
    double mean() const { return sum_ / static_cast<double>(samples_); }

  private:
    double sum_ = 0.0;
    long long samples_ = 0;
};

int main() {
    swirl::Simulation simulation(swirl::paper_scene(48, 1.0, 1));
    MeanDistance distance;
    // Sampling does not alter the trajectory.
    const int warmup = 20, end = 120, samples = 64;  // periods; samples per period
    for (int period = warmup; period < end; ++period)
        for (int k = 0; k < samples; ++k) {
            simulation.advance_to(period, swirl::paper_period * k / samples);
            distance.sample(simulation.snapshot());
        }
    std::printf("mean distance from the centre: %.4f disc radii\n", distance.mean());
    std::printf("for a uniform density it would be %.4f\n",
                2.0 / 3.0 * (swirl::paper_container_radius - 1));
}
