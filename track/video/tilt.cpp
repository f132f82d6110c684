#include "track/video/tilt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "swirl/math/unit_circle.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/container_rim.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr double tilt_stands_out = 4.0;  // standard errors

/// The rim in one frame.
struct RimOutline {
    const PreparedFrame* frame;
    Vec2 seen, centre;       // centre in the image, and without lens and tilt
    std::vector<Vec2> edge;  // edge as seen
};

/// Squeeze, perspective and rolling shutter that fit all outlines best, with the radius and the
/// centre of each.
class TiltFit {
  public:
    TiltFit(std::vector<RimOutline> outlines, const Lens& lens, const ContainerRim& rim,
            double radius, bool squeeze_known, bool rolls) {
        outlines_ = std::move(outlines), lens_ = lens, amplitude_ = rim.amplitude;
        radius_ = unit_ = radius, squeeze_known_ = squeeze_known, rolls_ = rolls;
        path_centre_ = lens.ideal(Lens::Circle{rim.path_centre, rim.radius}).centre;
        run(rim.polarity);
    }

    void run(Polarity polarity) {
        constexpr int rounds = 3, passes = 12;  // edges, and steps of Gauss–Newton
        constexpr double first_window = 0.015;  // radii: how far a tilted rim is off a circle
        constexpr double noise_factor = 3.0;    // standard deviations: least slope of an edge
        double window = std::max(known_window, first_window * radius_);
        for (int round = 0; round < rounds; ++round, window = known_window) {
            for (RimOutline& o : outlines_)
                o.edge = outline_edge(o.frame->sharp, lens_of(o), {o.centre, radius_},
                                      {polarity, window, noise_factor * o.frame->noise});
            scale_ = window;
            for (int pass = 0; pass < passes; ++pass) improve();
        }
    }
    const Lens& lens() const { return lens_; }
    double radius() const { return radius_; }
    /// Share of the edge points of all frames that lie on the outline.
    double support() const {
        constexpr double tolerance = 1.0;  // pixels
        std::size_t on = 0, all = 0;
        for (const RimOutline& o : outlines_)
            for (const Vec2& seen : o.edge) {
                ++all;
                if (std::abs(row_of(o, seen).residual) < tolerance) ++on;
            }
        return all > 0 ? double(on) / double(all) : 0.0;
    }

    struct Errors {
        double squeeze, perspective, shutter;
    };
    Errors errors() {
        improve();  // call for the final normal equations
        Global meat = Global::zeros();
        for (const GlobalVector& s : scores_) meat += s * s.t();
        const Global covariance = inverse_ * meat * inverse_;
        const double outline = 2.0 * harmonics() / radius_,
                     way = std::max(amplitude_, min_path_amplitude);
        const auto error = [&](int a) {
            return std::sqrt(0.5 * std::max(0.0, covariance(a, a) + covariance(a + 1, a + 1)));
        };
        // The arm of the shutter is that of the rim as seen: an error of second order.
        const double arm = amplitude_ * length(lens_.shutter);
        return {std::hypot(error(0), outline, arm * arm),
                std::hypot(error(2) / unit_, outline / way),
                std::hypot(error(7) / unit_, outline / way)};
    }

  private:
    static constexpr double known_window = 3.0;  // pixels about an outline that is known
    static constexpr double min_scale = 0.05;    // pixels: exact edges would give 0
    static constexpr double cutoff = 4.7;        // cutoff of Tukey's weights, standard deviations

    /// Squeeze (2), perspective (2, times `unit_`), radius, and a squeeze that goes round with the
    /// container (2): discs at the wall cause it, and so does an error of the distortion. Shutter
    /// (2, times `unit_`).
    static constexpr int unknowns = 9;
    using Global = cv::Matx<double, unknowns, unknowns>;
    using GlobalVector = cv::Vec<double, unknowns>;
    using Coupling = cv::Matx<double, unknowns, 2>;

    struct Row {
        GlobalVector global;
        Vec2 n;
        double residual, weight;
    };

