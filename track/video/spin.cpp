#include "track/video/spin.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/render/rotation_matrix.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/statistics/block_average.hpp"
#include "track/video/circles.hpp"
#include "track/video/video.hpp"

namespace swirl::tracking {

namespace {

constexpr double smoothing = 0.8;       // pixels: reduces noise and aliasing of gradients
constexpr double patch_reach = 0.9;     // radii: half width of a patch
constexpr double usable_radius = 0.75;  // radii: foreshortening limits the texture beyond
constexpr double min_match = 0.5;       // correlation
constexpr double min_error = 0.2;       // of a centre, pixels, in addition to that of the fit

using Vector = std::array<double, 3>;

Vector turned(const Rotation& r, const Vector& p) {
    return {r[0] * p[0] + r[1] * p[1] + r[2] * p[2], r[3] * p[0] + r[4] * p[1] + r[5] * p[2],
            r[6] * p[0] + r[7] * p[1] + r[8] * p[2]};
}

/// The part of an image around `centre`, resampled so that `centre` is its middle pixel.
cv::Mat patch_of(const cv::Mat& image, const Vec2& centre, double radius) {
    const int reach = int(std::ceil(patch_reach * radius)) + 1;
    const int side = 2 * reach + 1;
    cv::Mat across(side, side, CV_32FC2), patch;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            across.at<cv::Vec2f>(row, column) = {float(centre.x + column - reach),
                                                 float(centre.y + row - reach)};
    cv::remap(image, patch, across, cv::noArray(), cv::INTER_LANCZOS4, cv::BORDER_REPLICATE);
    return patch;
}

cv::Mat smoothed(const cv::Mat& grey) {
    cv::Mat image;
    grey.convertTo(image, CV_32F);
    cv::GaussianBlur(image, image, cv::Size(0, 0), smoothing, smoothing, cv::BORDER_REPLICATE);
    return image;
}

/// The mean image of discs of one radius, and a mask of the pixels with texture. Highlights are
/// saturated and do not turn, so they are masked out.
struct MeanDisc {
    cv::Mat mean, square, mask;
    int number = 0;
};
using MeanDiscs = std::map<double, MeanDisc>;

/// The texture of a disc: its image minus the mean image, scaled to its brightness.
cv::Mat texture_of(const cv::Mat& patch, const MeanDisc& mean) {
    cv::Mat known;
    mean.mask.convertTo(known, CV_32F);
    const cv::Mat weighed = mean.mean.mul(known);
    const double own = patch.dot(weighed), all = mean.mean.dot(weighed);
    return patch - (all > 0.0 ? own / all : 0.0) * mean.mean;
}

bool is_unmasked(const cv::Mat& mask, double x, double y) {
    const int column = int(x + 0.5), row = int(y + 0.5);
    return column >= 0 && row >= 0 && column < mask.cols && row < mask.rows &&
           mask.ptr<std::uint8_t>(row)[column] != 0;
}

struct Gradient {
    cv::Mat x, y;
    explicit Gradient(const cv::Mat& m) {
        cv::Sobel(m, x, CV_32F, 1, 0, 3, 1.0 / 8.0);
        cv::Sobel(m, y, CV_32F, 0, 1, 3, 1.0 / 8.0);
    }
};

/// The rotation that maps the texture `first` to `second`, and their correlation afterwards.
DiscSpin register_turn(const cv::Mat& first, const cv::Mat& second, const cv::Mat& mask,
                       const Gradient& slope, double radius, const Vector& initial_estimate,
                       double centre_error) {
    constexpr int unknowns = 5, rounds = 10;
    const double middle = 0.5 * (first.cols - 1);
    const int reach = int(usable_radius * radius);
    Vector w = initial_estimate;
    double shift_x = 0.0, shift_y = 0.0;
    DiscSpin best;
    for (int round = 0; round < rounds; ++round) {
        const Rotation r = rotation_by(w);
        cv::Matx<double, unknowns, unknowns> m = cv::Matx<double, unknowns, unknowns>::zeros();
        cv::Matx<double, unknowns, 1> b = cv::Matx<double, unknowns, 1>::zeros();
        double ab = 0.0, aa = 0.0, bb = 0.0, residual2 = 0.0;
        int count = 0;
        for (int v = -reach; v <= reach; ++v)
            for (int u = -reach; u <= reach; ++u) {
                const double X = u / radius, Y = -v / radius, q = X * X + Y * Y;
                if (q > usable_radius * usable_radius) continue;
                const Vector p = turned(r, {X, Y, std::sqrt(1.0 - q)});
                if (p[2] < 0.5) continue;
                if (!is_unmasked(mask, middle + u, middle + v) ||
                    !is_unmasked(mask, middle + radius * p[0], middle - radius * p[1]))
                    continue;
                // Linear between pixels, which is accurate enough because textures are smoothed.
                const Vec2 to{middle + radius * p[0] + shift_x, middle - radius * p[1] + shift_y};
                const double one = double(first.ptr<float>(v + int(middle))[u + int(middle)]);
                const double other = double(level_at(second, to));
                const double gx = double(level_at(slope.x, to)), gy = double(level_at(slope.y, to));
                // d(x, y) for a further rotation about x, y, z (ω × p), y down.
                const double rows[unknowns] = {
                    gy * radius * p[2],                        // p about x: p moves by (0, −z)
                    gx * radius * p[2],                        // p about y: p moves by (z, 0)
                    -gx * radius * p[1] - gy * radius * p[0],  // p about z: p moves by (−y, x)
                    gx, gy};
                const double residual = one - other;
                for (int i = 0; i < unknowns; ++i) {
                    for (int j = 0; j < unknowns; ++j) m(i, j) += rows[i] * rows[j];
                    b(i) += rows[i] * residual;
                }
                ab += one * other, aa += one * one, bb += other * other,
                    residual2 += residual * residual;
                ++count;
            }
        if (count < 40 || aa <= 0.0 || bb <= 0.0) return best;
        best.match = ab / std::sqrt(aa * bb);
        // Prior: the shift is zero within the error of the centres.
        const double weight = residual2 / count / (centre_error * centre_error);
        m(3, 3) += weight, m(4, 4) += weight;
        b(3) -= weight * shift_x, b(4) -= weight * shift_y;
        cv::Matx<double, unknowns, 1> d;
        if (!cv::solve(m, b, d, cv::DECOMP_CHOLESKY)) return best;
        for (std::size_t i = 0; i < 3; ++i) w[i] += d(int(i));
        shift_x += d(3), shift_y += d(4);
        if (std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]) > 2.0) return best;
        const double moved = std::abs(d(0)) + std::abs(d(1)) + std::abs(d(2));
        if (moved < 2e-4) break;
    }
    best.turn = w;
    best.known = best.match > min_match;
    return best;
}

