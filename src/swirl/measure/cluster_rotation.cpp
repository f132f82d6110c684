#define SWIRL_ROTATION_KERNEL
#include "swirl/measure/cluster_rotation.hpp"

#include <cstddef>

#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/cluster_rotation_kernel.hpp"

namespace swirl {
namespace {

constexpr std::size_t lanes = 8;

// One disc after the other: for fewer than eight discs, and if a disc on the centre of mass must be
// omitted.
RotationCentre centre_one_by_one(const Snapshot& s) {
    double mass = 0.0;
    Vec2 r{0.0, 0.0}, v{0.0, 0.0};
    for (std::size_t i = 0; i < s.size(); ++i) {
        mass += s.mass[i];
        r = r + s.mass[i] * s.position(i);
        v = v + s.mass[i] * s.velocity(i);
    }
    return {static_cast<std::ptrdiff_t>(s.size()),
            s.clock,
            mass,
            {r.x / mass, r.y / mass},
            {v.x / mass, v.y / mass}};
}

RotationSample rates_one_by_one(const Snapshot& s, const RotationCentre& c, double closest_square) {
    if (s.size() < 2) return {not_available, not_available};
    const Vec2 centre = c.position + (s.clock - c.held_at) * c.velocity;
    double individual = 0.0, counted = 0.0, angular = 0.0, square = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 r = s.position(i) - centre;
        const double l = cross(r, s.velocity(i) - c.velocity), q = dot(r, r);
        angular += l;
        square += q;
        if (q <= closest_square) continue;
        individual += l / q;
        counted += 1.0;
    }
    return {counted > 0.0 ? individual / counted : not_available,
            square > closest_square ? angular / square : not_available};
}

RotationCentre centre_of(const Snapshot& s, const RotationKernel& kernel) {
    if (s.size() < lanes) return centre_one_by_one(s);
    if (s.are_spheres())
        return kernel.centre_of_spheres(
            s.x.data(), s.y.data(), s.vx.data(), s.vy.data(), s.held_at.data(), s.mass.data(),
            static_cast<std::ptrdiff_t>(s.size()), s.clock, {s.ax.data(), s.ay.data()});
    return kernel.centre(s.x.data(), s.y.data(), s.vx.data(), s.vy.data(), s.held_at.data(),
                         s.mass.data(), static_cast<std::ptrdiff_t>(s.size()), s.clock);
}

/// The change of the centre of mass by an impulse of the wall.
void apply_wall_impulse(RotationCentre& c, const Event& event) {
    c.position = c.position + (event.clock - c.held_at) * c.velocity;
    c.held_at = event.clock;
    const Vec2 tangent{event.normal.y, -event.normal.x};
    const Vec2 impulse_on_wall =
        event.impulse.normal * event.normal + event.impulse.tangential * tangent;
    c.velocity = c.velocity - Vec2{impulse_on_wall.x / c.mass, impulse_on_wall.y / c.mass};
}

SWIRL_INLINE RotationSample sample_of(const Snapshot& s, const RotationCentre& c,
                                      const RotationKernel& kernel) {
    const double closest = 0x1p-40 * s.container_radius, closest_square = closest * closest;
    if (s.size() >= lanes || (s.size() >= 2 && !s.are_spheres())) {
        const RotationRates rates =
            s.size() < lanes ? kernel.rates_of_few(s.x.data(), s.y.data(), s.vx.data(), s.vy.data(),
                                                   s.held_at.data(), c, s.clock, closest_square)
            : s.are_spheres() ? kernel.rates_of_spheres(s.x.data(), s.y.data(), s.vx.data(),
                                                        s.vy.data(), s.held_at.data(), c, s.clock,
                                                        closest_square, {s.ax.data(), s.ay.data()})
                              : kernel.rates(s.x.data(), s.y.data(), s.vx.data(), s.vy.data(),
                                             s.held_at.data(), c, s.clock, closest_square);
        // Otherwise a disc is on the centre of mass, or a state is NaN.
        const bool is_number = rates[0] - rates[0] == 0.0;
        if (is_number) return {rates[0], rates[1]};
    }
    return rates_one_by_one(s, c, closest_square);
}

const RotationKernel& kernel_for(Width width) {
    width = has_width(width) ? width_meant(width) : Width::baseline;
#if defined(SWIRL_HAS_AVX512)
    if (width == Width::avx512) return rotation_avx512::kernel;
#endif
#if defined(SWIRL_HAS_AVX2)
    if (width == Width::avx2) return rotation_avx2::kernel;
#endif
    return rotation_baseline::kernel;
}

}  // namespace

