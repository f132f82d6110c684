// A saved state with one replaced number and a correct checksum is rejected, or the run continues
// from it for 300 events with all discs inside the container. Each state is tested in a child
// process, which detects crashes and hangs.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

RunConfig run_of(Shape body) {
    RunConfig config;
    config.discs = 12;
    config.events = 100'000;
    config.warmup = 1;
    config.body = body;
    config.floor = body != Shape::disc;
    return config;
}

struct Saved {
    std::string bytes;
    std::vector<SavedField> fields;
};

/// The state of a run with all measurements, in its fifth period or later.
Saved saved(const RunConfig& config) {
    Observation observation = observation_of(config, read_measurement_list("all"));
    RunControl control;
    control.observation = &observation;
    control.orientations = config.body != Shape::disc;
    swirl::Run run(config, control);
    for (int k = 0; k < 3'000 && run.next_event(); ++k) run.pass_event();
    Saved all;
    StateWriter write(&all.fields);
    run.write(write);
    all.bytes = std::move(write).bytes();
    return all;
}

constexpr int ran = 0, rejected = 1, impossible = 2;

/// The outcome of a run that is resumed from this state.
int outcome(const RunConfig& config, const std::string& state) {
    try {
        Observation observation = observation_of(config, read_measurement_list("all"));
        RunControl control;
        control.observation = &observation;
        control.orientations = config.body != Shape::disc;
        control.resume = state;
        swirl::Run run(config, control);
        for (int k = 0; k < 300 && run.next_event(); ++k) run.pass_event();
        observation.report();
        run.state();
        const Snapshot now = run.snapshot();
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Vec2 from_centre = now.position(i) - now.container_centre;
            // A hundredth of a radius: ten times the allowed overlap of a state (validate.cpp).
            if (!(std::hypot(from_centre.x, from_centre.y) + now.radius[i] <=
                  now.container_radius + 0.01 * now.radius[i]))
                return impossible;
        }
        run.result();
        return ran;
    } catch (const FileError&) {
    } catch (const Failure&) {
    }
    return rejected;
}

/// The same in a child process. The alarm ends a hang.
int outcome_in_child(const RunConfig& config, const std::string& state) {
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        _exit(outcome(config, state));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Replacements of a number: indices, sizes and extreme values, and the neighbours of the number.
std::uint64_t wrong_word(std::uint64_t was, std::uint64_t which) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr std::uint64_t whole[] = {0,          1,          2,          13,
                                       255,        1ull << 16, 1ull << 31, 1ull << 40,
                                       1ull << 61, 1ull << 62, 1ull << 63, ~0ull};
    constexpr double real[] = {std::numeric_limits<double>::quiet_NaN(),
                               infinite,
                               -infinite,
                               1e308,
                               -1e308,
                               1e18,
                               1e9,
                               -1.0,
                               0.5,
                               1e-300};
    const std::uint64_t count = std::size(whole) + std::size(real) + 2;
    which %= count;
    if (which < std::size(whole)) return whole[which];
    which -= std::size(whole);
    if (which < std::size(real)) return std::bit_cast<std::uint64_t>(real[which]);
    return which == std::size(real) ? was + 1 : was - 1;
}

/// The state with one number replaced; the seed determines which one.
std::string mutated(const Saved& good, std::uint64_t seed) {
    Random random(seed);
    const SavedField& field = good.fields[random.bits() % good.fields.size()];
    if (field.count == 0) return good.bytes;
    const std::size_t at = field.begin + field.width * (random.bits() % field.count);
    std::uint64_t word = 0;
    std::memcpy(&word, good.bytes.data() + at, field.width);
    word = wrong_word(word, random.bits());
    std::string bytes = good.bytes;
    std::memcpy(bytes.data() + at, &word, field.width);
    return bytes;
}

void expect_mutations_are_harmless(Shape body, std::uint64_t first, std::uint64_t count) {
    const RunConfig config = run_of(body);
    const Saved good = saved(config);
    ASSERT_EQ(outcome_in_child(config, good.bytes), ran);
    std::uint64_t outcomes[2]{};
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const int found = outcome_in_child(config, mutated(good, seed));
        ASSERT_TRUE(found == ran || found == rejected) << "seed " << seed << ": " << found;
        ++outcomes[found];
    }
    // Both outcomes must occur: mutations reach the checks, and not all are rejected.
    EXPECT_GT(outcomes[ran], count / 20);
    EXPECT_GT(outcomes[rejected], count / 20);
    ::testing::Test::RecordProperty("ran", int(outcomes[ran]));
    ::testing::Test::RecordProperty("rejected", int(outcomes[rejected]));
}

TEST(HostileState, OfDiscsIsRejectedOrRuns) { expect_mutations_are_harmless(Shape::disc, 1, 80); }
TEST(HostileState, OfSpheresIsRejectedOrRuns) {
    expect_mutations_are_harmless(Shape::sphere, 1, 80);
}
TEST(HostileState, Slow_OfDiscsIsRejectedOrRuns) {
    expect_mutations_are_harmless(Shape::disc, 1'000, 8'000);
}
TEST(HostileState, Slow_OfSpheresIsRejectedOrRuns) {
    expect_mutations_are_harmless(Shape::sphere, 1'000, 8'000);
}

// The index of the current run of a block series must be inside its runs.
TEST(HostileState, AnIndexBeyondItsColumnIsRejected) {
    BlockSeries series;
    series.add(1.0, 1.0);
    StateWriter write;
    write(series);
    std::string bytes = write.bytes();
    bytes[0] = '\1';  // the current run, of which there is one
    StateReader read(bytes);
    BlockSeries restored;
    EXPECT_THROW(read(restored), FileError);
}

TEST(HostileState, ColumnsOfAnotherLengthAreRejected) {
    CellRates many(8), few(7);
    StateWriter write;
    write(many);
    StateReader read(write.bytes());
    EXPECT_THROW(read(few), FileError);
}

TEST(HostileState, NegativeCountsAndInvalidBoolsAreRejected) {
    std::int64_t count = -1;
    StateWriter write;
    write(count);
    StateReader read(write.bytes());
    EXPECT_THROW(read(count), FileError);
    bool truth = false;
    StateReader two("\2");
    EXPECT_THROW(two(truth), FileError);
}

}  // namespace
}  // namespace swirl
