#include "swirl/study/map_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/statistics/crossing_search.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

constexpr std::size_t first_runs = 2, coarse_step = 5, min_coarse_cells = 3;
constexpr std::int64_t coarse_numbers = 5;

/// Ranks of two values of an axis.
struct Interval {
    std::size_t a = 0, b = 0;
    bool operator==(const Interval&) const = default;
};

struct Cell {
    Interval x, y;
};

/// The values of an axis by rank, and their places in the plan. A plan that has grown holds its
/// values in the order in which they came.
class MapAxis {
  public:
    MapAxis() = default;
    MapAxis(const SweepPlan& plan, const std::string& name) {
        std::size_t stride = static_cast<std::size_t>(plan.replicas);
        for (std::size_t a = plan.axes.size(); a-- > 0; stride *= plan.axes[a].values.size()) {
            if (plan.axes[a].name != name) continue;
            stride_ = stride;
            index_ = ascending_order(plan.axes[a]);
            ranks_.clear();
            for (const SweepStage& stage : plan.before) add_stage(stage.values[a]);
            add_stage(index_.size());
        }
        while (ranks_.size() <= plan.before.size())  // an axis without a name has one value
            ranks_.push_back({0});
    }

    std::size_t size() const { return index_.size(); }
    /// What a rank adds to the index in the product of the axes.
    std::size_t offset(std::size_t rank) const { return index_[rank] * stride_; }
    /// The index of the smallest value in the plan.
    std::size_t smallest() const { return index_.front(); }
    /// From the first to the last rank of a stage.
    Interval range(std::size_t stage) const {
        return {ranks_[stage].front(), ranks_[stage].back()};
    }

    /// The coarse intervals of a stage: all of the first one, later those beyond its values.
    std::vector<Interval> coarse_intervals(std::size_t stage) const {
        const std::vector<std::size_t>& ranks = ranks_[stage];
        if (stage == 0) return divided(ranks, min_coarse_cells);
        const std::vector<std::size_t>& before = ranks_[stage - 1];
        const auto begin = std::lower_bound(ranks.begin(), ranks.end(), before.front());
        const auto end = std::lower_bound(ranks.begin(), ranks.end(), before.back());
        const std::vector<std::size_t> below(ranks.begin(), begin + 1), above(end, ranks.end());
        std::vector<Interval> intervals;
        for (const auto* part : {&below, &above})
            if (part->size() > 1)
                for (const Interval& i : divided(*part, 1)) intervals.push_back(i);
        return intervals;
    }

    /// The rank that halves an interval, among the values of the earliest stage with one between. A
    /// map that has grown thus uses the points that it had.
    std::optional<std::size_t> middle(const Interval& i, std::size_t stage) const {
        for (std::size_t s = 0; s <= stage; ++s) {
            const std::vector<std::size_t>& ranks = ranks_[s];
            const auto first = std::upper_bound(ranks.begin(), ranks.end(), i.a) - ranks.begin();
            const auto last = std::lower_bound(ranks.begin(), ranks.end(), i.b) - ranks.begin();
            if (first < last) return ranks[static_cast<std::size_t>(first + last - 1) / 2];
        }
        return std::nullopt;
    }

  private:
    /// The ranks of the first `values` values.
    void add_stage(std::size_t values) {
        std::vector<std::size_t>& ranks = ranks_.emplace_back();
        for (std::size_t rank = 0; rank < index_.size(); ++rank)
            if (index_[rank] < values) ranks.push_back(rank);
    }

    /// Divided about every `coarse_step` of the ranks.
    static std::vector<Interval> divided(const std::vector<std::size_t>& ranks,
                                         std::size_t min_cells) {
        const std::size_t last = ranks.size() - 1;
        if (last == 0) return {{ranks[0], ranks[0]}};
        const std::size_t cells = std::max(last / coarse_step, std::min(min_cells, last));
        std::vector<Interval> intervals;
        for (std::size_t k = 0; k < cells; ++k)
            intervals.push_back({ranks[last * k / cells], ranks[last * (k + 1) / cells]});
        return intervals;
    }

    std::size_t stride_ = 0;
    std::vector<std::size_t> index_{0};  // index of the value in the plan, by rank
    // By stage: of its values, ascending.
    std::vector<std::vector<std::size_t>> ranks_ = {std::vector<std::size_t>{0}};
};

std::vector<Interval> halves(const Interval& i, const std::optional<std::size_t>& middle) {
    if (!middle) return {i};
    return {{i.a, *middle}, {*middle, i.b}};
}

