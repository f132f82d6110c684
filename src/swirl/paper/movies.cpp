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
#include "swirl/paper/parts.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

/// One movie.
struct PaperMovie {
    std::string system;   // "All friction": a heading of the page
    std::string name;     // of the file, as in the SI, without its ending
    std::string caption;  // on the page, below it
    std::string what_to_see;
    MovieConfig config;
    Json settings;  // what decides its bytes
    std::optional<RollingBall> model;
};

RunConfig filmed_run(std::int64_t discs, double mu_disc, double mu_wall, std::uint64_t seed) {
    RunConfig config;
    config.discs = discs;
    config.mu_disc = mu_disc;
    config.mu_wall = mu_wall;
    config.seed = seed;
    return config;
}

/// What a system shows, in the words of the page.
struct System {
    const char* title;
    double mu_disc, mu_wall;
    Coloring lab_coloring, m_coloring;
    const char* what_to_see;
    // Rotating and counterrotating, each in the lab frame and the M-frame.
    const char* lines[2][2];
};

constexpr System systems[] = {
    {"All friction",
     1.0,
     1.0,
     Coloring::id,
     Coloring::pinned,
     "The passage from rotation to counterrotation. The arc adds up how far the cluster has "
     "turned.",
     {{"28 discs slosh round the dish and drift with the swirl: the arc grows to the left.",
       "Discs that reach the wall ride up with it on the left, come off at the top and cross "
       "over."},
      {"48 discs creep against the swirl: the arc grows to the right.",
       "Most discs are pinned (orange), in layers against the wall that carries them clockwise."}}},
    {"No disc friction",
     0.0,
     1.0,
     Coloring::spin,
     Coloring::spin,
     "The wall spins up the discs that touch it, and nothing but their exchange hands the spin on.",
     {{"Colours show the spin: all have met the wall, and each whirls for itself.",
       "They fill the dish like a gas that is pushed down towards M."},
      {"As many discs as counterrotate with all friction: here they go round with the swirl.",
       "Discs at the wall whirl, those within hardly do: no friction hands the spin on."}}},
    {"No wall friction",
     1.0,
     0.0,
     Coloring::id,
     Coloring::speed,
     "Nothing drags the discs along the wall, so the cluster turns exactly as fast as the swirl.",
     {{"The cluster sloshes as one body and turns once a swirl.",
       "Seen from the M-frame it rests on the wall, like sand that has settled."},
      {"More discs make no difference: one turn a swirl.",
       "At rest, almost: the scale of colours ends at the speed of the wall."}}}};

constexpr System minimal_model{
    "Minimal model",
    0.0,
    0.0,
    Coloring::none,
    Coloring::none,
    "One rigid ball as large as half the dish, pressed against the wall.",
    {{"It rolls without slip, like a gear inside a ring, and turns against the swirl.",
      "The wall turns clockwise and takes the ball along."},
     {"It slips freely and keeps one side at M, so it turns once a swirl.",
      "The wall slides past, and the ball stays as it is."}}};

std::string lower(std::string text) {
    for (char& c : text) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
    return text;
}

