"""Against published theory: does a gas of rough discs cool as the mean-field theory of Huthmann and Zippelius says (Phys.
Rev. E 56, R6275, 1997, cond-mat/9708093)? Luding, Huthmann, McNamara and Zippelius compared it with simulations (Phys. Rev.
E 58, 3416, 1998). The container is at rest, and its wall is smooth. The gas first reaches equilibrium without friction and
losses. Then the collision law is switched on, with all spins zero.

The theory describes the translational temperature T = ½m⟨v²⟩ and that of the spins T_s = I⟨ω²⟩ of a homogeneous gas whose
velocities and spins have normal distributions. Two discs of mass m and radius r approach with the speed u along the
normal. Their contact slips at the rate s = w + rΣ, with w the tangential part of the relative velocity and Σ the sum of
the spins. If every contact sticks (μ → ∞), the tangential impulse is −mηs, with

    η = q (1 + β) / (2q + 2),   q = I/(m r²),

because the effective mass of two equal discs is mq/(2q + 2). The impulse changes the energies by

    translation   −(1 − e²) m u²/4 − mη s w + mη² s²
    spins                          − mη s rΣ + (mη²/q) s².

Pairs collide at a rate proportional to u, so ⟨u²⟩ = 4T/m. The tangential components do not affect the rate: ⟨w²⟩ = 2T/m and
r²⟨Σ²⟩ = 2T_s/(mq), and both are independent. A gas of N discs has the energy N T + N T_s/2. With τ the mean number of
collisions of a disc with others, N/2 of them for each unit of τ give

    dT/dτ   = −a T + b T_s        a = (1 − e²)/2 + η(1 − η) + a_w,   b = η²/q
    dT_s/dτ = 2b T − 2c T_s       c = (η/q)(1 − η/q).

The wall has the same restitution e. Each collision with it removes (1 − e²) m v²/2 of the normal velocity v, on average
(1 − e²) T. The discs at the wall have the number density p/T, so √(T/2πm) p/T of them hit a unit of its length in a unit
of time. With p = n T (1 + 2φg) and the circle of radius R − r on which their centres are,

    a_w = (1 − e²) 2π(R − r) n (1 + 2φg) / (√(2πm) N ν),   ν that of T = 1.

The time follows from the collision rate of a disc,

    dτ/dt = ν = 2√π n σ g √(T/m),   σ = 2r,   g = (1 − 7φ/16)/(1 − φ)²,

with n the number of discs per area and Henderson's pair correlation g at contact (1975, doi:10.1080/00268977500102511).

Limits. β = −1, or no friction (η = 0): only e matters, which is Haff's law. e = β = 1: a = b = c, so the energy is constant
and T = T_s in the end.
"""

import dataclasses
import math

import numpy as np
import scipy.integrate
import scipy.linalg

import style
import tables
from combine import means
from curves import with_error
from engine import swirl
from figure import Figure
from hard_discs import contact_correlation, pressure_ratio
from study import Point

FRACTION = 0.2  # φ = N r²/R²
QUANTITIES = ("translation", "spins", "time", "excess", "correlation")  # of a state of the gas
# Collisions per disc without losses: to reach equilibrium, then to measure the collision rate.
TO_MIX, TO_COUNT = 40, 20
MOMENTS = (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0)
FIRST_COLLISIONS = 2  # of the findings
STICKS = 1e6  # μ


@dataclasses.dataclass(frozen=True)
class Case:
    """One collision law. `beta` is that of the theory: −1 without friction."""

    case: str
    words: str
    restitution: float
    beta: float
    mu: float
    inertia: float

    def rates(self, discs):
        """The matrix of the theory."""
        e, q = self.restitution, self.inertia
        eta = q * (1 + self.beta) / (2 * q + 2)
        b, c = eta * eta / q, eta / q * (1 - eta / q)
        a = (1 - e * e) / 2 + eta * (1 - eta) + wall_loss(e, discs)
        return np.array([[-a, b], [2 * b, -2 * c]])

    def after(self, tau, discs):
        """(T, T_s) after τ collisions of a disc, in units of T at the start."""
        return scipy.linalg.expm(self.rates(discs) * tau) @ [1, 0]

    def time_of(self, tau, discs):
        """The time of τ collisions, in units of the inverse collision rate at the start: the integral of √(T₀/T)."""
        return scipy.integrate.quad(lambda t: 1 / math.sqrt(self.after(t, discs)[0]), 0, tau)[0]


