#include "app/footage_options.hpp"

#include <fmt/format.h>

#include "app/run_options.hpp"
#include "lab/failure.hpp"

namespace swirl {
namespace {

RollingBall ball_of(const FootageTexts& texts, const RunConfig& container) {
    if (!(*texts.slip >= 0.0 && *texts.slip <= 1.0))
        throw WrongCall(fmt::format(
            "--rolling-ball is {}, but it must be from 0 (slips) to 1 (rolls).", *texts.slip));
    if (!(texts.ball_radius > 0.0 && texts.ball_radius < container.container_radius))
        throw WrongCall(
            fmt::format("--ball-radius is {}, but it must be above 0 and below the container's {}.",
                        texts.ball_radius, container.container_radius));
    RollingBall ball;
    ball.container_radius = container.container_radius;
    ball.ball_radius = texts.ball_radius;
    ball.slip = *texts.slip;
    return ball;
}

}  // namespace

std::shared_ptr<FootageTexts> add_footage_options(CLI::App& subcommand) {
    auto texts = std::make_shared<FootageTexts>();
    const auto group = "What is shown";
    subcommand.add_option("FILE", texts->file, "a recorded trajectory (.h5) instead of a new run")
        ->group(group);
    subcommand
        .add_option("--beside", texts->beside,
                    "a second dish to the left, with N discs and otherwise alike")
        ->type_name("N")
        ->group(group);
    subcommand
        .add_option("--rolling-ball", texts->slip,
                    "the paper's minimal model instead: one rigid ball, slip parameter from 0 "
                    "(slips) to 1 (rolls)")
        ->type_name("S")
        ->group(group);
    subcommand.add_option("--ball-radius", texts->ball_radius, "of that ball [4.3]")
        ->type_name("NUMBER")
        ->group(group);
    texts->parameters = add_run_options(subcommand, {"events", "periods", "warmup"});
    return texts;
}

std::vector<Footage> footage(const FootageTexts& texts) {
    if (!texts.file.empty()) {
        if (!texts.parameters->empty())
            throw WrongCall(
                fmt::format("{} was recorded with parameters of its own: --{} cannot "
                            "change them.",
                            texts.file, texts.parameters->begin()->first));
        if (texts.beside || texts.slip)
            throw WrongCall("A recording stands alone: --beside and --rolling-ball need a run.");
        return {recorded(texts.file)};
    }
    const RunConfig config = resolve(*texts.parameters);
    if (texts.slip && texts.beside)
        throw WrongCall("--rolling-ball and --beside show different things: give one.");
    if (texts.slip) return {rolling(ball_of(texts, config), config.amplitude, config.period)};
    std::vector<Footage> dishes{simulated(config)};
    if (texts.beside) {
        RunConfig other = config;
        other.discs = *texts.beside;
        if (const auto wrong = problem(other)) throw WrongCall(*wrong);
        dishes.insert(dishes.begin(), simulated(other));
    }
    return dishes;
}

}  // namespace swirl
