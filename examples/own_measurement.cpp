// A measurement of one's own: how far the discs are from the middle of the dish, on average. It
// takes snapshots and nothing else, so it works on a recording or a camera's tracks as well.
#include <cmath>
#include <cstdio>

#include "dish.hpp"
#include "swirl/engine/simulation.hpp"

class MeanDistance {
  public:
    void sample(const swirl::Snapshot& dish) {
        for (std::size_t i = 0; i < dish.size(); ++i) {
            const swirl::Vec2 from_middle = dish.position(i) - dish.container_centre;
            sum_ += std::hypot(from_middle.x, from_middle.y);
            ++samples_;
        }
    }
    double mean() const { return sum_ / static_cast<double>(samples_); }

  private:
    double sum_ = 0.0;
    long long samples_ = 0;
};

int main() {
    swirl::Simulation simulation(paper_dish(48, 1.0, 1));
    MeanDistance distance;
    const int warmup = 20, end = 120, samples = 64;  // per period; a look changes no bit
    for (int period = warmup; period < end; ++period)
        for (int k = 0; k < samples; ++k) {
            simulation.advance_to(period, swirl::paper_period * k / samples);
            distance.sample(simulation.snapshot());
        }
    std::printf("mean distance from the middle: %.4f radii of a disc\n", distance.mean());
    std::printf("evenly spread it would be %.4f\n",
                2.0 / 3.0 * (swirl::paper_container_radius - 1));
}
