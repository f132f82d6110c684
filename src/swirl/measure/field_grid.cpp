#include "swirl/measure/field_grid.hpp"

#include <algorithm>

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

template <std::size_t n>
void add_scaled(std::array<double, n>& sum, const std::array<double, n>& other, double factor) {
    for (std::size_t k = 0; k < n; ++k) sum[k] += factor * other[k];
}
template <std::size_t n>
std::array<double, n> divided(const std::array<double, n>& sum, double weight) {
    std::array<double, n> mean{};
    for (std::size_t k = 0; k < n; ++k) mean[k] = weight > 0.0 ? sum[k] / weight : not_available;
    return mean;
}

/// Index of the first grid line at or after this distance from the first, in units of the spacing.
std::size_t grid_line(double at, std::size_t side) {
    const double line = std::ceil(at);
    if (!(line > 0.0)) return 0;
    return line < static_cast<double>(side) ? static_cast<std::size_t>(line) : side;
}

/// Delete-one-group jackknife: value of all, value without the group, and h = all weight / the
/// group's weight.
class Jackknife {
  public:
    explicit Jackknife(double whole) : whole_(whole) {}
    void add(double without, double h) {
        sum_ += (1.0 - 1.0 / h) * without;
        parts_.push_back({without, h});
    }
    double error() const {
        const auto groups = static_cast<double>(parts_.size());
        if (parts_.size() < 2) return not_available;
        const double mean = groups * whole_ - sum_;
        double square = 0.0;
        for (const Part& part : parts_) {
            const double pseudo = part.h * whole_ - (part.h - 1.0) * part.without;
            square += (pseudo - mean) * (pseudo - mean) / (part.h - 1.0);
        }
        return square_root(square / groups);
    }

  private:
    struct Part {
        double without, h;
    };
    double whole_, sum_ = 0.0;
    std::vector<Part> parts_;
};

}  // namespace

void FieldPoint::add(const FieldPoint& other, double factor) {
    add_scaled(values, other.values, factor);
    add_scaled(slopes_x, other.slopes_x, factor);
    add_scaled(slopes_y, other.slopes_y, factor);
    add_scaled(collisions, other.collisions, factor);
}

FieldValues field_values(const FieldPoint& sums, const FieldWeights& weights) {
    const double samples = weights.samples, duration = weights.duration;
    const auto v = divided(sums.values, samples);
    const auto gx = divided(sums.slopes_x, samples), gy = divided(sums.slopes_y, samples);
    const auto c = divided(sums.collisions, duration);
    const double n = v[0] > 0.0 ? v[0] : not_available;
    const double rho = v[1] > 0.0 ? v[1] : not_available;
    const double inertia = v[7] > 0.0 ? v[7] : not_available;
    const double ux = v[2] / rho, uy = v[3] / rho, spin = v[8] / inertia;
    const double dx_ux = (gx[1] - ux * gx[0]) / rho, dy_ux = (gy[1] - ux * gy[0]) / rho;
    const double dx_uy = (gx[2] - uy * gx[0]) / rho, dy_uy = (gy[2] - uy * gy[0]) / rho;
    const double kinetic_xx = -(v[4] - v[2] * ux), kinetic_xy = -(v[5] - v[2] * uy),
                 kinetic_yy = -(v[6] - v[3] * uy);
    return {v[1],
            v[12],
            v[2],
            v[3],
            ux,
            uy,
            -0.5 * (kinetic_xx + kinetic_yy) / n,
            v[8],
            spin,
            (v[9] - v[8] * spin) / n,
            dx_uy - dy_ux,
            dx_ux + dy_uy,
            0.5 * (dx_ux - dy_uy),
            0.5 * (dx_uy + dy_ux),
            (gx[4] - spin * gx[3]) / inertia,
            (gy[4] - spin * gy[3]) / inertia,
            -0.5 * (kinetic_xx + kinetic_yy + c[0] + c[3]),
            kinetic_xx,
            kinetic_xy,
            kinetic_yy,
            c[0],
            c[1],
            c[2],
            c[3],
            c[2] - c[1],
            -(v[10] - v[8] * ux),
            -(v[11] - v[8] * uy),
            c[4],
            c[5],
            c[6],
            c[7],
            c[8],
            sums.values[13] / weights.forces,
            sums.values[14] / weights.forces};
}

