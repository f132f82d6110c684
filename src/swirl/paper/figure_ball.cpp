// The minimal model, simulated: the spin of one disc in the swirled container, nearly as large as
// the container. γ = |ϖ_M|/Ω, where ϖ_M is its spin minus Ω; rolling without slip is γ_c =
// R_container/R_ball (physics/rolling_ball.hpp).
//
// The ball is a solid disc, without the paper's friction between discs. Its bounces on the wall are
// elastic as in the paper, or lose half of the normal velocity, after which it stays at the wall.
#include <fmt/format.h>

#include <cmath>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/physics/rolling_ball.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/statistics/circular_mean.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

struct Ball {
    double radius, mu, restitution;
};

RunConfig ball_run(const PaperSettings& settings, const Ball& ball) {
    RunConfig config;
    config.discs = 1;
    config.radius = ball.radius;
    config.inertia = solid_inertia(config.mass, ball.radius);
    config.mu_disc = config.mu_wall = ball.mu;
    config.restitution = ball.restitution;
    config.warmup = settings.periods(200, 5);
    config.periods = *config.warmup + settings.periods(300, 5);
    return config;
}

struct BallAverages {
    Estimate gamma, theta;
};

/// Averages of one run over the periods after the warm-up: γ from the spin, and the direction of
/// the ball about C in the M-frame, in degrees.
BallAverages ball_averages(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    SampleTimes times = run.sample_times(64);
    BlockMean gamma;
    CircularMean direction;
    while (run.next_event()) {
        const bool counts = run.event().periods >= *config.warmup;
        while (run.next_sample(times)) {
            if (!counts) continue;
            gamma.add(1.0 - run.snapshot().spin.front() / config.omega());
            direction.add(MFrameView(run.snapshot()).position(0));
        }
        run.pass_event();
        if (!counts || run.snapshot().periods == run.event().periods) continue;
        gamma.close_block();
        direction.close_block();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return {gamma.estimate(), scaled(direction.angle(), degrees_per_radian)};
}

Json ball_result(const RunConfig& config, int seeds, const RunControl& control) {
    std::vector<Estimate> gammas, thetas;
    for (int s = 0; s < seeds; ++s) {
        RunConfig seeded = config;
        seeded.seed += static_cast<std::uint64_t>(s);
        const BallAverages found = ball_averages(seeded, control);
        gammas.push_back(found.gamma);
        thetas.push_back(found.theta);
    }
    const Ensemble all = ensemble(gammas);
    const Estimate theta = several_directions(thetas).estimate;
    return Json{{"mean", all.estimate.mean},
                {"error", all.estimate.error},
                {"scatter", all.scatter},
                {"theta", {{"mean", theta.mean}, {"error", theta.error}}}};
}

PaperTask task_of(const PaperSettings& settings, const Ball& ball) {
    constexpr double events_per_period = 100.0;
    const RunConfig config = ball_run(settings, ball);
    const int seeds = settings.seeds();
    return {
        fmt::format("ball_R{}_mu{}_e{}_{}of{}periods_{}seeds_seed{}", ball.radius, ball.mu,
                    ball.restitution, *config.warmup, *config.periods, seeds, config.seed),
        events_per_period * static_cast<double>(*config.periods * seeds),
        [config, seeds](const RunControl& control) { return ball_result(config, seeds, control); }};
}

}  // namespace

static FigurePlan plan_figure_ball(const PaperSettings& settings) {
    constexpr double reported_radius = 5.0;
    FigurePlan plan;
    std::vector<Ball> balls;
    for (const double radius : {4.3, 5.0, 7.0})
        for (const double restitution : {0.5, 1.0})
            for (const double mu : {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
                balls.push_back({radius, mu, restitution});
                plan.points.push_back(task_of(settings, balls.back()));
            }
    plan.finish = [balls, seeds = settings.seeds()](const std::vector<Json>& results,
                                                    const fs::path& out) {
        Table table({"ball_radius", "container_radius", "mu", "restitution", "gamma", "gamma_error",
                     "gamma_no_slip", "slip", "slip_error", "theta", "theta_error", "seeds",
                     "scatter"});
        FigureOutcome outcome;
        for (std::size_t k = 0; k < balls.size(); ++k) {
            if (failed(results[k])) continue;
            RollingBall model;
            model.ball_radius = balls[k].radius;
            const double no_slip = model.gamma_no_slip();
            const double gamma = number(results[k]["mean"]), error = number(results[k]["error"]);
            std::vector<Table::Cell> row{balls[k].radius, model.container_radius,
                                         balls[k].mu,     balls[k].restitution,
                                         gamma,           error,
                                         no_slip,         gamma / no_slip,
                                         error / no_slip};
            add_mean(row, at(results[k], {"theta"}));
            row.emplace_back(std::int64_t{seeds});
            row.emplace_back(number(results[k]["scatter"]));
            table.add(std::move(row));
            if (balls[k].radius == reported_radius && (balls[k].mu == 0.0 || balls[k].mu == 1.0))
                outcome.findings.push_back(fmt::format(
                    "A disc of radius {}, μ = {}, e = {}: γ = {} (γ_c = {:.3f}).", balls[k].radius,
                    balls[k].mu, balls[k].restitution, with_error(gamma, error), no_slip));
        }
        outcome.write(table, "ball", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_the_ball() {
    return {{"ball", "the minimal model, simulated: γ of one large disc", plan_figure_ball}};
}

}  // namespace swirl