RotationSample cluster_rotation(const Snapshot& snapshot, Width width) {
    const RotationKernel& kernel = kernel_for(width);
    return sample_of(snapshot, centre_of(snapshot, kernel), kernel);
}

void ClusterRotation::follow_centre(const Snapshot& snapshot, const Event& event) {
    if (event.kind == EventKind::disc_wall)
        apply_wall_impulse(centre_, event);
    else if (snapshot.periods > event.periods || !angles_.are_followed(snapshot.size()))
        centre_ = centre_of(snapshot, *kernel_);
}

RotationSample ClusterRotation::sample(const Snapshot& snapshot) {
    if (snapshot.on_floor || centre_.discs != static_cast<std::ptrdiff_t>(snapshot.size()))
        centre_ = centre_of(snapshot, *kernel_);
    const RotationSample sample = sample_of(snapshot, centre_, *kernel_);
    event_.add(sample, swirl_sign_ * snapshot.period);
    return sample;
}

RotationSample ClusterRotation::sample_alone(const Snapshot& snapshot) {
    centre_ = centre_of(snapshot, *kernel_);
    const RotationSample sample = sample_of(snapshot, centre_, *kernel_);
    event_.add(sample, swirl_sign_ * snapshot.period);
    return sample;
}

RotationSample ClusterRotation::sample_by_time(const Snapshot& snapshot, double weight) {
    const RotationSample sample = sample_of(snapshot, centre_of(snapshot, *kernel_), *kernel_);
    time_.add(sample, swirl_sign_ * snapshot.period, weight);
    return sample;
}

void ClusterRotation::begin_angles(const Snapshot& snapshot) {
    centre_ = centre_of(snapshot, *kernel_);
    angles_.begin(snapshot, centre_.position);
}

/// Collisions end the flights of two discs. An impulse of the wall bends those of all discs, seen
/// from the centre of mass.
void ClusterRotation::follow_angles(const Snapshot& snapshot, const Event& event) {
    if (event.kind == EventKind::path_vertex) return;
    const Vec2 centre = centre_.position + (event.clock - centre_.held_at) * centre_.velocity;
    if (event.kind == EventKind::disc_wall) return angles_.fly_all(snapshot, centre);
    angles_.fly(snapshot, event.i, centre);
    angles_.fly(snapshot, event.j, centre);
}

void ClusterRotation::end_angles(const Snapshot& snapshot) {
    const Vec2 centre = centre_.position + (snapshot.clock - centre_.held_at) * centre_.velocity;
    time_.individual = angles_.end(snapshot, centre) * time_.samples;
}

ClusterRotation::ClusterRotation(Width width, bool clockwise)
    : kernel_(&kernel_for(width)), swirl_sign_(clockwise ? -1.0 : 1.0) {}

void ClusterRotation::OpenBlock::close_into(BlockSeries& individual_series,
                                            BlockSeries& rigid_series, double weight_of_a_sample) {
    const double per_omega = period / (2.0 * pi) * weight_of_a_sample;
    const double weight = samples * weight_of_a_sample;
    individual_series.add(weight > 0.0 ? individual * per_omega : 0.0, weight);
    rigid_series.add(weight > 0.0 ? rigid * per_omega : 0.0, weight);
    *this = {};
}

void ClusterRotation::close_block(std::uint64_t events_of_a_sample, double weight_by_time) {
    event_.close_into(individual_by_event_, rigid_by_event_,
                      static_cast<double>(events_of_a_sample));
    time_.close_into(individual_by_time_, rigid_by_time_, weight_by_time);
}

std::array<double, rotation_rates.size()> ClusterRotation::open_means() const {
    const auto mean = [](double sum, const OpenBlock& block) {
        return sum * (block.period / (2.0 * pi)) / block.samples;
    };
    return {mean(event_.individual, event_), mean(time_.individual, time_),
            mean(event_.rigid, event_), mean(time_.rigid, time_)};
}

std::array<double, rotation_rates.size()> ClusterRotation::open_weights(
    std::uint64_t events_of_a_sample, double weight_by_time) const {
    const double by_event = event_.samples * static_cast<double>(events_of_a_sample);
    const double by_time = time_.samples * weight_by_time;
    return {by_event, by_time, by_event, by_time};
}

RotationEstimates ClusterRotation::estimates() const {
    return {individual_by_event_.estimate(), individual_by_time_.estimate(),
            rigid_by_event_.estimate(), rigid_by_time_.estimate()};
}

}  // namespace swirl
