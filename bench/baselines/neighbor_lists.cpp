#include "baselines/neighbor_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "swirl/engine/pending_event.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
namespace {

constexpr double rounding_margin = 1.0 + 1e-9;  // larger than the rounding error
// How many bins ahead data are prefetched.
constexpr std::size_t bins_to_calendar = 48, bins_to_disc = 24, bins_to_others = 10;

double largest_radius(const std::vector<Disc>& discs) {
    double largest = 0.0;
    for (const Disc& disc : discs) largest = larger(disc.radius, largest);
    return largest;
}

/// Largest distance of the container's centre from the origin.
double farthest(const ContainerPath& path) {
    double square = 0.0;
    for (const Segment& segment : path.segments)
        square = larger(dot(segment.start, segment.start), square);
    return square_root(square);
}

/// Separation of the two at `time`.
Vec2 separation_at(const Flight<double>& disc, const Flight<double>& centre, double time) {
    return disc.position_at(time) - centre.position_at(time);
}

/// True if a point at distance |apart| is inside a circle. A disc that is inside now and at a later
/// time is inside in between, as a circle is convex. Near the edge the answer is no.
bool is_well_inside(const Vec2& apart, double clearance) {
    return dot(apart, apart) * rounding_margin < clearance * clearance;
}

ListSearch list_search(Width width) {
    width = width_meant(width);
#if defined(SWIRL_HAS_AVX512)
    if (width == Width::avx512) return list_search_avx512;
#endif
#if defined(SWIRL_HAS_AVX2)
    if (width == Width::avx2) return list_search_avx2;
#endif
    return list_search_baseline;
}

}  // namespace

NeighborListBaseline::NeighborListBaseline(const InitialState& initial, double skin, Width width)
    : first_on_list_(list_search(width)),
      path_(initial.path),
      container_radius_(initial.container_radius),
      disc_surface_(initial.disc_surface),
      wall_surface_(initial.wall_surface),
      size_(static_cast<Number>(initial.discs.size())),
      skin_(skin),
      largest_radius_(largest_radius(initial.discs)),
      farthest_centre_(farthest(initial.path)),
      hot_(size_),
      cold_(size_),
      pending_(size_),
      homes_of_(size_),
      lists_(capacity_ * size_),
      half_width_(container_radius_ + farthest_centre_),
      // The last bin holds all later events.
      first_in_bin_(std::bit_ceil(std::size_t{size_}) + 1, no_disc) {
    const double reach = 2.0 * (largest_radius_ + skin_) * rounding_margin;
    cells_across_ = std::max<std::size_t>(1, std::size_t(2.0 * half_width_ / reach));
    cells_per_length_ = double(cells_across_) / (2.0 * half_width_);
    first_in_cell_.assign(cells_across_ * cells_across_, no_disc);
    for (Number i = 0; i < size_; ++i) {
        const Disc& disc = initial.discs[i];
        hot_[i] = {disc.flight(), disc.radius, 0, 0, false};
        cold_[i] = {disc.angle,   disc.spin,       disc.mass,
                    disc.inertia, 1.0 / disc.mass, 1.0 / disc.inertia};
        pending_[i].bin = no_disc;
        homes_of_[i].position = disc.position;
        enter_cell(i);
    }
    for (Number i = 0; i < size_; ++i) clear_list(i);
    for (Number i = 0; i < size_; ++i) renew_list(i, segment().begin);
    begin_period();
}

Disc NeighborListBaseline::disc(std::size_t i) const {
    const Flight<double>& flight = hot_[i].flight;
    const Cold& cold = cold_[i];
    return {flight.position, flight.velocity, cold.angle, cold.spin,
            flight.time,     hot_[i].radius,  cold.mass,  cold.inertia};
}

Event NeighborListBaseline::step() {
    for (;;) {
        const Number i = first_in_calendar();
        if (i == no_disc || segment().end <= pending_[i].time) return end_segment();
        const double time = pending_[i].time;
        const Number partner = pending_[i].partner;
        if (partner == own_list) {
            renew_list(i, time);
        } else if (partner == i) {
            const Event event = collision(i, i, time);
            reschedule(i);
            return event;
        } else if (pending_[i].changes == hot_[partner].changes) {
            const Event event = collision(std::min(i, partner), std::max(i, partner), time);
            reschedule(partner);
            reschedule(i);
            return event;
        }
        reschedule(i);
    }
}

