// How closely do the paths of discs follow hypotrochoids? A rigid cluster whose centre orbits the
// container's centre C with the swirl's Ω, and that rotates with ϖ about its own centre, moves each
// of its discs along
//
//     p(t) = D e^{iΩt} + ρ e^{iϖt}
//
// relative to C, as complex numbers. With ϖ < 0 this is a hypotrochoid. A cluster of radius R_c in
// a container of radius R has |D| = R − R_c. If it rolls without slip, ϖ = Ω (1 − R/R_c); then a
// disc at its rim, |ρ| = R_c, follows a hypocycloid with its cusps at the wall.
//
// The fit. D and ρ are free for each disc, ϖ is one number for all discs. For a given ϖ, with the
// means over the samples a = ⟨p e^{−iΩt}⟩, b = ⟨p e^{−iϖt}⟩ and g = ⟨e^{i(ϖ−Ω)t}⟩, least squares
// leave
//
//     ⟨|p|²⟩ − (|a|² + |b|² − 2 Re(a* g b)) / (1 − |g|²)
//
// for each disc. The ϖ of least residual is searched on a grid.
//
// Units: those of p; ϖ in Ω. Limits: at least two periods; ϖ is searched from −0.5 to 0.8 Ω,
// because the two terms cannot be separated near ϖ = Ω.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

struct HypocycloidFit {
    double rotation = 0.0;  // ϖ/Ω
    double distance = 0.0;  // root mean square distance of the discs from their paths
};

/// `paths[i]` is that of disc i, at k/per_period periods for k = 0, 1, ….
inline HypocycloidFit fit_hypocycloids(const std::vector<std::vector<std::complex<double>>>& paths,
                                       int per_period) {
    using Complex = std::complex<double>;
    constexpr double lowest = -0.5, step = 0.005;
    constexpr int steps = 260, coarse = 10;
    const std::size_t samples = paths.front().size();
    const auto count = static_cast<double>(samples);
    const auto mean_with = [&](const std::vector<Complex>& path, double rate) {
        const Complex turn = std::polar(1.0, -2.0 * pi * rate / per_period);
        Complex sum = 0.0, phase = 1.0;
        for (const Complex& p : path) {
            sum += p * phase;
            phase *= turn;
        }
        return sum / count;
    };
    double power = 0.0;
    std::vector<Complex> a;
    for (const auto& path : paths) {
        for (const Complex& p : path) power += std::norm(p) / count;
        a.push_back(mean_with(path, 1.0));
    }
    const std::vector<Complex> ones(samples, 1.0);
    HypocycloidFit best;
    double least = INFINITY;
    const auto search = [&](int from, int to, int by) {
        int found = from;
        for (int k = from; k <= to; k += by) {
            const double rate = lowest + k * step;
            const Complex g = mean_with(ones, 1.0 - rate);
            double explained = 0.0;
            for (std::size_t i = 0; i < paths.size(); ++i) {
                const Complex b = mean_with(paths[i], rate);
                explained +=
                    std::norm(a[i]) + std::norm(b) - 2.0 * (std::conj(a[i]) * g * b).real();
            }
            const double residual = power - explained / (1.0 - std::norm(g));
            if (residual < least) {
                least = residual;
                best.rotation = rate;
                found = k;
            }
        }
        return found;
    };
    // The residual varies over 1/4 Ω in four periods, so a coarse search finds the valley.
    const int near = search(0, steps, coarse);
    search(std::max(near - coarse + 1, 0), std::min(near + coarse - 1, steps), 1);
    best.distance = std::sqrt(std::max(0.0, least) / static_cast<double>(paths.size()));
    return best;
}

}  // namespace swirl
