// Size and amplitude: the rotation over the packing fraction φ = N r²/R² and the relative amplitude
// A/R of the swirl, in dishes of different sizes R/r. The paper has one dish, R/r = 8.6 and A/R =
// 0.22. Where does the direction of rotation change, and in which state of the cluster?
#include <algorithm>

#include "swirl/paper/chapter_runs.hpp"
#include "swirl/paper/chapters.hpp"

namespace swirl {
namespace {

constexpr double ratio_of_the_paper = 0.22;  // SI: "A/R = 0.22"

/// Dense clusters in large dishes take most of the time, and there the direction does not change.
/// In the largest dish only the packing fractions near the changes are run.
bool is_run_in(double radius, double fraction) {
    constexpr double selected[] = {0.1, 0.2, 0.25, 0.28, 0.3, 0.36, 0.4};
    if (radius >= 40.0)
        return std::find(std::begin(selected), std::end(selected), fraction) != std::end(selected);
    return fraction < (radius < 20.0 ? 0.66 : 0.47);
}

}  // namespace

DishPoints dishes_of_sizes(const PaperSettings& settings) {
    std::vector<double> radii{8.6, 17.2}, fractions{0.2, 0.3, 0.4, 0.49, 0.6};
    if (!settings.quick) {
        radii = {6.0, 8.6, 12.0, 17.2, 24.0, 34.4, 60.0};
        fractions = {0.05, 0.1, 0.15, 0.2,  0.25, 0.28, 0.3,  0.32, 0.34, 0.36,
                     0.38, 0.4, 0.43, 0.46, 0.49, 0.52, 0.56, 0.6,  0.65};
    }
    DishPoints points;
    for (const double radius : radii)
        for (const double fraction : fractions)
            if (is_run_in(radius, fraction)) points.add({radius, ratio_of_the_paper}, fraction);
    return points;
}

static FigurePlan plan_figure_size(const PaperSettings& settings) {
    return plan_dishes(settings, "size", dishes_of_sizes(settings));
}

static FigurePlan plan_figure_amplitude(const PaperSettings& settings) {
    std::vector<double> ratios{0.1, 0.22, 0.4}, fractions{0.2, 0.4, 0.6};
    if (!settings.quick) {
        ratios = {0.05, 0.1, 0.15, 0.22, 0.3, 0.4, 1.0};
        fractions = {0.1, 0.2, 0.3, 0.4, 0.46, 0.49, 0.52, 0.6};
    }
    DishPoints points;
    for (const double ratio : ratios)
        for (const double fraction : fractions) points.add({8.6, ratio}, fraction);
    if (!settings.quick)
        for (const double ratio : {0.1, ratio_of_the_paper, 0.4})
            for (const double fraction : {0.1, 0.2, 0.3, 0.4, 0.46, 0.49, 0.52})
                points.add({17.2, ratio}, fraction);
    return plan_dishes(settings, "amplitude", points);
}

std::vector<PaperFigure> chapter_size() {
    return {{"size", "chapter: the direction of rotation in containers of different sizes",
             plan_figure_size},
            {"amplitude", "chapter: the direction of rotation for different amplitudes",
             plan_figure_amplitude}};
}

}  // namespace swirl