namespace {

/// At most as many points at once, in vectors of eight.
constexpr std::size_t batch = 16, lanes = 8;
constexpr std::size_t in_whole_vectors(std::size_t count) {
    return (count + lanes - 1) / lanes * lanes;
}

/// Points of one row, seen from a place: (x, y) of point k is (x[k], y). The last vector is full.
struct RowPoints {
    std::size_t count;
    double x[batch], y;
};

/// For each point q: W and its gradient.
struct RowKernel {
    double value[batch], gradient_x[batch], gradient_y[batch];
};
/// For each point q: B and B₁ of a line.
struct RowAverages {
    double whole[batch], weighted[batch];
};

/// What a disc adds: times W, and times each component of ∇W.
struct DiscTerms {
    double values[FieldPoint::disc_values], slopes[FieldPoint::disc_slopes];
};

// The same operations as CoarseKernel and line_average() have for one point, so the same bits.

SWIRL_WIDE void find_kernel(const CoarseKernel& kernel, const RowPoints& q, RowKernel& found) {
    const double square = kernel.width * kernel.width, height = kernel.height();
    for (std::size_t k = 0; k < in_whole_vectors(q.count); ++k) {
        const double part = 1.0 - (q.x[k] * q.x[k] + q.y * q.y) / square;
        const double slope = part > 0.0 ? -4.0 * height * part / square : 0.0;
        found.value[k] = part > 0.0 ? height * part * part : 0.0;
        found.gradient_x[k] = slope * q.x[k];
        found.gradient_y[k] = slope * q.y;
    }
}

SWIRL_WIDE void find_averages(const CoarseKernel& kernel, const RowPoints& q, const Vec2& line,
                              RowAverages& found) {
    const double width_square = kernel.width * kernel.width, height = kernel.height();
    const double a = line.x * line.x + line.y * line.y;
    for (std::size_t k = 0; k < in_whole_vectors(q.count); ++k) {
        const double x = q.x[k];
        const double b = x * line.x + q.y * line.y;
        const double c = x * x + q.y * q.y - width_square;
        const double square = b * b - a * c;
        const double root = __builtin_sqrt(square > 0.0 ? square : 0.0);
        const double far = b >= 0.0 ? b + root : b - root;
        const double one = far / a, other = c / far;
        const double first = b >= 0.0 ? other : one, last = b >= 0.0 ? one : other;
        // The line may be a point.
        const double begin = a == 0.0 || !(first > 0.0) ? 0.0 : first;
        const double end = a == 0.0 || !(last < 1.0) ? 1.0 : last;
        const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
        double whole = 0.0, weighted = 0.0;
        for (std::size_t n = 0; n < gauss_3.size(); ++n) {
            const double s = middle + half * gauss_3[n].at, weight = half * gauss_3[n].weight;
            const double dx = x - s * line.x, dy = q.y - s * line.y;
            const double part = 1.0 - (dx * dx + dy * dy) / width_square;
            const double value = weight * (part > 0.0 ? height * part * part : 0.0);
            whole = whole + value;
            weighted = weighted + s * value;
        }
        const bool is_inside = a == 0.0 ? c < 0.0 : square > 0.0 && begin < end;
        found.whole[k] = is_inside ? whole : 0.0;
        found.weighted[k] = is_inside ? weighted : 0.0;
    }
}

SWIRL_WIDE void add_disc(const DiscTerms& terms, const RowKernel& w, std::size_t count,
                         FieldPoint* points) {
    for (std::size_t k = 0; k < count; ++k) {
        if (w.value[k] == 0.0) continue;
        double* const values = points[k].values.data();
        double* const slopes_x = points[k].slopes_x.data();
        double* const slopes_y = points[k].slopes_y.data();
        const double value = w.value[k], x = w.gradient_x[k], y = w.gradient_y[k];
        for (std::size_t n = 0; n < FieldPoint::disc_values; ++n)
            values[n] += value * terms.values[n];
        for (std::size_t n = 0; n < FieldPoint::disc_slopes; ++n)
            slopes_x[n] += x * terms.slopes[n];
        for (std::size_t n = 0; n < FieldPoint::disc_slopes; ++n)
            slopes_y[n] += y * terms.slopes[n];
    }
}

}  // namespace

/// Calls visit(points, cell) for the points in the rectangle, row by row, in batches. The points
/// are seen from `origin`, and `cell` is that of the first.
template <class Visit>
void FieldGrid::for_each_row(const Vec2& low, const Vec2& high, const Vec2& origin,
                             const Visit& visit) const {
    const double scale = 1.0 / grid_.cell_width();
    const auto line = [&](double at) {
        return grid_line((at + grid_.half_width) * scale - 0.5, grid_.side);
    };
    // Written so that NaN selects no point.
    if (!(low.x <= high.x && low.y <= high.y)) return;
    const std::size_t begin = line(low.x), end = line(high.x), last_row = line(high.y);
    const double width = grid_.cell_width();
    const auto place = [&](std::size_t k) {
        return (static_cast<double>(k) + 0.5) * width - grid_.half_width;
    };
    RowPoints points;
    for (std::size_t row = line(low.y); row < last_row; ++row)
        for (std::size_t column = begin; column < end; column += batch) {
            points.count = std::min(batch, end - column);
            for (std::size_t k = 0; k < in_whole_vectors(points.count); ++k)
                points.x[k] = place(column + k) - origin.x;
            points.y = place(row) - origin.y;
            visit(points, row * grid_.side + column);
        }
}

