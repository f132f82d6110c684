// Error rates of the steady-state tests (statistics/steady_state.hpp) on recorded series: false
// alarms in steady runs, and the fraction of planted jumps, drifts and mixtures that they find. The
// test prints the tables of docs/explanation/statistics.md.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {
namespace {

/// True if a test found a change.
bool has_changed(const SteadyState& state) {
    return state.verdict != SteadyState::Verdict::steady &&
           state.verdict != SteadyState::Verdict::too_short;
}

using Series = std::vector<double>;

struct Setting {
    std::int64_t discs;
    double mu;
};

/// ϖ by event, period by period (or block by block), of runs of the paper's length.
std::vector<Series> recorded(const Setting& setting, std::size_t seeds) {
    std::vector<Series> all(seeds);
    parallel_for(seeds, [&](std::size_t k) {
        RunConfig config;
        config.discs = setting.discs;
        config.mu_disc = config.mu_wall = setting.mu;
        config.warmup = 50;
        config.seed = 1000 + k;
        CoreRun run(config, make_initial_state(config, nullptr));
        for (;;) {
            if (run.is_check_due() && (run.complete() || run.problem())) break;
            run.execute_event();
            run.pass_event();
        }
        all[k] = run.rotation_after_warmup().mean_by_event().block_means();
    });
    return all;
}

/// A shape that is added to a series, as a function of the elapsed fraction, with maximum 1.
struct Planted {
    const char* name;
    std::function<double(double share)> shape;
};

const std::vector<Planted> plants{
    {"jump at 10 %", [](double share) { return share < 0.1 ? 1.0 : 0.0; }},
    {"jump at 25 %", [](double share) { return share < 0.25 ? 1.0 : 0.0; }},
    {"jump at 50 %", [](double share) { return share < 0.5 ? 1.0 : 0.0; }},
    {"jump at 90 %", [](double share) { return share < 0.9 ? 1.0 : 0.0; }},
    {"straight line", [](double share) { return share; }},
    {"exp(−10 t)", [](double share) { return std::exp(-10.0 * share); }},
    {"excursion, 30 to 50 %", [](double share) { return share > 0.3 && share < 0.5 ? 1.0 : 0.0; }},
    {"mixture, 5 visits", [](double share) { return int(5.0 * share) % 2 == 0 ? 1.0 : 0.0; }},
    {"mixture, 16 visits", [](double share) { return int(16.0 * share) % 2 == 0 ? 1.0 : 0.0; }}};

/// The number of series with a verdict of a change if `size` standard errors of the mean are
/// planted.
int count_found(const std::vector<Series>& all, const Planted& plant, double size) {
    int count = 0;
    for (Series series : all) {
        const double error = estimate_of(series).error, n = double(series.size());
        for (std::size_t b = 0; b < series.size(); ++b)
            series[b] += size * error * plant.shape((double(b) + 0.5) / n);
        count += has_changed(find_steady_state(series)) ? 1 : 0;
    }
    return count;
}

// The rates of false_alarm_rate(), for autoregressive series of 50 to 2000 blocks with a memory of
// 0 to 0.95 of the previous block.
TEST(SteadyStateCalibration, Slow_FalseAlarmRateIsAsStated) {
    struct Bin {
        double minimum;
        int series = 0, alarms = 0;
        double stated = 0.0;
    };
    std::vector<Bin> bins{{0.0}, {20.0}, {50.0}, {100.0}, {500.0}};
    for (const double memory : {0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95})
        for (const std::size_t blocks : {50u, 75u, 100u, 150u, 300u, 600u, 1000u, 2000u}) {
            Random random(blocks + static_cast<std::uint64_t>(100.0 * memory));
            for (std::size_t k = 0; k < 300 + 300'000 / std::max<std::size_t>(blocks, 100); ++k) {
                Series series(blocks);
                double value = deviate(random) / std::sqrt(1.0 - memory * memory);
                for (double& block : series) block = value = memory * value + deviate(random);
                const SteadyState state = find_steady_state(series);
                Bin* bin = &bins.front();
                for (Bin& b : bins)
                    if (state.change.effective_samples >= b.minimum) bin = &b;
                ++bin->series;
                bin->alarms += has_changed(state) ? 1 : 0;
                bin->stated = std::max(bin->stated, false_alarm_rate(state.change));
            }
        }
    for (const Bin& bin : bins) {
        fmt::print("| {} or more | {} | {:.2f} |\n", bin.minimum, bin.series,
                   100.0 * bin.alarms / bin.series);
        // Three standard deviations of a Poisson count.
        const double expected = bin.stated * bin.series;
        EXPECT_LE(bin.alarms, expected + 3.0 * std::sqrt(expected)) << bin.minimum;
    }
}

TEST(SteadyStateCalibration, Slow_SteadyRecordedRunsAreRecognised) {
    int alarms = 0, runs = 0;
    double largest = 0.0;
    for (const Setting& setting : {Setting{6, 0.1},
                                   {16, 1.0},
                                   {24, 0.1},
                                   {24, 1.0},
                                   {28, 1.0},
                                   {36, 0.5},
                                   {40, 1.0},
                                   {44, 0.1},
                                   {48, 1.0}}) {
        int alarms_here = 0;
        for (const Series& series : recorded(setting, 48)) {
            const SteadyState state = find_steady_state(series);
            alarms_here += has_changed(state) ? 1 : 0;
            largest = std::max(largest, std::fabs(state.change.size) / state.change.max_size);
            ++runs;
        }
        fmt::print("| {} | {} | {} of 48 |\n", setting.discs, setting.mu, alarms_here);
        alarms += alarms_here;
    }
    fmt::print(
        "{} of {} steady runs are called not steady; the largest change is {:.2f} of its "
        "limit\n",
        alarms, runs, largest);
    // Expected are 0.05 to 0.4 % of 432, about one. Five or more occur by chance in one of 500
    // cases (Poisson with a mean of 0.9, 0.2 %).
    EXPECT_LT(alarms, 5);
}

TEST(SteadyStateCalibration, Slow_PlantedChangesInRecordedRunsAreFound) {
    std::vector<Series> all;
    for (const Setting& setting : {Setting{24, 1.0}, {40, 1.0}, {48, 1.0}, {24, 0.1}})
        for (Series& series : recorded(setting, 25)) all.push_back(std::move(series));
    const std::vector<double> sizes{5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0};
    for (const Planted& plant : plants) {
        std::string row = fmt::format("| {} |", plant.name);
        std::vector<int> shares;
        for (const double size : sizes) shares.push_back(count_found(all, plant, size));
        for (const int share : shares) row += fmt::format(" {} |", share);
        fmt::print("{}\n", row);
        // Larger changes are found more often, with a few exceptions among 100 series.
        for (std::size_t k = 1; k < shares.size(); ++k)
            EXPECT_GE(shares[k], shares[k - 1] - 5) << plant.name;
        // At the largest size, nearly all changes are found for every shape.
        EXPECT_GE(shares.back(), 95) << plant.name;
    }
}

}  // namespace
}  // namespace swirl
