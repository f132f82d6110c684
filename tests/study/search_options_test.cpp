// Any combination of options gives in a search for N_c, a map and a sweep the runs that `swirl run`
// makes of them, or its refusal.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <mutex>
#include <vector>

#include "io/scratch.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/map_plan.hpp"
#include "swirl/study/search_folder.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {
namespace {

using ::testing::Contains;

struct Choice {
    const char* name;
    std::vector<const char*> values;
};
const Choice choices[] = {
    {"mixture",
     {"5:0.8", "45:0.8", "45:0.8:2", "50%:0.8", "12.5%:0.5:3", "1%:0.5", "120%:1", "-5%:1", "%:1"}},
    {"sizes", {"normal:1:0.2", "uniform:0.5:1.2", "list 1 1 0.8", "normal:1:0.5"}},
    {"direction", {"clockwise"}},
    {"body", {"sphere"}},
    {"floor", {"sliding"}},
    {"container_radius", {"4", "6.3", "8.6", "20"}},
    {"radius", {"0.5", "1.1"}},
    {"mass", {"2"}},
    {"path", {"circle", "line", "ellipse:0.5", "ellipse:1"}},
    {"mu_disc", {"0.3"}},
    {"mu_wall", {"0", "0.5"}},
    {"frictionless", {"wall", "bulk"}},
    {"warmup", {"5", "auto", "1000"}},
    {"restitution", {"0.9"}},
    {"ramp", {"restitution=1:0.9@2..9"}},
    {"amplitude", {"0", "2"}},
    {"speed", {"2"}},
    {"inertia", {"solid"}},
    {"cannot_spin", {"0.5", "1"}},
    {"seed", {"7"}}};

/// One to four of them.
ParameterTexts random_options(Random& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random.uniform() * double(n)); };
    ParameterTexts texts{{"events", "20000"}};
    for (std::size_t k = 1 + below(4); k > 0; --k) {
        const Choice& choice = choices[below(std::size(choices))];
        texts[choice.name] = choice.values[below(choice.values.size())];
    }
    return texts;
}

std::string described(const ParameterTexts& texts) {
    std::string words;
    for (const auto& [name, value] : texts) words += fmt::format(" {} {}", name, value);
    return words;
}

/// The configuration as a text, without seed and length, which differ by design.
std::string comparable(RunConfig config) {
    config.seed = 0;
    config.periods.reset();
    config.events = 1;
    return config_text(config);
}

/// What `swirl run` makes of these options for each number of discs, and its refusals.
struct Expected {
    std::map<std::int64_t, std::string> runs;
    std::vector<std::string> refusals;
};

Expected expected_of(ParameterTexts texts, std::int64_t from, std::int64_t to) {
    Expected expected;
    for (std::int64_t n = from; n <= to; ++n) {
        texts["discs"] = std::to_string(n);
        try {
            expected.runs[n] = comparable(resolve(texts));
        } catch (const UsageError& error) {
            expected.refusals.emplace_back(error.what());
        }
    }
    return expected;
}

/// Rotation for few discs and counterrotation for many.
RunResult known_run(const RunConfig& config) {
    RunResult r;
    r.config = config;
    r.complete = true;
    r.periods = double(config.periods.value_or(1000));
    r.events.disc_disc = 1'000'000;
    const double n = double(config.discs);
    const Estimate e{.mean = 0.01 * (25.5 - n), .error = 1e-4};
    r.rotation = {e, e, e, e};
    return r;
}

constexpr const char* without_crossing[] = {"there is no N_c", "needs a steady state",
                                            "a search for N_c varies their number"};

/// The message is one of `swirl run`, or says that there is no N_c.
void expect_refusal(const std::string& message, const Expected& expected,
                    const std::string& options) {
    const bool no_crossing =
        std::any_of(std::begin(without_crossing), std::end(without_crossing),
                    [&](const char* part) { return message.find(part) != message.npos; });
    if (no_crossing) return;
    EXPECT_THAT(expected.refusals, Contains(message)) << options;
}

