#include "lab/paper_movies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "files/whole_file.hpp"
#include "lab/failure.hpp"
#include "lab/movie.hpp"
#include "measure/cluster_rotation.hpp"

namespace swirl {

namespace {

/// One row of the page: a system, filmed in both frames, in two versions.
struct Row {
    std::string title, name;  // name: as in the SI, in file names
    std::string what_to_see;
    Coloring lab_coloring, m_coloring;
    struct Version {
        std::string name;     // "rotating"
        std::string caption;  // on the page, above the videos
        Footage footage;
    };
    std::vector<Version> versions;
};

RunConfig paper_run(std::int64_t discs, double mu_disc, double mu_wall, std::uint64_t seed) {
    RunConfig config;
    config.discs = discs;
    config.mu_disc = mu_disc;
    config.mu_wall = mu_wall;
    config.seed = seed;
    return config;
}

Row numerical(const std::string& title, double mu_disc, double mu_wall, std::uint64_t seed,
              Coloring lab, Coloring m, const std::string& what_to_see) {
    Row row{title, "", what_to_see, lab, m, {}};
    row.name = title;
    for (char& c : row.name) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
    row.versions.push_back(
        {"rotating", "N = 28", simulated(paper_run(28, mu_disc, mu_wall, seed))});
    row.versions.push_back(
        {"counterrotating", "N = 48", simulated(paper_run(48, mu_disc, mu_wall, seed))});
    return row;
}

std::vector<Row> all_rows(std::uint64_t seed) {
    std::vector<Row> rows;
    rows.push_back(numerical("All friction", 1.0, 1.0, seed, Coloring::id, Coloring::pinned,
                             "The arc round the dish adds up how far the cluster has turned: 28 "
                             "discs drift round with the "
                             "swirl, 48 creep the other way. In the M-frame discs stick to the "
                             "wall, ride up with it, come off and cross over; "
                             "with 48 discs the pinned region (red) reaches much farther."));
    rows.push_back(numerical(
        "No disc friction", 0.0, 1.0, seed, Coloring::spin, Coloring::spin,
        "The wall spins up the discs that touch it, and without friction between them nothing "
        "slows "
        "them down: colours show the spin. The cluster is loose, like a gas, and turns with the "
        "swirl."));
    rows.push_back(numerical(
        "No wall friction", 1.0, 0.0, seed, Coloring::id, Coloring::speed,
        "Nothing drags the discs along the wall: in the lab frame the cluster sloshes round as one "
        "body, at the rate of the swirl; in the M-frame it hardly moves inside."));

    Row ball{
        "Minimal model",
        "minimal-model",
        "One rigid ball. Rolling on the wall without slip it counterrotates, like a gear inside "
        "a ring; where it slips freely it does not turn in the M-frame, so in the lab it turns "
        "with the swirl.",
        Coloring::none,
        Coloring::none,
        {}};
    for (const double slip : {1.0, 0.0}) {
        RollingBall model;
        model.slip = slip;
        const std::string name = slip == 1.0 ? "no-slip" : "slip";
        ball.versions.push_back({name, slip == 1.0 ? "no slip, s = 1" : "slip, s = 0",
                                 rolling(model, paper_amplitude, paper_period)});
    }
    rows.push_back(ball);
    return rows;
}

/// ϖ/Ω over the swirls shown, by time.
double rotation_over(const Footage& footage, double start, double swirls) {
    constexpr int samples = 64;  // per swirl
    const Reel reel = footage.open();
    const auto count = static_cast<int>(std::lround(swirls * samples));
    double sum = 0.0;
    for (int k = 0; k < count; ++k)
        sum += cluster_rotation(reel(start + (k + 0.5) / samples)).individual;
    return sum / count * footage.period / (2.0 * pi);
}

std::string signed_number(double value) {
    return fmt::format("{}{:.3f}", value < 0.0 ? "−" : "+", std::abs(value));
}

constexpr const char* page_head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Swirled discs: the movies</title>
<style>
:root { color-scheme: dark light; --page: #11151c; --ink: #edf1f5; --faint: #97a3b2; --line: #2b3442; }
@media (prefers-color-scheme: light) {
  :root { --page: #ffffff; --ink: #161b22; --faint: #5e6a77; --line: #dde2e8; } }
body { margin: 0 auto; max-width: 1500px; padding: 2.5rem 2rem 4rem; background: var(--page);
  color: var(--ink); font: 16px/1.55 Inter, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 2rem; letter-spacing: -0.01em; margin: 0 0 .3rem; }
h2 { font-size: 1.3rem; margin: 2.6rem 0 .3rem; }
p { max-width: 62rem; margin: .2rem 0 1rem; color: var(--faint); }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(260px, 1fr)); gap: 1rem; }
figure { margin: 0; }
video { width: 100%; display: block; border-radius: 8px; border: 1px solid var(--line);
  box-sizing: border-box; }
figcaption { margin-top: .45rem; font-size: .9rem; color: var(--faint); }
figcaption b { color: var(--ink); font-weight: 600; }
@media print { video { border-radius: 0; } }
</style>
</head>
<body>
<h1>Swirled discs: the movies</h1>
<p>The numerical videos of Lee, Ryan, Lahini, Holmes-Cerfon and Rubinstein, “Geometric frustration
induces the transition between rotation and counterrotation in swirled granular media”, computed
anew. The dish is swirled counter-clockwise and never turns itself: its marks stand still in the lab
frame. The M-frame turns with the swirl, so that the point M stays at the bottom and the wall turns
clockwise. ϖ is the cluster’s rotation in the lab frame, Ω that of the swirl.</p>
)";

std::string page_of(const std::vector<Row>& rows, const std::vector<std::string>& figures) {
    std::string page = page_head;
    std::size_t next = 0;
    for (const Row& row : rows) {
        page += fmt::format("<h2>{}</h2>\n<p>{}</p>\n<div class=\"row\">\n", row.title,
                            row.what_to_see);
        for (std::size_t k = 0; k < 2 * row.versions.size(); ++k) page += figures[next++];
        page += "</div>\n";
    }
    return page + "</body>\n</html>\n";
}

}  // namespace

std::vector<std::filesystem::path> make_paper_movies(const PaperMoviesSettings& settings,
                                                     const PaperMoviesControl& control) {
    const std::vector<Row> rows = all_rows(settings.seed);
    std::vector<std::filesystem::path> files;
    std::vector<std::string> figures;
    double total = 0.0;
    for (const Row& row : rows) total += 2.0 * static_cast<double>(row.versions.size());

    for (const Row& row : rows) {
        for (const Row::Version& version : row.versions) {
            for (const Frame frame : {Frame::lab, Frame::m}) {
                const bool lab = frame == Frame::lab;
                const bool model = row.name == "minimal-model";
                MovieConfig config;
                config.footage = {version.footage};
                config.start = model ? 0.0 : static_cast<double>(default_warmup);
                config.frames_per_second = settings.quick ? 30 : 60;
                config.frames = settings.quick ? 90 : 900;
                config.pace = 1.0;
                config.appearance.turned = lab;
                config.appearance.frames = {frame};
                config.appearance.coloring = lab ? row.lab_coloring : row.m_coloring;
                config.appearance.size = settings.quick ? Size{360, 360} : Size{900, 900};
                config.appearance.title = fmt::format(
                    "{}, {}", row.title, model ? version.footage.caption : version.caption);
                const std::string name =
                    fmt::format("{}{}-{}-{}.mp4", model ? "" : "numerical-",
                                model ? row.name : (lab ? "lab-frame" : "m-frame"),
                                model ? (lab ? "lab-frame" : "m-frame") : row.name, version.name);
                config.out = (settings.out / name).string();

                MovieControl movie_control;
                movie_control.stop = control.stop;
                movie_control.progress = [&](int done, int of) {
                    if (!control.progress) return;
                    const double whole = static_cast<double>(files.size());
                    control.progress((whole + double(done) / of) / total, name);
                };
                const MovieResult result = make_movie(config, movie_control);
                if (!result.complete) {
                    if (result.frames > 0) std::filesystem::remove(config.out);
                    throw Interrupted(
                        fmt::format("Stopped after {} of {:.0f} movies.", files.size(), total));
                }
                files.emplace_back(config.out);
                const double swirls = config.frames * config.pace / config.frames_per_second;
                const double rotation =
                    model ? RollingBall{.slip = version.name == "slip" ? 0.0 : 1.0}.rotation()
                          : rotation_over(version.footage, config.start, swirls);
                figures.push_back(fmt::format(
                    "<figure><video src=\"{}\" autoplay loop muted playsinline controls></video>\n"
                    "<figcaption><b>{}, {}</b><br>ϖ/Ω = {}{}</figcaption></figure>\n",
                    name, version.caption, lab ? "lab frame" : "M-frame", signed_number(rotation),
                    model ? "" : fmt::format(" over the {:g} swirls shown", swirls)));
            }
        }
    }
    const std::filesystem::path page = settings.out / "movies.html";
    write_whole_file(page, page_of(rows, figures));
    files.push_back(page);
    return files;
}

}  // namespace swirl
