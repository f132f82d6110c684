#include "swirl/measure/coarse_graining.hpp"

#include "swirl/measure/energy_budget.hpp"

namespace swirl {

Transfer transfer_of(const Event& event, const Snapshot& after) {
    const EnergyChange energy = energy_change(event, after);
    const Vec2 n = event.normal, along{n.y, -n.x};
    Transfer transfer;
    transfer.at_wall = event.kind == EventKind::disc_wall;
    transfer.begin = after.position(event.i);
    transfer.line =
        transfer.at_wall ? after.radius[event.i] * n : after.position(event.j) - transfer.begin;
    transfer.impulse = event.impulse.normal * n + event.impulse.tangential * along;
    const auto torque_on = [&](std::size_t i) {
        const double torque = after.radius[i] * event.impulse.tangential;
        if (after.inverse_inertia(i) != 0.0) return torque;
        transfer.taken_up += torque;
        return 0.0;
    };
    transfer.torque_i = torque_on(event.i);
    if (!transfer.at_wall) transfer.torque_j = torque_on(event.j);
    transfer.loss = energy.friction_loss + energy.inelastic_loss;
    return transfer;
}

}  // namespace swirl
