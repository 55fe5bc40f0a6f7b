// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The roughness power spectrum C(q), isotropic, in Persson's normalisation
//     <h²> = 2π ∫ q C(q) dq,   <|∇h|²> = 2π ∫ q³ C(q) dq.
//
// A power law with roll-off and the ring averages of a surface are both pieces on which C = c
// (q/qa)^n. On such a piece every moment has a closed form (a logarithm where the exponents cancel,
// as at H = 1), however wide or narrow the spectrum. Gaps are wavevectors that no piece covers.
// Units: any consistent set; q in 1/length, C in length⁴ (e.g. Å and Å⁴).
#pragma once

#include <span>
#include <vector>

namespace asperity::theory {

/// C constant for q_L <= q < q0, ∝ q^(-2(1+H)) for q0 <= q <= q1, zero otherwise.
struct SelfAffine {
    double q_L = 0, q0 = 0,
           q1 = 0;    ///< smallest, roll-off (q_L: none), largest wavevector [1/length]
    double hurst = 0; ///< H, usually 0..1
    double h_rms = 0; ///< rms roughness [length]
};

/// A wavevector and the moments of all roughness up to it.
struct Magnification {
    double q = 0;      ///< [1/length]
    double slope = 0;  ///< M3(q) = ∫ q³ C dq [1]
    double energy = 0; ///< M2(q) = ∫ q² C dq [length]
};

/// C = c (q/qa)^exponent on [qa, qb].
struct PowerLaw {
    double qa = 0, qb = 0, c = 0, exponent = 0;
};

class Spectrum {
public:
    /// Power law with roll-off, scaled to h_rms.
    static Spectrum self_affine(const SelfAffine& options);

    /// Ring averages of a surface: C[k] between edges[k] and edges[k+1]. The first edge is q_L even
    /// where C is zero there.
    static Spectrum rings(std::span<const double> edges, std::span<const double> C);

    /// The same shape at another roughness; 0 is smooth, and remembers the shape.
    [[nodiscard]] Spectrum with_rms_height(double h_rms) const;

    [[nodiscard]] double operator()(double q) const; ///< C(q) [length⁴]
    [[nodiscard]] double q_L() const { return q_smallest_; }
    [[nodiscard]] double q1() const { return q_largest_; }
    [[nodiscard]] double rms_height() const; ///< √(2π ∫ q C dq) [length]
    [[nodiscard]] double rms_slope() const;  ///< √(2π ∫ q³ C dq) [1]

    [[nodiscard]] Magnification at(double q) const;
    [[nodiscard]] Magnification last() const { return at(q_largest_); }
    /// At q = q_first e^L, q_first the smallest wavevector with any roughness: next to it the
    /// moments depend on the digits of L and not on those of q.
    [[nodiscard]] Magnification from_first(double L) const;

    /// ln(q/q_first) of the two ends and of the edges of gaps, ascending; first 0.
    [[nodiscard]] std::vector<double> edges() const;
    /// The whole spectrum.
    [[nodiscard]] std::vector<PowerLaw> pieces() const;

    [[nodiscard]] bool smooth() const { return flat_ || segments_.empty(); } ///< no roughness

private:
    struct Segment : PowerLaw {
        double log_width;             // ln(qb/qa)
        double height, energy, slope; // ∫ q^k C dq up to qa, k = 1, 2, 3
    };
    void append(double qa, double qb, double ca, double cb);
    void accumulate();
    [[nodiscard]] static double partial(const Segment& s, int k, double log_ratio);
    [[nodiscard]] static Magnification within(const Segment& s, double q, double log_ratio);
    [[nodiscard]] const Segment* segment_below(double q) const;

    double q_smallest_ = 0, q_largest_ = 0;
    double height_ = 0; // ∫ q C dq over everything
    bool flat_ = false; // scaled to zero: the segments hold the shape only
    std::vector<Segment> segments_;
};

} // namespace asperity::theory
