// The figures, by the file in which their plans are. A figure more is its plan there, with a line
// at the end of that file, and its script.
#pragma once

#include <vector>

#include "swirl/paper/paper.hpp"

namespace swirl {

std::vector<PaperFigure> figures_5b();
std::vector<PaperFigure> figures_of_pictures();
std::vector<PaperFigure> figures_of_the_cluster();
std::vector<PaperFigure> figures_of_maps();
std::vector<PaperFigure> figures_of_the_ball();
std::vector<PaperFigure> figures_of_times();
std::vector<PaperFigure> figures_beyond();
std::vector<PaperFigure> figures_of_condensation();
std::vector<PaperFigure> figures_of_spheres();

/// Whose runs others take up again.
FigurePlan plan_figure_5b(const PaperSettings& settings);

}  // namespace swirl