    Lens lens_of(const RimOutline& o) const {
        return lens_.in_frame(o.seen, o.centre - path_centre_);
    }

    Row row_of(const RimOutline& o, const Vec2& seen) const {
        const Lens lens = lens_of(o);
        const Vec2 p = lens.ideal(seen) - lens.image_centre,
                   d = p - (o.centre - lens_.image_centre);
        const double distance = length(d);
        const Vec2 n = (1.0 / distance) * d;
        Row row;
        const Vec2 way = o.centre - path_centre_;
        const double along = dot(n, way), across = dot(n, perpendicular(way)), w = dot(way, way);
        const double along_path = rolls_ ? -dot(n, perpendicular(lens.arm)) / unit_ : 0.0;
        const Vec2 later = along_path * (seen - lens.pivot);
        row.global = {0.5 * (n.x * p.x - n.y * p.y),
                      0.5 * (n.x * p.y + n.y * p.x),
                      dot(n, p) * p.x / unit_,
                      dot(n, p) * p.y / unit_,
                      -1.0,
                      (along * along - across * across) / w,
                      2.0 * along * across / w,
                      later.x,
                      later.y};
        if (squeeze_known_) row.global[0] = row.global[1] = 0.0;
        row.n = n;
        row.residual = distance - radius_ + rotating_squeeze_.x * row.global[5] +
                       rotating_squeeze_.y * row.global[6];
        row.weight = tukey_weight(row.residual / (cutoff * scale_));
        return row;
    }

    /// One step of Gauss–Newton. The centres are eliminated frame by frame.
    void improve() {
        constexpr double regularisation = 1e-9;  // keeps the matrix invertible without edges
        Global normal = Global::zeros();
        GlobalVector right = GlobalVector::all(0.0);
        struct Centre {
            cv::Matx22d inverse;
            Coupling coupling;
            cv::Vec2d right;
        };
        std::vector<Centre> centres;
        std::vector<double> off;
        scores_.clear();
        for (const RimOutline& o : outlines_) {
            Global a = Global::zeros();
            Coupling b = Coupling::zeros();
            cv::Matx22d c = regularisation * cv::Matx22d::eye();
            GlobalVector ra = GlobalVector::all(0.0);
            cv::Vec2d rc(0.0, 0.0);
            for (const Vec2& seen : o.edge) {
                const Row row = row_of(o, seen);
                off.push_back(std::abs(row.residual));
                const cv::Vec2d own(-row.n.x, -row.n.y);
                a += row.weight * (row.global * row.global.t());
                b += row.weight * (row.global * own.t());
                c += row.weight * (own * own.t());
                ra += row.weight * row.residual * row.global;
                rc += row.weight * row.residual * own;
            }
            const Centre m{c.inv(), b, rc};
            normal += a - b * m.inverse * b.t();
            const GlobalVector score = ra - b * (m.inverse * rc);
            right += score;
            scores_.push_back(score);
            centres.push_back(m);
        }
        if (off.empty()) return;
        if (squeeze_known_) normal(0, 0) = normal(1, 1) = 1.0;
        if (!rolls_) normal(7, 7) = normal(8, 8) = 1.0;
        inverse_ = normal.inv(cv::DECOMP_SVD);
        const GlobalVector d = -(inverse_ * right);
        lens_.squeeze = lens_.squeeze + Vec2{d[0], d[1]};
        lens_.perspective = lens_.perspective + (1.0 / unit_) * Vec2{d[2], d[3]};
        radius_ += d[4];
        rotating_squeeze_ = rotating_squeeze_ + Vec2{d[5], d[6]};
        lens_.shutter = lens_.shutter + (1.0 / unit_) * Vec2{d[7], d[8]};
        for (std::size_t k = 0; k < outlines_.size(); ++k) {
            const cv::Vec2d own =
                -(centres[k].inverse * (centres[k].right + centres[k].coupling.t() * d));
            outlines_[k].centre = outlines_[k].centre + Vec2{own[0], own[1]};
        }
        scale_ = std::clamp(mad_to_sigma * median(off), min_scale, known_window);
    }

