// The relations of a micropolar fluid, fitted to measured fields (Dahler, Scriven 1961; Tsai, Ye,
// Gollub, Lubensky 2005, doi:10.1103/PhysRevLett.94.214301):
//
//     torque of the stress   σ_yx − σ_xy = Γ √(mT) (curl u − 2ω)
//     deviator of σ          = 2 η √(mT) × (deviator of the strain rate)
//     couple stress          C = D √(mT) ∇ω
//     pressure               p = k p_H,  p_H that of smooth elastic discs (Henderson 1975,
//                            doi:10.1080/00268977500102511)
//
// Rigid discs have no other scale of time than √(m/T), so Γ, η and D depend on the packing fraction
// only, as long as the spins are as hot as the motion.
//
// Each is y = k x at every point of a region. There the packing fraction, a mean over the seeds, is
// in a range, and no contact with the wall contributes. Both x and y have errors, which are
// correlated within a run. So only products of two different seeds i ≠ j count:
//
//     k = Σ x_i y_j / Σ x_i x_j          explained = (Σ x_i y_j)² / (Σ x_i x_j · Σ y_i y_j)
//
// where the sums are over points and pairs of seeds. Noise does not change their expectation.
// "Explained" is the share of the square of the mean field y. All points have the same weight.
//
// Errors: jackknife over the seeds. Limits: at least two seeds, four for errors; otherwise NaN.
// "Explained" is NaN if the fields are so noisy that a sum of squares is not positive. Points with
// a missing value in any seed are omitted.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/paper/rank_correlation.hpp"
#include "swirl/paper/rough_gas.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// The columns of a table of fields, and those of all seeds.
using FieldColumns = std::map<std::string, Values>;
using FieldSeeds = std::vector<FieldColumns>;

struct FieldRegion {
    double low, high;  // of the packing fraction
    double reach;      // distance from C
    bool contains(double packing, double x, double y) const {
        return packing >= low && packing < high && x * x + y * y < reach * reach;
    }
};

/// x and y at one point; two components for vectors and deviators.
struct RelationSides {
    double x[2] = {0.0, 0.0}, y[2] = {0.0, 0.0};
};

struct FluidRelation {
    const char *name, *words, *explains;
    RelationSides (*at)(const FieldColumns& f, std::size_t point);
};

/// √(T/m) for discs of mass 1.
inline double thermal_speed(const FieldColumns& f, std::size_t point) {
    return std::sqrt(f.at("temperature")[point]);
}

/// p_H relative to an ideal gas.
inline double henderson_ratio(double packing) {
    return 1.0 + 2.0 * packing * contact_correlation(packing);
}

inline constexpr FluidRelation fluid_relations[] = {
    {"rotational_viscosity", "rotational viscosity Γ", "torque of the stress",
     [](const FieldColumns& f, std::size_t p) {
         return RelationSides{
             {thermal_speed(f, p) * (f.at("vorticity")[p] - 2.0 * f.at("spin")[p])},
             {f.at("torque")[p]}};
     }},
    {"shear_viscosity", "shear viscosity η", "deviator of the stress",
     [](const FieldColumns& f, std::size_t p) {
         const auto stress = [&](const std::string& ab) {
             return f.at("kinetic_" + ab)[p] + f.at("collisional_" + ab)[p];
         };
         const double symmetric =
             0.5 * (stress("xy") + f.at("kinetic_xy")[p] + f.at("collisional_yx")[p]);
         const double rate = 2.0 * thermal_speed(f, p);
         return RelationSides{{rate * f.at("strain_xx")[p], rate * f.at("strain_xy")[p]},
                              {0.5 * (stress("xx") - stress("yy")), symmetric}};
     }},
    {"spin_diffusion", "spin diffusion D", "couple stress",
     [](const FieldColumns& f, std::size_t p) {
         const auto couple = [&](const std::string& a) {
             return f.at("kinetic_couple_" + a)[p] + f.at("collisional_couple_" + a)[p];
         };
         const double speed = thermal_speed(f, p);
         return RelationSides{
             {speed * f.at("spin_gradient_x")[p], speed * f.at("spin_gradient_y")[p]},
             {couple("x"), couple("y")}};
     }},
    {"pressure", "pressure relative to smooth elastic discs", "pressure",
     [](const FieldColumns& f, std::size_t p) {
         const double packing = f.at("packing")[p];
         // Discs of radius 1 have the number density φ/π.
         return RelationSides{{packing / pi * f.at("temperature")[p] * henderson_ratio(packing)},
                              {f.at("pressure")[p]}};
     }}};

struct RelationFit {
    Estimate coefficient, explained;
    std::size_t points = 0;
};

inline RelationFit fit_relation(const FieldSeeds& seeds, const FluidRelation& relation,
                                const FieldRegion& region) {
    RelationFit fit;
    std::vector<std::vector<RelationSides>> sides;  // of each point, of each seed
    for (std::size_t p = 0; !seeds.empty() && p < seeds.front().at("packing").size(); ++p) {
        double packing = 0.0;
        std::vector<RelationSides> here;
        bool known = true;
        for (const FieldColumns& seed : seeds) {
            packing += seed.at("packing")[p] / static_cast<double>(seeds.size());
            const RelationSides s = here.emplace_back(relation.at(seed, p));
            known = known && std::isfinite(s.x[0] + s.x[1] + s.y[0] + s.y[1]);
        }
        if (known && region.contains(packing, seeds.front().at("x")[p], seeds.front().at("y")[p]))
            sides.push_back(std::move(here));
    }
    fit.points = sides.size();
    struct Products {
        double xx = 0.0, xy = 0.0, yy = 0.0;
    };
    const auto products = [&](const std::vector<std::size_t>& chosen_seeds) {
        Products all;
        for (const auto& point : sides)
            for (const int component : {0, 1}) {
                double x = 0.0, y = 0.0;
                for (const std::size_t s : chosen_seeds) {
                    const double a = point[s].x[component], b = point[s].y[component];
                    x += a;
                    y += b;
                    all.xx -= a * a;
                    all.xy -= a * b;
                    all.yy -= b * b;
                }
                all.xx += x * x;
                all.xy += x * y;
                all.yy += y * y;
            }
        return all;
    };
    if (sides.empty()) return fit;
    fit.coefficient = jackknife(seeds.size(), [&](const auto& chosen_seeds) {
        const Products s = products(chosen_seeds);
        return s.xy / s.xx;
    });
    fit.explained = jackknife(seeds.size(), [&](const auto& chosen_seeds) {
        const Products s = products(chosen_seeds);
        return s.xx > 0.0 && s.yy > 0.0 ? s.xy * s.xy / (s.xx * s.yy) : not_available;
    });
    return fit;
}

}  // namespace swirl
