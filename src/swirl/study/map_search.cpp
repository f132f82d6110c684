#include "swirl/study/map_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "swirl/run/reading.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {
namespace {

constexpr std::size_t first_runs = 2, coarse_step = 5, min_coarse_cells = 3, coarse_numbers = 5;

struct Interval {
    std::size_t a = 0, b = 0;
    bool can_halve() const { return b - a > 1; }
    std::size_t middle() const { return (a + b) / 2; }
};

struct Cell {
    Interval x, y;
    bool can_halve() const { return x.can_halve() || y.can_halve(); }
};

/// Divides the indices 0 … values − 1 into intervals of about `coarse_step`.
std::vector<Interval> coarse_intervals(std::size_t values) {
    const std::size_t last = values - 1;
    if (last == 0) return {{0, 0}};
    const std::size_t cells = std::max(last / coarse_step, std::min(min_coarse_cells, last));
    std::vector<Interval> intervals;
    for (std::size_t k = 0; k < cells; ++k)
        intervals.push_back({last * k / cells, last * (k + 1) / cells});
    return intervals;
}

std::vector<Interval> halves(const Interval& i) {
    if (!i.can_halve()) return {i};
    return {{i.a, i.middle()}, {i.middle(), i.b}};
}

/// An axis of the plan: the number of its values, and the distance of neighbours in the product.
struct MapAxis {
    std::size_t values = 1, stride = 0;
};

MapAxis axis_named(const SweepPlan& plan, const std::string& name) {
    std::size_t stride = static_cast<std::size_t>(plan.replicas);
    for (auto axis = plan.axes.rbegin(); axis != plan.axes.rend(); ++axis) {
        if (axis->name == name) return {axis->values.size(), stride};
        stride *= axis->values.size();
    }
    return {};
}

/// The runs at one point so far, combined.
struct PointRuns {
    bool complete = false;
    Estimate value = {};
    double periods = 0.0;
    std::int64_t runs = 0, failed = 0;
};

class MapSearch {
  public:
    using FindRun = std::function<const MapRun*(std::size_t)>;

    MapSearch(const SweepPlan& plan, const FindRun& find_run)
        : target_(*plan.map),
          find_run_(find_run),
          x_(axis_named(plan, target_.x)),
          y_(axis_named(plan, target_.y)),
          discs_(axis_named(plan, "discs")),
          max_runs_(static_cast<std::size_t>(plan.replicas)),
          sites_(x_.values * y_.values) {
        if (!target_.is_of_crossing()) return;
        first_number_ = static_cast<double>(*read_whole_number(plan.axis("discs")->values.front()));
    }

    MapState explore() {
        std::vector<Cell> cells;
        for (const Interval& y : coarse_intervals(y_.values))
            for (const Interval& x : coarse_intervals(x_.values)) {
                cells.push_back({x, y});
                for (const std::size_t j : {y.a, y.b})
                    for (const std::size_t i : {x.a, x.b}) site(i, j, {});
            }
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (!cells[k].can_halve() || !corners_are_decided(cells[k]) || !differs(cells[k]))
                    continue;
                const Cell cell = cells[k];
                cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(k--));
                halve(cell, cells);
                changed = true;
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

    std::optional<MapSite>& at(std::size_t i, std::size_t j) { return sites_[j * x_.values + i]; }

    /// Adds a site; its neighbours are decided and lie around it.
    void site(std::size_t i, std::size_t j, const Neighbours& neighbours) {
        std::optional<MapSite>& known = at(i, j);
        if (known) return;
        MapSite s{.x = i, .y = j};
        if (target_.is_of_crossing())
            find_crossing_at(s, neighbours);
        else
            find_value_at(s);
        known = std::move(s);
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
        if (c.x.can_halve())
            for (const std::size_t j : {c.y.a, c.y.b})
                site(c.x.middle(), j, {decided(c.x.a, j), decided(c.x.b, j)});
        if (c.y.can_halve())
            for (const std::size_t i : {c.x.a, c.x.b})
                site(i, c.y.middle(), {decided(i, c.y.a), decided(i, c.y.b)});
        if (c.x.can_halve() && c.y.can_halve())
            site(c.x.middle(), c.y.middle(),
                 {decided(c.x.a, c.y.a), decided(c.x.b, c.y.a), decided(c.x.a, c.y.b),
                  decided(c.x.b, c.y.b)});
        for (const Interval& y : halves(c.y))
            for (const Interval& x : halves(c.x)) cells.push_back({x, y});
    }

    /// The first `count` runs at a point; asks for those that are missing.
    PointRuns runs_at(const MapSite& s, std::size_t number, std::size_t count) {
        const std::size_t first = s.x * x_.stride + s.y * y_.stride + number * discs_.stride;
        PointRuns all{.complete = true};
        std::vector<Estimate> values;
        bool direction = false;
        for (std::size_t k = 0; k < count; ++k) {
            const MapRun* const run = find_run_(first + k);
            if (!run) {
                missing_.push_back(first + k);
                all.complete = false;
                continue;
            }
            (run->failed ? all.failed : all.runs) += 1;
            if (run->failed) continue;
            all.periods += run->periods;
            direction = direction || run->direction;
            values.push_back(run->value);
        }
        all.value = (direction ? several_directions(values) : ensemble(values)).estimate;
        return all;
    }

    std::size_t more_than(std::size_t runs) const { return std::min(2 * runs, max_runs_); }