PaperMovie video_of(const System& system, int version, Frame frame,
                    const PaperMoviesSettings& settings) {
    const bool lab = frame == Frame::lab, model = &system == &minimal_model;
    const std::string place = lab ? "lab-frame" : "m-frame";
    PaperMovie video;
    video.system = system.title;
    video.what_to_see = system.lines[version][lab ? 0 : 1];
    MovieConfig& config = video.config;
    if (model) {
        video.model = RollingBall{.slip = version == 0 ? 1.0 : 0.0};
        video.caption = version == 0 ? "No slip, s = 1" : "Slip, s = 0";
        video.name = "minimal-model-" + place + (version == 0 ? "-no-slip" : "-slip");
        config.sources = {rolling(*video.model, paper_amplitude, paper_period)};
        config.start = 0.0;
    } else {
        const RunConfig run =
            filmed_run(version == 0 ? 28 : 48, system.mu_disc, system.mu_wall, settings.seed);
        video.caption = fmt::format("N = {}", run.discs);
        video.name = "numerical-" + place + "-" + lower(system.title) +
                     (version == 0 ? "-rotating" : "-counterrotating");
        config.sources = {simulated(run)};
        config.start = static_cast<double>(default_warmup);
        video.settings["run"] = config_json(run);
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
        fmt::format("{}, {}", system.title, model ? config.sources[0].caption : video.caption);
    config.out = (settings.out / (video.name + ".mp4")).string();
    video.settings["quick"] = settings.quick;
    return video;
}

/// In the order of the page.
std::vector<PaperMovie> all_videos(const PaperMoviesSettings& settings) {
    std::vector<PaperMovie> videos;
    const auto add = [&](const System& system) {
        for (const int version : {0, 1})
            for (const Frame frame : {Frame::lab, Frame::m})
                videos.push_back(video_of(system, version, frame, settings));
    };
    for (const System& system : systems) add(system);
    add(minimal_model);
    return videos;
}

std::string movie_key(const PaperMovie& video) { return "movie-" + video.name; }

/// The rotation that was found in it, if an earlier call has made this very movie.
std::optional<double> finished_before(const PaperParts& parts, const PaperMovie& video) {
    const auto part = parts.recall(movie_key(video));
    if (!part) return {};
    const Json& result = (*part)["result"];
    std::error_code missing;
    const auto bytes = fs::file_size(video.config.out, missing);
    if (missing || result.value("bytes", std::uintmax_t(0)) != bytes ||
        result.value("movie", Json()) != video.settings)
        return {};
    return result.value("rotation", 0.0);
}

/// ϖ/Ω over the swirls shown, by time.
double rotation_in(const PaperMovie& video) {
    if (video.model) return video.model->rotation();
    const MovieConfig& movie = video.config;
    const FrameSource& source = movie.sources.front();
    const double start = movie.start, periods = movie.frames * movie.pace / movie.frames_per_second;
    constexpr int samples = 64;  // per swirl
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
induces the transition between rotation and counterrotation in swirled granular media”, computed
anew. The dish is swirled counter-clockwise and never turns itself: its marks stand still in the lab
frame. The M-frame turns with the swirl, so that the point M stays at the bottom and the wall turns
clockwise. ϖ is the cluster’s rotation in the lab frame, measured over the swirls shown; Ω is that of
the swirl.</p>
)";

/// A row plays in step, and only while it can be seen: sixteen movies at once are too many for some
/// machines.
constexpr const char* page_end = R"(<script>
const step = (row, play) => {
  const videos = [...row.querySelectorAll("video")];
  for (const v of videos) {
    v.currentTime = videos[0].currentTime;
    if (play) v.play().catch(() => {}); else v.pause();
  }
};
const seen = new IntersectionObserver(
  (rows) => rows.forEach((r) => step(r.target, r.isIntersecting)), { threshold: 0.25 });
document.querySelectorAll(".row").forEach((row) => seen.observe(row));
</script>
</body>
</html>
)";

std::string figure_of(const PaperMovie& video, double rotation) {
    const bool lab = video.config.appearance.frames.front() == Frame::lab;
    return fmt::format(
        "<figure><video src=\"{}.mp4\" preload=\"auto\" loop muted playsinline controls></video>\n"
        "<figcaption><b>{}, {}</b> <span>ϖ/Ω = {}</span><br>{}</figcaption></figure>\n",
        video.name, video.caption, lab ? "lab frame" : "M-frame", signed_number(rotation),
        video.what_to_see);
}

std::string page_of(const std::vector<PaperMovie>& videos, const std::vector<double>& rotations) {
    std::string page = page_head, open;
    for (std::size_t k = 0; k < videos.size(); ++k) {
        if (videos[k].system != open) {
            if (!open.empty()) page += "</div>\n</section>\n";
            open = videos[k].system;
            const auto* const found =
                std::find_if(std::begin(systems), std::end(systems),
                             [&](const System& s) { return open == s.title; });
            page += fmt::format("<section>\n<h2>{}</h2>\n<p>{}</p>\n<div class=\"row\">\n", open,
                                (found == std::end(systems) ? minimal_model : *found).what_to_see);
        }
        page += figure_of(videos[k], rotations[k]);
    }
    return page + "</div>\n</section>\n" + page_end;
}

}  // namespace

PaperMovies make_paper_movies(const PaperMoviesSettings& settings,
                              const PaperMoviesControl& control) {
    const std::vector<PaperMovie> videos = all_videos(settings);
    const PaperParts parts(settings.out);
    PaperMovies made;
    std::vector<double> rotations;
    for (const PaperMovie& video : videos) {
        if (const auto known = finished_before(parts, video)) {
            rotations.push_back(*known);
            ++made.remembered;
        } else {
            const auto begin = std::chrono::steady_clock::now();
            MovieControl movie_control;
            movie_control.stop = control.stop;
            movie_control.progress = [&](int done, int of) {
                if (!control.progress) return;
                const auto whole = static_cast<double>(rotations.size());
                control.progress((whole + double(done) / of) / double(videos.size()), video.name);
            };
            const MovieResult result = make_movie(video.config, movie_control);
            if (!result.complete) {
                if (result.frames > 0) fs::remove(video.config.out);
                throw Interrupted(
                    fmt::format("Stopped after {} of {} movies; the same call makes the others.",
                                rotations.size(), videos.size()));
            }
            rotations.push_back(rotation_in(video));
            parts.remember(
                movie_key(video),
                {{"movie", video.settings},
                 {"bytes", fs::file_size(video.config.out)},
                 {"rotation", rotations.back()}},
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        made.files.emplace_back(video.config.out);
    }
    const fs::path page = settings.out / "movies.html";
    write_file_atomically(page, page_of(videos, rotations));
    made.files.push_back(page);
    return made;
}

}  // namespace swirl
