#include "track/video/edge_profile.hpp"

#include <algorithm>
#include <cmath>

#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

EdgeProfile::Columns EdgeProfile::terms(double e, bool bent) const {
    constexpr double kernel_step = 0.05;  // pixels: resolves the cusp of the square root
    constexpr double kernel_reach = 3.5;  // standard deviations
    const int half = static_cast<int>(std::ceil(kernel_reach * blur_ / kernel_step));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) {
        kernel.push_back(std::exp(-0.5 * k * k * kernel_step * kernel_step / (blur_ * blur_)));
        sum += kernel.back();
    }
    Columns q;
    for (int j = 0; j < inside_ + outside_ + 1; ++j) {
        const double x = step * (j - inside_);
        std::array<double, columns> value{1.0};
        for (int k = -half; k <= half; ++k) {
            const double depth = e - (x + k * kernel_step);
            if (depth <= 0.0) break;  // this and all further points lie outside the edge
            const double w = kernel[static_cast<std::size_t>(k + half)] / sum;
            value[1] += w;
            value[2] += w * std::sqrt(depth);
            if (bent) value[3] += w * depth;
        }
        for (std::size_t c = 0; c < columns; ++c) q[c].push_back(value[c]);
    }
    return q;
}

EdgeProfile::EdgeProfile(double blur, int inside, int outside, double reach, bool bent)
    : blur_(blur), inside_(inside), outside_(outside), first_(-reach) {
    constexpr std::size_t lanes = 8;    // candidates are padded to whole vector registers
    constexpr double vanishing = 1e-6;  // norm of a term that is zero within the window
    constexpr double contrast_depth =
        3.0;  // pixels inside the edge that the contrast averages over
    candidates_ = static_cast<std::size_t>(2.0 * reach / spacing + 1.5);
    stride_ = (candidates_ + lanes - 1) / lanes * lanes;
    for (std::size_t c = 0; c < columns; ++c) {
        q_[c].assign(stride_ * static_cast<std::size_t>(inside + outside + 1), 0.0f);
        contrast_[c].assign(candidates_, 0.0);
    }
    for (std::size_t candidate = 0; candidate < candidates_; ++candidate) {
        Columns q = terms(first_ + spacing * double(candidate), bent);
        // Gram–Schmidt, twice because of its rounding errors. `made` stores how the columns follow
        // from the terms f: q_c = Σ made[c][d] f_d.
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
            const double scale = norm > vanishing ? 1.0 / norm : 0.0;
            for (double& m : made[c]) m *= scale;
            for (std::size_t j = 0; j < q[c].size(); ++j) {
                q[c][j] *= scale;
                q_[c][j * stride_ + candidate] = static_cast<float>(q[c][j]);
            }
        }
        // The mean of h + s √d + t d over the depth: its integrals are 1, 2/3 √depth and depth/2.
        for (std::size_t c = 0; c < columns; ++c)
            contrast_[c][candidate] = made[c][1] +
                                      2.0 / 3.0 * std::sqrt(contrast_depth) * made[c][2] +
                                      0.5 * contrast_depth * made[c][3];
    }
}

EdgeProfile::Edge EdgeProfile::find(const float* profile) const {
    constexpr std::size_t max_candidates = 64;  // enough for a reach of 7 pixels
    const auto samples = static_cast<std::size_t>(inside_ + outside_ + 1);
    std::array<std::array<float, max_candidates>, columns> products;
    const std::size_t stride = std::min(stride_, max_candidates);
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
    std::array<float, max_candidates> explained{};
    std::size_t best = 0;
    for (std::size_t k = 0; k < candidates_; ++k) {
        for (std::size_t c = 0; c < columns; ++c) explained[k] += products[c][k] * products[c][k];
        if (explained[k] > explained[best]) best = k;
    }
    if (best == 0 || best + 1 == candidates_) return edge;
    const double before = double(explained[best - 1]), here = double(explained[best]),
                 after = double(explained[best + 1]);
    edge.position = first_ + spacing * (double(best) + vertex_offset(before, here, after));
    double square = 0.0;
    for (std::size_t j = 0; j < samples; ++j) square += double(profile[j]) * double(profile[j]);
    edge.residual = std::max(0.0, square - here) / double(samples);
    for (std::size_t c = 0; c < columns; ++c)
        edge.contrast += double(products[c][best]) * contrast_[c][best];
    edge.sharpness = -(before - 2.0 * here + after) / (spacing * spacing);
    edge.found = true;
    return edge;
}

}  // namespace swirl::tracking
