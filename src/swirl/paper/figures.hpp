// The figures, grouped by the file of their plans. A new figure needs its plan in one of these
// files, an entry in the list at the end of that file, and a drawing in paper/figures/.
#pragma once

#include <vector>

#include "swirl/paper/paper.hpp"

namespace swirl {

std::vector<PaperFigure> figures_5b();
std::vector<PaperFigure> figures_against_time();
std::vector<PaperFigure> figures_of_condensation();
std::vector<PaperFigure> figures_of_drawings();
std::vector<PaperFigure> figures_of_maps();
std::vector<PaperFigure> figures_of_parameters();
std::vector<PaperFigure> figures_of_spheres();
std::vector<PaperFigure> figures_of_the_ball();
std::vector<PaperFigure> figures_of_the_cluster();
std::vector<PaperFigure> figures_of_times();

/// Figure `averages` uses its runs.
FigurePlan plan_figure_5b(const PaperSettings& settings);

}  // namespace swirl