CASES = (Case("haff", "smooth, e = 0.9", 0.9, -1, 0, 0.5), Case("elastic", "e = 1, β = 1, I = ½", 1, 1, STICKS, 0.5),
         Case("partly", "e = 0.95, β = 0.5, I = ½", 0.95, 0.5, STICKS, 0.5),
         Case("solid", "e = 0.9, β = 0, I = ½", 0.9, 0, STICKS, 0.5),
         Case("sticking", "e = 1, β = 0, I = 10", 1, 0, STICKS, 10), Case("paper", "e = 1, β = 0, I = 10, μ = 1", 1, 0, 1, 10),
         Case("slippery", "e = 1, β = 0, I = 10, μ = 0.1", 1, 0, 0.1, 10))


def collision_rate():
    """Enskog's, of discs of radius 1 and mass 1 at T = 1."""
    return 4 * math.sqrt(math.pi) * (FRACTION / math.pi) * contact_correlation(FRACTION)


def radius_of(discs):
    return math.sqrt(discs / FRACTION)


def wall_loss(restitution, discs):
    """a_w."""
    pressure = pressure_ratio(FRACTION)
    return ((1 - restitution ** 2) * 2 * math.pi * (radius_of(discs) - 1) * FRACTION / math.pi * pressure /
            (math.sqrt(2 * math.pi) * discs * collision_rate()))


# --- Runs -----------------------------------------------------------------------------------------

def state_of(gas):
    """T, T_s, the excess a₂ = ⟨v⁴⟩/2⟨v²⟩² − 1, and the correlation ⟨v²ω²⟩/⟨v²⟩⟨ω²⟩ − 1, NaN without spins."""
    now = gas.snapshot()
    v2, w2 = np.sum(now.velocity ** 2, axis=1), now.spin ** 2
    correlation = np.mean(v2 * w2) / (v2.mean() * w2.mean()) - 1 if w2.any() else math.nan
    return 0.5 * v2.mean(), now.inertia[0] * w2.mean(), 0.5 * np.mean(v2 ** 2) / v2.mean() ** 2 - 1, correlation


