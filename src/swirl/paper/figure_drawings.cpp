// The paper's drawings: 1c (the M-frame), 2a (pinned and loose discs), 5a (a snapshot).
#include <fmt/format.h>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/paper_parameters.hpp"
#include "swirl/render/frame_diagram.hpp"
#include "swirl/render/still.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

constexpr double shown_period = 50.3;    // of Figures 2a and 5a
constexpr double forces_period = 20.13;  // of Figure 1c

/// The figure has no tasks, no table and no script: it is drawn directly, in all formats.
template <class Draw>
FigurePlan plan_drawing(const std::string& stem, const std::string& finding, Draw draw) {
    FigurePlan plan;
    plan.is_drawn = false;  // drawn by finish
    plan.finish = [=](const std::vector<Json>&, const fs::path& out) {
        FigureOutcome outcome;
        outcome.findings = {finding};
        for (const char* ending : {".png", ".svg", ".pdf"}) {
            const fs::path file = out / (stem + ending);
            draw(file.string());
            outcome.files.push_back(file);
        }
        return outcome;
    };
    return plan;
}

RunConfig shown_run(std::int64_t discs, std::uint64_t seed) {
    RunConfig config;
    config.discs = discs;
    config.seed = seed;
    return config;
}

StillConfig light_still(std::uint64_t seed, Frame frame, const std::string& file) {
    StillConfig config;
    config.sources = {simulated(shown_run(counterrotating_n, seed))};
    config.appearance.frames = {frame};
    config.appearance.theme = light_theme();
    config.appearance.size = {1000, 1000};
    config.appearance.clock = false;
    config.at = shown_period;
    config.out = file;
    // In print the figure has the width of a column, 86 mm or 245 points. For readable letters it
    // is drawn small, without the parameters, which are in its caption.
    if (!file.ends_with(".png")) {
        config.appearance.size = {300, 300};
        config.sources.front().parameters.clear();
    }
    return config;
}

void title(StillConfig& config, const std::string& text) {
    if (config.out.ends_with(".png")) config.appearance.title = text;
}

void draw_figure_1c(std::uint64_t seed, const std::string& file) try {
    const Snapshot s = simulated(shown_run(rotating_n, seed)).open()(forces_period);
    // The disc nearest to a position right of C, where its arrows have space.
    const FrameTransform at(s, Frame::m);
    std::size_t chosen = 0;
    double nearest = never;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 away = at.position(s.position(i)) - Vec2{5.4, -2.2};
        if (dot(away, away) >= nearest) continue;
        nearest = dot(away, away);
        chosen = i;
    }
    Canvas canvas(Size{1500, 560}, *image_format(file));
    draw_frame_diagram(canvas, light_theme(), s, chosen);
    write_image(file, canvas.finish());
} catch (const DrawFailure& failure) {
    throw Failure(failure.what());
}

}  // namespace

static FigurePlan plan_figure_1c(const PaperSettings& settings) {
    return plan_drawing(
        "figure_1c",
        fmt::format("Figure 1c: drawn; the forces on one of {} discs at period {}.", rotating_n,
                    forces_period),
        [seed = settings.seed](const std::string& file) { draw_figure_1c(seed, file); });
}

static FigurePlan plan_figure_2a(const PaperSettings& settings) {
    return plan_drawing(
        "figure_2a",
        fmt::format("Figure 2a: {} discs in the M-frame at period {}, pinned and loose.",
                    counterrotating_n, shown_period),
        [seed = settings.seed](const std::string& file) {
            StillConfig config = light_still(seed, Frame::m, file);
            config.appearance.coloring = Coloring::pinned;
            config.appearance.angles = true;
            config.appearance.slice = 0.75 * pi;
            title(config, "Pinned and loose discs");
            make_still(config);
        });
}

static FigurePlan plan_figure_5a(const PaperSettings& settings) {
    return plan_drawing("figure_5a",
                        fmt::format("Figure 5a: {} discs in the lab frame at period {}.",
                                    counterrotating_n, shown_period),
                        [seed = settings.seed](const std::string& file) {
                            StillConfig config = light_still(seed, Frame::lab, file);
                            title(config, "The simulated discs");
                            make_still(config);
                        });
}

std::vector<PaperFigure> figures_of_drawings() {
    return {{"1c", "the M-frame and its forces", plan_figure_1c},
            {"2a", "discs pinned and loose, in the M-frame", plan_figure_2a},
            {"5a", "the simulated discs", plan_figure_5a}};
}

}  // namespace swirl
