"""The sizes by which claims are judged: where the paper leaves a size open ("roughly", "slightly"),
a constant here states it, with the reason. Frequencies are in units of Ω, lengths in disc radii,
angles in degrees. The paper's own numbers are in paper_parameters.py.

Every claim is also judged at half and at twice its sizes (scaled()). So judges read a size as
thresholds.NAME.
"""

import contextlib
import math

# --- Sizes that matter --------------------------------------------------------------------------

# Fewer than one turn in 200 periods is not a rotation. The paper's run of 10^6 events at N = 48 is
# about that long (3400 events per period).
LEAST_ROTATION = 0.005
# "Transitions to counterrotation at a lower N", "occurs at higher N": N is an integer.
ONE_DISC = 1.0
# "Quantitatively similar": within this share of the mean.
SIMILAR = 0.15
# "Increases", "decreases", "fewer", "hotter", "quickly", "accelerates": a change larger than what
# is still similar, relative to the initial or the reference value.
LEAST_CHANGE = SIMILAR
# "Dictating antiferromagnetic-like interactions for spinning ... for six-fold packing": half of the
# correlation of neighbours in the ground state of the antiferromagnetic Ising model on the
# triangular lattice. That correlation is −1/3: two of the three pairs of every triangle are
# opposed.
ANTIFERROMAGNETIC = -1 / 6
# "Prohibiting any", "often", "the major contributor": more than half, or less.
MAJORITY = 0.5
# The slip parameter "increases from approximately 0.5 at N = 25 to nearly 1": the rise must be a
# fifth of that 0.5. Two values of s closer than the height of a symbol in Figure 4a are equal.
LEAST_SLIP_RISE, LEAST_SLIP_GAP = 0.1, 0.02
# "Resulting in the beads tending to the left": more than 55 % of the discs, and the centre of mass
# a tenth of a disc radius.
LEFT_SHARE, LEFT_SHIFT = 0.55, 0.1
# "Near the bottom-left of the container (near M)": within an eighth of a turn of M, and left of it
# by the width of a slice of θ.
NEAR_M, LEFT_OF_M = 45.0, 5.0

# --- Words that the paper leaves open -----------------------------------------------------------

NEAR_OMEGA = 0.05  # "remains at that of the container"
CLOSE_TO_OMEGA = 0.1  # "remains close to the container velocity"
SLIGHT_DROP = LEAST_ROTATION  # the smallest drop, or rise after a minimum
NEAR_PANCAKE = 0.05  # "increasingly similarly to a model particle with no slip"
SAME_ANGLE = 20.0  # "at the same location"
LEAST_ADVANCE = 10.0  # "earlier in its cycle"
NEARLY_ONE = 0.9  # "nearly 1", of the slip parameter
ABOUT_HALF = 0.1  # "approximately 0.5" of the slip parameter, either way
AT_THE_WALL = 0.05  # "approaches 1", of the normalised angular velocity
ALMOST_ALL = 0.9  # share of the spheres: "they form a line that rolls along the container wall"
DRIFT_BY_CHANCE = 0.05  # share of the runs that may drift in a steady state
GROWTH = 0.2  # relative to its mean: larger growth of the energy is "blows up"
LITTLE_MOTION = 0.1  # of ΩR, in the M-frame: "very little internal movement"
FORCE_DIGIT = 10.0  # cm/s²: the last digit given in "0–460" and "0–200"
TIMES_AROUND = 10.0  # factor either way: "around" a time
ROUGHLY = 2.0  # spheres either way: "at roughly N = 36"
COUPLE = 2.0  # spheres: "with the addition of a couple of marbles"
RIGID = 0.1  # of ΩR: velocities that a rigid motion leaves, "move as a rigid structure"
MULTIPLE = 2.0  # "multiple collisions before settling"
NO_SPIN = 0.1  # relative to the discs with both kinds of friction: "without ... spinning"

# --- Half and twice the sizes -------------------------------------------------------------------

# Every constant above is a size. A share of one half is doubled as odds (1/3 to 2/3). These sizes
# are distances from a value that is not 0; all others are multiplied.
SIZES = tuple(name for name in dict(globals()) if name.isupper())
SHARES = ("MAJORITY",)
COUNTED_FROM = {"NEARLY_ONE": 1.0, "ALMOST_ALL": 1.0, "LEFT_SHARE": 0.5}


@contextlib.contextmanager
def scaled(factor):
    """In this context all sizes are multiplied by the factor."""

    def times(name, size):
        if name in SHARES:
            return factor * size / (1 + (factor - 1) * size)
        start = COUNTED_FROM.get(name, 0.0)
        return start + factor * (size - start)

    sizes = {name: globals()[name] for name in SIZES}
    globals().update({name: times(name, size) for name, size in sizes.items()})
    try:
        yield
    finally:
        globals().update(sizes)


# --- Choices of the analysis --------------------------------------------------------------------

HIGH_N = 41  # "very high N" starts here; from here on a curve may drop
FEW = 8  # "only a few marbles"
JUMP = 4.0  # a larger change of N_c between neighbouring friction coefficients is not continuous
DENSE_SPHERES = (44, 48)  # at these N smooth and roughened spheres counterrotate
PEAK_WINDOW = 45.0  # degrees on either side of a peak whose shape is compared
# Range of the gap between a disc's centre and the wall in the first and the second layer of a
# packing at the wall (rows are √3 to 2 apart), and between these layers.
FIRST_LAYER, BETWEEN_LAYERS, SECOND_LAYER = (1.0, 1.4), (1.6, 2.4), (2.6, 3.2)
IDENTICAL = 0.01  # two means of the same runs, sampled at different times
# A few dozen particles lose the memory of their initial state in about 50 periods (runs.py). So
# runs that average over fewer periods decide nothing.
LEAST_PERIODS = 50
LEAST_VISITS = 200  # a slice of θ with fewer visits is not used
LEVEL_FROM = 30  # the level before a drop is the mean from this N up to HIGH_N
MOST_RUNS = 0.5  # a point is not steady if a larger share of its runs is not
OTHER_SIDE = 90.0  # two angles farther apart are distinct locations
ENERGY_PARTS = 10  # an energy is averaged over this many combined of a run; the first is left out
NEAR_CROSSING = 3  # discs either way: points whose seeds improve a crossing
# Standard deviation of log10 of the shortest of many independent times. The shortest time has an
# exponential distribution, and the standard deviation of its natural logarithm is π/√6.
SCATTER_OF_SHORTEST = math.pi / math.sqrt(6) / math.log(10)