Event NeighborListBaseline::collision(Number i, Number j, double time) {
    const auto body = [this](Number k) {
        const Cold& cold = cold_[k];
        return Body{hot_[k].flight.velocity, cold.spin, hot_[k].radius, cold.inverse_mass,
                    cold.inverse_inertia};
    };
    const auto write_back = [this](Number k, const Body& after) {
        hot_[k].flight.velocity = after.velocity;
        cold_[k].spin = after.spin;
        ++hot_[k].changes;
    };
    if (i == j) {
        const double since_last = time - hot_[i].flight.time;
        move_to(i, time);
        Body disc = body(i), wall = wall_body(segment().velocity_at(time));
        const Vec2 outwards = hot_[i].flight.position - segment().position_at(time);
        const Impulse J = collide(disc, wall, outwards, at_contact(wall_surface_, since_last));
        write_back(i, disc);
        return {periods_, time, EventKind::disc_wall, i, i, {}, J, 0.0};
    }
    const double since_last = time - larger(hot_[i].flight.time, hot_[j].flight.time);
    move_to(i, time);
    move_to(j, time);
    Body a = body(i), b = body(j);
    const Impulse J = collide(a, b, hot_[j].flight.position - hot_[i].flight.position,
                              at_contact(disc_surface_, since_last));
    write_back(i, a);
    write_back(j, b);
    return {periods_, time, EventKind::disc_disc, i, j, {}, J, 0.0};
}

void NeighborListBaseline::move_to(Number i, double time) {
    Flight<double>& flight = hot_[i].flight;
    cold_[i].angle = cold_[i].angle + (time - flight.time) * cold_[i].spin;
    flight.position = flight.position_at(time);
    flight.time = time;
}