    /// The second harmonic to be expected from the harmonics 3 … 8 of the mean outline, if they
    /// fall as 1/n: light and shade shift an edge by amounts that change slowly along the rim.
    double harmonics() const {
        constexpr int first = 3, last = 8;
        std::array<double, 2 * (last - first + 1)> sums{};
        double weight = 0.0;
        for (const RimOutline& o : outlines_)
            for (const Vec2& seen : o.edge) {
                const Row row = row_of(o, seen);
                const double angle = std::atan2(row.n.y, row.n.x);
                weight += row.weight;
                std::size_t at = 0;
                for (int n = first; n <= last; ++n) {
                    const double off = 0.5 * n * row.weight * row.residual;
                    sums[at++] += off * std::cos(n * angle);
                    sums[at++] += off * std::sin(n * angle);
                }
            }
        double square = 0.0;
        for (const double s : sums) square += 4.0 * s * s / (weight * weight);
        return weight > 0.0 ? std::sqrt(square / double(sums.size())) : 0.0;
    }

    std::vector<RimOutline> outlines_;
    Lens lens_;
    Vec2 path_centre_, rotating_squeeze_{0.0, 0.0};
    double amplitude_, radius_, unit_;  // unit_: the initial radius
    bool squeeze_known_, rolls_;
    double scale_ = 1.0;
    Global inverse_ = Global::zeros();
    std::vector<GlobalVector> scores_;  // scores of each frame
};

Vec2 squeeze_of(double angle, double towards) {
    const double e = 1.0 - std::cos(angle);
    return e * Vec2{std::cos(2.0 * towards), -std::sin(2.0 * towards)};
}

/// The tilt by the squeeze alone.
Tilt tilt_by_squeeze(const Lens& lens, const TiltFit::Errors& errors) {
    constexpr double max_squeeze = 0.9;  // keeps the arc cosine of a failed fit finite
    Tilt tilt;
    tilt.squeeze_error = errors.squeeze;
    tilt.perspective_error = errors.perspective;
    const double e = std::min(length(lens.squeeze), max_squeeze);
    tilt.below = std::acos(1.0 - std::min(e + 2.0 * errors.squeeze, 1.0));
    if (e < tilt_stands_out * errors.squeeze) return tilt;
    tilt.angle = std::acos(1.0 - e);
    tilt.angle_error = errors.squeeze / std::sin(tilt.angle);
    tilt.towards = 0.5 * std::atan2(-lens.squeeze.y, lens.squeeze.x);  // half the angle, y up
    tilt.towards_error = 0.5 * errors.squeeze / e;
    return tilt;
}

/// Sets the direction in which the camera stands: where things are nearer, within the line of the
/// squeeze.
void add_perspective(const Lens& lens, Tilt& tilt) {
    constexpr double min_oval = 0.3;  // rad between the two directions of a container not round
    const double nearer = std::atan2(lens.perspective.y, -lens.perspective.x);
    const double nearer_error = tilt.perspective_error / length(lens.perspective);
    if (tilt.angle == 0.0) {
        tilt.towards = nearer, tilt.towards_error = nearer_error;
        return;
    }
    if (std::cos(nearer - tilt.towards) < 0.0) tilt.towards += pi;
    const double apart = std::abs(std::remainder(nearer - tilt.towards, 2.0 * pi));
    tilt.oval = apart > min_oval && apart > tilt_stands_out * (nearer_error + tilt.towards_error);
}

std::vector<RimOutline> rim_outlines(const std::vector<PreparedFrame>& frames,
                                     const ContainerRim& rim, const Lens& lens, double& radius) {
    std::vector<RimOutline> outlines;
    std::vector<double> radii;
    for (const PreparedFrame& frame : frames) {
        const CircleFit seen = find_container_rim(frame, rim);
        if (!seen.good) continue;
        const Lens::Circle circle = lens.ideal(Lens::Circle{seen.centre, seen.radius});
        outlines.push_back({&frame, seen.centre, circle.centre, {}});
        radii.push_back(circle.radius);
    }
    radius = median(radii);
    return outlines;
}

