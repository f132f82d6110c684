#include "swirl/paper/movies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <system_error>

#include "swirl/io/atomic_file.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/paper/paper_parameters.hpp"
#include "swirl/paper/result_store.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

struct PaperMovie {
    std::string system;  // "All friction": a heading of the page
    std::string name;    // of the file, as in the SI, without ending
    std::string caption;
    std::string explanation;
    MovieConfig config;
    Json settings;  // all that the content of the file depends on
    std::optional<RollingBall> model;
};

RunConfig run_of(std::int64_t discs, double mu_disc, double mu_wall, std::uint64_t seed) {
    RunConfig config;
    config.discs = discs;
    config.mu_disc = mu_disc;
    config.mu_wall = mu_wall;
    config.seed = seed;
    return config;
}

/// A pair of friction coefficients, or the minimal model, and the texts about it.
struct System {
    const char* title;
    double mu_disc, mu_wall;
    Coloring lab_coloring, m_coloring;
    const char* explanation;
    // Rotating and counterrotating, each in the lab frame and the M-frame.
    const char* lines[2][2];
};

constexpr System systems[] = {
    {"All friction",
     1.0,
     1.0,
     Coloring::id,
     Coloring::pinned,
     "The transition from rotation to counterrotation. The arc shows the total rotation of the "
     "cluster.",
     {{"28 discs slosh round the container and drift with the swirl: the arc grows to the left.",
       "Discs that reach the wall move up with it on the left, depin at the top and cross the "
       "container."},
      {"48 discs drift against the swirl: the arc grows to the right.",
       "Most discs are pinned (orange), in layers against the wall that carries them clockwise."}}},
    {"No disc friction",
     0.0,
     1.0,
     Coloring::spin,
     Coloring::spin,
     "The wall accelerates the spin of the discs that touch it. No friction passes the spin on.",
     {{"Colours show the spin: all discs have touched the wall and spin independently.",
       "They fill the container like a gas that is pushed down towards M."},
      {"The number that counterrotates with all friction: here it rotates with the swirl.",
       "Discs at the wall spin, those inside hardly do: no friction passes the spin on."}}},
    {"No wall friction",
     1.0,
     0.0,
     Coloring::id,
     Coloring::speed,
     "Nothing drags the discs along the wall, so the cluster rotates with the frequency of the "
     "swirl.",
     {{"The cluster sloshes as one body and rotates once per period.",
       "In the M-frame it rests on the wall, like settled sand."},
      {"With more discs it is the same: one rotation per period.",
       "Almost at rest: the colour scale ends at the speed of the wall."}}}};

constexpr System minimal_model{
    "Minimal model",
    0.0,
    0.0,
    Coloring::none,
    Coloring::none,
    "One rigid ball of half the size of the container, pressed against the wall.",
    {{"It rolls without slip, like a gear inside a ring, and rotates against the swirl.",
      "The wall turns clockwise and carries the ball along."},
     {"It slips freely and keeps one side at M, so it rotates once per period.",
      "The wall slides past, and the ball is at rest."}}};

std::string lower(std::string text) {
    for (char& c : text) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
    return text;
}

