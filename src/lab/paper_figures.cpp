// The list of the figures; each one's plan lives in its own paper_figure_*.cpp.
#include <vector>

#include "lab/paper.hpp"

namespace swirl {

FigurePlan plan_figure_1c(const PaperSettings& settings);
FigurePlan plan_figure_2a(const PaperSettings& settings);
FigurePlan plan_figure_5a(const PaperSettings& settings);
FigurePlan plan_figure_5b(const PaperSettings& settings);

const std::vector<PaperFigure>& paper_figures() {
    static const std::vector<PaperFigure> all = {
        {"1c", "what the M-frame is: a drawing", plan_figure_1c},
        {"2a", "pinned and loose discs in the M-frame: a snapshot", plan_figure_2a},
        {"5a", "the simulated discs: a snapshot", plan_figure_5a},
        {"5b", "rotation of the cluster against the number of discs, for five frictions",
         plan_figure_5b},
    };
    return all;
}

}  // namespace swirl
