#include "swirl/study/rival/plain_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "swirl/physics/contact_time.hpp"

namespace swirl {

PlainLists::PlainLists(const InitialState& initial, double reach)
    : discs_(initial),
      size_(static_cast<Number>(initial.discs.size())),
      radius_(initial.discs.front().radius),
      container_radius_(initial.container_radius),
      reach_(reach * 2.0 * radius_),
      skin_(0.5 * (reach_ - 2.0 * radius_)),
      flights_(size_),
      changes_(size_, 0),
      expected_(size_),
      centres_(size_),
      at_wall_(size_),
      lists_(room_ * size_),
      lengths_(size_),
      cells_across_(std::max<std::size_t>(1, std::size_t(2.0 * container_radius_ / reach_))),
      first_in_cell_(cells_across_ * cells_across_, nobody),
      next_in_cell_(size_, nobody),
      previous_in_cell_(size_, nobody),
      first_in_bin_(std::bit_ceil(std::size_t{size_}) + 1,
                    nobody),  // the last: later than all bins
      next_in_bin_(size_, nobody),
      previous_in_bin_(size_, nobody),
      bin_of_(size_, nobody) {
    cell_width_ = 2.0 * container_radius_ / double(cells_across_);
    for (Number i = 0; i < size_; ++i) centres_[i] = discs_.disc(i).position;
    for (Number i = 0; i < size_; ++i) enter_cell(i);
    begin_swirl();
}

/// All clocks restart: everything anew.
void PlainLists::begin_swirl() {
    for (Number i = 0; i < size_; ++i) {
        take_over(i);
        if (bin_of_[i] != nobody) leave_bin(i);
    }
    for (Number i = 0; i < size_; ++i) renew_list(i, flights_[i].position);
    std::vector<double> waits;
    for (Number i = 0; i < size_; ++i) {
        predict(i);
        waits.push_back(expected_[i].time);
    }
    // About one event in a bin.
    const auto middle = waits.begin() + std::ptrdiff_t(waits.size() / 2);
    std::nth_element(waits.begin(), middle, waits.end());
    bin_width_ = *middle / double(size_);
    calendar_begin_ = 0.0;
    now_ = 0;
    for (Number i = 0; i < size_; ++i) enter_bin(i);
}

void PlainLists::take_over(Number i) { flights_[i] = discs_.disc(i).flight(); }

Event PlainLists::step() {
    for (;;) {
        const Number i = first_in_calendar();
        const double end_of_leg = discs_.leg().end;
        const Expected next = i == nobody ? Expected{end_of_leg, nobody, 0} : expected_[i];
        if (end_of_leg <= next.time) {
            const Event end = discs_.apply({end_of_leg, size_, size_});
            begin_swirl();
            return end;
        }
        leave_bin(i);
        if (next.partner == own_list) {
            renew_list(i, flights_[i].position_at(next.time));
        } else if (next.partner == i || next.changes == changes_[next.partner]) {
            const Event event =
                discs_.apply({next.time, std::min(i, next.partner), std::max(i, next.partner)});
            take_over(i);
            ++changes_[i];
            if (next.partner != i) {
                take_over(next.partner);
                ++changes_[next.partner];
                leave_bin(next.partner);
                predict(next.partner);
                enter_bin(next.partner);
            }
            predict(i);
            enter_bin(i);
            return event;
        }
        predict(i);
        enter_bin(i);
    }
}

void PlainLists::predict(Number i) {
    const Flight<double> flight = flights_[i];
    Expected best{time_of_wall_contact(flight, {centres_[i], {0.0, 0.0}, flight.time}, skin_),
                  own_list, 0};
    const auto consider = [&](double time, Number partner) {
        if (precedes({time, i, partner}, {best.time, i, best.partner})) best = {time, partner, 0};
    };
    if (at_wall_[i]) {
        const Leg& leg = discs_.leg();
        consider(time_of_wall_contact(flight, {leg.start, leg.velocity, leg.begin},
                                      container_radius_ - radius_),
                 i);
    }
    const Number* const list = &lists_[room_ * i];
    for (Number k = 0; k < lengths_[i]; ++k)
        consider(time_of_contact(flight, flights_[list[k]], 2.0 * radius_), list[k]);
    if (best.partner < size_) best.changes = changes_[best.partner];
    expected_[i] = best;
}

void PlainLists::renew_list(Number i, const Vec2& centre) {
    for (Number k = 0; k < lengths_[i]; ++k) forget(lists_[room_ * i + k], i);
    lengths_[i] = 0;
    leave_cell(i);
    centres_[i] = centre;
    enter_cell(i);
    // With a little more than the reach, for rounding.
    const double square = reach_ * reach_ * (1.0 + 1e-9);
    const std::size_t cell = cell_at(centre), row = cell / cells_across_,
                      column = cell % cells_across_;
    for (std::size_t y = row > 0 ? row - 1 : 0; y <= std::min(row + 1, cells_across_ - 1); ++y)
        for (std::size_t x = column > 0 ? column - 1 : 0;
             x <= std::min(column + 1, cells_across_ - 1); ++x)
            for (Number j = first_in_cell_[y * cells_across_ + x]; j != nobody;
                 j = next_in_cell_[j]) {
                const Vec2 apart = centres_[j] - centre;
                if (j == i || dot(apart, apart) >= square) continue;
                note(i, j);
                note(j, i);
            }
    const double farthest = container_radius_ - radius_ - skin_ * (1.0 + 1e-9);
    at_wall_[i] = farthest <= 0.0 || dot(centre, centre) >= farthest * farthest;
}

void PlainLists::forget(Number i, Number j) {
    Number* const list = &lists_[room_ * i];
    *std::find(list, list + lengths_[i], j) = list[lengths_[i] - 1];
    --lengths_[i];
}

void PlainLists::note(Number i, Number j) {
    Number* const list = &lists_[room_ * i];
    if (std::find(list, list + lengths_[i], j) != list + lengths_[i]) return;
    if (lengths_[i] == room_) {
        widen_lists();
        return note(i, j);
    }
    list[lengths_[i]++] = j;
}

void PlainLists::widen_lists() {
    std::vector<Number> wider(2 * room_ * size_);
    for (Number i = 0; i < size_; ++i)
        std::copy_n(&lists_[room_ * i], lengths_[i], &wider[2 * room_ * i]);
    lists_ = std::move(wider);
    room_ *= 2;
}

std::size_t PlainLists::cell_at(const Vec2& place) const {
    const auto across = [this](double x) {
        const double cell = (x + container_radius_) / cell_width_;
        return std::min(std::size_t(std::max(cell, 0.0)), cells_across_ - 1);
    };
    return across(place.y) * cells_across_ + across(place.x);
}
void PlainLists::leave_cell(Number i) {
    const Number before = previous_in_cell_[i], after = next_in_cell_[i];
    (before == nobody ? first_in_cell_[cell_at(centres_[i])] : next_in_cell_[before]) = after;
    if (after != nobody) previous_in_cell_[after] = before;
}
void PlainLists::enter_cell(Number i) {
    Number& first = first_in_cell_[cell_at(centres_[i])];
    previous_in_cell_[i] = nobody;
    next_in_cell_[i] = first;
    if (first != nobody) previous_in_cell_[first] = i;
    first = i;
}

std::size_t PlainLists::bin_at(double time) const {
    const std::size_t later = first_in_bin_.size() - 1;
    const double bin = (time - calendar_begin_) / bin_width_;
    // Rounding may not put it where the calendar has passed.
    return bin < double(later) ? std::max(std::size_t(std::max(bin, 0.0)), now_) : later;
}
void PlainLists::leave_bin(Number i) {
    const Number before = previous_in_bin_[i], after = next_in_bin_[i];
    (before == nobody ? first_in_bin_[bin_of_[i]] : next_in_bin_[before]) = after;
    if (after != nobody) previous_in_bin_[after] = before;
    bin_of_[i] = nobody;
}
void PlainLists::enter_bin(Number i) {
    bin_of_[i] = Number(bin_at(expected_[i].time));
    Number& first = first_in_bin_[bin_of_[i]];
    previous_in_bin_[i] = nobody;
    next_in_bin_[i] = first;
    if (first != nobody) previous_in_bin_[first] = i;
    first = i;
}

bool PlainLists::comes_before(Number i, Number j) const {
    return precedes({expected_[i].time, i, expected_[i].partner},
                    {expected_[j].time, j, expected_[j].partner});
}

PlainLists::Number PlainLists::first_in_calendar() {
    const std::size_t later = first_in_bin_.size() - 1;
    while (first_in_bin_[now_] == nobody) {
        if (calendar_begin_ + bin_width_ * double(now_) > discs_.leg().end) return nobody;
        if (++now_ < later) continue;
        // The last page: what was left for later comes on the next ones.
        std::vector<Number> left;
        for (Number i = first_in_bin_[later]; i != nobody; i = next_in_bin_[i]) left.push_back(i);
        first_in_bin_[later] = nobody;
        calendar_begin_ += bin_width_ * double(later);
        now_ = 0;
        for (const Number i : left) enter_bin(i);
    }
    Number first = first_in_bin_[now_];
    for (Number i = next_in_bin_[first]; i != nobody; i = next_in_bin_[i])
        if (comes_before(i, first)) first = i;
    return first;
}

}  // namespace swirl
