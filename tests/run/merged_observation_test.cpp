// Every number of every measurement: two containers observed separately and merged give the results
// of one observation of both. A member missing in merge() fails here.
#include <gmock/gmock.h>

#include <cmath>

#include "swirl/measure/observation.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

/// Some measurements use every 7th or 100th sample. Those of pinned discs use every 64th sample for
/// which the pinned discs are known (not the first and last seven). One uses every 32nd event. Both
/// observations must use the same samples, so the length of a run is a multiple of these.
struct Part {
    bool of_the_pinned;
    int periods, samples;
};
constexpr Part pinned{true, 17, 686}, others{false, 16, 700};
static_assert(pinned.periods * pinned.samples % 64 == 14);
static_assert(others.periods * others.samples % 700 == 0);

std::vector<std::string> names_of(const Part& part) {
    std::vector<std::string> names;
    for (const MeasurementKind& kind : measurement_kinds())
        if (kind.needs_pinned == part.of_the_pinned) names.emplace_back(kind.name);
    return names;
}

RunConfig container(const Part& part, std::uint64_t seed) {
    RunConfig config;
    config.discs = 28;
    config.restitution = 0.99;  // or one loss of the energy budget is 0
    config.periods = part.periods;
    config.seed = seed;
    return config;
}

/// A whole run from its first event, period by period.
void observe(const Part& part, std::uint64_t seed, std::initializer_list<Observation*> observers) {
    swirl::Run run(container(part, seed));
    SampleTimes times = run.sample_times(part.samples);
    std::uint64_t events = 0;
    while (run.next_event()) {
        while (run.next_sample(times))
            for (Observation* o : observers) o->sample(run.snapshot());
        const std::int64_t periods = run.event().periods;
        run.pass_event();
        const bool last = run.snapshot().periods == part.periods;
        // The vertex that ends the last period is handed over once or more, until the number is a
        // multiple.
        do
            for (Observation* o : observers) o->sample(run.event(), run.snapshot());
        while (++events % events_per_sample != 0 && last);
        if (run.snapshot().periods > periods)
            for (Observation* o : observers) o->close_block();
    }
}

/// Means agree up to the order of additions. Errors use the correlation of a block with the
/// previous one, and the first block of the second container has none.
void expect_same(double merged, double whole, const std::string& what) {
    if (std::isnan(whole) || std::isnan(merged)) {
        EXPECT_EQ(std::isnan(whole), std::isnan(merged)) << what;
        return;
    }
    const bool error = what.find("error") != std::string::npos;
    EXPECT_NEAR(merged, whole, error ? 0.2 * whole + 1e-7 : 1e-11 * (1.0 + std::fabs(whole)))
        << what;
}

class MergedObservation : public testing::TestWithParam<Part> {};

TEST_P(MergedObservation, EqualsOneObservationOfBothContainers) {
    const Part part = GetParam();
    const auto observation = [&] {
        const RunConfig config = container(part, 1);
        return Observation(dish_of(config), names_of(part));
    };
    Observation whole = observation(), first = observation(), second = observation();
    observe(part, 1, {&whole, &first});
    whole.begin_tracks();
    observe(part, 2, {&whole, &second});
    first.merge(second);
    const auto merged = first.report(), expected = whole.report();
    ASSERT_EQ(merged.size(), names_of(part).size());
    std::size_t known = 0;
    for (std::size_t m = 0; m < merged.size(); ++m) {
        const Report &a = merged[m].report, &b = expected[m].report;
        for (std::size_t k = 0; k < b.rows.size(); ++k) {
            const std::string name = merged[m].name + "." + b.rows[k].name;
            // Between the two containers the energy jumps, and no collision accounts for it.
            if (name == "energy.unaccounted_share") continue;
            expect_same(a.rows[k].estimate.mean, b.rows[k].estimate.mean, name);
            expect_same(a.rows[k].estimate.error, b.rows[k].estimate.error, name + " error");
            EXPECT_EQ(a.rows[k].estimate.blocks, b.rows[k].estimate.blocks) << name;
            for (std::size_t d = 0; d < b.rows[k].details.size(); ++d)
                expect_same(a.rows[k].details[d].value, b.rows[k].details[d].value,
                            name + " " + b.rows[k].details[d].name);
            known += std::isnan(b.rows[k].estimate.mean) ? 0 : 1;
        }
        for (std::size_t t = 0; t < b.tables.size(); ++t) {
            ASSERT_EQ(a.tables[t].values.size(), b.tables[t].values.size());
            const std::size_t columns = b.tables[t].columns.size();
            for (std::size_t v = 0; v < b.tables[t].values.size(); ++v) {
                const std::string& column = b.tables[t].columns[v % columns].name;
                // The errors of fields come from groups of periods. A merge joins no groups.
                if (merged[m].name == "fields" && column.ends_with("_error")) continue;
                expect_same(a.tables[t].values[v], b.tables[t].values[v],
                            merged[m].name + " " + b.tables[t].name + " " +
                                b.tables[t].columns[v % columns].name + " of row " +
                                std::to_string(v / columns));
            }
        }
    }
    // The numbers must not agree merely because there are no samples.
    EXPECT_GT(known, 15u);
}

INSTANTIATE_TEST_SUITE_P(Measurements, MergedObservation, testing::Values(pinned, others),
                         [](const auto& part) {
                             return part.param.of_the_pinned ? "OfThePinned" : "Others";
                         });

}  // namespace
}  // namespace swirl
