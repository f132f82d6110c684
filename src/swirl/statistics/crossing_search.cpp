#include "swirl/statistics/crossing_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swirl {
namespace {

/// More than the plan needs, because its variance is an estimate. A batch that just misses the
/// tolerance would cost another one.
constexpr double margin = 1.05;

/// The plan of a short group is uncertain. Only a last batch, which makes a group at most so many
/// times as long, is as long as planned; the others reach this share of the plan.
constexpr double last_step = 1.8, caution = 0.6;

double squared(double x) { return x * x; }

/// The error of a mean without Student's factor. If the replicates disagree, only their scatter is
/// known to contain everything.
double plain_error_of(const Ensemble& all) {
    return all.disagree || !(all.within > 0.0) ? all.estimate.error : all.within;
}

}  // namespace

std::vector<ProposedRun> CrossingSearch::next() {
    if (groups_.empty())
        return runs_at("coarse scan", rules_.start.empty() ? coarse_numbers() : rules_.start);
    if (const Numbers missing = missing_in_brackets(); !missing.empty())
        return runs_at("narrowing", missing);
    const Crossing found = crossing();
    if (const Numbers beyond = beyond_the_scan(found); !beyond.empty())
        return runs_at("coarse scan", beyond);
    plan_signs(found);
    plan_bracket(found);
    Numbers more;
    for (auto& [n, group] : groups_) {
        if (group.wanted == 0.0) continue;
        begin_round(group);
        more.insert(n);
    }
    return runs_at("more runs", more);
}

