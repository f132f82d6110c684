#include "track/experiment/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <span>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/math/median.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"
#include "swirl/statistics/few_blocks.hpp"
#include "swirl/statistics/model_comparison.hpp"
#include "swirl/statistics/replicates.hpp"
#include "track/experiment/camera_sampled_run.hpp"
#include "track/experiment/curves.hpp"
#include "track/experiment/result_store.hpp"
#include "track/experiment/seed_ensemble.hpp"

namespace swirl {
namespace {

/// Radii and amplitudes of the same container agree within this share.
constexpr double same_container = 0.02;

const std::vector<std::string>& numbers_against_n() {
    static const auto parts = split(
        "slip.cluster_perimeter,slip.pancake,slip.cluster,slip.pinned_region,"
        "slip.resident=slip_resident,frustration.wall_spin,frustration.pinned_wall_spin,"
        "frustration.resident_spin,frustration.spin_correlation,frustration.triangles,"
        "centre.distance=centre_distance,centre.theta=centre_theta,order.all=psi6,"
        "temperature.granular,pinned.share=pinned_share,residence.share=residence_share",
        ",");
    static const std::vector<std::string> names(parts.begin(), parts.end());
    return names;
}

double of_camera(const ContainerVideo& video, const char* name) {
    return number(at(video.found, {"camera", name}));
}
std::int64_t discs_of(const ContainerVideo& video) {
    const Json& discs = at(video.found, {"discs"});
    return discs.is_number_integer() ? discs.get<std::int64_t>() : 0;
}
double frames_per_period(const ContainerVideo& video) {
    return 2.0 * pi / of_camera(video, "omega") * of_camera(video, "camera-fps");
}
double position_error(const ContainerVideo& video) {
    const double error = number(at(video.found, {"quality", "position_error"}));
    return std::isfinite(error) ? error : 0.0;
}
const char* kind_of(bool smooth) { return smooth ? "smooth" : "rough"; }

/// One simulation. Its result is stored in OUT/parts/KEY.json.
struct Task {
    std::string key;
    std::function<Json(const RunControl&)> work;
};

/// The simulation for one or several videos.
struct Counterpart {
    bool smooth;
    RunConfig config;
    CameraSampling sampling;
    std::vector<Task> runs;
    Json result = nullptr;
};

class Experiment {
  public:
    Experiment(const std::vector<ContainerVideo>& videos, const ExperimentSettings& settings)
        : videos_(videos), settings_(settings) {
        if (settings.simulate)
            for (std::size_t k = 0; k < videos.size(); ++k)
                if (videos[k].good()) add_counterpart(k);
    }

    void simulate(const ExperimentControl& control, ExperimentResult& result);
    std::vector<fs::path> write_tables() const;
    std::vector<std::string> findings() const;
    Json json() const;

  private:
    /// The values of the good videos, or of those but one.
    std::vector<double> values_of(const char* name, const ContainerVideo* without = nullptr) const {
        std::vector<double> values;
        for (const ContainerVideo& video : videos_)
            if (video.good() && &video != without) values.push_back(of_camera(video, name));
        return values;
    }
    /// What a video is compared with: the median of all videos, or the other one of two, of which
    /// neither is the odd one.
    double reference(const ContainerVideo& video, const char* name) const {
        const std::vector<double> all = values_of(name);
        return median(all.size() == 2 ? values_of(name, &video) : all);
    }
    bool is_odd(const ContainerVideo& video, const char* name) const {
        const double usual = reference(video, name);
        return std::abs(of_camera(video, name) - usual) > same_container * usual;
    }
    /// The median of all videos, if this video agrees with the others: they show the same
    /// container.
    double shared(const ContainerVideo& video, const char* name) const {
        return is_odd(video, name) ? of_camera(video, name) : median(values_of(name));
    }
    void add_counterpart(std::size_t video);
    const Json& simulated(std::size_t video) const {
        static const Json nothing;
        const auto found = counterpart_of_.find(video);
        return found == counterpart_of_.end() ? nothing : counterparts_[found->second].result;
    }
    template <class Visit>
    void each_side(Visit&& visit) const;
    std::vector<NamedCurve> curves() const;

    fs::path written(const Table& table, const std::string& name) const {
        table.write(settings_.out / (name + ".csv"));
        return settings_.out / (name + ".csv");
    }
    fs::path write_videos() const;
    fs::path write_points() const;
    fs::path write_profiles() const;
    fs::path write_maps(std::size_t video) const;
    void add_video_findings(const ContainerVideo& video, const Json& simulated,
                            std::vector<std::string>& findings) const;

