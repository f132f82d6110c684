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
    transfer.torque_i = after.radius[event.i] * event.impulse.tangential;
    if (!transfer.at_wall) transfer.torque_j = after.radius[event.j] * event.impulse.tangential;
    transfer.loss = energy.friction_loss + energy.inelastic_loss;
    return transfer;
}

}  // namespace swirl
