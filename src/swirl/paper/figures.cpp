// All figures in the order of the report: those of the paper by their names, then those beyond it.
#include "swirl/paper/figures.hpp"

#include <algorithm>

#include "swirl/paper/chapters.hpp"

namespace swirl {
namespace {

/// Where a figure of the paper is sorted. Pinning and depinning have no figure in the paper; they
/// follow Figure 3.
std::string_view sort_key(const PaperFigure& figure) {
    return figure.name == "pinning" ? "3c" : figure.name;
}
/// "5b" is a figure of the paper, "5b-steady" and "ball" are not.
bool is_of_the_paper(const PaperFigure& figure) { return sort_key(figure).size() == 2; }

void append(std::vector<PaperFigure>& all, std::vector<PaperFigure> more, std::string_view group) {
    for (PaperFigure& figure : more) {
        figure.group = is_of_the_paper(figure) ? "paper" : group;
        all.push_back(figure);
    }
}

std::vector<PaperFigure> in_order() {
    std::vector<PaperFigure> all;
    for (const auto& figures :
         {figures_of_drawings(), figures_of_the_ball(), figures_of_the_cluster(), figures_of_maps(),
          figures_of_times(), figures_5b(), figures_of_parameters(), figures_against_time(),
          figures_of_condensation()})
        append(all, figures, "beyond");
    append(all, figures_of_spheres(), "rolling");
    append(all, chapter_figures(), "chapters");
    const auto beyond = std::stable_partition(all.begin(), all.end(), is_of_the_paper);
    std::sort(all.begin(), beyond,
              [](const PaperFigure& a, const PaperFigure& b) { return sort_key(a) < sort_key(b); });
    return all;
}

}  // namespace

std::vector<PaperFigure> chapter_figures() {
    std::vector<PaperFigure> all;
    for (const auto& chapter :
         {chapter_size(), chapter_critical(), chapter_mechanism(), chapter_material(),
          chapter_spheres(), chapter_fields(), chapter_cooling(), chapter_experiments()})
        all.insert(all.end(), chapter.begin(), chapter.end());
    return all;
}

const std::vector<PaperFigure>& paper_figures() {
    static const std::vector<PaperFigure> all = in_order();
    return all;
}

}  // namespace swirl