PaperMovie movie_of(const System& system, int version, Frame frame,
                    const PaperMoviesSettings& settings) {
    const bool lab = frame == Frame::lab, model = &system == &minimal_model;
    const std::string frame_name = lab ? "lab-frame" : "m-frame";
    PaperMovie movie;
    movie.system = system.title;
    movie.explanation = system.lines[version][lab ? 0 : 1];
    MovieConfig& config = movie.config;
    if (model) {
        movie.model = RollingBall{.slip = version == 0 ? 1.0 : 0.0};
        movie.caption = version == 0 ? "No slip, s = 1" : "Slip, s = 0";
        movie.name = "minimal-model-" + frame_name + (version == 0 ? "-no-slip" : "-slip");
        config.sources = {rolling(*movie.model, paper_amplitude, paper_period)};
        config.start = 0.0;
    } else {
        const RunConfig run = run_of(version == 0 ? rotating_n : counterrotating_n, system.mu_disc,
                                     system.mu_wall, settings.seed);
        movie.caption = fmt::format("N = {}", run.discs);
        movie.name = "numerical-" + frame_name + "-" + lower(system.title) +
                     (version == 0 ? "-rotating" : "-counterrotating");
        config.sources = {simulated(run)};
        config.start = static_cast<double>(default_warmup);
        movie.settings["run"] = config_json(run);
    }
    config.frames_per_second = settings.quick ? 30 : 60;
    config.frames = settings.quick ? 90 : 900;
    config.pace = 1.0;
    config.appearance.turned = lab;
    config.appearance.frames = {frame};
    config.appearance.coloring = lab ? system.lab_coloring : system.m_coloring;
    if (!model)
        config.appearance.full_speed =
            config.sources[0].container_radius * 2.0 * pi / config.sources[0].period;
    config.appearance.size = settings.quick ? Size{360, 360} : Size{900, 900};
    config.appearance.title =
        fmt::format("{}, {}", system.title, model ? config.sources[0].caption : movie.caption);
    config.out = (settings.out / (movie.name + ".mp4")).string();
    movie.settings["quick"] = settings.quick;
    return movie;
}

/// In the order of the page.
std::vector<PaperMovie> all_movies(const PaperMoviesSettings& settings) {
    std::vector<PaperMovie> movies;
    const auto add = [&](const System& system) {
        for (const int version : {0, 1})
            for (const Frame frame : {Frame::lab, Frame::m})
                movies.push_back(movie_of(system, version, frame, settings));
    };
    for (const System& system : systems) add(system);
    add(minimal_model);
    return movies;
}

std::string movie_key(const PaperMovie& movie) { return "movie-" + movie.name; }

/// The rotation measured in this movie, if an earlier call has made the same movie.
std::optional<double> find_finished(const ResultStore& store, const PaperMovie& movie) {
    const auto stored = store.find(movie_key(movie));
    if (!stored) return {};
    const Json& result = (*stored)["result"];
    std::error_code missing;
    const auto bytes = fs::file_size(movie.config.out, missing);
    if (missing || result.value("bytes", std::uintmax_t(0)) != bytes ||
        result.value("movie", Json()) != movie.settings)
        return {};
    return result.value("rotation", 0.0);
}

/// ϖ/Ω over the periods shown, by time.
double rotation_in(const PaperMovie& movie) {
    if (movie.model) return movie.model->rotation();
    const MovieConfig& config = movie.config;
    const FrameSource& source = config.sources.front();
    const double start = config.start,
                 periods = config.frames * config.pace / config.frames_per_second;
    constexpr int samples = 64;  // per period
    const Playback playback = source.open();
    const auto count = static_cast<int>(std::lround(periods * samples));
    double sum = 0.0;
    for (int k = 0; k < count; ++k)
        sum += cluster_rotation(playback(start + (k + 0.5) / samples)).individual;
    return sum / count * source.period / (2.0 * pi);
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
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(260px, 1fr)); gap: 1.2rem 1rem; }
figure { margin: 0; }
video { width: 100%; display: block; border-radius: 8px; border: 1px solid var(--line);
  box-sizing: border-box; }
figcaption { margin-top: .45rem; font-size: .9rem; color: var(--faint); }
figcaption b { color: var(--ink); font-weight: 600; }
figcaption span { float: right; font-variant-numeric: tabular-nums; }
@media print { video { border-radius: 0; } }
</style>
</head>
<body>
<h1>Swirled discs: the movies</h1>
<p>The numerical videos of Lee, Ryan, Lahini, Holmes-Cerfon and Rubinstein, “Geometric frustration
induces the transition between rotation and counterrotation in swirled granular media”, reproduced.
The container is swirled counter-clockwise and does not rotate: its marks are at rest in the lab frame.
The M-frame rotates with the swirl, so the point M stays at the bottom and the wall moves clockwise.
ϖ is the cluster’s rotation frequency in the lab frame, measured over the periods shown; Ω is that of
the swirl.</p>
)";

