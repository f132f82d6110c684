"""Random mutations (draw.py) that no test can notice: (file, line before, line after, the
reason)."""

GRID = "src/swirl/measure/field_grid.cpp"
COARSE = "src/swirl/measure/coarse_graining.hpp"

EQUIVALENT = [
    (
        GRID,
        "if (!(low.x <= high.x && low.y <= high.y)) return;",
        "if (!(low.x <= high.x && low.y < high.y)) return;",
        "equal bounds select no row in the loop below either",
    ),
    (
        COARSE,
        "for (const GaussNode& node : nodes) visit(middle + half * node.at, half * node.weight);",
        "for (const GaussNode& node : nodes) visit(middle - half * node.at, half * node.weight);",
        "Gauss nodes lie symmetrically about the middle, with equal weights",
    ),
    (
        "src/swirl/measure/fields.cpp",
        "balances_ = {FieldBalance({0.0, 0.0}, narrow),",
        "balances_ = {FieldBalance({1.0, 0.0}, narrow),",
        "the balance holds at every point; its residual is a rounding error at each",
    ),
    (
        "src/swirl/engine/neighbors/search_setup.cpp",
        "candidates.capacity = std::max(min_candidates, (2 * longest_list + 7) / 8 * 8);",
        "candidates.capacity = std::max(min_candidates, (2 * longest_list + 7) / 9 * 8);",
        "candidates beyond the capacity take the slower way to the same list",
    ),
    (
        "src/swirl/run/core_run.cpp",
        "complete() ? 0 : events_between_checks(visits_all_discs ? simulation_.size() : 1);",
        "complete() ? 0 : events_between_checks(visits_all_discs ? simulation_.size() : 2);",
        "how often a run looks for a stop changes no result",
    ),
    (
        "src/swirl/measure/field_balance.cpp",
        "if (duration > 0.0 && dot(q, q) < reach * reach) {",
        "if (duration > 0.0 && dot(q, q) <= reach * reach) {",
        "at the edge of its reach the kernel and its slope are zero",
    ),
    (
        "src/swirl/engine/neighbors/linked_cells.hpp",
        "for (std::uint32_t c = 0; c < cells; ++c) {",
        "for (std::uint32_t c = 1; c < cells; ++c) {",
        "the grid has two rows of cells outside of all discs (search_setup.cpp)",
    ),
    (
        "src/swirl/measure/pinned_loose.hpp",
        "double last_time_ = 0.0, step_ = 0.0, breaks_ = 0.0;",
        "double last_time_ = 0.0, step_ = 1.0, breaks_ = 0.0;",
        "the first step replaces it before it is read",
    ),
    (
        "src/swirl/engine/neighbors/search_setup.cpp",
        "if (state.grid_count == 1 && state.size < too_many_for_cells)",
        "if (state.grid_count == 1 && state.size <= too_many_for_cells)",
        "where the discs of a cell are stored changes no result",
    ),
    (
        "src/swirl/engine/neighbors/wall_times.hpp",
        "const double versine = (0.5 * q) * next(3.0, next(5.0, next(7.0, 1.0)));",
        "const double versine = (0.5 * q) * next(3.0, next(5.0, next(7.0, 1.2)));",
        "the margin of the bound, 10⁻⁸, is larger than the error",
    ),
    (
        "src/swirl/engine/neighbors/verlet_skin.hpp",
        "for (std::uint32_t g = 0; g < state.grid_count; ++g) empty_cells(state, state.grids[g]);",
        "for (std::uint32_t g = 0; g <= state.grid_count; ++g) empty_cells(state, state.grids[g]);",
        "a grid that no disc uses has no cells",
    ),
    (
        "src/swirl/measure/cluster_rotation_kernel.hpp",
        "if (rows.left > 0)",
        "if (rows.left >= 0)",
        "discs with the weight zero change no sum",
    ),
]