/// A disc of one frame.
struct DiscPatch {
    std::int64_t id;
    double radius, error;
    cv::Mat texture, mask;
};

/// Masks pixels whose brightness varies less than usual between discs.
void mask_uniform_pixels(double radius, MeanDisc& all) {
    constexpr double minimum = 0.7;  // share of the median variation relative to the brightness
    all.mean /= all.number;
    all.square /= all.number;
    const int middle = all.mean.rows / 2;
    cv::Mat variation(all.mean.size(), CV_32F, cv::Scalar(0));
    std::vector<double> common;
    for (int row = 0; row < all.mean.rows; ++row)
        for (int column = 0; column < all.mean.cols; ++column) {
            const double x = column - middle, y = row - middle;
            if (x * x + y * y > usable_radius * usable_radius * radius * radius) continue;
            const double m = double(all.mean.at<float>(row, column));
            const double v = double(all.square.at<float>(row, column)) - m * m;
            const double share = std::sqrt(std::max(v, 0.0)) / std::max(m, 1.0);
            variation.at<float>(row, column) = float(share);
            common.push_back(share);
        }
    all.mask = variation > minimum * median(common);
}

/// Replaces the mean image by a polynomial of degree two in the surface normal (X, Y, Z), on which
/// the brightness of a matt sphere depends. The mean of a few dozen discs still contains residues
/// of their textures, which would bias rotations towards zero.
void smooth_shading(double radius, MeanDisc& all) {
    constexpr int terms = 8;
    using Row = cv::Vec<double, terms>;
    const int middle = all.mean.rows / 2;
    const auto row_at = [&](double x, double y) {
        const double X = x / radius, Y = y / radius;
        const double Z = std::sqrt(std::max(0.0, 1.0 - X * X - Y * Y));
        return Row{1.0, X, Y, Z, X * Y, X * X - Y * Y, X * Z, Y * Z};
    };
    cv::Matx<double, terms, terms> m = cv::Matx<double, terms, terms>::zeros();
    cv::Matx<double, terms, 1> b = cv::Matx<double, terms, 1>::zeros();
    for (int row = 0; row < all.mean.rows; ++row)
        for (int column = 0; column < all.mean.cols; ++column) {
            if (all.mask.at<std::uint8_t>(row, column) == 0) continue;
            const Row r = row_at(column - middle, row - middle);
            for (int i = 0; i < terms; ++i) {
                for (int j = 0; j < terms; ++j) m(i, j) += r[i] * r[j];
                b(i) += r[i] * double(all.mean.at<float>(row, column));
            }
        }
    cv::Matx<double, terms, 1> c;
    if (!cv::solve(m, b, c, cv::DECOMP_CHOLESKY)) return;
    for (int row = 0; row < all.mean.rows; ++row)
        for (int column = 0; column < all.mean.cols; ++column) {
            const Row r = row_at(column - middle, row - middle);
            double level = 0.0;
            for (int i = 0; i < terms; ++i) level += c(i) * r[i];
            all.mean.at<float>(row, column) = float(level);
        }
}

