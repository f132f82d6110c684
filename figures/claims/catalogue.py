"""Every claim of the paper, in the order of the report: source, statement, figure, and how it is judged. Where
the statement is a summary, the paper's sentence stands above it."""

from . import contacts, motion, profiles, residence, rotation, spheres
from .claim import Claim

CLAIMS = [
    Claim("main text, Fig. 5b", "With friction at the wall and between the discs the cluster rotates with "
          "the swirl at low N and counterrotates at high N.", "5b", rotation.transition),
    Claim("main text, Fig. 1b", "Beyond the crossing ϖ reaches a minimum and then rises slightly for the "
          "largest N.", "5b", rotation.minimum),
    # "As N increases the cluster transitions from rotation to stalling to counterrotation."
    Claim("main text, Fig. 1b", "As N increases the cluster goes from rotation to stalling to "
          "counterrotation, once.", "5b", rotation.passage),
    Claim("main text, Fig. 5b", "The lower the friction, the higher the N at which the direction of "
          "rotation changes.", "5b", rotation.friction_order),
    Claim("main text, Fig. 5b", "Without wall friction the cluster rotates with the frequency of the swirl "
          "at every N.", "5b", rotation.no_wall_at_omega),
    Claim("main text, Fig. 5b", "Without wall friction there is never a transition.",
          "5b", rotation.never_crosses("no-wall")),
    Claim("main text, Fig. 5b", "Without disc friction ϖ remains close to Ω.", "5b", rotation.no_disc_close),
    Claim("main text, Fig. 5b", "Without disc friction ϖ drops slightly at very high N.",
          "5b", rotation.no_disc_drop),
    Claim("main text, Fig. 5b", "Without disc friction there is never a transition.",
          "5b", rotation.never_crosses("no-disc")),
    Claim("main text, Fig. 2", "In the M-frame the discs are in a statistical steady state.",
          "5b", rotation.steady),
    Claim("main text, Figs 2 and 3", "In the M-frame all discs circulate clockwise.",
          "3a", profiles.clockwise),
    Claim("main text, Fig. 1b", "With growing N the cluster behaves increasingly like a pancake that rolls "
          "on the wall.", "1b", rotation.pancake),
    Claim("main text, Fig. 3b", "Pinned discs lag behind the wall at low N and move with it at high N.",
          "3b", profiles.pinned_reach_wall),
    Claim("main text, Fig. 3a", "In the pinned region |ϖ_M| rises with N.", "3a", profiles.pinned_faster),
    # "Therefore, the pinned region is the major contributor to the different behaviors seen across varying
    # N's."
    Claim("main text", "The pinned region is the major contributor to the differences between N.",
          "3a", profiles.pinned_decides),
    # "Once loose, a particle experiences centrifugal ... and Coriolis ... forces and accelerates as it
    # traverses the loose region."
    Claim("main text", "Loose discs accelerate as they cross the loose region.",
          "3a", profiles.loose_accelerate),
    # "In the pinned region, the particles are packed in layers against the moving wall and move as a rigid
    # structure ..."
    Claim("main text", "In the pinned region discs are packed in layers against the wall.",
          "2c", profiles.layers),
    # "The coherent pinned region (top left on the container) grows in size with increasing N ..."
    Claim("main text, Fig. 2", "The pinned region is at the top left of the container.",
          "3a", residence.top_left),
    Claim("main text, Fig. 3a", "In the loose region ϖ_M rises and falls in a similar way at all N; only "
          "the location of the peak differs.", "3a", profiles.loose_peak),
    Claim("main text, Fig. 3", "With increasing N discs enter the pinned region earlier in their cycle.",
          "3a", residence.pinned_earlier),
    Claim("main text, Fig. 2c", "The pinned region grows with N.", "3a", residence.pinned_grows),
    Claim("main text, Fig. 3", "Discs leave the pinned region at the same location for all N.",
          "3a", residence.free_fixed),
    Claim("main text, Fig. 4a", "The slip parameter of the pinned discs rises with N to nearly 1.",
          "4a", contacts.slip_rises),
    Claim("main text, Fig. 4a", "It is closer to 1 for rough discs than for smooth ones.",
          "4a", contacts.slip_rough),
    Claim("main text, Fig. 4b", "The spin of the discs along the wall in the pinned region falls with N.",
          "4b", contacts.wall_spin),
    Claim("main text", "The interaction between the spins of discs in strong contact is "
          "antiferromagnetic-like: they spin in opposite directions.", "4b", contacts.gears),
    Claim("main text", "At high N six-fold packing is often seen in the pinned region.",
          "4b", contacts.six_fold),
    Claim("main text", "The more discs, the more collisions each disc has.", "4b", contacts.more_collisions),
    Claim("main text, Fig. 2", "The Coriolis force makes the discs tend to the left of M.",
          "1b", motion.left_of_M),
    Claim("main text", "The centrifugal force on a disc reaches 460 cm/s², the Coriolis force 200.",
          "1b", motion.forces),
    Claim("main text, Fig. 3a", "|ϖ_M| falls in the transition regions because the cluster is oblong: discs "
          "are farther from its centre there, and as fast.", "3a", profiles.oblong),
    Claim("main text", "Without wall friction the discs have very little internal movement in the M-frame.",
          "states", motion.rim),
    # "With no disc-disc friction ... The cluster of discs is loose and gas-like, unlike the rigid body
    # appearance of the cluster when all friction is present (SI video)."
    Claim("main text", "Without disc friction the cluster is loose and gas-like: in the paper's 10^6 "
          "events, from the start until it condenses.", "condensation", motion.gas("before")),
    Claim("main text", "Without disc friction the cluster is loose and gas-like: in the steady state, after "
          "that.", "condensation", motion.gas("after")),
    # "The outer discs are accelerated by frictional collisions with the wall and spin about their own axes
    # quickly. ... individual discs spin with no coherence."
    Claim("main text", "Without disc friction the outer discs spin quickly, and without coherence.",
          "condensation", motion.outer_spins),
    Claim("SI", "The shortest time between collisions is around 10⁻¹¹ with friction and 10⁻⁹ without.",
          "times", motion.shortest_times),
    Claim("main text, Fig. 4c", "Rough discs change their direction of rotation at a lower N than smooth "
          "ones.", "4c", rotation.rough_earlier),
    Claim("main text", "Damping of the normal motion is not needed for the transition.",
          "5b", rotation.elastic),
    Claim("main text", "A single ball counterrotates if it rolls on the wall and rotates if it slips "
          "freely.", "ball", motion.ball),
    # "A steady-state for the ball in the M-frame occurs when it is near the bottom-left of the container
    # (near M) ..."
    Claim("main text", "The ball of the minimal model stays near the bottom left of the container, near M.",
          "ball", motion.ball_near_m),
    Claim("SI", "With both friction coefficients zero the energy blows up and the program crashes.",
          "energy", motion.blow_up),
    Claim("main text, Fig. 1b", "In the experiment the direction of rotation changes at roughly N = 36.",
          "5b", rotation.near_36),
    Claim("main text", "At high N spheres at the wall are prevented from rolling on the ground.",
          "spheres_pinned", spheres.spheres_prevented_from_rolling),
    Claim("experiment, Fig. 1b", "Few spheres rotate with the swirl, many counterrotate.",
          "spheres", spheres.spheres_transition),
    Claim("experiment, Fig. 1b", "As N increases spheres go from rotation to stalling to counterrotation, "
          "once.", "spheres", spheres.spheres_passage),
    # "When there are only a few marbles in the container, they form a line that rolls along the container
    # wall at the frequency of the circular translations ("snake" mode)."
    Claim("main text", "A few spheres form a line that rolls along the wall at the frequency of the swirl.",
          "spheres_few", spheres.snake),
    Claim("experiment, Fig. 1b", "Spheres of smooth plastic change their direction of rotation at roughly N "
          "= 36.", "spheres_direction", spheres.spheres_change_near(36)),
    Claim("experiment, Fig. 4", "Roughened spheres change it at N = 28, smooth ones at N = 36: sandpaper "
          "raises their friction coefficient.", "spheres_direction", spheres.spheres_roughened),
    Claim("experiment, Fig. 4c", "The rougher the spheres, the lower the N at which the direction of "
          "rotation changes.", "spheres_direction", spheres.spheres_friction_order),
    Claim("experiment, Fig. 1b", "Beyond the crossing ϖ of spheres reaches a minimum and then rises "
          "slightly for the largest N.", "spheres", spheres.spheres_minimum),
    Claim("title", "Geometric frustration induces counterrotation: spheres counterrotate, and without "
          "vertical friction, which frustrates their rolling, ϖ is higher.",
          "spheres_ingredients", spheres.spheres_frustration),
    Claim("main text", "Damping is not needed for spheres to counterrotate.",
          "spheres_ingredients", spheres.spheres_elastic),
    # "... there is no friction with the substrate, no three-dimensional rolling effects, and no normal
    # damping during collisions ... Therefore, these additional factors cannot be critical for observing the
    # transition."
    Claim("main text", "Friction with the substrate, rolling in three dimensions and damping cannot be "
          "critical for the transition.", "spheres_ingredients", spheres.substrate),
    Claim("experiment, Fig. 4a", "The slip parameter of pinned spheres rises with N, from approximately 0.5 "
          "at N = 25 to nearly 1.", "spheres_pinned", spheres.spheres_slip),
    Claim("experiment, Fig. 4a", "It is closer to 1 for roughened spheres than for smooth ones.",
          "spheres_pinned", spheres.spheres_slip_rough),
    Claim("experiment, Fig. 4b", "The spin of pinned spheres at the wall falls with N.",
          "spheres_pinned", spheres.of_pinned_spheres(spheres.spin_falls)),
    Claim("experiment, Fig. 3", "With increasing N spheres enter the pinned region earlier in their cycle.",
          "spheres_pinned", spheres.of_pinned_spheres(residence.earlier)),
    Claim("experiment, Fig. 3", "Spheres leave the pinned region at the same location for all N.",
          "spheres_pinned", spheres.of_pinned_spheres(residence.same_location)),
    Claim("experiment, Fig. 2c", "The pinned region of spheres grows with N.",
          "spheres_pinned", spheres.of_pinned_spheres(residence.grows)),
]
