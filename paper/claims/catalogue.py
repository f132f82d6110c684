"""Every claim of the paper, in the order of the report: source, statement, figure, how it is
judged, on what, and the points that it needs. Where the statement is a summary, the paper's
sentence stands above it."""

from paper.paper_parameters import COUNTERROTATING_N, EVENTS, ROTATING_N

from paper.claims import contacts, motion, profiles, residence, rotation, settling, spheres
from paper.claims import thresholds as size
from paper.claims.claim import BOTH, DISCS, NOTHING, SPHERES, Claim, by_construction, untested
from paper.claims.settings import GRID, on_spheres


def runs(table, *settings, numbers=GRID):
    """Points that a claim needs."""
    return [(table, {"setting": setting}, "discs", numbers) for setting in settings]


# Of Figure 5b a claim needs these N, those of which there are no transitions also some beyond the
# paper's last.
OF_5B = (8, 16, 24, 28, 32, 36, 40, 44, 48)
DENSE = (52, 55)
COEFFICIENTS = [("spheres_friction", {"curve": "experiment"}, "mu", (0.3, 0.4, 0.6, 0.7))]
FEW_AND_MANY = runs("spheres", "smooth", numbers=(8, 16, *GRID))


def of_5b(statement, judge, *settings, numbers=OF_5B, source="main text, Fig. 5b"):
    return Claim(source, statement, "5b", judge, DISCS, runs("5b", *settings, numbers=numbers))


def from_start(statement, judge, setting):
    """The averages contain the transient, and ϖ is farther from Ω the less of it a run covers."""
    return Claim(
        "main text, Fig. 5b",
        statement,
        "5b-start",
        judge,
        DISCS,
        runs("5b-start", setting, numbers=OF_5B),
        least_events=EVENTS,
    )


def of_spheres(
    source, statement, figure, judge, note="", also=("half", "high"), settings=("smooth",)
):
    return Claim(
        source, statement, figure, on_spheres(judge, note, also), SPHERES, runs(figure, *settings)
    )


def of_settling(statement, judge, note):
    return Claim(
        "main text",
        statement,
        "settling",
        on_spheres(judge, note, ("rough",)),
        SPHERES,
        runs("settling", "smooth", numbers=(24, 48)),
    )


def not_tested(source, statement, reason):
    return Claim(source, statement, "", untested(reason), NOTHING)