void FieldGrid::add(const FieldDisc& d) {
    const double w = kernel_.width, spin = d.inertia * d.spin;
    const Vec2 p = d.mass * d.velocity;
    const DiscTerms terms{
        .values = {1.0, d.mass, p.x, p.y, p.x * d.velocity.x, p.x * d.velocity.y,
                   p.y * d.velocity.y, d.inertia, spin, spin * d.spin, spin * d.velocity.x,
                   spin * d.velocity.y, pi * d.radius * d.radius, d.force.x, d.force.y},
        .slopes = {d.mass, p.x, p.y, d.inertia, spin}};
    const auto add_row = [&](const RowPoints& points, std::size_t cell) {
        RowKernel w_of;
        find_kernel(kernel_, points, w_of);
        add_disc(terms, w_of, points.count, &open_.points[cell]);
    };
    for_each_row(d.position - Vec2{w, w}, d.position + Vec2{w, w}, d.position, add_row);
}

void FieldGrid::add(const Transfer& t) {
    const double w = kernel_.width;
    const Vec2 J = t.impulse, l = t.line, end = t.end();
    const Vec2 low{smaller(t.begin.x, end.x) - w, smaller(t.begin.y, end.y) - w};
    const Vec2 high{larger(t.begin.x, end.x) + w, larger(t.begin.y, end.y) + w};
    for_each_row(low, high, t.begin, [&](const RowPoints& points, std::size_t cell) {
        RowAverages average;
        find_averages(kernel_, points, l, average);
        for (std::size_t k = 0; k < points.count; ++k) {
            const double whole = average.whole[k], weighted = average.weighted[k];
            const double wall = t.at_wall ? -kernel_.value(grid_.centre_of(cell + k) - end) : 0.0;
            // Most points of the rectangle are outside the kernel, and sums would not change.
            if (whole == 0.0 && wall == 0.0) continue;
            const double couple = t.torque_i * (whole - weighted) - t.torque_j * weighted;
            const std::array<double, 9> values{
                -J.x * l.x * whole, -J.x * l.y * whole, -J.y * l.x * whole,
                -J.y * l.y * whole, l.x * couple,       l.y * couple,
                t.loss * whole,     wall * J.x,         wall * J.y};
            add_scaled(open_.points[cell + k].collisions, values, 1.0);
        }
    });
}

void FieldGrid::Sums::add(const Sums& other) {
    weights.add(other.weights);
    for (std::size_t k = 0; k < points.size(); ++k) points[k].add(other.points[k]);
}

void FieldGrid::join_neighbours(std::vector<Sums>& groups) {
    const std::size_t pairs = groups.size() / 2;
    for (std::size_t k = 0; k < pairs; ++k) {
        Sums joined = std::move(groups[2 * k]);
        joined.add(groups[2 * k + 1]);
        groups[k] = std::move(joined);
    }
    if (groups.size() % 2 == 1) groups[pairs] = std::move(groups.back());
    groups.resize(groups.size() - pairs);
}

/// Everything of the open period is added, except that collisions count only with close_events().
void FieldGrid::close_period() {
    if (groups_.empty() || periods_in_last_ == periods_per_group_) {
        if (groups_.size() + 1 == max_groups) {
            join_neighbours(groups_);
            // 15 groups: seven pairs and one that is half full.
            periods_per_group_ *= 2;
            periods_in_last_ = periods_per_group_ / 2;
        }
        if (groups_.empty() || periods_in_last_ == periods_per_group_) {
            groups_.emplace_back(grid_.cells());
            periods_in_last_ = 0;
        }
    }
    ++periods_in_last_;
    groups_.back().add(open_);
    open_ = Sums(grid_.cells());
}

void FieldGrid::close_events(double duration) {
    if (!groups_.empty()) groups_.back().weights.duration += duration;
}

std::array<Estimate, std::tuple_size_v<FieldValues>> FieldGrid::estimates(std::size_t cell) const {
    std::array<Estimate, std::tuple_size_v<FieldValues>> found;
    FieldWeights weights;
    FieldPoint whole;
    std::vector<const Sums*> groups;
    for (const auto* list : {&groups_, &merged_})
        for (const Sums& sums : *list) groups.push_back(&sums);
    for (const Sums* sums : groups) {
        weights.add(sums->weights);
        whole.add(sums->points[cell]);
    }
    const FieldValues values = field_values(whole, weights);
    std::vector<Jackknife> errors;
    for (const double value : values) errors.emplace_back(value);
    for (const Sums* sums : groups) {
        const double samples = sums->weights.samples;
        if (groups.size() < 2 || !(samples > 0.0)) continue;
        FieldPoint rest = whole;
        rest.add(sums->points[cell], -1.0);
        FieldWeights rest_weights = weights;
        rest_weights.add(sums->weights, -1.0);
        const FieldValues without = field_values(rest, rest_weights);
        for (std::size_t k = 0; k < values.size(); ++k)
            errors[k].add(without[k], weights.samples / samples);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
        found[k].mean = values[k];
        found[k].error = errors[k].error();
        found[k].blocks = groups.size();
        found[k].effective_samples = static_cast<double>(groups.size());
    }
    return found;
}

void FieldGrid::merge(const FieldGrid& other) {
    for (const auto* list : {&other.groups_, &other.merged_})
        merged_.insert(merged_.end(), list->begin(), list->end());
    // Bounded memory, however many runs are merged.
    while (merged_.size() > 4 * max_groups) join_neighbours(merged_);
}

}  // namespace swirl
