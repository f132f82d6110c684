#include "swirl/tracking/tilt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/tracking/outline.hpp"

namespace swirl {

namespace {

constexpr double stands_out = 4.0;   // standard errors
constexpr std::size_t minimum = 8;   // pictures
constexpr double close_to_it = 3.0;  // pixels about an outline that is known
constexpr double on_it = 1.0;        // pixels: an edge that may be the rim's
constexpr double sure_rim = 0.9;     // of the edges lie on it

/// Of one picture: the rim's middle without lens and tilt, and the edge as it is seen.
struct Outline {
    const Picture* picture;
    Vec2 centre;
    std::vector<Vec2> edge;
};

/// Squeeze and perspective (by the radius) that fit all outlines best, with the radius and the
/// middle of each.
class TiltFit {
  public:
    TiltFit(std::vector<Outline> outlines, const Lens& lens, const Vec2& swirl_centre,
            double amplitude, double radius, bool squeeze_known)
        : outlines_(std::move(outlines)),
          lens_(lens),
          swirl_centre_(swirl_centre),
          amplitude_(amplitude),
          radius_(radius),
          unit_(radius),
          squeeze_known_(squeeze_known) {}

    void run(Polarity polarity) {
        double window = std::max(close_to_it, 0.015 * radius_);
        for (int pass = 0; pass < 3; ++pass, window = close_to_it) {
            for (Outline& o : outlines_)
                o.edge = outline_edge(o.picture->sharp, lens_, {o.centre, radius_},
                                      {polarity, window, 3.0 * o.picture->noise});
            scale_ = window;
            for (int round = 0; round < 12; ++round) improve();
        }
    }
    const Lens& lens() const { return lens_; }
    /// Share of the edge of all pictures that lies on the outline.
    double support() const {
        std::size_t on = 0, all = 0;
        for (const Outline& o : outlines_)
            for (const Vec2& seen : o.edge) {
                ++all;
                if (std::abs(row_of(o, seen).rest) < on_it) ++on;
            }
        return all > 0 ? double(on) / double(all) : 0.0;
    }
    double radius() const { return radius_; }

    struct Errors {
        double squeeze, perspective;
    };
    Errors errors() {
        improve();  // for the normal equations at the end
        Global meat = Global::zeros();
        for (const GlobalVector& s : scores_) meat += s * s.t();
        const Global spread = inverse_ * meat * inverse_;
        const double outline = 2.0 * harmonics() / radius_, way = std::max(amplitude_, 1.0);
        const auto error = [&](int a) {
            return std::sqrt(0.5 * std::max(0.0, spread(a, a) + spread(a + 1, a + 1)));
        };
        return {std::hypot(error(0), outline), std::hypot(error(2) / unit_, outline / way)};
    }

  private:
    /// Squeeze, perspective, radius; and a squeeze that goes round with the dish, as what lies at
    /// its wall makes one, and as a distortion does that is not quite known.
    static constexpr int unknowns = 7;
    using Global = cv::Matx<double, unknowns, unknowns>;
    using GlobalVector = cv::Vec<double, unknowns>;
    using Own = cv::Matx<double, unknowns, 2>;

    struct Row {
        GlobalVector global;
        Vec2 n;
        double rest, weight;
    };

    Row row_of(const Outline& o, const Vec2& seen) const {
        const Vec2 p = lens_.ideal(seen) - lens_.middle, d = p - (o.centre - lens_.middle);
        const double far = length(d);
        const Vec2 n = (1.0 / far) * d;
        Row row;
        const Vec2 way = o.centre - swirl_centre_;
        const double along = dot(n, way), across = dot(n, perpendicular(way)), w = dot(way, way);
        row.global = {0.5 * (n.x * p.x - n.y * p.y),
                      0.5 * (n.x * p.y + n.y * p.x),
                      dot(n, p) * p.x / unit_,
                      dot(n, p) * p.y / unit_,
                      -1.0,
                      (along * along - across * across) / w,
                      2.0 * along * across / w};
        if (squeeze_known_) row.global[0] = row.global[1] = 0.0;
        row.n = n;
        row.rest = far - radius_ + turning_.x * row.global[5] + turning_.y * row.global[6];
        const double q = row.rest / (4.7 * scale_);
        row.weight = std::abs(q) < 1.0 ? (1.0 - q * q) * (1.0 - q * q) : 0.0;
        return row;
    }