def advance(gas, start, per_disc):
    """To the exact number of collisions of two discs, per disc."""
    target = start + int(0.5 * per_disc * len(gas))
    while (left := target - gas.counts.disc_disc) > 0:
        gas.advance(events=max(1, left // 2))


def cool(gas, case, parameters):
    """Rows T, T_s, time, excess and correlation at all moments, in units of the start."""
    start = gas.snapshot()
    gas = swirl.Simulation(position=start.position, velocity=start.velocity, mu_disc=case.mu, mu_wall=0,
                           restitution=case.restitution, tangential_restitution=max(case.beta, 0), inertia=case.inertia,
                           container_radius=parameters["container_radius"], amplitude=0)
    rows, at_start = [], state_of(gas)[0]
    for tau in MOMENTS:
        advance(gas, 0, tau)
        T, spins, excess, correlation = state_of(gas)
        rows.append([T / at_start, spins / at_start, gas.time * math.sqrt(at_start), excess, correlation])
    return rows


def cooling_run(parameters):
    """The collision rate in equilibrium, in units of Enskog's, and the states of all cases."""
    gas = swirl.Simulation(**parameters)
    advance(gas, 0, TO_MIX)
    begin, before = gas.time, gas.counts.disc_disc
    advance(gas, before, TO_COUNT)
    rate = 2 * (gas.counts.disc_disc - before) / (len(gas) * (gas.time - begin))
    return {"rate": rate / (math.sqrt(state_of(gas)[0]) * collision_rate()),
            **{case.case: cool(gas, case, parameters) for case in CASES}}


def points(settings):
    return [Point(settings, f"cooling_N{n}", settings.chapter_seeds,
                  {"discs": n, "container_radius": radius_of(n), "amplitude": 0, "mu": 0}, work=cooling_run,
                  cells={"discs": n, "container_radius": radius_of(n)})
            for n in ((500, 1000) if settings.quick else (500, 1000, 2000, 4000, 8000))]


# --- Tables ---------------------------------------------------------------------------------------

def rows_of_case(case, point):
    """The largest gas, with the theory."""
    discs, rate, rows = point.cells["discs"], collision_rate(), []
    for k, tau in enumerate(MOMENTS):
        found = means([dict(zip(QUANTITIES, run[case.case][k])) for run in point.runs], QUANTITIES)
        found |= {name: found[name] * rate for name in ("time", "time_error")}
        theory = dict(zip(QUANTITIES, (*case.after(tau, discs), case.time_of(tau, discs))))
        rows.append({**dataclasses.asdict(case), "collisions": tau, **found,
                     **{f"theory_{name}": value for name, value in theory.items()}, "seeds": len(point.runs)})
    return rows


def largest_deviation(rows, name):
    """"0.3 ± 0.2 %": the largest relative deviation from the theory during the first collisions."""
    found = [(100 * (row[name] / row[f"theory_{name}"] - 1), 100 * row[f"{name}_error"] / row[f"theory_{name}"])
             for row in rows if row["collisions"] <= FIRST_COLLISIONS and row[f"theory_{name}"] > 0]
    return f"{with_error(*max(found, key=lambda pair: abs(pair[0])))} %"


def table(points, settings):
    rows, findings = [], []
    for case in CASES:
        here = rows_of_case(case, points[-1])
        rows += here
        spins = f" and {largest_deviation(here, 'spins')} for the spins" if case.mu else ""
        findings.append(f"{case.words}: the largest deviation from the mean-field theory up to {FIRST_COLLISIONS} "
                        f"collisions of a disc is {largest_deviation(here, 'translation')} for the translation{spins}.")
    rates = [{**point.cells, "packing_fraction": FRACTION, **means(point.runs, ["rate"]), "seeds": len(point.runs)}
             for point in points]
    words = [f"{with_error(r['rate'], r['rate_error'])} at R/r = {r['container_radius']:.0f}" for r in rates]
    return {"": rows, "_rates": rates}, [*findings, f"Collision rate in units of Enskog's: {', '.join(words)}."]


# --- Drawing --------------------------------------------------------------------------------------

LAST = 10.5  # collisions of a disc that the figure shows
LINEAR = 15  # per cent: the scale of deviations is logarithmic beyond


def temperatures(axes, rows, look):
    tau = [0.0, *style.column(rows, "collisions")]
    for name, start, face, line in (("translation", 1.0, look["color"], "-"), ("spins", 0.0, "white", "--")):
        if rows[0]["mu"] in (0, STICKS):
            axes.plot(tau, [start, *style.column(rows, f"theory_{name}")], color=look["color"], linestyle=line, linewidth=0.9)
        style.curve(axes, rows, "collisions", name, linestyle="none", markerfacecolor=face, **look)


def deviations(axes, rows, look, name):
    """Returns the drawn values, in per cent."""
    here = [row | {"deviation": 100 * (row[name] / row[f"theory_{name}"] - 1),
                   "deviation_error": 100 * row[f"{name}_error"] / row[f"theory_{name}"]}
            for row in rows if row[f"theory_{name}"] > 0 and row["collisions"] <= LAST]
    if here:
        style.curve(axes, here, "collisions", "deviation", **look)
    return style.column(here, "deviation")


def draw(table):
    rows, rates = style.read(table), tables.companion(table, "_rates")
    drawing, ((both, translation), (spins, last)) = style.figure(style.PAGE, 5.4, ncols=2, nrows=2)
    cases = [(tables.select(rows, case=case), style.look_of(k))
             for k, case in enumerate(dict.fromkeys(row["case"] for row in rows))]
    for here, look in cases:
        temperatures(both, here, look)
    both.set_ylabel("temperature / that at the start")
    for axes, name, words in ((translation, "translation", "T"), (spins, "spins", "T_s")):
        style.zero_line(axes)
        style.fine_near_zero(axes, np.concatenate([deviations(axes, *case, name) for case in cases]), LINEAR)
        axes.set_ylabel(f"${words}$: simulation / theory − 1 (%)")
    for axes in (both, translation, spins):
        axes.set(xlim=(0, LAST), xlabel=r"collisions per disc $\tau$")
    rates = [row | {"inverse": 1 / row["container_radius"]} for row in rates]
    style.curve(last, rates, "inverse", "rate", color=style.BLACK, marker="o", linestyle="none")
    last.axhline(1.0, color=style.GREY, linewidth=0.7, linestyle=":")
    last.set_xlim(0, 1.1 * max(style.column(rates, "inverse")))
    last.locator_params(axis="x", nbins=5)
    last.set(xlabel="$r/R$", ylabel="collision rate / Enskog's")
    style.legend_of_all(drawing, [translation.plot([], [], label=here[0]["words"], **look)[0] for here, look in cases], ncol=4)
    style.save(drawing, table)


FIGURES = [Figure("cooling", "chapters", "chapter: does a gas of rough discs cool as mean-field theory says?", points,
                  table, draw)]