/// The number of a point from its index in the product of the axes.
std::vector<std::size_t> points_by_index(const SweepPlan& plan) {
    std::vector<std::size_t> points(plan.product_indices.size());
    for (std::size_t p = 0; p < points.size(); ++p) points[plan.product_indices[p]] = p;
    return points;
}

class MapSearch {
  public:
    using FindRun = std::function<const MapRun*(std::size_t)>;

    MapSearch(const SweepPlan& plan, const FindRun& find_run)
        : plan_(plan),
          target_(*plan.map),
          find_run_(find_run),
          x_(plan, target_.x),
          y_(plan, target_.y),
          discs_(plan, target_.is_of_crossing() ? "discs" : ""),
          point_at_(points_by_index(plan)),
          sites_(x_.size() * y_.size()),
          searches_(sites_.size()) {
        for (const SweepStage& stage : plan.before)
            max_runs_of_.push_back(static_cast<std::size_t>(stage.replicas));
        max_runs_of_.push_back(static_cast<std::size_t>(plan.replicas));
        if (!target_.is_of_crossing()) return;
        first_number_ = *read_whole_number(plan.axis("discs")->values[discs_.smallest()]);
    }

    /// A map that has grown repeats its search stage by stage, so all its runs are used.
    MapState explore() {
        std::vector<Cell> cells;
        for (stage_ = 0; stage_ < max_runs_of_.size() && missing_.empty(); ++stage_) {
            max_runs_ = max_runs_of_[stage_];
            numbers_ = discs_.range(stage_);
            decide_again();
            add_coarse_cells(cells);
            for (bool changed = true; changed;) {
                changed = false;
                for (std::size_t k = 0; k < cells.size(); ++k) {
                    if (!can_halve(cells[k]) || !corners_are_decided(cells[k]) ||
                        !differs(cells[k]))
                        continue;
                    const Cell cell = cells[k];
                    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(k--));
                    halve(cell, cells);
                    changed = true;
                }
            }
        }
        MapState state;
        for (const std::optional<MapSite>& known : sites_)
            if (known) state.sites.push_back(*known);
        std::sort(missing_.begin(), missing_.end());
        state.missing = std::move(missing_);
        return state;
    }

  private:
    using Neighbours = std::vector<const MapSite*>;

    std::optional<MapSite>& at(std::size_t i, std::size_t j) { return sites_[j * x_.size() + i]; }

    /// The cells of this stage: all pairs with an interval that is new on one of the axes.
    void add_coarse_cells(std::vector<Cell>& cells) {
        const std::vector<Interval> new_x = x_.coarse_intervals(stage_),
                                    new_y = y_.coarse_intervals(stage_);
        const auto add = [&](const std::vector<Interval>& xs, const std::vector<Interval>& ys) {
            for (const Interval& y : ys)
                for (const Interval& x : xs) {
                    cells.push_back({x, y});
                    for (const std::size_t j : {y.a, y.b})
                        for (const std::size_t i : {x.a, x.b}) site(i, j, {});
                }
        };
        add(new_x, coarse_y_);
        coarse_x_.insert(coarse_x_.end(), new_x.begin(), new_x.end());
        add(coarse_x_, new_y);
        coarse_y_.insert(coarse_y_.end(), new_y.begin(), new_y.end());
    }

    /// Sites that were open with the runs and numbers of discs allowed before.
    void decide_again() {
        if (stage_ == 0 ||
            (max_runs_ == max_runs_of_[stage_ - 1] && numbers_ == discs_.range(stage_ - 1)))
            return;
        for (std::size_t k = 0; k < sites_.size(); ++k)
            if (sites_[k] && (sites_[k]->verdict == "undetermined" ||
                              sites_[k]->verdict == "undecided" || target_.is_of_crossing())) {
                MapSite s{.x = sites_[k]->x, .y = sites_[k]->y};
                decide(s, searches_[k], {});
                sites_[k] = std::move(s);
            }
    }

    bool can_halve(const Cell& c) const {
        return x_.middle(c.x, stage_).has_value() || y_.middle(c.y, stage_).has_value();
    }

    /// Adds a site; its neighbours are decided and lie around it.
    void site(std::size_t i, std::size_t j, const Neighbours& neighbours) {
        std::optional<MapSite>& known = at(i, j);
        if (known) return;
        MapSite s{.x = i, .y = j};
        decide(s, searches_[j * x_.size() + i], neighbours);
        known = std::move(s);
    }

    void decide(MapSite& s, std::optional<CrossingSearch>& search, const Neighbours& neighbours) {
        if (target_.is_of_crossing())
            find_crossing_at(s, search, neighbours);
        else
            find_value_at(s);
    }

    bool corners_are_decided(const Cell& c) {
        for (const std::size_t j : {c.y.a, c.y.b})
            for (const std::size_t i : {c.x.a, c.x.b})
                if (!at(i, j)->decided) return false;
        return true;
    }

    /// Compares the decided sites in the cell and on its border. A neighbouring fine cell may have
    /// sites on the border.
    bool differs(const Cell& c) {
        const MapSite* first = nullptr;
        double least = 0.0, most = 0.0;
        for (std::size_t j = c.y.a; j <= c.y.b; ++j)
            for (std::size_t i = c.x.a; i <= c.x.b; ++i) {
                const std::optional<MapSite>& s = at(i, j);
                if (!s || !s->decided) continue;
                if (s->verdict == "undetermined" || s->verdict == "undecided") return true;
                if (!first) {
                    first = &*s;
                    least = most = s->value.mean;
                }
                if (s->verdict != first->verdict) return true;
                least = std::fmin(least, s->value.mean);
                most = std::fmax(most, s->value.mean);
            }
        return target_.change > 0.0 && most - least > target_.change;
    }

    /// The sites in the middle of an edge depend on the ends of that edge alone, because the cell
    /// on its other side may ask for them, too.
    void halve(const Cell& c, std::vector<Cell>& cells) {
        const auto decided = [&](std::size_t i, std::size_t j) { return &*at(i, j); };
        const auto x_middle = x_.middle(c.x, stage_), y_middle = y_.middle(c.y, stage_);
        if (x_middle)
            for (const std::size_t j : {c.y.a, c.y.b})
                site(*x_middle, j, {decided(c.x.a, j), decided(c.x.b, j)});
        if (y_middle)
            for (const std::size_t i : {c.x.a, c.x.b})
                site(i, *y_middle, {decided(i, c.y.a), decided(i, c.y.b)});
        if (x_middle && y_middle)
            site(*x_middle, *y_middle,
                 {decided(c.x.a, c.y.a), decided(c.x.b, c.y.a), decided(c.x.a, c.y.b),
                  decided(c.x.b, c.y.b)});
        for (const Interval& y : halves(c.y, y_middle))
            for (const Interval& x : halves(c.x, x_middle)) cells.push_back({x, y});
    }

    std::size_t point_of(const MapSite& s, std::size_t number, std::size_t replica) const {
        const std::size_t index = x_.offset(s.x) + y_.offset(s.y) + discs_.offset(number) + replica;
        return point_at_.empty() ? index : point_at_[index];
    }

    /// A run at a site; asks for it if it is missing.
    const MapRun* run_at(const MapSite& s, std::size_t number, std::size_t replica) {
        const std::size_t point = point_of(s, number, replica);
        const MapRun* const run = find_run_(point);
        if (!run) missing_.push_back(point);
        return run;
    }

    /// The mean over the first `count` runs; nothing if some are missing.
    std::optional<Estimate> mean_at(MapSite& s, std::size_t count) {
        std::vector<Estimate> values;
        bool direction = false, complete = true;
        s.runs = s.failed = 0;
        s.periods = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const MapRun* const run = run_at(s, 0, k);
            complete = complete && run;
            if (!run) continue;
            (run->failed ? s.failed : s.runs) += 1;
            if (run->failed) continue;
            s.periods += run->periods;
            direction = direction || run->direction;
            values.push_back(run->value);
        }
        if (!complete) return {};
        return (direction ? several_directions(values) : ensemble(values)).estimate;
    }

    void find_value_at(MapSite& s) {
        for (std::size_t runs = first();; runs = std::min(2 * runs, max_runs_)) {
            const std::optional<Estimate> mean = mean_at(s, runs);
            if (!mean) return;
            s.value = *mean;
            const double distance = s.value.mean - target_.level;
            const int sign = certain_sign_of(distance, s.value.error);
            if (sign == 0 && runs < max_runs_) continue;
            s.decided = true;
            s.verdict = s.runs == 0 ? "failed"
                        : sign == 0 ? "undetermined"
                                    : (sign > 0 ? "above" : "below");
            return;
        }
    }

    /// The rules of a search that begins next to the N_c of the neighbours, if all have one.
    CrossingRules rules_for(const MapSite& s, const Neighbours& neighbours) const {
        CrossingRules rules{.from = s.from,
                            .to = s.to,
                            .tolerance = target_.tolerance,
                            .seeds = std::int64_t(first()),
                            .max_runs = std::int64_t(max_runs_)};
        rules.rounds = std::numeric_limits<int>::max();  // only max_runs limits
        rules.sign_length = std::numeric_limits<double>::infinity();
        rules.longer_runs = rules.every_change = false;
        rules.coarse_numbers = coarse_numbers;
        if (neighbours.empty()) return rules;
        double least = neighbours.front()->value.mean, most = least;
        for (const MapSite* n : neighbours) {
            if (n->verdict != "crosses") return rules;
            least = std::min(least, n->value.mean);
            most = std::max(most, n->value.mean);
        }
        const auto in_range = [&](double n) {
            return std::clamp(std::int64_t(n), rules.from, rules.to);
        };
        rules.start = {in_range(std::floor(least) - 1.0), in_range(std::ceil(most) + 1.0)};
        return rules;
    }

    /// The end of the range of numbers of discs at this site. If not even the smallest number fits,
    /// the runs fail and say so.
    std::int64_t end_of_numbers(const MapSite& s) const {
        try {
            const RunConfig here = resolve(plan_.parameters(point_of(s, 0, 0)));
            return most_that_fit(here, s.from, number(numbers_.b));
        } catch (const UsageError&) {
            return number(numbers_.b);
        }
    }

    std::size_t first() const { return std::min(first_runs, max_runs_); }
    std::int64_t number(std::size_t index) const { return first_number_ + std::int64_t(index); }

    /// The next stage continues the search of this one.
    void find_crossing_at(MapSite& s, std::optional<CrossingSearch>& search,
                          const Neighbours& neighbours) {
        s.from = number(numbers_.a);
        s.to = end_of_numbers(s);
        if (search)
            search->extend(s.from, s.to, std::int64_t(max_runs_));
        else
            search.emplace(rules_for(s, neighbours));
        s.decided = true;
        while (s.decided) {
            const std::vector<ProposedRun> runs = search->next();
            if (runs.empty()) break;
            for (const ProposedRun& run : runs) s.decided = take_run(s, *search, run) && s.decided;
        }
        for (const auto& [discs, group] : search->groups()) {
            s.runs += std::int64_t(group.finished.size());
            s.failed += group.failed;
            for (const SearchedRun& run : group.finished) s.periods += run.length;
        }
        set(s, search->crossing());
    }

    /// False if the run is missing.
    bool take_run(const MapSite& s, CrossingSearch& search, const ProposedRun& proposed) {
        const MapRun* const run =
            run_at(s, std::size_t(proposed.discs - first_number_), std::size_t(proposed.replica));
        if (!run) return false;
        const SearchedRun result{{run->value}, run->periods};
        search.take(proposed, run->failed ? nullptr : &result);
        return true;
    }

    static void set(MapSite& s, const Crossing& crossing) {
        s.value = {.mean = crossing.discs, .error = crossing.error};
        s.lower = crossing.lower;
        s.upper = crossing.upper;
        switch (crossing.verdict) {
            case Crossing::Verdict::crosses:
                s.verdict = std::isnan(crossing.discs) ? "undecided" : "crosses";
                break;
            case Crossing::Verdict::always_rotates:
                s.verdict = "always rotates";
                break;
            case Crossing::Verdict::always_counterrotates:
                s.verdict = "always counterrotates";
                break;
            case Crossing::Verdict::undecided:
                s.verdict = s.runs == 0 ? "failed" : "undecided";
                break;
        }
    }

    const SweepPlan& plan_;
    const MapTarget target_;
    const FindRun& find_run_;
    const MapAxis x_, y_, discs_;              // discs_: one value, if the map is not of N_c
    const std::vector<std::size_t> point_at_;  // empty if the plan has not grown
    std::vector<std::size_t> max_runs_of_;     // one per stage
    std::size_t stage_ = 0, max_runs_ = 0;
    Interval numbers_;  // ranks of the numbers of discs in this stage
    std::int64_t first_number_ = 0;
    std::vector<Interval> coarse_x_, coarse_y_;
    std::vector<std::optional<MapSite>> sites_;
    std::vector<std::optional<CrossingSearch>> searches_;  // one per site of a map of N_c
    std::vector<std::size_t> missing_;
};

}  // namespace

MapState explore_map(const SweepPlan& plan,
                     const std::function<const MapRun*(std::size_t point)>& find_run) {
    return MapSearch(plan, find_run).explore();
}

}  // namespace swirl