    /// One step of Gauss–Newton. The middles are eliminated picture by picture.
    void improve() {
        Global normal = Global::zeros();
        GlobalVector right = GlobalVector::all(0.0);
        struct Middle {
            cv::Matx22d inverse;
            Own coupling;
            cv::Vec2d right;
        };
        std::vector<Middle> middles;
        std::vector<double> off;
        scores_.clear();
        for (const Outline& o : outlines_) {
            Global a = Global::zeros();
            Own b = Own::zeros();
            cv::Matx22d c = 1e-9 * cv::Matx22d::eye();
            GlobalVector ra = GlobalVector::all(0.0);
            cv::Vec2d rc(0.0, 0.0);
            for (const Vec2& seen : o.edge) {
                const Row row = row_of(o, seen);
                off.push_back(std::abs(row.rest));
                const cv::Vec2d own(-row.n.x, -row.n.y);
                a += row.weight * (row.global * row.global.t());
                b += row.weight * (row.global * own.t());
                c += row.weight * (own * own.t());
                ra += row.weight * row.rest * row.global;
                rc += row.weight * row.rest * own;
            }
            const Middle m{c.inv(), b, rc};
            normal += a - b * m.inverse * b.t();
            const GlobalVector score = ra - b * (m.inverse * rc);
            right += score;
            scores_.push_back(score);
            middles.push_back(m);
        }
        if (off.empty()) return;
        if (squeeze_known_) normal(0, 0) = normal(1, 1) = 1.0;
        inverse_ = normal.inv(cv::DECOMP_SVD);
        const GlobalVector d = -(inverse_ * right);
        lens_.squeeze = lens_.squeeze + Vec2{d[0], d[1]};
        lens_.perspective = lens_.perspective + (1.0 / unit_) * Vec2{d[2], d[3]};
        radius_ += d[4];
        turning_ = turning_ + Vec2{d[5], d[6]};
        for (std::size_t k = 0; k < outlines_.size(); ++k) {
            const cv::Vec2d own =
                -(middles[k].inverse * (middles[k].right + middles[k].coupling.t() * d));
            outlines_[k].centre = outlines_[k].centre + Vec2{own[0], own[1]};
        }
        scale_ = std::clamp(1.4826 * median(off), 0.05, close_to_it);
    }

    /// What the mean outline's coefficients of harmonic 3 … 8 let one expect of the second if they
    /// fall as 1/n: edges are off by what changes slowly round the dish, light and shade.
    double harmonics() const {
        constexpr int first = 3, last = 8;
        std::array<double, 2 * (last - first + 1)> sums{};
        double weight = 0.0;
        for (const Outline& o : outlines_)
            for (const Vec2& seen : o.edge) {
                const Row row = row_of(o, seen);
                const double angle = std::atan2(row.n.y, row.n.x);
                weight += row.weight;
                std::size_t at = 0;
                for (int n = first; n <= last; ++n) {
                    const double off = 0.5 * n * row.weight * row.rest;
                    sums[at++] += off * std::cos(n * angle);
                    sums[at++] += off * std::sin(n * angle);
                }
            }
        double square = 0.0;
        for (const double s : sums) square += 4.0 * s * s / (weight * weight);
        return weight > 0.0 ? std::sqrt(square / double(sums.size())) : 0.0;
    }

