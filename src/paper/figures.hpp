// The plans of all figures, for the list of them.
#pragma once

#include "swirl/paper/paper.hpp"

namespace swirl {

FigurePlan plan_figure_1b(const PaperSettings& settings);
FigurePlan plan_figure_1c(const PaperSettings& settings);
FigurePlan plan_figure_2a(const PaperSettings& settings);
FigurePlan plan_figure_2b(const PaperSettings& settings);
FigurePlan plan_figure_2c(const PaperSettings& settings);
FigurePlan plan_figure_3a(const PaperSettings& settings);
FigurePlan plan_figure_3b(const PaperSettings& settings);
FigurePlan plan_figure_4a(const PaperSettings& settings);
FigurePlan plan_figure_4b(const PaperSettings& settings);
FigurePlan plan_figure_4c(const PaperSettings& settings);
FigurePlan plan_figure_5a(const PaperSettings& settings);
FigurePlan plan_figure_5b(const PaperSettings& settings);
FigurePlan plan_figure_5b_steady(const PaperSettings& settings);
FigurePlan plan_figure_5c(const PaperSettings& settings);
FigurePlan plan_figure_5d(const PaperSettings& settings);
FigurePlan plan_figure_averages(const PaperSettings& settings);
FigurePlan plan_figure_ball(const PaperSettings& settings);
FigurePlan plan_figure_energy(const PaperSettings& settings);
FigurePlan plan_figure_friction(const PaperSettings& settings);
FigurePlan plan_figure_inertia(const PaperSettings& settings);
FigurePlan plan_figure_map(const PaperSettings& settings);
FigurePlan plan_figure_polygon(const PaperSettings& settings);
FigurePlan plan_figure_restitution(const PaperSettings& settings);
FigurePlan plan_figure_spheres(const PaperSettings& settings);
FigurePlan plan_figure_spheres_ingredients(const PaperSettings& settings);
FigurePlan plan_figure_spheres_pinned(const PaperSettings& settings);
FigurePlan plan_figure_spheres_sense(const PaperSettings& settings);
FigurePlan plan_figure_states(const PaperSettings& settings);
FigurePlan plan_figure_tangential(const PaperSettings& settings);
FigurePlan plan_figure_times(const PaperSettings& settings);
FigurePlan plan_figure_transient(const PaperSettings& settings);

}  // namespace swirl
