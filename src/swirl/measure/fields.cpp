#include "swirl/measure/fields.hpp"

#include <cmath>

namespace swirl {

void Fields::begin(const Snapshot& first) {
    known_ = true;
    double radius = 0.0;
    for (const double r : first.radius) radius += r / static_cast<double>(first.size());
    const CoarseKernel narrow{2.0 * radius}, wide{4.0 * radius};
    const Vec2 C = first.container_centre;
    const double swept = container_radius_ + square_root(dot(C, C));
    const SquareGrid container{side_, container_radius_};
    grids_ = {FieldGrid(container, narrow), FieldGrid(container, wide),
              FieldGrid({side_, swept}, narrow)};
    balances_ = {FieldBalance({0.0, 0.0}, narrow),
                 FieldBalance({0.5 * container_radius_, 0.0}, wide),
                 FieldBalance({0.0, -0.9 * container_radius_}, narrow)};
}

void Fields::sample_in_lab(const Snapshot& lab) {
    const bool is_used = samples_++ % samples_per_use == sample_in_use || uses_every_sample_;
    if (!is_used || lab.size() == 0) return;
    if (!known_) begin(lab);
    const MFrame frame = m_frame(lab);
    // Without a floor its force is known to be 0.
    const bool force_is_known =
        !lab.on_floor || !std::isnan(balances_[0].floor_force(lab, lab.size() - 1).x);
    for (std::size_t i = 0; i < lab.size(); ++i) {
        const bool has_force = lab.on_floor && force_is_known;
        const FieldDisc disc =
            field_disc(lab, i, has_force ? balances_[0].floor_force(lab, i) : Vec2{0.0, 0.0});
        const FieldDisc in_m_frame = relative_to(frame, disc);
        grids_[0].add(in_m_frame);
        grids_[1].add(in_m_frame);
        grids_[2].add(disc);
    }
    for (FieldGrid& grid : grids_) grid.add_sample(force_is_known);
}

void Fields::sample_event(const Event& event, const Snapshot& after) {
    if (after.size() == 0) return;
    if (!known_) begin(after);
    for (FieldBalance& balance : balances_) {
        if (balance.has_begun())
            balance.add(event, after);
        else
            balance.begin(after);
    }
    if (!is_collision(event)) return;
    const Transfer lab = transfer_of(event, after), in_m_frame = relative_to(m_frame(after), lab);
    grids_[0].add(in_m_frame);
    grids_[1].add(in_m_frame);
    grids_[2].add(lab);
}

void Fields::close_block() {
    if (known_)
        for (FieldGrid& grid : grids_) grid.close_period();
}

/// A ramp may shift all positions between two periods, so every period has a balance of its own.
void Fields::close_event_block(double duration) {
    if (!known_) return;
    for (FieldGrid& grid : grids_) grid.close_events(duration);
    for (FieldBalance& balance : balances_) {
        if (!balance.has_begun()) continue;
        balance.finish();
        const std::array<double, 3> relative = balance.relative_residuals();
        for (std::size_t k = 0; k < relative.size(); ++k)
            residuals_[k] =
                std::isnan(residuals_[k]) ? relative[k] : larger(residuals_[k], relative[k]);
    }
}

ReportTable Fields::table(const char* name, const char* description, std::size_t grid) const {
    ReportTable table{name, description, {{quantity("fields.x")}, {quantity("fields.y")}}};
    for (const Quantity* column : field_quantities) table.add_column({*column, with_error_column});
    const FieldGrid none({side_, container_radius_}, {});
    const FieldGrid& shown = known_ ? grids_[grid] : none;
    for (std::size_t cell = 0; cell < shown.grid().cells(); ++cell) {
        const Vec2 at = shown.grid().centre_of(cell);
        table.add(at.x, at.y);
        for (const Estimate& estimate : shown.estimates(cell)) table.add(estimate);
    }
    return table;
}

void Fields::merge(const Fields& other) {
    if (!other.known_) return;
    if (!known_) {
        known_ = true;
        for (std::size_t k = 0; k < grids_.size(); ++k)
            grids_[k] = FieldGrid(other.grids_[k].grid(), other.grids_[k].kernel());
        for (std::size_t k = 0; k < balances_.size(); ++k)
            balances_[k] = other.balances_[k].at_the_same_point();
    }
    for (std::size_t k = 0; k < grids_.size(); ++k) {
        grids_[k].merge(other.grids_[k]);
        if (std::isnan(residuals_[k]) || other.residuals_[k] > residuals_[k])
            residuals_[k] = other.residuals_[k];
    }
}

}  // namespace swirl