TEST(SearchOptions, ASearchMakesTheRunsOfItsOptionsOrRefusesThem) {
    Random random(52);
    int searched = 0, refused = 0;
    for (int k = 0; k < 400; ++k) {
        const ParameterTexts texts = random_options(random);
        CrossingSettings settings;
        settings.from = 2 + std::int64_t(random.uniform() * 20.0);
        settings.to = settings.from + 1 + std::int64_t(random.uniform() * 25.0);
        const std::string options =
            fmt::format("{} to {}:{}", settings.from, settings.to, described(texts));
        const Expected expected = expected_of(texts, settings.from, settings.to);
        CrossingControl control;
        std::mutex mutex;
        control.make_run = [&](const RunConfig& config, const RunControl&) {
            const std::lock_guard lock(mutex);
            EXPECT_EQ(comparable(config), expected.runs.at(config.discs)) << options;
            return known_run(config);
        };
        try {
            reject_listed_particles(texts);
            ParameterTexts largest = texts;
            largest["discs"] = std::to_string(settings.to);
            settings.config = resolve(largest);
            const CrossingResult search = search_crossing(settings, control);
            EXPECT_THAT(expected.refusals, testing::IsEmpty()) << options;
            EXPECT_EQ(search.failed(), 0) << options;
            if (settings.from <= 25 && settings.to >= 26) {
                EXPECT_NEAR(search.crossing().discs, 25.5, 0.01) << options;
            }
            ++searched;
        } catch (const UsageError& error) {
            expect_refusal(error.what(), expected, options);
            ++refused;
        }
    }
    EXPECT_GT(searched, 50);
    EXPECT_GT(refused, 50);
}

/// The points of a plan are the runs of `swirl run`; refused ones fail with its message.
void expect_points(const SweepPlan& plan, const Expected& expected, const std::string& options) {
    for (std::size_t point = 0; point < plan.points(); point += std::size_t(plan.replicas)) {
        try {
            const RunConfig config = plan.config(point);
            EXPECT_EQ(comparable(config), expected.runs.at(config.discs)) << options;
        } catch (const UsageError& error) {
            expect_refusal(error.what(), expected, options);
        }
    }
}

TEST(SearchOptions, SweepsAndMapsMakeTheRunsOfTheirOptionsOrRefuseThem) {
    Random random(53);
    int swept = 0, mapped = 0, refused = 0;
    for (int k = 0; k < 400; ++k) {
        ParameterTexts texts = random_options(random);
        const std::int64_t from = 2 + std::int64_t(random.uniform() * 20.0),
                           to = from + 1 + std::int64_t(random.uniform() * 10.0);
        const std::string options = fmt::format("{} to {}:{}", from, to, described(texts));
        const Expected expected = expected_of(texts, from, to);
        try {
            ParameterTexts lists = texts;
            lists["discs"] = fmt::format("{}:{}", from, to);
            expect_points(make_plan(lists, 2), expected, options);
            ++swept;
        } catch (const UsageError& error) {
            expect_refusal(error.what(), expected, options);
            ++refused;
        }
        if (texts.contains("restitution") || texts.contains("ramp")) continue;
        ParameterTexts with_value = texts;
        with_value["restitution"] = "1";
        const Expected of_the_map = expected_of(with_value, from, to);
        try {
            MapSettings map{.x = {"restitution", "1"}};
            map.of = "N_c";
            map.from = from;
            map.to = to;
            map.parameters = texts;
            expect_points(make_map_plan(map), of_the_map, options);
            ++mapped;
        } catch (const UsageError& error) {
            expect_refusal(error.what(), of_the_map, options);
        }
    }
    EXPECT_GT(swept, 50);
    EXPECT_GT(mapped, 50);
    EXPECT_GT(refused, 50);
}

// A search that continues from a folder makes no run again, and finds the same.
TEST(SearchOptions, AFolderHoldsTheRunsOfASearch) {
    const Scratch scratch;
    const ParameterTexts texts{{"mixture", "50%:0.8"}, {"events", "20000"}};
    CrossingSettings settings;
    settings.config = resolve({{"mixture", "50%:0.8"}, {"events", "20000"}, {"discs", "28"}});
    settings.from = 20;
    settings.to = 28;
    const SweepPlan plan = search_plan(texts, settings.from, settings.to);
    write_plan(scratch.folder(), plan);
    EXPECT_EQ(read_plan(scratch.folder()), plan);
    int made = 0;
    const auto search = [&](StoredRuns* stored) {
        CrossingControl control;
        control.threads = 1;
        control.stored = stored;
        control.make_run = [&](const RunConfig& config, const RunControl&) {
            ++made;
            return known_run(config);
        };
        return search_crossing(settings, control);
    };
    SearchFolder folder(scratch.folder(), plan, texts);
    const CrossingResult first = search(&folder);
    EXPECT_EQ(made, int(first.runs));
    const CrossingResult again = search(&folder), without = search(nullptr);
    EXPECT_EQ(made, 2 * int(first.runs));
    for (const CrossingResult* other : {&again, &without}) {
        EXPECT_EQ(other->runs, first.runs);
        EXPECT_EQ(other->events, first.events);
        EXPECT_EQ(other->crossing().discs, first.crossing().discs);
        EXPECT_EQ(other->crossing().error, first.crossing().error);
    }
    // Results that were cut off are made again.
    made = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scratch / "results"))
        if (made++ == 0) std::filesystem::resize_file(entry.path(), 100);
    made = 0;
    search(&folder);
    EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace swirl
