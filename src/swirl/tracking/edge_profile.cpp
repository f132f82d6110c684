#include "swirl/tracking/edge_profile.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {

EdgeProfile::EdgeProfile(double blur, int inside, int outside, double reach, bool bent)
    : blur_(blur), inside_(inside), outside_(outside), first_(-reach), spacing_(0.25) {
    const int samples = inside + outside + 1;
    // The kernel on a grid fine enough for the root's cusp.
    constexpr double fine = 0.05;
    const int half = static_cast<int>(std::ceil(3.5 * blur / fine));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) {
        kernel.push_back(std::exp(-0.5 * k * k * fine * fine / (blur * blur)));
        sum += kernel.back();
    }
    candidates_ = static_cast<std::size_t>(2.0 * reach / spacing_ + 1.5);
    stride_ = (candidates_ + 7) / 8 * 8;
    for (std::size_t c = 0; c < columns; ++c) {
        q_[c].assign(stride_ * static_cast<std::size_t>(samples), 0.0f);
        contrast_[c].assign(candidates_, 0.0);
    }
    for (std::size_t candidate = 0; candidate < candidates_; ++candidate) {
        const double e = first_ + spacing_ * double(candidate);
        std::array<std::vector<double>, columns> q;
        for (int j = 0; j < samples; ++j) {
            const double x = step * (j - inside);
            std::array<double, columns> value{};
            value[0] = 1.0;
            for (int k = -half; k <= half; ++k) {
                const double depth = e - (x + k * fine);
                if (depth <= 0.0) break;  // from here on outwards
                const double w = kernel[static_cast<std::size_t>(k + half)] / sum;
                value[1] += w;
                value[2] += w * std::sqrt(depth);
                if (bent) value[3] += w * depth;
            }
            for (std::size_t c = 0; c < columns; ++c) q[c].push_back(value[c]);
        }
        // Gram–Schmidt, twice for its rounding; `made` keeps q_c = Σ made[c][d] f_d.
        std::array<std::array<double, columns>, columns> made{};
        for (std::size_t c = 0; c < columns; ++c) {
            made[c][c] = 1.0;
            for (int twice = 0; twice < 2; ++twice)
                for (std::size_t d = 0; d < c; ++d) {
                    double product = 0.0;
                    for (std::size_t j = 0; j < q[c].size(); ++j) product += q[c][j] * q[d][j];
                    for (std::size_t j = 0; j < q[c].size(); ++j) q[c][j] -= product * q[d][j];
                    for (std::size_t m = 0; m < columns; ++m) made[c][m] -= product * made[d][m];
                }
            double norm = 0.0;
            for (const double v : q[c]) norm += v * v;
            norm = std::sqrt(norm);
            const double scale = norm > 1e-6 ? 1.0 / norm : 0.0;  // nothing of it in the window
            for (double& m : made[c]) m *= scale;
            for (std::size_t j = 0; j < q[c].size(); ++j) {
                q[c][j] *= scale;
                q_[c][j * stride_ + candidate] = static_cast<float>(q[c][j]);
            }
        }
        // Contrast: h + s √d averaged over the first three pixels inside.
        constexpr double depth = 3.0;
        for (std::size_t c = 0; c < columns; ++c)
            contrast_[c][candidate] =
                made[c][1] + 2.0 / 3.0 * std::sqrt(depth) * made[c][2] + 0.5 * depth * made[c][3];
    }
}

EdgeProfile::Edge EdgeProfile::find(const float* profile) const {
    const auto samples = static_cast<std::size_t>(inside_ + outside_ + 1);
    constexpr std::size_t maximum = 64;
    std::array<std::array<float, maximum>, columns> products;
    const std::size_t stride = std::min(stride_, maximum);
    for (std::size_t c = 0; c < columns; ++c) {
        float* const sum = products[c].data();
        for (std::size_t k = 0; k < stride; ++k) sum[k] = 0.0f;
        const float* q = q_[c].data();
        for (std::size_t j = 0; j < samples; ++j, q += stride_) {
            const float value = profile[j];
            for (std::size_t k = 0; k < stride; ++k) sum[k] += q[k] * value;
        }
    }
    Edge edge;
    std::array<float, maximum> explained{};
    std::size_t best = 0;
    for (std::size_t k = 0; k < candidates_; ++k) {
        for (std::size_t c = 0; c < columns; ++c) explained[k] += products[c][k] * products[c][k];
        if (explained[k] > explained[best]) best = k;
    }
    if (best == 0 || best + 1 == candidates_) return edge;
    const double before = double(explained[best - 1]), here = double(explained[best]),
                 after = double(explained[best + 1]);
    const double bend = before - 2.0 * here + after;
    edge.at =
        first_ + spacing_ * (double(best) + (bend < 0.0 ? 0.5 * (before - after) / bend : 0.0));
    double square = 0.0;
    for (std::size_t j = 0; j < samples; ++j) square += double(profile[j]) * double(profile[j]);
    edge.rest = std::max(0.0, square - here) / double(samples);
    for (std::size_t c = 0; c < columns; ++c)
        edge.contrast += double(products[c][best]) * contrast_[c][best];
    edge.sharpness = -bend / (spacing_ * spacing_);
    edge.found = true;
    return edge;
}

}  // namespace swirl