    const std::vector<ContainerVideo>& videos_;
    const ExperimentSettings& settings_;
    std::vector<Counterpart> counterparts_;
    std::map<std::size_t, std::size_t> counterpart_of_;
};

/// The configuration of a video, overridden by the parameters in the settings.
RunConfig config_of(const ContainerVideo& video, const ExperimentSettings& settings, double radius,
                    double amplitude) {
    ParameterTexts texts{{"events", "5e5"}, {"path", "circle"}};
    texts = overridden(texts, settings.parameters);
    texts["discs"] = std::to_string(discs_of(video));
    if (!texts.contains("container_radius"))
        texts["container_radius"] = fmt::format("{:.4f}", radius);
    if (!texts.contains("amplitude")) texts["amplitude"] = fmt::format("{:.4f}", amplitude);
    if (!texts.contains("period") && !texts.contains("speed")) texts["speed"] = "1";
    if (const Json& species = at(video.found, {"species"});
        species.is_array() && species.size() == 2) {
        // The radius of the more frequent species is the unit of length.
        const bool first = number(species[0]["number"]) >= number(species[1]["number"]);
        const Json &unit = species[first ? 0 : 1], &other = species[first ? 1 : 0];
        texts["mixture"] = fmt::format("{}:{:.4f}", other["number"].get<std::int64_t>(),
                                       number(other["radius"]) / number(unit["radius"]));
    }
    if (video.smooth) {
        texts.erase("mu_disc");
        texts.erase("mu_wall");
        texts["mu"] = settings.smooth_mu;
    }
    return resolve(texts);
}

void Experiment::add_counterpart(std::size_t k) {
    const ContainerVideo& video = videos_[k];
    Counterpart made{
        video.smooth,
        config_of(video, settings_, shared(video, "container-radius"), shared(video, "amplitude")),
        {},
        {}};
    made.sampling.frames_per_period = std::max(4, int(std::lround(frames_per_period(video))));
    made.sampling.position_error =
        std::round(1e4 * position_error(video) / of_camera(video, "scale")) * 1e-4;
    const std::string what =
        fmt::format("{} {} {}", config_text(made.config), made.sampling.frames_per_period,
                    made.sampling.position_error);
    const std::string key = fmt::format("seen_{}_N{}_{:016x}", kind_of(video.smooth),
                                        made.config.discs, checksum(what));
    for (std::size_t c = 0; c < counterparts_.size(); ++c)
        if (counterparts_[c].runs.front().key.starts_with(key)) {
            counterpart_of_[k] = c;
            return;
        }
    for (int seed = 0; seed < settings_.seeds; ++seed) {
        RunConfig config = made.config;
        config.seed += static_cast<std::uint64_t>(seed);
        made.runs.push_back({fmt::format("{}_seed{}", key, config.seed),
                             [config, sampling = made.sampling](const RunControl& control) {
                                 return camera_sampled_run(config, sampling,
                                                           measurements_of_a_video(), control);
                             }});
    }
    counterpart_of_[k] = counterparts_.size();
    counterparts_.push_back(std::move(made));
}

void Experiment::simulate(const ExperimentControl& control, ExperimentResult& result) {
    const ResultStore store(settings_.out);
    std::vector<const Task*> left;
    std::map<std::string, Json> done;
    for (const Counterpart& c : counterparts_)
        for (const Task& task : c.runs) {
            ++result.runs;
            if (auto part = store.find(task.key)) {
                done[task.key] = (*part)["result"];
                ++result.remembered;
            } else {
                left.push_back(&task);
            }
        }
    std::mutex mutex;
    std::vector<double> shares(left.size(), 0.0);
    parallel_for(
        left.size(),
        [&](std::size_t k) {
            RunControl inner;
            inner.stop = control.stop;
            inner.progress = [&](const RunProgress& p) {
                const std::lock_guard lock(mutex);
                shares[k] = p.fraction;
                double sum = 0.0;
                for (const double share : shares) sum += share;
                if (control.progress) control.progress(sum / double(shares.size()));
            };
            Json found;
            const auto begin = std::chrono::steady_clock::now();
            try {
                found = left[k]->work(inner);
                const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
                store.store(left[k]->key, found, took.count());
            } catch (const Failure& failure) {
                found = {{"failed", failure.what()}};
            }
            const std::lock_guard lock(mutex);
            shares[k] = 1.0;
            done[left[k]->key] = std::move(found);
        },
        control.threads);
    for (Counterpart& c : counterparts_) {
        std::vector<Json> seeds;
        for (const Task& task : c.runs) seeds.push_back(done.at(task.key));
        c.result = seed_ensemble(seeds);
    }
}

/// Calls visit(source, surface, name, discs, result) for every video and every simulation.
template <class Visit>
void Experiment::each_side(Visit&& visit) const {
    for (const ContainerVideo& video : videos_)
        if (video.good())
            visit("video", kind_of(video.smooth), video.name, discs_of(video), video.result);
    for (const Counterpart& c : counterparts_)
        if (!c.result.is_null() && !failed(c.result))
            visit("simulation", kind_of(c.smooth), std::string(), c.config.discs, c.result);
}

/// ϖ(N) of videos and of simulations. Videos with the same N and surface are averaged.
std::vector<NamedCurve> Experiment::curves() const {
    std::map<std::string, std::map<std::int64_t, std::vector<const Json*>>> points;
    each_side([&](const char* source, const char* kind, const std::string&, std::int64_t discs,
                  const Json& result) {
        points[fmt::format("{} {}", source, kind)][discs].push_back(&result);
    });
    std::vector<NamedCurve> all;
    for (const auto& [name, by_number] : points) {
        all.push_back({name});
        for (const auto& [discs, results] : by_number)
            for (std::size_t k = 0; k < rotation_rates.size(); ++k) {
                std::vector<Estimate> estimates;
                for (const Json* r : results) {
                    const RotationPoint p =
                        rotation_point(double(discs), *r, rotation_rates[k].name);
                    estimates.push_back({.mean = p.mean, .error = p.error});
                }
                const Estimate e = estimates.size() == 1
                                       ? estimates.front()
                                       : ensemble(estimates, std::span<const double>()).estimate;
                all.back().curves[k].push_back({double(discs), e.mean, e.error});
            }
    }
    return all;
}

fs::path Experiment::write_videos() const {
    Table table(
        joined({"video", "surface", "discs", "frames", "periods", "frames_per_period", "radius",
                "container_radius", "amplitude", "omega", "omega_error", "complete_share"},
               {"position_error", "mean_by_time", "mean_by_time_error", "rigid_by_time",
                "rigid_by_time_error", "simulated", "simulated_error", "failed"}));
    for (std::size_t k = 0; k < videos_.size(); ++k) {
        const ContainerVideo& video = videos_[k];
        std::vector<Table::Cell> row{video.name, std::string(kind_of(video.smooth))};
        for (const char* name : {"discs", "frames"})
            row.emplace_back(whole(at(video.found, {name})));
        row.emplace_back(number(at(video.result, {"periods"})));
        row.emplace_back(frames_per_period(video));
        for (const char* name : {"scale", "container-radius", "amplitude"})
            row.emplace_back(of_camera(video, name));
        for (const auto& [part, name] :
             {std::pair("path", "omega"), std::pair("path", "omega_error"),
              std::pair("quality", "complete_share"), std::pair("quality", "position_error")})
            row.emplace_back(number(at(video.found, {part, name})));
        for (const auto& [result, which] :
             {std::pair(&video.result, "mean_by_time"), std::pair(&video.result, "rigid_by_time"),
              std::pair(&simulated(k), "mean_by_time")})
            for (const char* what : {"mean", "error"})
                row.emplace_back(number(at(*result, {"rotation", which, what})));
        row.emplace_back(video.good() ? std::string() : video.result["failed"].get<std::string>());
        table.add(std::move(row));
    }
    return written(table, "videos");
}

fs::path Experiment::write_points() const {
    Table table(joined(joined({"source", "surface", "video", "discs", "mean_by_time",
                               "mean_by_time_error", "rigid_by_time", "rigid_by_time_error"},
                              number_columns(numbers_against_n())),
                       {"steady_state"}));
    each_side([&](const char* source, const char* kind, const std::string& name, std::int64_t discs,
                  const Json& result) {
        std::vector<Table::Cell> row{std::string(source), std::string(kind), name, discs};
        for (const char* which : {"mean_by_time", "rigid_by_time"})
            for (const char* what : {"mean", "error"})
                row.emplace_back(number(at(result, {"rotation", which, what})));
        add_numbers(row, numbers_against_n(), result);
        // The steady state of a video is not tested.
        row.emplace_back(source == std::string("video") ? "steady" : steadiness(result));
        table.add(std::move(row));
    });
    return written(table, "points");
}

fs::path Experiment::write_profiles() const {
    const std::vector<std::string> columns{
        "theta",      "visits",           "varpi_m", "varpi_m_error", "wall",
        "normalised", "normalised_error", "speed",   "speed_error"};
    Table table(joined({"source", "surface", "video", "discs"}, columns));
    each_side([&](const char* source, const char* kind, const std::string& name, std::int64_t discs,
                  const Json& result) {
        const Json& profile = at(result, {"measured", "profile"});
        if (!profile.is_object()) return;
        for (std::size_t r = 0; r < profile["theta"].size(); ++r) {
            std::vector<Table::Cell> row{std::string(source), std::string(kind), name, discs};
            for (const std::string& column : columns)
                row.emplace_back(number(at(profile, {column})[r]));
            table.add(std::move(row));
        }
    });
    return written(table, "profiles");
}

fs::path Experiment::write_maps(std::size_t k) const {
    Table table({"source", "map", "discs", "x", "y", "density", "u_x", "u_y", "visits"});
    const auto add = [&](const char* source, std::int64_t discs, const Json& result) {
        const Json &density = at(result, {"measured", "density"}),
                   &flow = at(result, {"measured", "flow"});
        if (!density.is_object() || !flow.is_object()) return;
        for (std::size_t r = 0; r < density["x"].size(); ++r)
            table.add({std::string(source), std::string("density"), discs, number(density["x"][r]),
                       number(density["y"][r]), number(density["by_time"][r]), not_available,
                       not_available, not_available});
        for (std::size_t r = 0; r < flow["x"].size(); ++r)
            table.add({std::string(source), std::string("flow"), discs, number(flow["x"][r]),
                       number(flow["y"][r]), not_available, number(flow["u_x"][r]),
                       number(flow["u_y"][r]), number(flow["visits"][r])});
    };
    add("video", discs_of(videos_[k]), videos_[k].result);
    add("simulation", discs_of(videos_[k]), simulated(k));
    return written(table, "maps_" + videos_[k].name);
}

std::vector<fs::path> Experiment::write_tables() const {
    std::vector<fs::path> files{write_videos(), write_points(), write_profiles()};
    for (std::size_t k = 0; k < videos_.size(); ++k)
        if (videos_[k].good()) files.push_back(write_maps(k));
    files.push_back(settings_.out / "crossings.csv");
    write_crossings(curves(), files.back());
    return files;
}

void Experiment::add_video_findings(const ContainerVideo& video, const Json& simulation,
                                    std::vector<std::string>& findings) const {
    if (!video.good()) {
        findings.push_back(fmt::format("{} could not be used: {}", video.name,
                                       video.result["failed"].get<std::string>()));
        return;
    }
    const RotationPoint seen =
        rotation_point(double(discs_of(video)), video.result, "mean_by_time");
    std::string text = fmt::format("{}: {}, ϖ/Ω = {} by time", video.name,
                                   counted(std::int64_t(discs_of(video)), "disc"),
                                   with_error(seen.mean, seen.error));
    if (failed(simulation)) {
        text += fmt::format("; its simulation failed: {}", simulation["failed"].get<std::string>());
    } else if (simulation.is_object()) {
        const RotationPoint run = rotation_point(0.0, simulation, "mean_by_time");
        text += fmt::format("; simulated {}", with_error(run.mean, run.error));
        const double error = std::hypot(seen.error, run.error);
        if (error > 0.0)
            text += fmt::format(", {:.1f} standard errors apart",
                                std::abs(seen.mean - run.mean) / error);
    }
    findings.push_back(text + ".");
    if (std::isnan(seen.error))
        findings.push_back(fmt::format(
            "{} shows {:.1f} periods, too few for an error, so it is not compared with the "
            "simulation: {} are needed, and twenty make the error reliable.",
            video.name, number(at(video.result, {"periods"})), min_blocks_of_an_error));
    for (const char* name : {"container-radius", "amplitude"}) {
        if (is_odd(video, name))
            findings.push_back(fmt::format(
                "The {} of {} is {:.3f} disc radii, but {} {:.3f}: a different container, or "
                "different discs. Its simulation uses its own value.",
                name[0] == 'c' ? "container radius" : "amplitude", video.name,
                of_camera(video, name),
                values_of(name).size() == 2 ? "that of the other video is"
                                            : "the median of all videos is",
                reference(video, name)));
    }
}

/// The points of a curve that have an error; none if there is no such curve.
std::vector<RotationPoint> points_with_error(const std::vector<NamedCurve>& curves,
                                             const std::string& name) {
    std::vector<RotationPoint> found;
    for (const NamedCurve& curve : curves)
        if (curve.name == name)
            std::copy_if(curve.points().begin(), curve.points().end(), std::back_inserter(found),
                         [](const RotationPoint& p) { return p.error > 0.0; });
    return found;
}

/// χ² of the videos of one surface next to its simulations, as `swirl sweep --my-points` has it;
/// empty without points that can be compared.
std::string agreement_sentence(const std::vector<NamedCurve>& curves, const std::string& surface) {
    const ModelCurve model{.points = points_with_error(curves, "simulation " + surface)};
    const std::vector<RotationPoint> seen = points_with_error(curves, "video " + surface);
    const std::vector<RotationPoint> compared = comparable_points(std::span(&model, 1), seen);
    if (compared.empty()) return "";
    return fmt::format("{} videos next to their simulations: χ² = {:.3g} of {}.", surface,
                       chi_square_of(model, compared),
                       counted(std::int64_t(compared.size()), "point"));
}

std::vector<std::string> Experiment::findings() const {
    std::vector<std::string> findings;
    const std::vector<NamedCurve> all = curves();
    for (const NamedCurve& curve : all) {
        if (curve.points().size() < 2) {
            findings.push_back(
                fmt::format("{}: there is only one number of discs; finding the transition to "
                            "counterrotation needs videos with several.",
                            curve.name));
            continue;
        }
        const bool crosses = find_crossing(curve.points()).verdict == Crossing::Verdict::crosses;
        findings.push_back(fmt::format(
            "{}: {}ϖ by time {}", curve.name,
            crosses ? "" : "no crossing is found with these numbers of discs and errors: ",
            crossing_sentence(curve)));
    }
    for (const bool smooth : {false, true})
        if (const std::string text = agreement_sentence(all, kind_of(smooth)); !text.empty())
            findings.push_back(text);
    for (std::size_t k = 0; k < videos_.size(); ++k)
        add_video_findings(videos_[k], simulated(k), findings);
    const bool spins = std::any_of(videos_.begin(), videos_.end(), [](const ContainerVideo& video) {
        return std::isfinite(
            number(at(video.result, {"measured", "frustration", "wall_spin", "mean"})));
    });
    if (!spins)
        findings.push_back(
            "No video has the spins of its discs, so Figure 4b shows only the simulation. --spin "
            "measures spins if the discs have a texture.");
    if (std::none_of(videos_.begin(), videos_.end(),
                     [](const ContainerVideo& f) { return f.smooth; }))
        findings.push_back(
            "All videos have discs of the same roughness, so there is no Figure 4c. --smooth-discs "
            "takes "
            "videos of smoother discs.");
    findings.push_back(
        "Quantities of single collisions (rates, impulses, sticking, energy) cannot be measured in "
        "a video: discs collide more often than once per frame.");
    return findings;
}

Json Experiment::json() const {
    Json videos = Json::array();
    for (std::size_t k = 0; k < videos_.size(); ++k) {
        const ContainerVideo& video = videos_[k];
        Json images = Json::array();
        for (const fs::path& image : video.images) images.push_back(image.string());
        videos.push_back({{"name", video.name},
                          {"surface", kind_of(video.smooth)},
                          {"video", video.video},
                          {"result", video.result},
                          {"simulation", simulated(k)},
                          {"found", video.found},
                          {"remarks", video.remarks},
                          {"images", images}});
    }
    return {{"command", settings_.command}, {"version", version()},
            {"build", build_description()}, {"seeds", settings_.seeds},
            {"findings", findings()},       {"videos", videos}};
}

}  // namespace

const std::vector<std::string>& measurements_of_a_video() {
    static const std::vector<std::string> names{"density",     "flow",   "profile", "pinned",
                                                "residence",   "centre", "slip",    "frustration",
                                                "temperature", "order"};
    return names;
}

void check(const ExperimentSettings& settings) {
    if (settings.seeds < 1)
        throw UsageError(
            fmt::format("--replicates is {}, but it must be at least 1.", settings.seeds));
    resolve(settings.parameters);
    resolve({{"mu", settings.smooth_mu}});
}

ExperimentResult make_experiment(const std::vector<ContainerVideo>& videos,
                                 const ExperimentSettings& settings,
                                 const ExperimentControl& control) {
    ExperimentResult result;
    Experiment experiment(videos, settings);
    if (settings.simulate) experiment.simulate(control, result);
    result.files = experiment.write_tables();
    result.findings = experiment.findings();
    result.json = experiment.json();
    result.json["runs"] = result.runs;
    const fs::path about = settings.out / "experiment.json";
    write_file_atomically(about, result.json.dump(2) + "\n");
    result.files.push_back(about);
    run_python_script("experiment", {settings.out.string()}, control.stop);
    for (const fs::directory_entry& entry : fs::directory_iterator(settings.out))
        if (entry.path().filename().string().starts_with("figure_"))
            result.files.push_back(entry.path());
    result.files.push_back(settings.out / "report.html");
    return result;
}

}  // namespace swirl
