// The search for N_c: which runs to make next, from the results so far. It makes no run itself:
// next() proposes the runs of a step, take() receives their results. `swirl crossing`, `swirl map`,
// Python and the browser page share it. Definition of N_c and its interval: zero_crossing.hpp.
//
// 1. Coarse scan: `seeds` runs with different seeds at about `coarse_numbers` numbers of discs in
//    the range, or at the numbers of `start`. If these do not bracket N_c, the scan goes beyond
//    them, and finally covers the range.
// 2. Narrowing: runs at the middle of each bracket, until every number in it has runs. This is done
//    for all curves.
// 3. Plan: the numbers in the bracket of N_c get the runs that the tolerance needs, and no more
//    (below), in at most `rounds` batches. A number outside of every bracket whose sign is not
//    certain gets runs until it is, at most `sign_length` times its first ones.
//
// The plan. The numbers of the bracket give a line by weighted least squares, with the slope b and
// the zero x_0, and the variance v of a mean over one unit of length. Let N ≤ x_0 < N + 1 and
// f = x_0 − N. N_c is the zero of the line between the means of N and N + 1, so that runs of the
// lengths T_N and T_{N+1} determine it with the variance
//
//     σ² = v [(1 − f)²/T_N + f²/T_{N+1}] / b².
//
// For a given sum T of both lengths it is smallest for T_N = (1 − f) T and T_{N+1} = f T. It is
// then v/(T b²), and the square of the tolerance gives T. All other numbers of the bracket, at the
// distance d from x_0, are there because their sign is uncertain. Their mean is expected to be b d,
// so they need the length v (planned_sign/(b d))², or at most T.
//
// What the plan knows is uncertain itself. So a batch makes a group at most `growth` times as long,
// and the next one is planned from all runs. Lengths follow from the line, not from the mean of the
// group alone. If each group got runs until its own sign is certain, it would stop where chance
// moves it away from zero, and the interval of N_c would be too narrow.
//
// A batch adds `seeds` runs at a number, of equal length. If the replicates at a number scatter
// more than their errors explain, longer runs do not help, for example because each seed draws
// other sizes. From then on, a batch there has more runs of the same length. Without `longer_runs`,
// this holds from the start.
//
// After each step the search narrows again. One curve (`rate`) controls step 3; the others are
// evaluated from the same runs. The runs at a number near N_c depend on the runs made there,
// not on the range. Therefore two ranges find the same N_c if they contain its bracket with certain
// signs. If the bracket ends at the end of the range, with an undetermined sign, the replicates
// differ, and N_c agrees within its error.
//
// A failed run is excluded and counted. A number of discs at which every run failed has no point.
// If it lies in a bracket, N_c is not determined.
//
// Runs at one number of discs are combined with their lengths as weights (replicates.hpp). What is
// proposed depends on the rules and the results alone, not on the order in which a step's results
// come. So a search can be repeated from stored results.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "swirl/statistics/replicates.hpp"
#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {

/// A batch makes a group at most so many times as long. The plan is then made again.
inline constexpr double growth = 4.0;
/// Errors from zero for which the plan makes a sign certain: three would succeed in half of all
/// cases.
inline constexpr double planned_sign = 4.0;

/// Default maximum of runs at one number of discs.
inline constexpr std::int64_t max_search_runs = 1000;

struct CrossingRules {
    std::int64_t from = 5, to = 48;    // numbers of discs
    double tolerance = 0.3;            // target standard error of N_c
    std::size_t curves = 1, rate = 0;  // number of curves, and the one that controls the search
    std::int64_t seeds = 3;            // runs of one step at one number of discs
    std::int64_t max_runs = max_search_runs;  // most runs at one number of discs
    int rounds = 10;                          // most batches of step 3 at one number of discs
    /// Most runs outside of the brackets, relative to the first ones.
    double sign_length = 32.0;
    bool longer_runs = true;
    std::set<std::int64_t> start = {};  // replaces the numbers of the coarse scan
    std::int64_t coarse_numbers = 8;
    std::int64_t step = 0;     // step of the coarse scan in discs; 0: coarse_numbers
    std::int64_t at_once = 1;  // so many missing numbers of a bracket are run together
    bool every_change = true;  // otherwise only the bracket of N_c is narrowed
};

/// A run that the search proposes. Its length is a multiple of that of the first runs.
struct ProposedRun {
    std::int64_t discs, replica, length;
};

/// The result of a run: its mean by each curve, and its length (in any unit).
struct SearchedRun {
    std::vector<Estimate> rates;
    double length;
};

class CrossingSearch {
  public:
    /// The runs at one number of discs.
    struct Group {
        std::vector<SearchedRun> finished = {};
        std::int64_t failed = 0;
        /// Length of all finished runs, in that of a first run.
        std::int64_t length = 0;
        double wanted = 0.0;         // the length that the plan wants; 0 if it is long enough
        std::int64_t next_runs = 0;  // runs of the next batch, and the length of each
        std::int64_t next_length = 1;
        int rounds = 0;         // batches after the first runs
        bool scatters = false;  // the replicates disagree, so more runs are no longer
        std::int64_t attempted() const { return std::int64_t(finished.size()) + failed; }
    };
    using Numbers = std::set<std::int64_t>;  // numbers of discs

    explicit CrossingSearch(CrossingRules rules) : rules_(std::move(rules)) {}

    /// The runs of the next step; those with many discs come first, because they take longest.
    /// Empty at the end of the search. Needs the results of all runs proposed before.
    std::vector<ProposedRun> next();
    /// "coarse scan", "narrowing" or "more runs": the step of the last proposal.
    const char* stage() const { return stage_; }

    /// The result of a proposed run; null if it failed. At one number of discs in ascending order
    /// of the replicas.
    void take(const ProposedRun& run, const SearchedRun* result);

    /// A larger range or more runs at one number: the search continues.
    void extend(std::int64_t from, std::int64_t to, std::int64_t max_runs);

    const std::map<std::int64_t, Group>& groups() const { return groups_; }  // key: number of discs
    Ensemble combined(const Group& group, std::size_t rate) const;
    /// The points of a curve; numbers without a finished run have none.
    std::vector<RotationPoint> curve(std::size_t rate) const;
    Crossing crossing(std::size_t rate) const { return find_crossing(curve(rate)); }
    /// Of the controlling curve.
    Crossing crossing() const { return crossing(rules_.rate); }
    bool is_within_tolerance() const { return is_within_tolerance(crossing()); }
    /// The numbers in the bracket of N_c; all numbers if there is no bracket.
    Numbers decisive_numbers(const Crossing& crossing) const;

  private:
    /// ϖ/Ω near N_c, and the variance of a mean over the length of one first run.
    struct Line {
        double slope, zero, variance;
    };

    Numbers coarse_numbers() const;
    Numbers missing_in_brackets() const;
    Numbers beyond_the_scan(const Crossing& crossing) const;
    void plan_signs(const Crossing& crossing);
    void plan_bracket(const Crossing& crossing);
    bool has_rounds_left(const Group& group) const;
    bool is_within_tolerance(const Crossing& crossing) const;
    /// True if the group has a run and is in this bracket.
    static bool takes_part(const SignChange& change, std::int64_t number, const Group& group);
    Line line_in(const SignChange& change) const;
    void begin_round(Group& group) const;
    std::vector<ProposedRun> runs_at(const char* stage, const Numbers& numbers);

    CrossingRules rules_;
    const char* stage_ = "coarse scan";
    std::map<std::int64_t, Group> groups_;
};

}  // namespace swirl
