// All measurements, one row each: the name, the header with the definition, and one line of
// description. The command line, JSON, CSV and Python follow this list; measurements.md is written
// by hand. sampling.hpp lists the functions of a measurement and when they are called.
#pragma once

#include <tuple>

#include "swirl/measure/angular_profile.hpp"
#include "swirl/measure/cluster_centre.hpp"
#include "swirl/measure/collision_angles.hpp"
#include "swirl/measure/collision_rates.hpp"
#include "swirl/measure/contact_network.hpp"
#include "swirl/measure/density_map.hpp"
#include "swirl/measure/diffusion.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/measure/fields.hpp"
#include "swirl/measure/flow_map.hpp"
#include "swirl/measure/granular_temperature.hpp"
#include "swirl/measure/hexatic_order.hpp"
#include "swirl/measure/local_packing.hpp"
#include "swirl/measure/measurement_row.hpp"
#include "swirl/measure/pair_correlation.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/radial_density.hpp"
#include "swirl/measure/rolling.hpp"
#include "swirl/measure/rotation_fluctuations.hpp"
#include "swirl/measure/segregation.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"
#include "swirl/measure/torque_budget.hpp"
#include "swirl/measure/velocity_correlation.hpp"
#include "swirl/measure/velocity_distribution.hpp"
#include "swirl/measure/wall_residence.hpp"
#include "swirl/measure/wall_stress.hpp"

namespace swirl {

// clang-format off
inline constexpr std::tuple measurement_list{
    measurement_in_container<DensityMaps>("density", "density_map.hpp",
        "density map, 100 × 100, by time and by event (Figs 2, 5c)"),
    measurement_in_container<FlowMap>("flow", "flow_map.hpp",
        "velocity relative to the container, 20 × 20 (Figs 2, 5d)"),
    measurement<AngularProfile>("profile", "angular_profile.hpp",
        "angular velocity about the centre of mass as a function of θ (Fig. 3)"),
    measurement<PinnedByCollisions>("pinned", "pinned_loose.hpp",
        "where discs pin and depin, by tracks and by collisions (Fig. 3)"),
    measurement<WallResidences>("residence", "wall_residence.hpp",
        "residence in the wall layer: where discs pin and depin (Fig. 3)"),
    measurement<ClusterCentre>("centre", "cluster_centre.hpp",
        "position of the cluster in the M-frame, its shape, centrifugal and Coriolis force"),
    measurement<Slip>("slip", "slip.hpp",
        "slip parameter, perimeter, pancake line (Figs 1b, 4a)"),
    measurement<SpinFrustration>("frustration", "spin_frustration.hpp",
        "spins at the wall and of neighbours, sticking contacts (Fig. 4b)"),
    measurement_in_container<RadialDensity>("radial", "radial_density.hpp",
        "density as a function of the distance from the container's centre"),
    measurement_in_container<GranularTemperature>("temperature", "granular_temperature.hpp",
        "granular temperature of the motion and of the spins"),
    measurement<HexaticOrder>("order", "hexatic_order.hpp",
        "hexatic order ψ6 from Voronoi neighbours, of all discs and of the pinned"),
    measurement<LocalPacking>("packing", "local_packing.hpp",
        "local packing fraction from Voronoi cells, of all discs and of the pinned"),
    measurement<Segregation>("segregation", "segregation.hpp",
        "separation of large and small particles, radially and among neighbours"),
    measurement<CollisionRates>("collisions", "collision_rates.hpp",
        "collision rates of a disc, mean free time"),
    measurement_in_container<WallStress>("wall", "wall_stress.hpp",
        "pressure on the wall and traction along it as functions of θ"),
    measurement<DiffusionLags>("diffusion", "diffusion.hpp",
        "squared displacement and rotation of a disc as functions of the time lag"),
    measurement<EnergyBudget>("energy", "energy_budget.hpp",
        "energy budget: work of wall and floor, losses in friction and collisions"),
    measurement<TorqueBudget>("torque", "torque_budget.hpp",
        "torques on the cluster: wall, friction between discs, spins; pinned and loose"),
    measurement<Rolling>("rolling", "rolling.hpp",
        "for spheres: rolling and sliding on the floor, vertical friction, frustration"),
    measurement_in_dish<PairCorrelation>("pair_correlation", "pair_correlation.hpp",
        "pair correlation function g(r), and its value at contact"),
    measurement_in_dish<VelocityCorrelation>("velocity_correlation", "velocity_correlation.hpp",
        "correlation of velocities and of spins against the distance"),
    measurement<VelocityDistribution>("velocity_distribution", "velocity_distribution.hpp",
        "distribution of speeds and of spins, and its kurtosis"),
    measurement<ContactNetwork>("contact_network", "contact_network.hpp",
        "contacts of a disc, rattlers, connected groups, loops"),
    measurement<CollisionAngles>("collision_angles", "collision_angles.hpp",
        "head-on or grazing: impact parameters and directions of the collisions"),
    measurement<RotationFluctuations>("fluctuations", "rotation_fluctuations.hpp",
        "fluctuations of the rotation: N var(ϖ), Binder cumulant, lifetimes of states"),
    measurement_in_container<Fields>("fields", "fields.hpp",
        "coarse-grained fields: density, flow, spin, stress, couple stress, dissipation"),
};
// clang-format on

}  // namespace swirl
