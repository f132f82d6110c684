#include "measure/cluster_rotation.hpp"

#include <cstddef>
#include <cstring>

#include "physics/unit_circle.hpp"

namespace swirl {
namespace {

// Eight doubles side by side (GCC's vector extension): one AVX-512 register, two of AVX, four of
// SSE2. The operations are exactly rounded and never fused, lane by lane.
typedef double Eight __attribute__((vector_size(64)));
typedef long long Mask __attribute__((vector_size(64)));

constexpr std::size_t lanes = 8;

SWIRL_INLINE Eight all(double value) {
    return Eight{value, value, value, value, value, value, value, value};
}

SWIRL_INLINE Eight load(const double* from) {
    Eight e;
    std::memcpy(&e, from, sizeof e);
    return e;
}

SWIRL_INLINE double sum(const Eight& e) {
    return ((e[0] + e[4]) + (e[2] + e[6])) + ((e[1] + e[5]) + (e[3] + e[7]));
}

// The columns of eight discs. Lanes beyond the last disc hold zeros, mass 0 among them.
struct Columns {
    Eight x, y, vx, vy, mass;
};

SWIRL_INLINE Columns full_columns(const Snapshot& s, std::size_t first) {
    const Eight elapsed = all(s.clock) - load(&s.held_at[first]);
    const Eight vx = load(&s.vx[first]), vy = load(&s.vy[first]);
    return {load(&s.x[first]) + elapsed * vx, load(&s.y[first]) + elapsed * vy, vx, vy,
            load(&s.mass[first])};
}

SWIRL_INLINE Columns last_columns(const Snapshot& s, std::size_t first) {
    Columns c{};
    for (std::size_t k = 0; first + k < s.size(); ++k) {
        const std::size_t i = first + k;
        const double elapsed = s.clock - s.held_at[i];
        c.vx[k] = s.vx[i];
        c.vy[k] = s.vy[i];
        c.x[k] = s.x[i] + elapsed * s.vx[i];
        c.y[k] = s.y[i] + elapsed * s.vy[i];
        c.mass[k] = s.mass[i];
    }
    return c;
}

struct Moments {
    Eight mass = {}, x = {}, y = {}, vx = {}, vy = {};

    SWIRL_INLINE void add(const Columns& c) {
        mass += c.mass;
        x += c.mass * c.x;
        y += c.mass * c.y;
        vx += c.mass * c.vx;
        vy += c.mass * c.vy;
    }
};

struct Turning {
    Eight individual = {}, counted = {}, angular = {}, square = {};

    // `there` is all ones in the lanes that hold a disc.
    SWIRL_INLINE void add(const Columns& c, const Eight& cx, const Eight& cy, const Eight& cvx,
                          const Eight& cvy, const Eight& closest, const Mask& there) {
        const Eight rx = c.x - cx, ry = c.y - cy;
        const Eight ux = c.vx - cvx, uy = c.vy - cvy;
        const Eight l = rx * uy - ry * ux;
        const Eight q = rx * rx + ry * ry;
        // A state that is not a number must show in the mean, so only what is too close drops out.
        const Mask counts = there & ~(q <= closest);
        individual += counts ? l / q : all(0.0);
        counted += counts ? all(1.0) : all(0.0);
        angular += there ? l : all(0.0);
        square += there ? q : all(0.0);
    }
};

SWIRL_INLINE RotationSample rotation_of(const Snapshot& s) {
    const std::size_t n = s.size();
    if (n < 2) return {not_known, not_known};
    const std::size_t whole = n - n % lanes;

    Moments moments;
    for (std::size_t i = 0; i < whole; i += lanes) moments.add(full_columns(s, i));
    Columns last{};
    if (whole < n) {
        last = last_columns(s, whole);
        moments.add(last);
    }
    const double mass = sum(moments.mass);
    const Eight cx = all(sum(moments.x) / mass), cy = all(sum(moments.y) / mass);
    const Eight cvx = all(sum(moments.vx) / mass), cvy = all(sum(moments.vy) / mass);

    const double closest = 0x1p-40 * s.container_radius;
    const Eight closest_square = all(closest * closest);
    const Mask everybody = ~Mask{};
    Turning turning;
    for (std::size_t i = 0; i < whole; i += lanes)
        turning.add(full_columns(s, i), cx, cy, cvx, cvy, closest_square, everybody);
    if (whole < n) {
        const Mask lane{0, 1, 2, 3, 4, 5, 6, 7};
        const long long left = static_cast<long long>(n - whole);
        const Mask there = lane < Mask{left, left, left, left, left, left, left, left};
        turning.add(last, cx, cy, cvx, cvy, closest_square, there);
    }

    const double counted = sum(turning.counted), square = sum(turning.square);
    if (counted == 0.0) return {not_known, not_known};
    return {sum(turning.individual) / counted, sum(turning.angular) / square};
}

RotationSample baseline_rotation(const Snapshot& s) { return rotation_of(s); }

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) RotationSample avx2_rotation(const Snapshot& s) {
    return rotation_of(s);
}
__attribute__((target("avx512f,avx512dq"))) RotationSample avx512_rotation(const Snapshot& s) {
    return rotation_of(s);
}
#endif

using Kernel = RotationSample (*)(const Snapshot&);

Kernel kernel_for(VectorWidth width) {
#if defined(__x86_64__) && defined(__GNUC__)
    if (width == VectorWidth::avx512) return avx512_rotation;
    if (width == VectorWidth::avx2) return avx2_rotation;
#endif
    (void)width;
    return baseline_rotation;
}

Kernel best_kernel() {
    for (const VectorWidth width : {VectorWidth::avx512, VectorWidth::avx2})
        if (processor_has(width)) return kernel_for(width);
    return baseline_rotation;
}

}  // namespace

bool processor_has(VectorWidth width) {
    if (width == VectorWidth::baseline) return true;
#if defined(__x86_64__) && defined(__GNUC__)
    if (width == VectorWidth::avx2) return __builtin_cpu_supports("avx2");
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#else
    return false;
#endif
}

RotationSample cluster_rotation(const Snapshot& snapshot, VectorWidth width) {
    return kernel_for(processor_has(width) ? width : VectorWidth::baseline)(snapshot);
}

RotationSample cluster_rotation(const Snapshot& snapshot) { return best_kernel()(snapshot); }

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
