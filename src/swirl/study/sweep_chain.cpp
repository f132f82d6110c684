#include "swirl/study/sweep_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "swirl/io/checkpoint.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// Identifies the run that led to the state: its configuration and its place in the chain.
std::string identity_of_state(const SweepPlan& plan, std::size_t point) {
    return fmt::format("{} chain {} {}", config_text(plan.config(point)), plan.chain,
                       plan.direction(point));
}

}  // namespace

fs::path state_file(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    return part_of_sweep(folder, "states", plan) / (number_of_point(point) + ".state");
}

std::vector<std::vector<std::size_t>> chains_of(const SweepPlan& plan) {
    std::vector<std::vector<std::size_t>> chains;
    std::map<std::pair<ParameterTexts, std::int64_t>, std::size_t> index;
    std::vector<double> values(plan.points());
    for (std::size_t point = 0; point < plan.points(); ++point) {
        ParameterTexts others = plan.parameters(point);
        values[point] = read_number(others.at(plan.chain)).value_or(0.0);
        others.erase(plan.chain);
        const auto [entry, is_new] =
            index.try_emplace({others, plan.replica(point)}, chains.size());
        if (is_new) chains.emplace_back();
        chains[entry->second].push_back(point);
    }
    const auto is_down = [&](std::size_t point) {
        return plan.direction(point) == std::string_view("down");
    };
    for (std::vector<std::size_t>& chain : chains)
        std::sort(chain.begin(), chain.end(), [&](std::size_t a, std::size_t b) {
            if (is_down(a) != is_down(b)) return is_down(b);
            return is_down(a) ? values[a] > values[b] : values[a] < values[b];
        });
    return chains;
}

void write_final_state(const fs::path& folder, const SweepPlan& plan, std::size_t point,
                       FinalState state) {
    const fs::path file = state_file(folder, plan, point);
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    StateWriter bytes;
    bytes(state);
    write_checkpoint(file, {identity_of_state(plan, point), std::move(bytes).bytes()});
}

std::optional<FinalState> find_final_state(const fs::path& folder, const SweepPlan& plan,
                                           std::size_t point) {
    const fs::path file = state_file(folder, plan, point);
    if (!file_exists(file)) return {};
    try {
        const Checkpoint saved = read_checkpoint(file);
        if (saved.about != identity_of_state(plan, point)) return {};
        FinalState state;
        StateReader bytes(saved.state);
        bytes(state);
        bytes.expect_end();
        return state;
    } catch (const DamagedFile&) {
        return {};
    }
}

}  // namespace swirl
