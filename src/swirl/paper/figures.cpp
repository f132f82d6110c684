// All figures in the order of the report: the paper's by their names, then what goes beyond it.
#include "swirl/paper/figures.hpp"

#include <algorithm>

namespace swirl {
namespace {

/// "5b" is one, "5b-steady" and "ball" are not.
/// What the SI says of becoming pinned and free has no figure in the paper: it stands beside
/// Figure 3.
std::string_view place_of(const PaperFigure& figure) {
    return figure.name == "pinning" ? "3c" : figure.name;
}
bool is_of_the_paper(const PaperFigure& figure) { return place_of(figure).size() == 2; }

std::vector<PaperFigure> in_order() {
    std::vector<PaperFigure> all;
    for (const auto& of_a_file :
         {figures_of_pictures(), figures_of_the_ball(), figures_of_the_cluster(), figures_of_maps(),
          figures_of_times(), figures_5b(), figures_beyond(), figures_of_condensation(),
          figures_of_spheres()})
        all.insert(all.end(), of_a_file.begin(), of_a_file.end());
    const auto beyond = std::stable_partition(all.begin(), all.end(), is_of_the_paper);
    std::sort(all.begin(), beyond,
              [](const PaperFigure& a, const PaperFigure& b) { return place_of(a) < place_of(b); });
    return all;
}

}  // namespace

const std::vector<PaperFigure>& paper_figures() {
    static const std::vector<PaperFigure> all = in_order();
    return all;
}

}  // namespace swirl
