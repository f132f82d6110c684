#include "frames.hpp"

#include <algorithm>

#include "swirl/statistics/block_average.hpp"

namespace swirl::python {

void Frames::reserve(std::size_t frames, std::size_t of_discs) {
    periods.reserve(frames);
    for (auto* column : {&clock, &time}) column->reserve(frames);
    for (auto* column : {&container_centre, &container_velocity}) column->reserve(2 * frames);
    for (auto* column : {&position, &velocity}) column->reserve(2 * frames * of_discs);
    for (auto* column : {&angle, &spin}) column->reserve(frames * of_discs);
}

void Frames::begin(const Snapshot& s) {
    discs = s.size();
    period = s.period;
    container_radius = s.container_radius;
    on_floor = s.on_floor;
    are_spheres = s.are_spheres();
    lie_flat = s.lie_flat;
    radius = s.radius;
    mass = s.mass;
    inertia = s.inertia;
    can_spin = s.can_spin;
    can_spin.resize(discs, 1.0);
}

void Frames::add_time(std::int64_t whole_periods, double clock_now, const PeriodChange& since,
                      const Vec2& centre, const Vec2& centre_velocity) {
    periods.push_back(whole_periods);
    clock.push_back(clock_now);
    time.push_back(since.time + static_cast<double>(whole_periods - since.periods) * period +
                   clock_now);
    container_centre.insert(container_centre.end(), {centre.x, centre.y});
    container_velocity.insert(container_velocity.end(), {centre_velocity.x, centre_velocity.y});
}

void Frames::add(const Snapshot& s) {
    if (size() == 0) begin(s);
    add_time(s.periods, s.clock, {s.periods_at_change, s.time_at_change}, s.container_centre,
             s.container_velocity);
    const auto add_vector = [](std::vector<double>& column, const Vec2& v) {
        column.push_back(v.x);
        column.push_back(v.y);
    };
    for (std::size_t i = 0; i < s.size(); ++i) {
        add_vector(position, s.position(i));
        add_vector(velocity, s.velocity(i));
        angle.push_back(s.orientation(i));
        spin.push_back(s.spin[i]);
        if (!s.are_spheres()) continue;
        add_vector(acceleration, {s.ax[i], s.ay[i]});
        add_vector(rolling_spin, {s.spin_x[i], s.spin_y[i]});
    }
}

void Frames::add(const Simulation& simulation, const ContainerPath& path,
                 const PeriodChange& since) {
    if (size() == 0 || are_spheres) {
        Snapshot s = simulation.snapshot();
        s.periods_at_change = since.periods;
        s.time_at_change = since.time;
        return add(s);
    }
    const double now = simulation.clock();
    const Segment& segment = path.segment_at(now);
    add_time(simulation.periods(), now, since, segment.position_at(now), segment.velocity_at(now));
    const std::size_t at = angle.size();
    for (auto* column : {&position, &velocity}) column->resize(2 * (at + discs));
    for (auto* column : {&angle, &spin}) column->resize(at + discs);
    double *p = position.data() + 2 * at, *v = velocity.data() + 2 * at;
    for (std::size_t i = 0; i < discs; ++i) {
        const Disc d = simulation.disc(i).at(now);
        *p++ = d.position.x;
        *p++ = d.position.y;
        *v++ = d.velocity.x;
        *v++ = d.velocity.y;
        angle[at + i] = d.angle;
        spin[at + i] = d.spin;
    }
}

Snapshot Frames::frame(std::size_t k) const {
    Snapshot s;
    s.periods = periods[k];
    s.clock = clock[k];
    s.period = period;
    if (time[k] != s.time()) {  // a ramp has changed the period
        s.periods_at_change = periods[k];
        s.time_at_change = time[k] - clock[k];
    }
    s.container_radius = container_radius;
    s.on_floor = on_floor;
    s.lie_flat = lie_flat;
    s.container_centre = {container_centre[2 * k], container_centre[2 * k + 1]};
    s.container_velocity = {container_velocity[2 * k], container_velocity[2 * k + 1]};
    if (are_spheres)
        s.resize_for_spheres(discs);
    else
        s.resize(discs);
    s.radius = radius;
    s.mass = mass;
    s.inertia = inertia;
    if (std::find(can_spin.begin(), can_spin.end(), 0.0) != can_spin.end()) s.can_spin = can_spin;
    for (std::size_t i = 0; i < discs; ++i) {
        const std::size_t at = k * discs + i;
        const auto vector = [at](const std::vector<double>& column) {
            return Vec2{column[2 * at], column[2 * at + 1]};
        };
        s.set_motion(i, {vector(position), vector(velocity), clock[k]}, angle[at], spin[at]);
        if (are_spheres) s.set_floor_motion(i, vector(rolling_spin), vector(acceleration));
    }
    return s;
}

PinnedColumns Frames::pinned() const {
    if (in_lab) return in_lab->pinned();
    SnapshotSeries own;
    own.frames = size();
    own.frame = [this](std::uint64_t k) { return frame(k); };
    const auto states = recording ? recording : std::make_shared<PinnedSeries>(own);
    PinnedColumns all;
    for (std::size_t k = 0; k < size(); ++k) {
        const PinnedColumns& found = states->at(recording ? numbers[k] : k);
        all.pinned.insert(all.pinned.end(), found.pinned.begin(), found.pinned.end());
        all.resident.insert(all.resident.end(), found.resident.begin(), found.resident.end());
    }
    return all;
}

PinnedColumns SingleFrame::pinned() const {
    const std::vector<double> unknown(frames.discs, not_available);
    if (!taken_from) return {unknown, unknown};
    const PinnedColumns all = taken_from->pinned();
    const auto row = [&](const std::vector<double>& column) {
        const auto begin = column.begin() + static_cast<std::ptrdiff_t>(number * frames.discs);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(frames.discs));
    };
    return {row(all.pinned), row(all.resident)};
}

}  // namespace swirl::python
