#include "swirl/statistics/crossing_search.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {

std::vector<ProposedRun> CrossingSearch::next() {
    if (groups_.empty())
        return runs_at("coarse scan", rules_.start.empty() ? coarse_numbers() : rules_.start);
    if (const Numbers missing = missing_in_brackets(); !missing.empty())
        return runs_at("narrowing", missing);
    const Crossing found = crossing();
    if (const Numbers beyond = beyond_the_scan(found); !beyond.empty())
        return runs_at("coarse scan", beyond);
    const Numbers more = numbers_for_more_runs(found);
    for (const std::int64_t n : more) begin_round(groups_[n]);
    return runs_at("more runs", more);
}

void CrossingSearch::take(const ProposedRun& run, const SearchedRun* result) {
    Group& group = groups_[run.discs];
    if (result)
        group.finished.push_back(*result);
    else
        ++group.failed;
}

void CrossingSearch::extend(std::int64_t from, std::int64_t to, std::int64_t max_runs) {
    rules_.from = from;
    rules_.to = to;
    rules_.max_runs = max_runs;
}

Ensemble CrossingSearch::combined(const Group& group, std::size_t rate) const {
    std::vector<Estimate> estimates;
    std::vector<double> lengths;
    for (const SearchedRun& run : group.finished) {
        estimates.push_back(run.rates[rate]);
        lengths.push_back(run.length);
    }
    return ensemble(estimates, lengths);
}

std::vector<RotationPoint> CrossingSearch::curve(std::size_t rate) const {
    std::vector<RotationPoint> points;
    for (const auto& [n, group] : groups_) {
        if (group.finished.empty()) continue;
        const Estimate e = combined(group, rate).estimate;
        points.push_back({static_cast<double>(n), e.mean, e.error});
    }
    return points;
}

CrossingSearch::Numbers CrossingSearch::decisive_numbers(const Crossing& crossing) const {
    const SignChange* const change = crossing.last();
    Numbers numbers;
    for (const auto& [n, group] : groups_)
        if (!group.finished.empty() &&
            (!change || (change->before <= double(n) && double(n) <= change->after)))
            numbers.insert(n);
    return numbers;
}

CrossingSearch::Numbers CrossingSearch::coarse_numbers() const {
    const std::int64_t from = rules_.from, length = rules_.to - from;
    Numbers numbers{rules_.to};
    if (rules_.step > 0)
        for (std::int64_t n = from; n < rules_.to; n += rules_.step) numbers.insert(n);
    else
        for (std::int64_t k = 0; k < rules_.coarse_numbers; ++k)
            numbers.insert(from + length * k / (rules_.coarse_numbers - 1));
    return numbers;
}

/// In each bracket the number without runs that is nearest to its middle, or all if they are few.
/// Numbers at which all runs failed do not end the search in their bracket.
CrossingSearch::Numbers CrossingSearch::missing_in_brackets() const {
    Numbers missing;
    for (std::size_t rate = 0; rate < rules_.curves; ++rate) {
        const Crossing found = crossing(rate);
        for (const SignChange& change : found.changes) {
            if (!rules_.every_change && &change != found.last()) continue;
            Numbers free;
            for (auto n = std::int64_t(change.before) + 1; double(n) < change.after; ++n)
                if (!groups_.contains(n)) free.insert(n);
            const auto from_middle = [&](std::int64_t n) {
                return std::fabs(2.0 * double(n) - change.before - change.after);
            };
            if (std::int64_t(free.size()) > rules_.at_once)
                free = {*std::min_element(free.begin(), free.end(),
                                          [&](std::int64_t a, std::int64_t b) {
                                              return from_middle(a) < from_middle(b);
                                          })};
            missing.merge(free);
        }
    }
    return missing;
}

/// If the numbers so far do not bracket N_c: numbers farther out where the sign is not the expected
/// one, and finally those of a coarse scan.
CrossingSearch::Numbers CrossingSearch::beyond_the_scan(const Crossing& crossing) const {
    if (crossing.last()) return {};
    const auto& [low, first] = *groups_.begin();
    const auto& [high, last] = *groups_.rbegin();
    const std::int64_t step = std::max<std::int64_t>(2, (high - low) / 2);
    const auto sign_of = [&](const Group& group) {
        const Estimate e = combined(group, rules_.rate).estimate;
        return certain_sign_of(e.mean, e.error);
    };
    Numbers numbers;
    if (sign_of(first) != 1) numbers.insert(std::max(low - step, rules_.from));
    if (sign_of(last) != -1) numbers.insert(std::min(high + step, rules_.to));
    const auto is_known = [&](std::int64_t n) { return groups_.contains(n); };
    std::erase_if(numbers, is_known);
    if (numbers.empty()) numbers = coarse_numbers();
    std::erase_if(numbers, is_known);
    return numbers;
}

CrossingSearch::Numbers CrossingSearch::numbers_for_more_runs(const Crossing& crossing) const {
    Numbers numbers;
    for (const double discs : crossing.undetermined) {
        const bool in_bracket =
            std::any_of(crossing.changes.begin(), crossing.changes.end(),
                        [&](const SignChange& c) { return c.before < discs && discs < c.after; });
        const auto n = std::int64_t(discs);
        if (!in_bracket && has_rounds_left(n, rules_.sign_rounds)) numbers.insert(n);
    }
    const SignChange* const change = crossing.last();
    if (!change || !change->resolved() || is_within_tolerance(crossing)) return numbers;
    for (const std::int64_t n : decisive_numbers(crossing))
        if (has_rounds_left(n, rules_.rounds)) numbers.insert(n);
    return numbers;
}

bool CrossingSearch::has_rounds_left(std::int64_t number, int max_rounds) const {
    const Group& group = groups_.find(number)->second;
    return group.rounds < std::min(max_rounds, rules_.rounds) &&
           group.attempted() < rules_.max_runs;
}

bool CrossingSearch::is_within_tolerance(const Crossing& crossing) const {
    if (crossing.verdict == Crossing::Verdict::crosses) return crossing.error <= rules_.tolerance;
    return crossing.verdict != Crossing::Verdict::undecided;
}

void CrossingSearch::begin_round(Group& group) const {
    ++group.rounds;
    group.scatters = group.scatters || !rules_.longer_runs || combined(group, rules_.rate).disagree;
    if (!group.scatters) ++group.doublings;
}

std::vector<ProposedRun> CrossingSearch::runs_at(const char* stage, const Numbers& numbers) {
    stage_ = stage;
    std::vector<ProposedRun> runs;
    for (auto n = numbers.rbegin(); n != numbers.rend(); ++n) {
        const Group& group = groups_[*n];
        const std::int64_t before = group.attempted(),
                           count = group.scatters ? before : rules_.seeds;
        for (std::int64_t k = before; k < std::min(before + count, rules_.max_runs); ++k)
            runs.push_back({*n, k, group.doublings});
    }
    return runs;
}

}  // namespace swirl