/// A shutter reads rows or columns of the image: sets the other component to 0. False if there is
/// none: it does not stand out from its error, or has no such direction.
bool set_shutter(double error, Lens& lens) {
    constexpr double max_slant = 0.1;
    Vec2& s = lens.shutter;
    const bool rows = std::abs(s.y) > std::abs(s.x);
    const double along = std::abs(rows ? s.y : s.x), across = std::abs(rows ? s.x : s.y);
    if (along < tilt_stands_out * error ||
        across > std::max(tilt_stands_out * error, max_slant * along))
        return false;
    (rows ? s.x : s.y) = 0.0;
    lens.shutter_error = error;
    return true;
}

/// The tilt with the present distortion and focal length of `lens`.
Tilt fit_tilt(const std::vector<PreparedFrame>& frames, const KnownCamera& known, ContainerRim& rim,
              Lens& lens) {
    constexpr std::size_t min_frames = 8;  // fewer do not go round
    constexpr double good_support = 0.9;   // share of the edge points: no other start is better
    constexpr double exact = 1e-6;         // error of a given angle, rad: outweighs a fitted one
    double radius = 0.0;
    const auto outlines = rim_outlines(frames, rim, lens, radius);
    if (outlines.size() < min_frames) return {};
    const auto best_fit = [&](bool rolls) {
        TiltFit fit(outlines, lens, rim, radius, known.tilt.has_value(), rolls);
        // The circle that fits a tilted rim may lie between two edges of the wall.
        for (const double ratio : {0.975, 1.025, 0.95, 1.05}) {
            if (fit.support() > good_support) break;
            TiltFit other(outlines, lens, rim, ratio * radius, known.tilt.has_value(), rolls);
            if (other.support() > fit.support()) fit = std::move(other);
        }
        return fit;
    };
    TiltFit fit = best_fit(rim.amplitude > 0.0);
    TiltFit::Errors errors = fit.errors();
    Lens found = fit.lens();
    if (rim.amplitude > 0.0 && !set_shutter(errors.shutter, found)) {
        fit = best_fit(false);
        errors = fit.errors();
        found = fit.lens();
    }
    const bool perspective = length(found.perspective) > tilt_stands_out * errors.perspective;
    if (!perspective) found.perspective = {0.0, 0.0};
    Tilt tilt = tilt_by_squeeze(found, errors);
    if (known.tilt) {
        tilt.angle = *known.tilt, tilt.angle_error = exact;
        tilt.towards = known.towards.value_or(0.0), tilt.towards_error = exact;
    }
    if (perspective) add_perspective(found, tilt);
    if (known.tilt) tilt.angle_error = tilt.towards_error = 0.0;
    found.squeeze = squeeze_of(tilt.angle, tilt.towards);
    lens = found;
    rim.radius = fit.radius();
    return tilt;
}

}  // namespace

Tilt find_tilt(const std::vector<PreparedFrame>& frames, const KnownCamera& known,
               ContainerRim& rim, Lens& lens) {
    if (known.tilt && *known.tilt == 0.0) return {};
    Lens start = lens;
    // The sizes of balls give the perspective to a few per cent. This start keeps the fit from
    // taking another edge for the rim, which then gives it exactly.
    const Vec2& p = lens.size_perspective;
    if (length(p) > tilt_stands_out * lens.size_perspective_error) start.perspective = p;
    if (known.tilt) start.squeeze = squeeze_of(*known.tilt, known.towards.value_or(0.0));
    const ContainerRim seen = rim;
    lens = start;
    const Tilt tilt = fit_tilt(frames, known, rim, lens);
    if (lens.tilted() || lens.rolls())
        rim.lens = lens;
    else
        rim = seen;
    return tilt;
}

}  // namespace swirl::tracking