/// The movies of a row play synchronously, and only while the row is visible: some machines cannot
/// play sixteen movies at once.
constexpr const char* page_end = R"(<script>
const step = (row, play) => {
  const videos = [...row.querySelectorAll("video")];
  for (const v of videos) {
    v.currentTime = videos[0].currentTime;
    if (play) v.play().catch(() => {}); else v.pause();
  }
};
const visible = new IntersectionObserver(
  (rows) => rows.forEach((r) => step(r.target, r.isIntersecting)), { threshold: 0.25 });
document.querySelectorAll(".row").forEach((row) => visible.observe(row));
</script>
</body>
</html>
)";

std::string figure_of(const PaperMovie& movie, double rotation) {
    const bool lab = movie.config.appearance.frames.front() == Frame::lab;
    return fmt::format(
        "<figure><video src=\"{}.mp4\" preload=\"auto\" loop muted playsinline controls></video>\n"
        "<figcaption><b>{}, {}</b> <span>ϖ/Ω = {}</span><br>{}</figcaption></figure>\n",
        movie.name, movie.caption, lab ? "lab frame" : "M-frame", signed_number(rotation),
        movie.explanation);
}

std::string page_of(const std::vector<PaperMovie>& movies, const std::vector<double>& rotations) {
    std::string page = page_head, open;
    for (std::size_t k = 0; k < movies.size(); ++k) {
        if (movies[k].system != open) {
            if (!open.empty()) page += "</div>\n</section>\n";
            open = movies[k].system;
            const auto* const found =
                std::find_if(std::begin(systems), std::end(systems),
                             [&](const System& s) { return open == s.title; });
            page += fmt::format("<section>\n<h2>{}</h2>\n<p>{}</p>\n<div class=\"row\">\n", open,
                                (found == std::end(systems) ? minimal_model : *found).explanation);
        }
        page += figure_of(movies[k], rotations[k]);
    }
    return page + "</div>\n</section>\n" + page_end;
}

}  // namespace

PaperMovies make_paper_movies(const PaperMoviesSettings& settings,
                              const PaperMoviesControl& control) {
    const std::vector<PaperMovie> movies = all_movies(settings);
    const ResultStore store(settings.out);
    PaperMovies made;
    std::vector<double> rotations;
    for (const PaperMovie& movie : movies) {
        if (const auto rotation = find_finished(store, movie)) {
            rotations.push_back(*rotation);
            ++made.reused;
        } else {
            const auto begin = std::chrono::steady_clock::now();
            MovieControl movie_control;
            movie_control.stop = control.stop;
            movie_control.progress = [&](int done, int of) {
                if (!control.progress) return;
                const auto whole = static_cast<double>(rotations.size());
                control.progress((whole + double(done) / of) / double(movies.size()), movie.name);
            };
            const MovieResult result = make_movie(movie.config, movie_control);
            if (!result.complete) {
                if (result.frames > 0) fs::remove(movie.config.out);
                throw Interrupted(fmt::format(
                    "stopped after {} of {} movies.\nhint: the same call makes the others.",
                    rotations.size(), movies.size()));
            }
            rotations.push_back(rotation_in(movie));
            store.store(
                movie_key(movie),
                {{"movie", movie.settings},
                 {"bytes", fs::file_size(movie.config.out)},
                 {"rotation", rotations.back()}},
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        made.files.emplace_back(movie.config.out);
    }
    const fs::path page = settings.out / "movies.html";
    write_file_atomically(page, page_of(movies, rotations));
    made.files.push_back(page);
    return made;
}

}  // namespace swirl
