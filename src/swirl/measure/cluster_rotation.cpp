#define SWIRL_ROTATION_KERNEL
#include "swirl/measure/cluster_rotation.hpp"

#include <cstddef>

#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/cluster_rotation_kernel.hpp"

namespace swirl {
namespace {

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

std::ptrdiff_t discs_of(const Snapshot& s) { return static_cast<std::ptrdiff_t>(s.size()); }

double closest_square_of(const Snapshot& s) {
    const double closest = 0x1p-40 * s.container_radius;
    return closest * closest;
}

}  // namespace

RotationSample cluster_rotation(const Snapshot& s, Width width) {
    const RotationKernel& kernel = kernel_for(width);
    const RotationColumns columns = rotation_columns(s);
    const RotationCentre centre = kernel.centre(columns, s.mass.data(), discs_of(s), s.clock);
    const RotationRates rates = kernel.rates(columns, centre, s.clock, closest_square_of(s));
    return {rates[0], rates[1]};
}

RotationFollower ClusterRotation::follower(const Snapshot& s) {
    event_.period = time_.period = swirl_sign_ * s.period;
    return {.kernel = kernel_,
            .centre = &centre_,
            .by_event = &event_,
            .by_time = &time_,
            .angles = follows_angles(s) ? angles_.sides() : SweptSides{},
            .mass = s.mass.data(),
            .discs = discs_of(s),
            .closest_square = closest_square_of(s),
            .on_floor = s.on_floor};
}

void ClusterRotation::renew_centre(const Snapshot& s) {
    centre_ = kernel_->centre(rotation_columns(s), s.mass.data(), discs_of(s), s.clock);
}

void ClusterRotation::begin_angles(const Snapshot& snapshot) {
    renew_centre(snapshot);
    angles_.begin(snapshot, centre_.position);
}

void ClusterRotation::end_angles(const Snapshot& snapshot) {
    time_.individual = angles_.end(snapshot, centre_.at(snapshot.clock)) * time_.samples;
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