    void find_value_at(MapSite& s) {
        for (std::size_t count = first();; count = more_than(count)) {
            const PointRuns all = runs_at(s, 0, count);
            s.value = all.value;
            s.periods = all.periods;
            s.runs = all.runs;
            s.failed = all.failed;
            if (!all.complete) return;
            const double distance = s.value.mean - target_.level;
            const bool certain = std::abs(distance) > certain_sign * s.value.error;
            if (!certain && count < max_runs_) continue;
            s.decided = true;
            s.verdict = s.runs == 0 ? "failed"
                        : !certain  ? "undetermined"
                                    : (distance > 0.0 ? "above" : "below");
            return;
        }
    }

    /// Key: index of the number of discs. Value: number of runs.
    using Counts = std::map<std::size_t, std::size_t>;

    void add_coarse_numbers(Counts& counts) const {
        const std::size_t last = discs_.values - 1;
        for (std::size_t k = 0; k < coarse_numbers; ++k)
            counts.try_emplace(last * k / (coarse_numbers - 1), first());
    }

    /// Next to the N_c of the neighbours, if all have one.
    Counts first_numbers(const Neighbours& neighbours) const {
        Counts counts;
        const bool all_cross =
            !neighbours.empty() && std::all_of(neighbours.begin(), neighbours.end(),
                                               [](auto* n) { return n->verdict == "crosses"; });
        if (!all_cross) {
            add_coarse_numbers(counts);
            return counts;
        }
        double least = neighbours.front()->value.mean, most = least;
        for (const MapSite* n : neighbours) {
            least = std::min(least, n->value.mean);
            most = std::max(most, n->value.mean);
        }
        return {{index_of(std::floor(least) - 1.0), first()},
                {index_of(std::ceil(most) + 1.0), first()}};
    }

    std::size_t first() const { return std::min(first_runs, max_runs_); }
    double number(std::size_t index) const { return first_number_ + static_cast<double>(index); }
    std::size_t index_of(double discs) const {
        const double index = std::clamp(std::round(discs - first_number_), 0.0,
                                        static_cast<double>(discs_.values - 1));
        return static_cast<std::size_t>(index);
    }

    void find_crossing_at(MapSite& s, const Neighbours& neighbours) {
        Counts counts = first_numbers(neighbours);
        do {
            s.runs = s.failed = 0;
            s.periods = 0.0;
            bool complete = true;
            std::vector<RotationPoint> points;
            for (const auto& [n, count] : counts) {
                const PointRuns all = runs_at(s, n, count);
                s.runs += all.runs;
                s.failed += all.failed;
                s.periods += all.periods;
                complete = complete && all.complete;
                points.push_back({number(n), all.value.mean, all.value.error});
            }
            if (!complete) return;
            const Crossing crossing = find_crossing(points);
            set(s, crossing);
            s.decided = !ask_for_more(counts, crossing, points);
        } while (!s.decided);
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

    /// Adds numbers of discs or runs; false if N_c is known as well as it will be.
    bool ask_for_more(Counts& counts, const Crossing& crossing,
                      const std::vector<RotationPoint>& points) const {
        const SignChange* const change = crossing.last();
        if (change && !change->resolved()) return add_middle(counts, *change);
        if (!change && add_beyond(counts, points)) return true;
        const auto in_bracket = [&](double n) {
            return change && change->before <= n && n <= change->after;
        };
        bool more = false;
        const auto double_runs = [&](double n) {
            std::size_t& count = counts.at(index_of(n));
            more = more || count < max_runs_;
            count = more_than(count);
        };
        for (const double n : crossing.undetermined)
            if (!in_bracket(n)) double_runs(n);
        if (more || !change || crossing.error <= target_.tolerance) return more;
        for (const RotationPoint& p : points)
            if (in_bracket(p.discs)) double_runs(p.discs);
        return more;
    }

    /// The number without runs that is nearest to the middle of a bracket.
    bool add_middle(Counts& counts, const SignChange& change) const {
        const auto nearest = middle_number(
            static_cast<std::int64_t>(index_of(change.before)),
            static_cast<std::int64_t>(index_of(change.after)),
            [&](std::int64_t n) { return !counts.contains(static_cast<std::size_t>(n)); });
        if (nearest) counts.emplace(static_cast<std::size_t>(*nearest), first());
        return nearest.has_value();
    }

    /// If the search began next to the N_c of the neighbours and did not find that of this site:
    /// adds numbers farther out, and finally those of a site without neighbours.
    bool add_beyond(Counts& counts, const std::vector<RotationPoint>& points) const {
        const std::size_t before = counts.size(), last = discs_.values - 1;
        const std::size_t low = counts.begin()->first, high = counts.rbegin()->first;
        const std::size_t step = std::max<std::size_t>(2, (high - low) / 2);
        const auto certain = [](const RotationPoint& p, double sign) {
            return sign * p.mean > certain_sign * p.error;
        };
        if (!certain(points.front(), 1.0)) counts.try_emplace(low > step ? low - step : 0, first());
        if (!certain(points.back(), -1.0)) counts.try_emplace(std::min(high + step, last), first());
        if (counts.size() == before) add_coarse_numbers(counts);
        return counts.size() > before;
    }

    const MapTarget target_;
    const FindRun& find_run_;
    const MapAxis x_, y_, discs_;
    const std::size_t max_runs_;
    double first_number_ = 0.0;
    std::vector<std::optional<MapSite>> sites_;
    std::vector<std::size_t> missing_;
};

}  // namespace

MapState explore_map(const SweepPlan& plan,
                     const std::function<const MapRun*(std::size_t point)>& find_run) {
    return MapSearch(plan, find_run).explore();
}

}  // namespace swirl