CLAIMS = [
    # --- The transition -------------------------------------------------------------------------
    Claim(
        "main text, Fig. 1b",
        "Few particles rotate with the swirl, many counterrotate.",
        "spheres",
        on_spheres(rotation.transition, f"rotation: more than {size.LEAST_ROTATION} Ω"),
        SPHERES,
        FEW_AND_MANY,
    ),
    # "... crosses zero and transitions between rotation and counterrotation at roughly 36
    # particles"
    Claim(
        "main text, Fig. 1b",
        "Smooth particles change their direction of rotation at roughly N = 36.",
        "spheres_friction",
        spheres.change_near_36,
        SPHERES,
        COEFFICIENTS,
    ),
    # "As N increases the cluster transitions from rotation to stalling to counterrotation."
    Claim(
        "main text, Fig. 1b",
        "As N increases the cluster goes from rotation to stalling to counterrotation, once.",
        "spheres",
        on_spheres(
            rotation.passage,
            f"rotating: more than {size.LEAST_ROTATION} Ω; stalling: ϖ is 0 within its error",
        ),
        SPHERES,
        FEW_AND_MANY,
    ),
    # "... because the angular momentum of the marbles in their own reference frame changes sign
    # with the addition of a couple marbles"
    Claim(
        "main text",
        "The direction of rotation changes with the addition of a couple of particles.",
        "spheres",
        on_spheres(rotation.couple, f"a couple: {size.COUPLE:.0f}"),
        SPHERES,
        runs("spheres", "smooth", numbers=(*GRID, 34, 35, 37, 38)),
    ),
    Claim(
        "main text, Fig. 1b",
        "Beyond the crossing ϖ reaches a minimum and then rises slightly for the largest N.",
        "spheres",
        on_spheres(rotation.minimum, f"a rise: more than {size.SLIGHT_DROP} Ω"),
        SPHERES,
        runs("spheres", "smooth", numbers=(44, 48, *DENSE)),
    ),
    of_spheres(
        "main text, Fig. 1b",
        "With growing N the cluster behaves increasingly like a pancake that rolls on the wall.",
        "1b",
        rotation.pancake,
        f"nearer, and at the end within {size.NEAR_PANCAKE} Ω",
    ),
    # "When there are only a few marbles in the container, they form a line that rolls along the
    # container wall at the frequency of the circular translations ("snake" mode)."
    Claim(
        "main text",
        "A few particles form a line that rolls along the wall at the frequency of the swirl.",
        "spheres_few",
        spheres.snake,
        SPHERES,
    ),
    # --- The M-frame ----------------------------------------------------------------------------
    Claim(
        "main text, Fig. 2",
        "In the M-frame the particles are in a statistical steady state.",
        "spheres",
        on_spheres(
            rotation.steady,
            f"{size.DRIFT_BY_CHANCE:.0%} of the runs may drift by chance",
            ("high",),
        ),
        SPHERES,
        runs("spheres", "smooth"),
    ),
    # "In the M-frame, all particles follow clockwise trajectories ..."
    of_spheres(
        "main text, Figs 2 and 3",
        "In the M-frame the particles circulate clockwise: on average at every angle "
        "and every N.",
        "3a",
        profiles.clockwise,
    ),
    of_spheres(
        "main text, Fig. 2",
        "The Coriolis force makes the particles tend to the left of M.",
        "1b",
        motion.left_of_M,
        f"to the left: more than {size.LEFT_SHARE} of them, and by {size.LEFT_SHIFT} radii",
    ),
    of_spheres(
        "main text",
        "The centrifugal force on a particle reaches 460 cm/s², the Coriolis force 200.",
        "1b",
        motion.forces,
        f"required: within {size.FORCE_DIGIT:.0f} cm/s²",
    ),
    # --- The pinned and the loose region --------------------------------------------------------
    # "In the pinned region, the particles are packed in layers against the moving wall and move as
    # a rigid structure ..."
    Claim(
        "main text",
        "In the pinned region particles are packed in layers against the wall.",
        "2c",
        on_spheres(profiles.layers, f"layers: denser than between them by {size.LEAST_CHANGE:.0%}"),
        SPHERES,
        runs("2b", "smooth", numbers=(ROTATING_N,))
        + runs("2c", "smooth", numbers=(COUNTERROTATING_N,)),
    ),
    of_settling(
        "Pinned particles move as a rigid structure.",
        settling.rigid,
        f"rigid: within {size.RIGID}, and less than loose ones",
    ),
    of_spheres(
        "main text, Fig. 2",
        "The pinned region is at the top left of the container.",
        "3a",
        residence.top_left,
        "top left: 90° to 180°; 180° is left, 270° is M",
    ),
    # "The coherent pinned region (top left on the container) grows in size with increasing N ..."
    of_spheres(
        "main text, Fig. 2c", "The pinned region grows with N.", "3a", residence.pinned_grows
    ),
    of_settling(
        "A particle has several collisions before it settles in the pinned region.",
        settling.settles,
        f"several: more than {size.MULTIPLE:.0f}",
    ),
    of_spheres(
        "main text, Fig. 3",
        "With increasing N particles enter the pinned region earlier in their cycle.",
        "3a",
        residence.pinned_earlier,
        f"earlier: by more than {size.LEAST_ADVANCE:.0f}°",
    ),
    of_spheres(
        "main text, Fig. 3",
        "Particles leave the pinned region at the same location for all N.",
        "3a",
        residence.free_fixed,
        f"the same: within {size.SAME_ANGLE:.0f}°",
    ),
    of_spheres(
        "main text",
        "The more particles, the more collisions each of them has.",
        "4b",
        contacts.more_collisions,
        f"required: {size.LEAST_CHANGE:.0%} more",
    ),
    # "Once loose, a particle experiences centrifugal ... and Coriolis ... forces and accelerates as
    # it traverses the loose region."
    of_spheres(
        "main text",
        "Loose particles accelerate as they cross the loose region.",
        "3a",
        profiles.loose_accelerate,
        f"required: {size.LEAST_CHANGE:.0%}",
    ),
    # "In the loose region, ϖ_i(θ) increases and decreases in a quantitatively similar manner for
    # all values of N, with the only difference being the location on the dish at which this peak
    # occurs."
    of_spheres(
        "main text, Fig. 3a",
        "In the loose region ϖ_M rises and falls in a similar way at all N; only the "
        "location of the peak differs.",
        "3a",
        profiles.loose_peak,
        f"similar: within {size.SIMILAR:.0%} of the height of the peak above Ω",
    ),
    of_spheres(
        "main text, Fig. 3a",
        "In the pinned region |ϖ_M| rises with N.",
        "3a",
        profiles.pinned_faster,
        f"by more than {size.NEAR_OMEGA} Ω",
    ),
    # "Therefore, the pinned region is the major contributor to the different behaviors seen across
    # varying N's."
    of_spheres(
        "main text",
        "The pinned region is the major contributor to the differences between N.",
        "3a",
        profiles.pinned_decides,
        f"more than {size.MAJORITY:.0%}",
    ),
    of_spheres(
        "main text, Fig. 3b",
        "Pinned particles lag behind the wall at low N and move with it at high N.",
        "3b",
        profiles.pinned_reach_wall,
        f"slower than the wall, or equal: by {size.AT_THE_WALL}",
    ),
    of_spheres(
        "main text, Fig. 3a",
        "|ϖ_M| falls in the transition regions because the cluster is oblong: particles "
        "are farther from its centre there, and as fast.",
        "3a",
        profiles.oblong,
        f"as fast: within {size.SIMILAR:.0%}",
    ),
    # --- Slip, spin and frustration -------------------------------------------------------------
    of_spheres(
        "main text, Fig. 4a",
        "The slip parameter of the pinned particles rises with N, from approximately 0.5 "
        "at N = 25 to nearly 1.",
        "4a",
        contacts.slip_rises,
        f"approximately 0.5: within {size.ABOUT_HALF}; nearly 1: above {size.NEARLY_ONE}",
    ),
    of_spheres(
        "main text, Fig. 4a",
        "It is closer to 1 for roughened particles than for smooth ones.",
        "4a",
        contacts.slip_rough,
        f"required: {size.LEAST_SLIP_GAP}",
        ("high",),
        ("smooth", "rough"),
    ),
    of_spheres(
        "main text, Fig. 4b",
        "The spin of the particles along the wall in the pinned region falls with N.",
        "4b",
        contacts.wall_spin,
    ),
    # "When interparticle friction is strong between two contacting particles, they must spin about
    # their own axes in opposite directions, dictating antiferromagnetic-like interactions for
    # spinning."
    of_spheres(
        "main text",
        "The interaction between the spins of particles in strong contact is "
        "antiferromagnetic-like: they spin in opposite directions.",
        "4b",
        contacts.gears,
        f"opposite: correlation below −{-size.ANTIFERROMAGNETIC:.3f}",
        ("rough", "half", "high"),
    ),
    # "For six-fold packing, as we often see in the pinned region, this results in geometric
    # frustration, prohibiting any of the particles from rolling or spinning freely at high N ..."
    of_spheres(
        "main text",
        "Particles whose contact belongs to a triangle are frustrated: their spins have no order.",
        "4b",
        contacts.triangles_frustrate,
        f"no order: within ±{-size.ANTIFERROMAGNETIC:.3f}",
        ("rough", "half", "high"),
    ),
    of_spheres(
        "main text",
        "At high N six-fold packing is often seen in the pinned region.",
        "4b",
        contacts.six_fold,
        f"often: more than {size.MAJORITY}; random points have 0.29, a crystal 1",
    ),
    # "Similarly, particles in strong contact cannot advance as a tight single-file due to geometric
    # frustration, and can only roll on the ground side-by-side."
    of_settling(
        "Particles in strong contact cannot roll in single file.",
        settling.single_file,
        f"cannot: fewer than {size.MAJORITY} of them roll",
    ),
    of_settling(
        "They can only roll side by side.",
        settling.side_by_side,
        "required: more than in single file, at every N",
    ),
    of_spheres(
        "main text",
        "At high N particles at the wall are prevented from rolling on the ground.",
        "4b",
        contacts.prevented_from_rolling,
        f"prevented: fewer than {size.MAJORITY} of them roll",
        ("rough", "half"),
    ),
    Claim(
        "main text, Fig. 4c",
        "Roughened particles change their direction at N = 28, smooth ones at N = 36.",
        "spheres_friction",
        spheres.roughened,
        SPHERES,
        COEFFICIENTS,
    ),
    Claim(
        "main text, Fig. 4c",
        "The rougher the particles, the lower the N at which the direction of rotation changes.",
        "spheres_friction",
        spheres.friction_order,
        SPHERES,
        COEFFICIENTS,
    ),
    Claim(
        "title",
        "Geometric frustration induces counterrotation.",
        "cause",
        spheres.frustration,
        BOTH,
        runs("4b", "smooth", "rough", "high", numbers=(24, 28, 36, 40, 44, 48))
        + [("cause", {"body": body}, "discs", (48,)) for body in ("discs", "spheres")],
    ),
    # --- The minimal model ----------------------------------------------------------------------
    Claim(
        "main text",
        "A single ball that rolls on the wall counterrotates.",
        "ball",
        motion.rolling_ball,
        DISCS,
    ),
    Claim(
        "main text",
        "A single ball that slips freely rotates with the swirl.",
        "ball",
        motion.slipping_ball,
        NOTHING,
    ),
    # "A steady-state for the ball in the M-frame occurs when it is near the bottom-left of the
    # container (near M) ..."
    Claim(
        "main text",
        "The ball of the minimal model stays near the bottom left of the container, near M.",
        "ball",
        motion.ball_near_m,
        DISCS,
    ),
    not_tested(
        "main text",
        "A fluid rotates in the direction in which its container is swirled.",
        "The program simulates particles, and no fluid.",
    ),
    # --- The simulation -------------------------------------------------------------------------
    Claim(
        "main text, Fig. 5b",
        "With friction at the wall and between the discs the cluster rotates with the swirl at "
        "low N and counterrotates at high N.",
        "5b",
        rotation.simulated_transition,
        DISCS,
        runs("5b", "high", numbers=OF_5B),
    ),
    of_5b(
        "The lower the friction, the higher the N at which the direction of rotation changes.",
        rotation.friction_order,
        "high",
        "medium",
        "low",
    ),
    Claim(
        "main text, Fig. 5",
        "The maps of density and flow of discs are similar to those of the experiment.",
        "2c",
        profiles.maps_alike,
        BOTH,
    ),
    from_start(
        "Without wall friction the cluster rotates with the frequency of the swirl at every N.",
        rotation.no_wall_at_omega,
        "no-wall",
    ),
    # Without wall friction 10^6 events are fewer than 50 periods at large N.
    Claim(
        "main text, Fig. 5b",
        "Without wall friction there is never a transition.",
        "5b-steady",
        rotation.never_crosses("no-wall", "5b-steady"),
        DISCS,
        runs("5b-steady", "no-wall", numbers=OF_5B),
    ),
    Claim(
        "main text",
        "Without wall friction the discs do not spin.",
        "states",
        motion.no_spinning,
        DISCS,
    ),
    Claim(
        "main text",
        "Without wall friction the discs have very little internal movement in the M-frame.",
        "states",
        motion.rim,
        DISCS,
    ),
    not_tested(
        "main text",
        "Without wall friction the discs form a rim at the boundary of the container.",
        "The maps of density and flow have both kinds of friction.",
    ),
    from_start("Without disc friction ϖ remains close to Ω.", rotation.no_disc_close, "no-disc"),
    from_start(
        "Without disc friction ϖ drops slightly at very high N.", rotation.no_disc_drop, "no-disc"
    ),
    of_5b(
        "Without disc friction there is never a transition.",
        rotation.never_crosses("no-disc"),
        "no-disc",
        numbers=OF_5B + DENSE,
    ),
    # "With no disc-disc friction ... The cluster of discs is loose and gas-like, unlike the rigid
    # body appearance of the cluster when all friction is present (SI video)."
    Claim(
        "main text",
        "Without disc friction the cluster is loose and gas-like: in the paper's 10^6 "
        "events, from the start until it condenses.",
        "condensation",
        motion.gas("before"),
        DISCS,
    ),
    Claim(
        "main text",
        "Without disc friction the cluster is loose and gas-like: in the steady state, after "
        "that.",
        "condensation",
        motion.gas("after"),
        DISCS,
    ),
    # "The outer discs are accelerated by frictional collisions with the wall and spin about their
    # own axes quickly. ... individual discs spin with no coherence."
    Claim(
        "main text",
        "Without disc friction the outer discs spin quickly, and without coherence.",
        "condensation",
        motion.outer_spins,
        DISCS,
    ),
    Claim(
        "main text",
        "Without disc friction the spin of the outer discs reaches the inner ones only by "
        "exchange.",
        "",
        by_construction(
            "The collision law leaves no other way: without friction no collision of two discs "
            "changes a spin. A simulation with this law cannot fail the test."
        ),
        NOTHING,
    ),
    # "... there is no friction with the substrate, no three-dimensional rolling effects, and no
    # normal damping during collisions ... Therefore, these additional factors cannot be critical
    # for observing the transition."
    Claim(
        "main text",
        "Friction with the substrate, rolling in three dimensions and damping cannot be "
        "critical for the transition.",
        "spheres_ingredients",
        spheres.substrate,
        SPHERES,
    ),
    Claim(
        "main text",
        "Damping of the normal motion is not needed for the transition.",
        "spheres_ingredients",
        spheres.no_damping,
        BOTH,
    ),
    Claim(
        "SI",
        "The shortest time between collisions is around 10⁻¹¹ with friction and 10⁻⁹ without.",
        "times",
        motion.shortest_times,
        DISCS,
    ),
    Claim(
        "SI",
        "With both friction coefficients zero the energy blows up and the program crashes.",
        "energy",
        motion.blow_up,
        DISCS,
    ),
]