    std::vector<Outline> outlines_;
    Lens lens_;
    Vec2 swirl_centre_, turning_{0.0, 0.0};
    double amplitude_, radius_, unit_;
    bool squeeze_known_;
    double scale_ = 1.0;
    Global inverse_ = Global::zeros();
    std::vector<GlobalVector> scores_;
};

/// Half the angle of a squeeze, y up.
double direction_of(const Vec2& squeeze) { return 0.5 * std::atan2(-squeeze.y, squeeze.x); }

double length_of_squeeze(const Lens& lens) {
    return std::min(std::sqrt(dot(lens.squeeze, lens.squeeze)), 0.9);
}

Vec2 squeeze_of(double angle, double towards) {
    const double e = 1.0 - std::cos(angle);
    return e * Vec2{std::cos(2.0 * towards), -std::sin(2.0 * towards)};
}

/// By the squeeze alone.
Tilt squeezed(const Lens& lens, const TiltFit::Errors& errors) {
    Tilt tilt;
    tilt.squeeze_error = errors.squeeze;
    tilt.perspective_error = errors.perspective;
    const double e = length_of_squeeze(lens);
    tilt.below = std::acos(1.0 - std::min(e + 2.0 * errors.squeeze, 1.0));
    if (e < stands_out * errors.squeeze) return tilt;
    tilt.angle = std::acos(1.0 - e);
    tilt.angle_error = errors.squeeze / std::sin(tilt.angle);
    tilt.towards = direction_of(lens.squeeze);
    tilt.towards_error = 0.5 * errors.squeeze / e;
    return tilt;
}

/// The better one of two, or their mean where they err alike.
void combine(double other, double other_error, double& value, double& error) {
    const double a = 1.0 / (error * error), b = 1.0 / (other_error * other_error);
    value = (a * value + b * other) / (a + b);
    error = 1.0 / std::sqrt(a + b);
}

/// By the nearness of its sides too.
void add_perspective(const Lens& lens, bool focal_known, Tilt& tilt) {
    const double p = std::sqrt(dot(lens.perspective, lens.perspective));
    // The camera stands where things are nearer.
    const double nearer = std::atan2(lens.perspective.y, -lens.perspective.x);
    const double nearer_error = tilt.perspective_error / p;
    if (tilt.angle > 0.0) {
        if (std::cos(nearer - tilt.towards) < 0.0) tilt.towards += pi;
        const double apart = std::remainder(nearer - tilt.towards, 2.0 * pi);
        tilt.oval = std::abs(apart) > 0.3 &&
                    std::abs(apart) > stands_out * (nearer_error + tilt.towards_error);
        combine(tilt.towards + apart, nearer_error, tilt.towards, tilt.towards_error);
    } else {
        tilt.towards = nearer, tilt.towards_error = nearer_error;
    }
    if (focal_known) {
        const double other = std::asin(std::min(p / lens.nearness, 0.7));
        const double other_error = tilt.perspective_error / lens.nearness / std::cos(other);
        if (tilt.angle > 0.0)
            combine(other, other_error, tilt.angle, tilt.angle_error);
        else
            tilt.angle = other, tilt.angle_error = other_error;
    } else if (tilt.angle > 0.0) {
        const double tangent = lens.half * p / std::sin(tilt.angle);
        tilt.view_angle = 2.0 * std::atan(tangent);
        const double share = std::hypot(nearer_error, tilt.angle_error / std::tan(tilt.angle));
        tilt.view_angle_error = 2.0 * tangent / (1.0 + tangent * tangent) * share;
    }
}

std::vector<Outline> outlines_of(const std::vector<Picture>& pictures, const Rim& rim,
                                 const Lens& lens, double& radius) {
    std::vector<Outline> outlines;
    std::vector<double> radii;
    for (const Picture& picture : pictures) {
        const CircleFit seen = find_rim(picture, rim);
        if (!seen.good) continue;
        const Lens::Circle circle = lens.ideal(Lens::Circle{seen.centre, seen.radius});
        outlines.push_back({&picture, circle.centre, {}});
        radii.push_back(circle.radius);
    }
    radius = median(radii);
    return outlines;
}

/// With the distortion and the focal length that the lens has now.
Tilt fitted(const std::vector<Picture>& pictures, const KnownCamera& known, Rim& rim, Lens& lens) {
    double radius = 0.0;
    const auto outlines = outlines_of(pictures, rim, lens, radius);
    if (outlines.size() < minimum) return {};
    const Vec2 centre = lens.ideal(Lens::Circle{rim.swirl_centre, rim.radius}).centre;
    const auto fit_from = [&](double start) {
        TiltFit one(outlines, lens, centre, rim.amplitude, start, known.tilt.has_value());
        one.run(rim.polarity);
        return one;
    };
    TiltFit fit = fit_from(radius);
    // A circle through the image of a tilted rim may run between two edges of the wall.
    for (const double other : {0.975, 1.025, 0.95, 1.05}) {
        if (fit.support() > sure_rim) break;
        TiltFit one = fit_from(other * radius);
        if (one.support() > fit.support()) fit = std::move(one);
    }
    const TiltFit::Errors errors = fit.errors();
    Lens found = fit.lens();
    const bool nearer =
        std::sqrt(dot(found.perspective, found.perspective)) > stands_out * errors.perspective;
    if (!nearer) found.perspective = {0.0, 0.0};
    Tilt tilt = squeezed(found, errors);
    if (known.tilt) tilt.angle = *known.tilt, tilt.angle_error = 1e-6;
    if (known.tilt) tilt.towards = known.towards.value_or(0.0), tilt.towards_error = 1e-6;
    if (nearer) add_perspective(found, known.view_angle.has_value(), tilt);
    if (known.tilt) tilt.angle_error = tilt.towards_error = 0.0;
    found.squeeze = squeeze_of(tilt.angle, tilt.towards);
    lens = found;
    rim.radius = fit.radius();
    return tilt;
}

}  // namespace

Tilt find_tilt(const std::vector<Picture>& pictures, const KnownCamera& known, Rim& rim,
               Lens& lens) {
    constexpr double well_known = 0.2;  // of a view angle, for what it does to sizes
    const bool given = known.view_angle && *known.view_angle > 0.0;
    if (given) lens.nearness = std::tan(0.5 * *known.view_angle) / lens.half;
    lens.settle_distortion();
    if (known.tilt && *known.tilt == 0.0) return {};
    Lens straight = lens;
    // Balls tell to some per cent what the rim tells exactly once it is not taken for another edge.
    const Vec2& p = lens.apparent_perspective;
    if (std::sqrt(dot(p, p)) > stands_out * lens.apparent_error) straight.perspective = p;
    if (known.tilt) straight.squeeze = squeeze_of(*known.tilt, known.towards.value_or(0.0));
    const Rim seen = rim;
    lens = straight;
    Tilt tilt = fitted(pictures, known, rim, lens);
    if (!given && tilt.view_angle_error > 0.0 &&
        tilt.view_angle_error < well_known * tilt.view_angle) {
        straight.nearness = std::tan(0.5 * tilt.view_angle) / lens.half;
        straight.settle_distortion();
        lens = straight;
        rim = seen;
        tilt = fitted(pictures, known, rim, lens);
    }
    if (lens.tilted())
        rim.lens = lens;
    else
        rim = seen;
    return tilt;
}

}  // namespace swirl
