"""Random mutations (draw.py) that no test can notice: (file, line before, line after, the reason)."""

GRID = "src/swirl/measure/field_grid.cpp"
COARSE = "src/swirl/measure/coarse_graining.hpp"

EQUIVALENT = [
    (GRID, "if (!(low.x <= high.x && low.y <= high.y)) return;", "if (!(low.x <= high.x && low.y < high.y)) return;",
     "equal bounds select no row in the loop below either"),
    (COARSE, "for (const GaussNode& node : nodes) visit(middle + half * node.at, half * node.weight);",
     "for (const GaussNode& node : nodes) visit(middle - half * node.at, half * node.weight);",
     "Gauss nodes lie symmetrically about the middle, with equal weights"),
]
