// The paper's drawn figures: 1c (what the M-frame is), 2a (pinned and loose discs), 5a (a
// snapshot).
#include <filesystem>

#include "swirl/paper/paper.hpp"
#include "swirl/render/frame_diagram.hpp"
#include "swirl/render/still.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

using Files = std::vector<std::filesystem::path>;

/// No table, no script: the picture is drawn at once, in all formats.
template <class Draw>
FigurePlan picture_plan(const std::string& stem, const std::string& finding, Draw draw) {
    FigurePlan plan;
    plan.finish = [=](const std::vector<nlohmann::ordered_json>&,
                      const std::filesystem::path& out) {
        FigureOutcome outcome;
        outcome.findings = {finding};
        for (const char* ending : {".png", ".svg", ".pdf"}) {
            const std::filesystem::path file = out / (stem + ending);
            draw(file.string());
            outcome.files.push_back(file);
        }
        return outcome;
    };
    return plan;
}

RunConfig pictured_run(std::int64_t discs, std::uint64_t seed) {
    RunConfig config;
    config.discs = discs;
    config.seed = seed;
    return config;
}

StillConfig light_picture(std::uint64_t seed, Frame frame, const std::string& file) {
    StillConfig config;
    config.sources = {simulated(pictured_run(48, seed))};
    config.appearance.frames = {frame};
    config.appearance.theme = light_theme();
    config.appearance.size = {1000, 1000};
    config.appearance.clock = false;
    config.at = 50.3;
    config.out = file;
    // What goes to print is as wide as a column, 86 mm or 245 points. Letters can be read there
    // only if it is drawn small, without what its caption says.
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
    const Snapshot s = simulated(pictured_run(28, seed)).open()(20.13);
    // The disc nearest to a place where its arrows have room, right of C.
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
    return picture_plan(
        "figure_1c", "Figure 1c: drawn; the forces are those on one of 28 discs at swirl 20.13.",
        [seed = settings.seed](const std::string& file) { draw_figure_1c(seed, file); });
}

static FigurePlan plan_figure_2a(const PaperSettings& settings) {
    return picture_plan("figure_2a",
                        "Figure 2a: 48 discs in the M-frame at swirl 50.3, pinned and loose.",
                        [seed = settings.seed](const std::string& file) {
                            StillConfig config = light_picture(seed, Frame::m, file);
                            config.appearance.coloring = Coloring::pinned;
                            config.appearance.angles = true;
                            config.appearance.slice = 0.75 * pi;
                            title(config, "Pinned and loose discs");
                            make_still(config);
                        });
}

static FigurePlan plan_figure_5a(const PaperSettings& settings) {
    return picture_plan("figure_5a", "Figure 5a: 48 discs in the lab frame at swirl 50.3.",
                        [seed = settings.seed](const std::string& file) {
                            StillConfig config = light_picture(seed, Frame::lab, file);
                            title(config, "The simulated discs");
                            make_still(config);
                        });
}

std::vector<PaperFigure> figures_of_pictures() {
    return {{"1c", "the M-frame and its forces", plan_figure_1c},
            {"2a", "discs pinned and loose, in the M-frame", plan_figure_2a},
            {"5a", "the simulated discs", plan_figure_5a}};
}

}  // namespace swirl
