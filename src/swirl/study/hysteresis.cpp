#include "swirl/study/hysteresis.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/run/reading.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/study/collected_sweep.hpp"

namespace swirl {
namespace {

/// The points of one replica's loop with ascending values, and what the trapezoidal rule multiplies
/// each with.
struct LoopOfChain {
    std::vector<const PointResult*> up, down;

    bool is_complete() const {
        const auto exists = [](const PointResult* r) { return r->exists; };
        return std::all_of(up.begin(), up.end(), exists) &&
               std::all_of(down.begin(), down.end(), exists);
    }
    Estimate area(std::size_t index, const std::string& name,
                  const std::vector<double>& weights) const {
        double sum = 0.0, square = 0.0;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const Estimate rising = up[k]->quantity(index, name),
                           falling = down[k]->quantity(index, name);
            sum += weights[k] * (falling.mean - rising.mean);
            square += std::pow(weights[k] * std::hypot(falling.error, rising.error), 2);
        }
        return {.mean = sum, .error = std::sqrt(square)};
    }
};

std::vector<double> trapezoidal_weights(const std::vector<double>& x) {
    std::vector<double> weights(x.size(), 0.0);
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        weights[k] += 0.5 * (x[k + 1] - x[k]);
        weights[k + 1] += 0.5 * (x[k + 1] - x[k]);
    }
    return weights;
}

}  // namespace

std::vector<LoopAreas> loop_areas(const SweepPlan& plan, const std::vector<PointResult>& results,
                                  const std::vector<std::string>& quantities) {
    std::size_t combinations = 1, chain_stride = 1;
    for (auto axis = plan.axes.rbegin(); axis != plan.axes.rend(); ++axis) {
        if (axis->name == plan.chain) chain_stride = combinations;
        combinations *= axis->values.size();
    }
    const SweepAxis& chain = *plan.axis(plan.chain);
    const std::vector<std::size_t> order = ascending_order(chain);
    std::vector<double> x;
    for (const std::size_t k : order) x.push_back(*read_number(chain.values[k]));
    const std::vector<double> weights = trapezoidal_weights(x);
    const auto replicas = static_cast<std::size_t>(plan.replicas);
    std::vector<LoopAreas> all;
    for (std::size_t combination = 0; combination < combinations; ++combination) {
        if (combination / chain_stride % chain.values.size() != 0) continue;  // once per loop
        std::vector<LoopOfChain> loops;
        for (std::size_t r = 0; r < replicas; ++r) {
            LoopOfChain loop;
            for (const std::size_t k : order) {
                const std::size_t first = (combination + k * chain_stride) * 2 * replicas + r;
                loop.up.push_back(&results[first]);
                loop.down.push_back(&results[first + replicas]);
            }
            if (loop.is_complete()) loops.push_back(std::move(loop));
        }
        LoopAreas here{plan.parameters(combination * 2 * replicas),
                       static_cast<std::int64_t>(loops.size())};
        here.parameters.erase(plan.chain);
        for (std::size_t q = 0; q < quantities.size(); ++q) {
            std::vector<Estimate> areas;
            for (const LoopOfChain& loop : loops) {
                areas.push_back(loop.area(q, quantities[q], weights));
                if (loops.size() > 1) areas.back().error = not_available;
            }
            here.areas.push_back(ensemble(areas).estimate);
        }
        all.push_back(std::move(here));
    }
    return all;
}

Table loop_table(const SweepPlan& plan, const std::vector<LoopAreas>& loops,
                 const std::vector<std::string>& quantities) {
    std::vector<std::string> columns;
    for (const SweepAxis& axis : plan.axes)
        if (axis.name != plan.chain) columns.push_back(axis.name);
    columns.emplace_back("replicates");
    for (const std::string& name : quantities)
        columns.insert(columns.end(), {name, name + "_error"});
    Table table(columns);
    for (const LoopAreas& loop : loops) {
        std::vector<Table::Cell> row;
        for (const SweepAxis& axis : plan.axes)
            if (axis.name != plan.chain) row.push_back(cell_of(loop.parameters.at(axis.name)));
        row.emplace_back(loop.replicas);
        for (const Estimate& area : loop.areas) {
            row.emplace_back(area.mean);
            row.emplace_back(area.error);
        }
        table.add(std::move(row));
    }
    return table;
}

}  // namespace swirl
