// The mean of angles, for which 350° and 10° average to 0°: the direction of the sum of unit
// vectors.
//
//     C = Σ cos θ,  S = Σ sin θ,  θ̄ = angle of (C, S),  R̄ = √(C² + S²)/n
//
// R̄ is 1 if all angles agree and near 0 if they have no preferred direction (Mardia and Jupp,
// Directional Statistics, 2000, ch. 2). The error of θ̄ is that from blocks of periods, taken for
// independent. What scatters is the part of a block's sum across the mean,
// d_b = Σ_b sin(θ − θ̄), so
//
//     error² = n_b/(n_b − 1) Σ d_b² / (C² + S²)
//
// with the n_b blocks that have an angle.
//
// Units: radians, 0 ≤ θ̄ < 2π. Limits: no angles, or a sum of 0: NaN. Fewer than two blocks: the
// error is NaN. An error of more than about 1 means that there is no preferred direction.
#pragma once

#include <cmath>

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class CircularMean {
  public:
    /// Adds the direction of a vector with weight 1, independent of its length. A zero vector adds
    /// nothing.
    void add(const Vec2& v) {
        const double square = dot(v, v);
        if (!(square > 0.0)) return;
        const double inverse = 1.0 / square_root(square);
        c_ += v.x * inverse;
        s_ += v.y * inverse;
        n_ += 1.0;
    }
    /// Adds a whole block, the direction of the vector with its length as weight.
    void add_block(const Vec2& sum) {
        c_ = sum.x;
        s_ = sum.y;
        n_ = square_root(dot(sum, sum));
        close_block();
    }
    void close_block() {
        ++blocks_;
        used_ += n_ > 0.0 ? 1.0 : 0.0;
        C_ += c_;
        S_ += s_;
        CC_ += c_ * c_;
        CS_ += c_ * s_;
        SS_ += s_ * s_;
        N_ += n_;
        c_ = s_ = n_ = 0.0;
    }

    /// Mean angle in radians.
    Estimate angle() const {
        Estimate e;
        e.blocks = blocks_;
        e.effective_samples = used_;
        const double square = C_ * C_ + S_ * S_;
        if (!(square > 0.0)) return e;
        e.mean = 2.0 * pi * turns_of({C_, S_});
        e.weight = square_root(square);  // sums of vectors add up
        if (used_ < 2.0) return e;
        const double across = (CC_ * S_ * S_ - 2.0 * CS_ * C_ * S_ + SS_ * C_ * C_) / square;
        e.error = std::sqrt((across > 0.0 ? across : 0.0) * used_ / (used_ - 1.0) / square);
        return e;
    }
    /// R̄.
    double concentration() const {
        return N_ > 0.0 ? square_root(C_ * C_ + S_ * S_) / N_ : not_available;
    }
    double count() const { return N_; }
    void forget_blocks() {
        C_ = S_ = CC_ = CS_ = SS_ = N_ = used_ = 0.0;
        blocks_ = 0;
    }

    void merge(const CircularMean& o) {
        blocks_ += o.blocks_;
        used_ += o.used_;
        C_ += o.C_;
        S_ += o.S_;
        CC_ += o.CC_;
        CS_ += o.CS_;
        SS_ += o.SS_;
        N_ += o.N_;
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(c_, s_, n_, C_, S_, CC_, CS_, SS_, N_, used_, blocks_);
    }

  private:
    double c_ = 0.0, s_ = 0.0, n_ = 0.0;  // the open block
    double C_ = 0.0, S_ = 0.0, CC_ = 0.0, CS_ = 0.0, SS_ = 0.0, N_ = 0.0;
    double used_ = 0.0;  // blocks with an angle
    std::size_t blocks_ = 0;
};

}  // namespace swirl