/// Masks pixels where the mean image `original` is brighter than its shading explains, and their
/// surroundings.
void mask_highlights(double radius, const cv::Mat& original, MeanDisc& all) {
    constexpr double brighter = 1.08;  // exceeds what textures leave in the mean
    constexpr double margin = 0.12;    // radii
    const cv::Mat highlights = original > brighter * all.mean;
    const int reach = std::max(1, int(std::lround(margin * radius)));
    const cv::Mat disc =
        cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
    cv::Mat wide;
    cv::dilate(highlights, wide, disc);
    all.mask.setTo(0, wide);
    original.copyTo(all.mean);
    smooth_shading(radius, all);
}

MeanDiscs mean_discs(const TrackedVideo& tracked, const TrackingSettings& settings) {
    constexpr std::int64_t frames = 40;  // frames in the mean
    const std::int64_t every = std::max<std::int64_t>(1, tracked.frame_count / frames);
    Video video(settings.video, every, settings.first_frame, tracked.reading);
    MeanDiscs means;
    cv::Mat grey;
    for (std::int64_t k = 0; k < tracked.frame_count && video.next(grey); k += every) {
        tracked.stabilise(std::size_t(k), grey);
        const cv::Mat image = smoothed(grey);
        const TrackFrame& f = tracked.tracks.frames[std::size_t(k)];
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const cv::Mat patch =
                patch_of(image, tracked.seen_by_lens(std::size_t(k), i), f.radius[i]);
            MeanDisc& all = means[f.radius[i]];
            if (all.number == 0) {
                all.mean = cv::Mat::zeros(patch.size(), CV_32F);
                all.square = all.mean.clone();
            }
            all.mean += patch;
            all.square += patch.mul(patch);
            ++all.number;
        }
    }
    for (auto& [radius, all] : means) {
        mask_uniform_pixels(radius, all);
        const cv::Mat original = all.mean.clone();
        for (int round = 0; round < 3; ++round) {
            smooth_shading(radius, all);
            mask_highlights(radius, original, all);
        }
    }
    return means;
}

std::vector<DiscPatch> disc_patches(const cv::Mat& image, const TrackedVideo& tracked,
                                    std::size_t k, const MeanDiscs& means) {
    std::vector<DiscPatch> patches;
    const TrackFrame& f = tracked.tracks.frames[k];
    for (std::size_t i = 0; i < f.id.size(); ++i) {
        const auto mean = means.find(f.radius[i]);
        if (mean == means.end()) continue;
        const cv::Mat patch = patch_of(image, tracked.seen_by_lens(k, i), f.radius[i]);
        patches.push_back({f.id[i], f.radius[i], tracked.errors[k][i],
                           texture_of(patch, mean->second), mean->second.mask});
    }
    return patches;
}

/// Rotation between two frames, in radians.
DiscSpin step_between(const DiscPatch& from, const DiscPatch& to) {
    constexpr double fast_turn = 0.25;  // rad: more than Gauss–Newton finds from 0
    const Gradient slope(to.texture);
    const double error = std::hypot(min_error + from.error, min_error + to.error);
    DiscSpin spin;
    for (const double start : {0.0, fast_turn, -fast_turn})
        if (!spin.known)
            spin = register_turn(from.texture, to.texture, to.mask, slope, from.radius,
                                 {0.0, 0.0, start}, error);
    return spin;
}

using Steps = std::vector<
    std::map<std::int64_t, DiscSpin>>;  // rotations for frame k, by disc ID: k to k + step

