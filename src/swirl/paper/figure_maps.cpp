// Figures 2b, 2c, 5c and 5d: number density and flow in the M-frame, for a rotating (N = 28) and a
// counterrotating cluster (N = 48). Figure 2 is about the experiment and has its smooth spheres next
// to discs; Figure 5 is about discs. Both friction coefficients of discs are 1.
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

const std::vector<Friction> settings_of_2{high_friction, smooth_spheres};

/// Density and flow in one table: rows of one have no values of the other.
FigurePlan plan_both(const PaperSettings& settings, const std::string& name, std::int64_t discs) {
    FigurePlan plan;
    for (const Friction& friction : settings_of_2)
        plan.points.push_back(measured_point(settings, friction, discs));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"setting", "map", "discs", "steady_state", "x", "y", "density",
                     "density_error", "u_x", "u_x_error", "u_y", "u_y_error", "visits"});
        for (std::size_t s = 0; s < results.size(); ++s) {
            const Json& result = results[s];
            if (failed(result)) throw Failure("one of its runs failed.");
            const std::string setting = settings_of_2[s].name;
            const Json& density = result["measured"]["density"];
            for (std::size_t r = 0; r < density["x"].size(); ++r)
                table.add({setting, std::string("density"), discs, steadiness(result),
                           number(density["x"][r]), number(density["y"][r]),
                           number(density["by_time"][r]), number(density["by_time_error"][r]),
                           not_available, not_available, not_available, not_available,
                           not_available});
            const Json& flow = result["measured"]["flow"];
            for (std::size_t r = 0; r < flow["x"].size(); ++r)
                table.add({setting, std::string("flow"), discs, steadiness(result),
                           number(flow["x"][r]), number(flow["y"][r]), not_available, not_available,
                           number(flow["u_x"][r]), number(flow["u_x_error"][r]),
                           number(flow["u_y"][r]), number(flow["u_y_error"][r]),
                           number(flow["visits"][r])});
        }
        FigureOutcome outcome;
        outcome.write(table, name, out);
        return outcome;
    };
    return plan;
}

/// Columns of one measurement, for both N.
FigurePlan plan_map(const PaperSettings& settings, const std::string& name,
                    const std::string& measurement, const std::vector<std::string>& columns) {
    FigurePlan plan;
    const std::vector<std::int64_t> numbers{rotating_n, counterrotating_n};
    for (const std::int64_t n : numbers)
        plan.points.push_back(measured_point(settings, high_friction, n));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"discs", "steady_state"}, columns));
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (failed(results[k])) continue;
            const Json& map = results[k]["measured"][measurement];
            for (std::size_t r = 0; r < map[columns.front()].size(); ++r) {
                std::vector<Table::Cell> row{numbers[k], steadiness(results[k])};
                for (const std::string& column : columns) row.emplace_back(number(map[column][r]));
                table.add(std::move(row));
            }
        }
        FigureOutcome outcome;
        outcome.write(table, name, out);
        return outcome;
    };
    return plan;
}

}  // namespace

static FigurePlan plan_figure_2b(const PaperSettings& settings) {
    return plan_both(settings, "2b", rotating_n);
}
static FigurePlan plan_figure_2c(const PaperSettings& settings) {
    return plan_both(settings, "2c", counterrotating_n);
}
static FigurePlan plan_figure_5c(const PaperSettings& settings) {
    return plan_map(settings, "5c", "density",
                    {"x", "y", "by_event", "by_event_error", "by_time", "by_time_error"});
}
static FigurePlan plan_figure_5d(const PaperSettings& settings) {
    return plan_map(settings, "5d", "flow",
                    {"x", "y", "visits", "u_x", "u_x_error", "u_y", "u_y_error"});
}

std::vector<PaperFigure> figures_of_maps() {
    return {{"2b", "density and flow of a rotating cluster, N = 28", plan_figure_2b},
            {"2c", "density and flow of a counterrotating cluster, N = 48", plan_figure_2c},
            {"5c", "density, N = 28 and 48", plan_figure_5c},
            {"5d", "flow relative to the container, N = 28 and 48", plan_figure_5d}};
}

}  // namespace swirl
