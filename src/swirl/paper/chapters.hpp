// The chapters: questions that the paper leaves open. A chapter is one file with one or more
// figures. Each has a question and a caption (paper/captions.py), a table, a drawing in paper/figures/,
// and findings that are computed from the table. A new chapter needs its file, a line in
// chapter_figures() and the script.
#pragma once

#include <vector>

#include "swirl/paper/paper.hpp"

namespace swirl {

std::vector<PaperFigure> chapter_critical();
std::vector<PaperFigure> chapter_size();
std::vector<PaperFigure> chapter_mechanism();
std::vector<PaperFigure> chapter_material();
std::vector<PaperFigure> chapter_spheres();
std::vector<PaperFigure> chapter_fields();
std::vector<PaperFigure> chapter_cooling();
std::vector<PaperFigure> chapter_experiments();

/// Of all chapters, in their order.
std::vector<PaperFigure> chapter_figures();

/// Seeds of a point of a chapter.
inline int chapter_seeds(const PaperSettings& settings) { return settings.quick ? 2 : 8; }

}  // namespace swirl