Steps measure_steps(const TrackedVideo& tracked, const TrackingSettings& settings, int step) {
    const MeanDiscs means = mean_discs(tracked, settings);
    Video video(settings.video, 1, settings.first_frame, tracked.reading);
    Steps steps(tracked.tracks.frames.size());
    std::vector<std::vector<DiscPatch>> recent(std::size_t(step) + 1);
    cv::Mat grey;
    for (std::size_t k = 0; k < steps.size() && video.next(grey); ++k) {
        settings.throw_if_stopped();
        if (settings.progress && k % 8 == 0)
            settings.progress("measuring spins", double(k) / double(steps.size()));
        tracked.stabilise(k, grey);
        std::vector<DiscPatch>& now = recent[k % recent.size()];
        now = disc_patches(smoothed(grey), tracked, k, means);
        if (k < std::size_t(step)) continue;
        const std::size_t begin = k - std::size_t(step);
        const std::vector<DiscPatch>& before = recent[begin % recent.size()];
        std::vector<std::pair<const DiscPatch*, const DiscPatch*>> pairs;
        for (const DiscPatch& a : before)
            for (const DiscPatch& b : now)
                if (a.id == b.id && a.texture.size() == b.texture.size())
                    pairs.emplace_back(&a, &b);
        std::vector<DiscSpin> found(pairs.size());
        parallel_for(
            pairs.size(),
            [&](std::size_t p) { found[p] = step_between(*pairs[p].first, *pairs[p].second); },
            settings.threads);
        for (std::size_t p = 0; p < pairs.size(); ++p) steps[begin][pairs[p].first->id] = found[p];
    }
    return steps;
}

/// Mean over the measured steps before and after frame k, per frame.
DiscSpin spin_at(const Steps& steps, std::size_t k, std::int64_t id, int step) {
    DiscSpin spin;
    double number = 0.0;
    const auto add = [&](std::size_t begin) {
        const auto found = steps[begin].find(id);
        if (found == steps[begin].end() || !found->second.known) return;
        const DiscSpin& s = found->second;
        for (std::size_t i = 0; i < 3; ++i) spin.turn[i] += s.turn[i] / step;
        spin.match += s.match;
        number += 1.0;
    };
    if (k >= std::size_t(step)) add(k - std::size_t(step));
    add(k);
    if (number == 0.0) return spin;
    for (double& w : spin.turn) w /= number;
    spin.match /= number;
    spin.known = true;
    return spin;
}

/// Interpolates spins in frames without a measurement; NaN for discs without any measurement.
void fill_gaps(const TrackedVideo& tracked, VideoSpins& spins) {
    std::map<std::int64_t, std::vector<std::pair<std::size_t, std::size_t>>> occurrences;
    for (std::size_t k = 0; k < spins.discs.size(); ++k)
        for (std::size_t i = 0; i < spins.discs[k].size(); ++i)
            occurrences[tracked.tracks.frames[k].id[i]].emplace_back(k, i);
    for (const auto& [id, where] : occurrences) {
        const auto spin = [&](std::size_t j) -> DiscSpin& {
            return spins.discs[where[j].first][where[j].second];
        };
        std::size_t last = where.size();
        for (std::size_t j = 0; j <= where.size(); ++j) {
            if (j < where.size() && !spin(j).known) continue;
            const std::size_t begin = last == where.size() ? 0 : last + 1;
            for (std::size_t g = begin; g < j; ++g) {
                if (last == where.size() && j == where.size()) {
                    spin(g).turn.fill(not_available);
                    continue;
                }
                const Vector &a = spin(last == where.size() ? j : last).turn,
                             &b = spin(j == where.size() ? last : j).turn;
                const double u = double(g + 1 - begin) / double(j - begin + 1);
                for (std::size_t n = 0; n < 3; ++n) spin(g).turn[n] = (1.0 - u) * a[n] + u * b[n];
            }
            last = j;
        }
    }
}

}  // namespace

VideoSpins measure_spins(const TrackedVideo& tracked, const TrackingSettings& settings) {
    constexpr double steps_per_period = 32.0;
    const double frames_per_period = 2.0 * pi / tracked.path.omega / tracked.step();
    VideoSpins spins;
    spins.step = std::max(1, int(std::lround(frames_per_period / steps_per_period)));
    const Steps steps = measure_steps(tracked, settings, spins.step);
    std::vector<double> matches;
    std::size_t all = 0, known = 0;
    for (const auto& here : steps)
        for (const auto& [id, spin] : here) {
            matches.push_back(spin.match);
            ++all;
            known += spin.known ? 1 : 0;
        }
    spins.measured = all ? double(known) / double(all) : 0.0;
    spins.match = median(matches);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        std::vector<DiscSpin> here;
        for (const std::int64_t id : tracked.tracks.frames[k].id)
            here.push_back(spin_at(steps, k, id, spins.step));
        spins.discs.push_back(std::move(here));
    }
    fill_gaps(tracked, spins);
    return spins;
}

}  // namespace swirl::tracking
