// The list of the figures; each one's plan lives in its own paper_figure_*.cpp.
#include "swirl/paper/figures.hpp"

namespace swirl {

const std::vector<PaperFigure>& paper_figures() {
    static const std::vector<PaperFigure> all = {
        {"1b", "rotation against N, and the pancake line", plan_figure_1b},
        {"1c", "the M-frame and its forces", plan_figure_1c},
        {"2a", "discs pinned and loose, in the M-frame", plan_figure_2a},
        {"2b", "density and flow of a rotating dish, N = 28", plan_figure_2b},
        {"2c", "density and flow of a counterrotating dish, N = 48", plan_figure_2c},
        {"3a", "angular velocity against the angular position", plan_figure_3a},
        {"3b", "the same, divided by that of the wall", plan_figure_3b},
        {"4a", "slip parameter of the pinned discs, smooth and rough", plan_figure_4a},
        {"4b", "spin of the pinned discs at the wall, and frustration", plan_figure_4b},
        {"4c", "rotation against N, smooth and rough", plan_figure_4c},
        {"5a", "the simulated discs", plan_figure_5a},
        {"5b", "rotation against N, for five frictions", plan_figure_5b},
        {"5c", "density, N = 28 and 48", plan_figure_5c},
        {"5d", "flow relative to the container, N = 28 and 48", plan_figure_5d},
        {"ball", "the minimal model, simulated: γ of one large disc", plan_figure_ball},
        {"states", "without one of the frictions: motion in the M-frame", plan_figure_states},
        {"times", "the smallest times between collisions", plan_figure_times},
        {"averages", "beyond the paper: by event and by time", plan_figure_averages},
        {"transient", "beyond the paper: spin and rotation from rest, μ_d = 0",
         plan_figure_transient},
        {"5b-steady", "beyond the paper: Figure 5b in the steady state", plan_figure_5b_steady},
        {"friction", "beyond the paper: the crossing N_c against μ", plan_figure_friction},
        {"inertia", "beyond the paper: moment of inertia ½, 1, 10", plan_figure_inertia},
        {"restitution", "beyond the paper: restitution e = 1, 0.99, 0.9", plan_figure_restitution},
        {"tangential", "beyond the paper: tangential restitution, solid discs",
         plan_figure_tangential},
        {"polygon", "beyond the paper: the polygon's sides, and the true circle",
         plan_figure_polygon},
        {"energy", "beyond the paper: energy without any friction", plan_figure_energy},
        {"spheres", "spheres that roll: rotation against N, six frictions", plan_figure_spheres},
        {"spheres_sense", "spheres that roll: where the sense of rotation changes",
         plan_figure_spheres_sense},
        {"spheres_ingredients", "spheres that roll: each ingredient switched off alone",
         plan_figure_spheres_ingredients},
        {"spheres_pinned", "spheres that roll: the pinned, and the frustration of rolling",
         plan_figure_spheres_pinned},
        {"map", "beyond the paper: both frictions at N = 48", plan_figure_map},
    };
    return all;
}

}  // namespace swirl