void CrossingSearch::take(const ProposedRun& run, const SearchedRun* result) {
    Group& group = groups_[run.discs];
    if (!result) {
        ++group.failed;
        return;
    }
    group.finished.push_back(*result);
    group.length += run.length;
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

bool CrossingSearch::takes_part(const SignChange& change, std::int64_t number, const Group& group) {
    return !group.finished.empty() && change.before <= double(number) &&
           double(number) <= change.after;
}

CrossingSearch::Numbers CrossingSearch::decisive_numbers(const Crossing& crossing) const {
    const SignChange* const change = crossing.last();
    Numbers numbers;
    for (const auto& [n, group] : groups_)
        if (change ? takes_part(*change, n, group) : !group.finished.empty()) numbers.insert(n);
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

/// Step 3, numbers outside of the brackets.
void CrossingSearch::plan_signs(const Crossing& crossing) {
    for (const double discs : crossing.undetermined) {
        const bool in_bracket =
            std::any_of(crossing.changes.begin(), crossing.changes.end(),
                        [&](const SignChange& c) { return c.before < discs && discs < c.after; });
        Group& group = groups_.find(std::int64_t(discs))->second;
        const double most = rules_.sign_length * double(rules_.seeds);
        if (in_bracket || !has_rounds_left(group) || double(group.length) >= most) continue;
        const Estimate e = combined(group, rules_.rate).estimate;
        // At least twice as long, since a mean may be large by chance.
        const double factor = std::max(2.0, squared(planned_sign * e.error / e.mean));
        group.wanted = double(group.length) * std::min(factor, growth);
    }
}

/// Step 3, the bracket of N_c.
void CrossingSearch::plan_bracket(const Crossing& crossing) {
    const SignChange* const change = crossing.last();
    if (!change || !change->resolved() || is_within_tolerance(crossing)) return;
    const Line line = line_in(*change);
    const double below = std::clamp(std::floor(line.zero), change->before, change->after - 1.0);
    const double share = std::clamp(line.zero - below, 0.0, 1.0);
    const double unit = line.variance / squared(line.slope);  // the length that gives the error 1
    double made = 0.0;
    for (const auto& [number, group] : groups_)
        if (double(number) == below || double(number) == below + 1.0) made += double(group.length);
    // The error that was found may exceed the planned one.
    const double total =
        margin * std::max(unit, made * squared(crossing.error)) / squared(rules_.tolerance);
    for (auto& [number, group] : groups_) {
        if (!takes_part(*change, number, group)) continue;
        const double n = double(number), distance = std::fabs(n - line.zero);
        double wanted = n == below ? (1.0 - share) * total : n == below + 1.0 ? share * total : 0.0;
        if (distance > 0.5) wanted = std::max(wanted, unit * squared(planned_sign / distance));
        wanted = std::min(wanted, total);
        if (wanted > double(group.length) && has_rounds_left(group)) group.wanted = wanted;
    }
}

/// The line of the plan. If the errors of too few numbers are known, it is the one through both
/// ends.
CrossingSearch::Line CrossingSearch::line_in(const SignChange& change) const {
    double sum = 0.0, of_n = 0.0, of_mean = 0.0, of_square = 0.0, of_product = 0.0;
    double variance = 0.0, length = 0.0, first = 0.0, last = 0.0;
    for (const auto& [number, group] : groups_) {
        if (!takes_part(change, number, group)) continue;
        const Ensemble all = combined(group, rules_.rate);
        const Estimate& e = all.estimate;
        const double n = double(number) - change.before, T = double(group.length);
        if (n == 0.0) first = e.mean;
        last = e.mean;
        if (!(e.error > 0.0 && e.error < std::numeric_limits<double>::infinity())) continue;
        const double weight = 1.0 / squared(e.error);
        sum += weight;
        of_n += weight * n;
        of_mean += weight * e.mean;
        of_square += weight * n * n;
        of_product += weight * n * e.mean;
        variance += squared(T * plain_error_of(all));
        length += T;
    }
    if (length > 0.0) variance /= length;
    const double spread = sum * of_square - of_n * of_n;
    const double slope = (sum * of_product - of_n * of_mean) / spread;
    if (slope < 0.0)
        return {.slope = slope,
                .zero = change.before + (of_n - of_mean / slope) / sum,
                .variance = variance};
    return {.slope = (last - first) / (change.after - change.before),
            .zero = change.discs,
            .variance = variance};
}

bool CrossingSearch::has_rounds_left(const Group& group) const {
    return group.rounds < rules_.rounds && group.attempted() < rules_.max_runs;
}

bool CrossingSearch::is_within_tolerance(const Crossing& crossing) const {
    if (crossing.verdict == Crossing::Verdict::crosses) return crossing.error <= rules_.tolerance;
    return crossing.verdict != Crossing::Verdict::undecided;
}

/// Plans a batch after which the group has the length `wanted`, if that is at most `growth` times
/// as long.
void CrossingSearch::begin_round(Group& group) const {
    ++group.rounds;
    group.scatters = group.scatters || !rules_.longer_runs || combined(group, rules_.rate).disagree;
    const double factor = group.wanted / double(group.length);
    group.wanted = 0.0;
    const double missing = (factor > last_step ? std::min(caution * factor, growth) : factor) - 1.0;
    const auto at_least_one = [](double x) { return std::int64_t(std::ceil(std::max(x, 1.0))); };
    if (group.scatters) {
        group.next_runs = at_least_one(missing * double(group.finished.size()));
        return;
    }
    group.next_runs = rules_.seeds;
    group.next_length = at_least_one(missing * double(group.length) / double(rules_.seeds));
}

std::vector<ProposedRun> CrossingSearch::runs_at(const char* stage, const Numbers& numbers) {
    stage_ = stage;
    std::vector<ProposedRun> runs;
    for (auto n = numbers.rbegin(); n != numbers.rend(); ++n) {
        const Group& group = groups_[*n];
        const std::int64_t before = group.attempted();
        const std::int64_t count = before == 0 ? rules_.seeds : group.next_runs;
        for (std::int64_t k = before; k < std::min(before + count, rules_.max_runs); ++k)
            runs.push_back({.discs = *n, .replica = k, .length = group.next_length});
    }
    return runs;
}

}  // namespace swirl
