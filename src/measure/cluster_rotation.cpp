#define SWIRL_ROTATION_KERNEL
#include "measure/cluster_rotation.hpp"

#include <cstddef>

#include "measure/cluster_rotation_kernel.hpp"
#include "physics/unit_circle.hpp"

namespace swirl {
namespace {

constexpr std::size_t lanes = 8;

RotationColumns columns_of(const Snapshot& s) {
    return {s.x.data(),
            s.y.data(),
            s.vx.data(),
            s.vy.data(),
            s.held_at.data(),
            s.mass.data(),
            static_cast<std::ptrdiff_t>(s.size()),
            s.clock};
}

// Fewer than eight discs, behind zeros.
struct Few {
    double x[lanes] = {}, y[lanes] = {}, vx[lanes] = {}, vy[lanes] = {}, held_at[lanes] = {},
           mass[lanes] = {};

    RotationColumns fill(const Snapshot& s) {
        const std::size_t before = lanes - s.size();
        for (std::size_t i = 0; i < s.size(); ++i) {
            x[before + i] = s.x[i];
            y[before + i] = s.y[i];
            vx[before + i] = s.vx[i];
            vy[before + i] = s.vy[i];
            held_at[before + i] = s.held_at[i];
            mass[before + i] = s.mass[i];
        }
        return {x + before,
                y + before,
                vx + before,
                vy + before,
                held_at + before,
                mass + before,
                static_cast<std::ptrdiff_t>(s.size()),
                s.clock};
    }
};

// Somebody sits on the centre of mass, and is left out.
double individual_without_the_centre(const Snapshot& s, const RotationSums& sums,
                                     double closest_square) {
    double sum = 0.0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 r = s.position(i) - Vec2{sums.x, sums.y};
        const double q = dot(r, r);
        if (q <= closest_square) continue;
        sum += cross(r, s.velocity(i) - Vec2{sums.vx, sums.vy}) / q;
        ++counted;
    }
    return counted > 0 ? sum / static_cast<double>(counted) : not_known;
}

RotationSample sample_of(const Snapshot& s, RotationKernel kernel) {
    if (s.size() < 2) return {not_known, not_known};
    RotationSums sums;
    if (s.size() < lanes) {
        Few few;
        sums = kernel(few.fill(s));
    } else {
        sums = kernel(columns_of(s));
    }
    RotationSample sample{sums.individual / static_cast<double>(s.size()),
                          sums.angular / sums.square};
    const double closest = 0x1p-40 * s.container_radius, closest_square = closest * closest;
    if (sums.least <= closest_square) {
        sample.individual = individual_without_the_centre(s, sums, closest_square);
        if (!(sums.square > closest_square)) sample.rigid = not_known;
    }
    return sample;
}

RotationKernel kernel_for(VectorWidth width) {
#if defined(__x86_64__)
    if (width == VectorWidth::avx512) return rotation_avx512::rotation_sums;
    if (width == VectorWidth::avx2) return rotation_avx2::rotation_sums;
#endif
    (void)width;
    return rotation_baseline::rotation_sums;
}

RotationKernel best_kernel() {
    for (const VectorWidth width : {VectorWidth::avx512, VectorWidth::avx2})
        if (processor_has(width)) return kernel_for(width);
    return rotation_baseline::rotation_sums;
}

}  // namespace

bool processor_has(VectorWidth width) {
    if (width == VectorWidth::baseline) return true;
#if defined(__x86_64__)
    if (width == VectorWidth::avx2) return __builtin_cpu_supports("avx2");
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

RotationSample cluster_rotation(const Snapshot& snapshot, VectorWidth width) {
    return sample_of(snapshot, kernel_for(processor_has(width) ? width : VectorWidth::baseline));
}

RotationSample cluster_rotation(const Snapshot& snapshot) {
    return sample_of(snapshot, best_kernel());
}

void ClusterRotation::look(const Snapshot& snapshot) {
    event_.add(sample_of(snapshot, kernel_), snapshot.period);
}

void ClusterRotation::look_in_time(const Snapshot& snapshot) {
    time_.add(sample_of(snapshot, kernel_), snapshot.period);
}

ClusterRotation::ClusterRotation() : kernel_(best_kernel()) {}

void ClusterRotation::OpenBlock::close_into(BlockSeries& individual_series,
                                            BlockSeries& rigid_series) {
    const double per_omega = period / (2.0 * pi);
    const double weight = samples;
    individual_series.add(weight > 0.0 ? individual * per_omega : 0.0, weight);
    rigid_series.add(weight > 0.0 ? rigid * per_omega : 0.0, weight);
    *this = {};
}

void ClusterRotation::close_block() {
    event_.close_into(individual_by_event_, rigid_by_event_);
    time_.close_into(individual_by_time_, rigid_by_time_);
}

RotationEstimates ClusterRotation::estimates() const {
    return {individual_by_event_.estimate(), individual_by_time_.estimate(),
            rigid_by_event_.estimate(), rigid_by_time_.estimate()};
}

void ClusterRotation::merge(const ClusterRotation& other) {
    individual_by_event_.merge(other.individual_by_event_);
    individual_by_time_.merge(other.individual_by_time_);
    rigid_by_event_.merge(other.rigid_by_event_);
    rigid_by_time_.merge(other.rigid_by_time_);
}

}  // namespace swirl
