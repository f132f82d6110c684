"""The paper's sentence behind each claim, in the order of the catalogue: Lee et al., Phys. Rev. E
100, 012903 (2019) and its Supplementary Information. "…" marks an omission; formulas are written as
text."""

QUOTES = (
    "At low densities the particle cluster rotates in the same direction as the swirling motion of "
    "the container, while at high densities it rotates in the opposite direction.",
    "The average angular velocity ϖ crosses zero and transitions between rotation and "
    "counterrotation at roughly 36 particles.",
    "As N increases the cluster transitions from rotation to stalling to counterrotation.",
    "The angular momentum of the marbles in their own reference frame changes sign with the "
    "addition of a couple marbles.",
    "For even higher values of N, the average angular velocity reaches a minimum and then "
    "increases slightly for the largest values of N.",
    "Our experimentally swirled cluster behaves increasingly similarly to a model particle with "
    "no-slip boundary conditions as N is increased.",
    "When there are only a few marbles in the container, they form a line that rolls along the "
    "container wall at the frequency of the circular translations (“snake” mode).",
    "In the M-frame, our system appears to be at steady state …, characterized by a steady "
    "particle density pattern and a steady circulation pattern.",
    "In the M-frame, all particles follow clockwise trajectories within the container.",
    "The M-frame introduces the Coriolis force that the rotating drum lacks, resulting in the "
    "beads tending to the left of the container.",
    "Once loose, a particle experiences centrifugal (0-460 cm/s²) and Coriolis (0-200 cm/s²) "
    "forces.",
    "In the pinned region, the particles are packed in layers against the moving wall …",
    "… and move as a rigid structure, whereas in the loose region the particles perform less "
    "constrained trajectories.",
    "The coherent pinned region (top left on the container) …",
    "… grows in size with increasing N, while the loose region shrinks in size.",
    "When a particle in the loose region transitions to the pinned region, it undergoes multiple "
    "collisions before settling into a trajectory parallel to the container's edge.",
    "Increasing N also increases the number of collisions a particle experiences, causing it to "
    "enter the pinned region earlier in its cycle.",
    "For all values of N, particles exit the pinned region and detach from the rigid structure at "
    "the same location.",
    "Increasing N also increases the number of collisions a particle experiences.",
    "Once loose, a particle … accelerates as it traverses the loose region.",
    "In the loose region, ϖ_i(θ) increases and decreases in a quantitatively similar manner for "
    "all values of N, with the "
    "only difference being the location on the dish at which this peak occurs.",
    "In the pinned region, the average value of |ϖ_i(θ)| consistently increases with increasing N.",
    "Therefore, the pinned region is the major contributor to the different behaviors seen across "
    "varying N's.",
    "The particles in the pinned region lag behind the moving boundary for low values of N, but "
    "approach the speed of the boundary at high N.",
    "The apparent decrease … in the transition regions is an artifact of the ooblong shape of the "
    "particle cluster. The "
    "transition regions occur at higher distances from the center, but the linear velocity of the "
    "particles during the transition regions does not change much.",
    "The slip parameter of the pinned particles in our system increases from approximately 0.5 at "
    "N=25 to nearly 1 at the highest values of N.",
    "The calculated slip parameter s for the roughened particles is consistently closer to 1 than "
    "for the smooth particles.",
    "The local rotation of individual particles along the wall in the pinned area decreases with "
    "increasing N.",
    "When interparticle friction is strong between two contacting particles, they must spin about "
    "their own axes in opposite "
    "directions, dictating antiferromagnetic-like interactions for spinning.",
    "For six-fold packing, … this results in geometric frustration, prohibiting any of the "
    "particles from rolling or spinning "
    "freely at high N.",
    "For six-fold packing, as we often see in the pinned region, …",
    "Particles in strong contact cannot advance as a tight single-file due to geometric "
    "frustration …",
    "… and can only roll on the ground side-by-side.",
    "… prohibiting any of the particles from rolling or spinning freely at high N.",
    "Sandpaper-roughened particles transition to counterrotation at N=28 as compared to N=36 for "
    "smooth particles.",
    "Particles with roughened surfaces, and therefore increased friction, transition to "
    "counterrotation at a lower N than for "
    "smoother particles.",
    "Geometric frustration induces the transition between rotation and counterrotation in swirled "
    "granular media.",
    "When friction is strong, the ball rolls commensurately on the wall of the container without "
    "slipping … the ball thus counterrotates in the lab frame.",
    "When there is no friction, the ball cannot rotate at all due to perfect slip boundary "
    "conditions and γ=0<1, corresponding to rotation.",
    "A steady-state for the ball in the M-frame occurs when it is near the bottom-left of the "
    "container (near M).",
    "A fluid will rotate in the same direction as the container is swirled.",
    "The average angular velocity ϖ for the simulations … [exhibits] a rotation-counterrotation "
    "transition with increasing N.",
    "This rotation-counterrotation transition point occurs at higher N when friction is decreased.",
    "The M-frame density histograms and relative angular velocities are also qualitatively similar "
    "to those of the experiment.",
    "The angular velocity of the cluster therefore remains at that of the container regardless of "
    "N.",
    "Without additional forcing from the wall, the angular velocity of the cluster cannot change, "
    "so the system never transitions to counterrotation.",
    "In the lab frame, the cluster of discs behaves as a solid-like unit sloshing around the "
    "container without any internal individual spinning.",
    "In the M-frame, the discs form a rim … with very little internal movement.",
    "In the M-frame, the discs form a rim at the boundary of the container.",
    "With no disc-disc friction the average angular velocity remains close to the container "
    "velocity, …",
    "… except at very high N where it drops slightly.",
    "The system never transitions to counterrotation, verifying that disc-disc friction is also "
    "critical to induce counterrotation.",
    "The cluster of discs is loose and gas-like, unlike the rigid body appearance of the cluster "
    "when all friction is present.",
    "The cluster of discs is loose and gas-like, unlike the rigid body appearance of the cluster "
    "when all friction is present.",
    "The outer discs are accelerated by frictional collisions with the wall and spin about their "
    "own axes quickly. … Individual discs spin with no coherence.",
    "None of this spinning is transferred to the inner discs except through particle exchanges.",
    "There is no friction with the substrate, no three-dimensional rolling effects, and no normal "
    "damping during collisions "
    "… Therefore, these additional factors cannot be critical for observing the transition.",
    "The dynamics we seek to understand do not seem to require nonelastic collisions.",
    "The minimal time between collisions is around 10⁻¹¹ and 10⁻⁹ with and without friction, "
    "respectively.",
    "Setting both parameters to 0 will result in a crash as the discs' energies will blow up.",
)
