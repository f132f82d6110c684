// The list of the figures; each one's plan lives in its own paper_figure_*.cpp.
#include <vector>

#include "lab/paper.hpp"

namespace swirl {

FigurePlan plan_figure_5b(const PaperSettings& settings);

const std::vector<PaperFigure>& paper_figures() {
    static const std::vector<PaperFigure> all = {
        {"5b", "rotation of the cluster against the number of discs, for five frictions",
         plan_figure_5b},
    };
    return all;
}

}  // namespace swirl