Event NeighborListBaseline::end_segment() {
    const double end = segment().end;
    const Event event{periods_, end, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
    segment_ = (segment_ + 1) % path_.segments.size();
    if (segment_ != 0) {
        begin_segment();
        return event;
    }
    ++periods_;
    for (Number i = 0; i < size_; ++i) {
        move_to(i, end);
        hot_[i].flight.time = homes_of_[i].since = 0.0;
    }
    begin_period();
    return event;
}

/// The velocity of the wall has changed.
void NeighborListBaseline::begin_segment() {
    for (Number i = 0; i < size_; ++i)
        if (hot_[i].at_wall) reschedule(i);
}

/// All clocks restart.
void NeighborListBaseline::begin_period() {
    for (Number i = 0; i < size_; ++i)
        if (pending_[i].bin != no_disc) leave_bin(i);
    for (Number i = 0; i < size_; ++i) predict(i);
    open_calendar();
}

void NeighborListBaseline::predict(Number i) {
    const ListedDisc& me = hot_[i];
    const Flight<double> flight = me.flight;
    FirstContact best = first_on_list_(hot_.data(), i, &lists_[capacity_ * i], own_list);
    if (me.at_wall) {
        const Segment& segment = this->segment();
        const double clearance = container_radius_ - me.radius;
        if (segment.turn_rate != 0.0 ||
            !is_well_inside(
                separation_at(flight, {segment.start, segment.velocity, segment.begin}, best.time),
                clearance)) {
            const double time = time_of_wall_contact(flight, segment, clearance);
            if (precedes({time, i, i}, {best.time, i, best.partner})) best = {time, i};
        }
    }
    const Flight<double> home{homes_of_[i].position, {0.0, 0.0}, homes_of_[i].since};
    if (!is_well_inside(separation_at(flight, home, best.time), skin_)) {
        const double time = time_of_wall_contact(flight, home, skin_);
        if (time < best.time) best = {time, own_list};
    }
    Pending& pending = pending_[i];
    pending.time = best.time;
    pending.partner = best.partner;
    pending.changes = best.partner < size_ ? hot_[best.partner].changes : 0;
}

void NeighborListBaseline::reschedule(Number i) {
    if (pending_[i].bin != no_disc) leave_bin(i);
    predict(i);
    enter_bin(i);
}

void NeighborListBaseline::renew_list(Number i, double time) {
    ++renewed_lists_;
    for (Number k = 0; k < hot_[i].listed; ++k) remove_from_list(lists_[capacity_ * i + k], i);
    clear_list(i);
    leave_cell(i);
    const Vec2 home = hot_[i].flight.position_at(time);
    homes_of_[i].position = home;
    homes_of_[i].since = time;
    enter_cell(i);
    update_at_wall(i);
    const double reach = (hot_[i].radius + 2.0 * skin_) * rounding_margin;
    const std::size_t cell = cell_at(home), row = cell / cells_across_,
                      column = cell % cells_across_;
    for (std::size_t y = row > 0 ? row - 1 : 0; y <= std::min(row + 1, cells_across_ - 1); ++y)
        for (std::size_t x = column > 0 ? column - 1 : 0;
             x <= std::min(column + 1, cells_across_ - 1); ++x)
            for (Number j = first_in_cell_[y * cells_across_ + x]; j != no_disc;
                 j = homes_of_[j].next) {
                const Vec2 apart = homes_of_[j].position - home;
                const double within = reach + hot_[j].radius;
                if (j == i || dot(apart, apart) >= within * within) continue;
                add_to_list(i, j);
                add_to_list(j, i);
            }
}

/// Determines for disc i whether it may reach the wall within `skin` of its home, in any position
/// of the container.
void NeighborListBaseline::update_at_wall(Number i) {
    const Vec2 home = homes_of_[i].position;
    const double farthest =
        container_radius_ - hot_[i].radius - skin_ * rounding_margin - farthest_centre_;
    hot_[i].at_wall = farthest <= 0.0 || dot(home, home) >= farthest * farthest;
}

void NeighborListBaseline::clear_list(Number i) {
    std::fill_n(&lists_[capacity_ * i], capacity_, i);
    hot_[i].listed = 0;
}

void NeighborListBaseline::remove_from_list(Number i, Number j) {
    Number* const list = &lists_[capacity_ * i];
    Number& listed = hot_[i].listed;
    *std::find(list, list + listed, j) = list[listed - 1];
    list[--listed] = i;
}

void NeighborListBaseline::add_to_list(Number i, Number j) {
    Number* const list = &lists_[capacity_ * i];
    Number& listed = hot_[i].listed;
    if (listed == capacity_) {
        widen_lists();
        return add_to_list(i, j);
    }
    list[listed++] = j;
}

void NeighborListBaseline::widen_lists() {
    OnHugePages<Number> wider(2 * capacity_ * size_);
    for (Number i = 0; i < size_; ++i) {
        std::fill_n(&wider[2 * capacity_ * i], 2 * capacity_, i);
        std::copy_n(&lists_[capacity_ * i], hot_[i].listed, &wider[2 * capacity_ * i]);
    }
    lists_ = std::move(wider);
    capacity_ *= 2;
}

/// Positions outside the grid map to the nearest edge cell.
std::size_t NeighborListBaseline::cell_at(const Vec2& position) const {
    const auto across = [this](double x) {
        const double cell = (x + half_width_) * cells_per_length_;
        return std::min(std::size_t(std::max(cell, 0.0)), cells_across_ - 1);
    };
    return across(position.y) * cells_across_ + across(position.x);
}
void NeighborListBaseline::leave_cell(Number i) {
    const Home& home = homes_of_[i];
    (home.previous == no_disc ? first_in_cell_[cell_at(home.position)]
                              : homes_of_[home.previous].next) = home.next;
    if (home.next != no_disc) homes_of_[home.next].previous = home.previous;
}
void NeighborListBaseline::enter_cell(Number i) {
    Number& first = first_in_cell_[cell_at(homes_of_[i].position)];
    homes_of_[i].previous = no_disc;
    homes_of_[i].next = first;
    if (first != no_disc) homes_of_[first].previous = i;
    first = i;
}

/// Chooses the bin width such that a bin holds about one event.
void NeighborListBaseline::open_calendar() {
    std::vector<double> waits;
    for (const Pending& pending : pending_) waits.push_back(pending.time);
    const auto middle = waits.begin() + std::ptrdiff_t(waits.size() / 2);
    std::nth_element(waits.begin(), middle, waits.end());
    bin_width_ = smaller(*middle, path_.period) / double(size_);
    bins_per_time_ = 1.0 / bin_width_;
    calendar_begin_ = 0.0;
    now_ = 0;
    for (Number i = 0; i < size_; ++i) enter_bin(i);
}

std::size_t NeighborListBaseline::bin_at(double time) const {
    const std::size_t later = first_in_bin_.size() - 1;
    const double bin = (time - calendar_begin_) * bins_per_time_;
    // Rounding must not put an event into a bin that has been passed.
    return bin < double(later) ? std::max(std::size_t(std::max(bin, 0.0)), now_) : later;
}
void NeighborListBaseline::leave_bin(Number i) {
    Pending& pending = pending_[i];
    (pending.previous == no_disc ? first_in_bin_[pending.bin] : pending_[pending.previous].next) =
        pending.next;
    if (pending.next != no_disc) pending_[pending.next].previous = pending.previous;
    pending.bin = no_disc;
}
void NeighborListBaseline::enter_bin(Number i) {
    Pending& pending = pending_[i];
    pending.bin = Number(bin_at(pending.time));
    Number& first = first_in_bin_[pending.bin];
    pending.previous = no_disc;
    pending.next = first;
    if (first != no_disc) pending_[first].previous = i;
    first = i;
}

bool NeighborListBaseline::comes_before(Number i, Number j) const {
    return precedes({pending_[i].time, i, pending_[i].partner},
                    {pending_[j].time, j, pending_[j].partner});
}

NeighborListBaseline::Number NeighborListBaseline::first_in_calendar() {
    const std::size_t later = first_in_bin_.size() - 1;
    while (first_in_bin_[now_] == no_disc) {
        if (calendar_begin_ + bin_width_ * double(now_) > segment().end) return no_disc;
        if (++now_ < later) {
            prefetch_next_events();
            continue;
        }
        // End of the page: all remaining events are in the overflow bucket. They are inserted again
        // in the order of the discs, which is the order of memory.
        first_in_bin_[later] = no_disc;
        calendar_begin_ += bin_width_ * double(later);
        now_ = 0;
        for (Number i = 0; i < size_; ++i) enter_bin(i);
    }
    Number first = first_in_bin_[now_];
    for (Number i = pending_[first].next; i != no_disc; i = pending_[i].next)
        if (comes_before(i, first)) first = i;
    return first;
}

/// Prefetches first the disc itself, some bins later its partner and its list, then the discs of
/// both lists.
void NeighborListBaseline::prefetch_next_events() const {
    const std::size_t later = first_in_bin_.size() - 1;
    const auto in_bin = [&](std::size_t ahead, const auto& fetch) {
        if (now_ + ahead >= later) return;
        for (Number i = first_in_bin_[now_ + ahead]; i != no_disc; i = pending_[i].next) fetch(i);
    };
    const auto partner_of = [this](Number i) {
        return pending_[i].partner < size_ ? pending_[i].partner : i;
    };
    const auto fetch_disc = [this](Number i) {
        __builtin_prefetch(&hot_[i], 1);
        __builtin_prefetch(&cold_[i], 1);
        __builtin_prefetch(&lists_[capacity_ * i]);
    };
    const auto fetch_others = [this](Number i) {
        const Number* const list = &lists_[capacity_ * i];
        for (Number k = 0; k < hot_[i].listed; ++k) __builtin_prefetch(&hot_[list[k]]);
    };
    if (const std::size_t bin = now_ + bins_to_calendar; bin < later)
        if (const Number i = first_in_bin_[bin]; i != no_disc) __builtin_prefetch(&pending_[i], 1);
    in_bin(bins_to_disc, [&](Number i) {
        fetch_disc(i);
        if (const Number j = partner_of(i); j != i) {
            fetch_disc(j);
            __builtin_prefetch(&pending_[j], 1);
        }
    });
    in_bin(bins_to_others, [&](Number i) {
        fetch_others(i);
        if (const Number j = partner_of(i); j != i) {
            fetch_others(j);
            for (const Number neighbour : {pending_[j].next, pending_[j].previous})
                if (neighbour != no_disc) __builtin_prefetch(&pending_[neighbour], 1);
        }
    });
}

}  // namespace swirl
