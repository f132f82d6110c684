"""The texts of the report about each figure: the question it answers and what it shows. Numbers
come from the findings of the figure, which are computed from its table."""

import re

from paper import point_names

CONTRADICTIONS = [
    (
        "Amplitude of the path",
        "The main text has A = 0.96. The SI has A = 1.892 and A/R = 0.22.",
        "The first value is in disc diameters, the second in disc radii. This program uses 1.892, "
        "which gives the container the speed 1 that the SI states.",
    ),
    (
        "Amplitude of the experiment",
        "The main text has 1.15 cm and forces of up to 460 and 200 cm/s². The SI's A/R = 0.22 "
        "implies 0.575 cm.",
        "A = 1.15 cm, as the main text states. With the assumed restitution, one friction "
        "coefficient then gives N_c and the "
        "single change of direction. The force of 460 cm/s² needs 1.05 cm. A Coriolis force of at "
        "most 200 cm/s² fits neither value. "
        "Claims about the experiment are judged there, and “half the amplitude” shows 0.575 cm.",
    ),
    (
        "Moment of inertia",
        "The table has I = 10 for m = r = 1. A rigid plane disc cannot exceed 1 (a ring); a "
        "solid disc has ½.",
        "The paper's 10 is the default. Figure “inertia” shows 1 and ½.",
    ),
    (
        "Minimal time between collisions",
        "The paper discards predicted contacts that are less than 10⁻¹³ ahead, since "
        "some of them were false.",
        "This program discards no contact. It predicts none for discs that touch and separate, and "
        "discs that touch and approach collide at once.",
    ),
    (
        "Period of the swirl",
        "The table calls 11.866071 the value of ω⁻¹.",
        "It is the period T, and Ω = 2π/T. With 30 sides and A = 1.892 it gives the speed 1.",
    ),
    (
        "Slope against angle",
        "The SI's formula for depinning compares a slope with an angle, and has a sum instead "
        "of a mean.",
        "Directions are compared with directions, and angles are averaged as directions.",
    ),
    (
        "“Strong slip (s ≪ 1)”",
        "In the conclusion s ≪ 1 is strong slip and s ≈ 1 is minimal slip. Earlier in the "
        "text s = 1 is no slip.",
        "Both agree: s = 1 is rolling and s = 0 is free slip.",
    ),
    (
        "Steady state",
        "The paper mentions no warm-up, so its averages seem to include the first events.",
        "Averages exclude the first 20 periods, or a fifth of the run if that is shorter. Without "
        "disc friction, spins need longer; figures “transient” and “5b-steady” show both.",
    ),
    (
        "Collisions with the wall",
        "The SI says that no sign changes are needed because the wall does not spin.",
        "The disc's own spin enters the slip at the wall with the sign of the outward normal.",
    ),
    (
        "A ball that slips freely",
        "It has γ = 0 at s = 0 and “corresponds to rotation”. But by the introduction, a "
        "body without torque has no direction of rotation.",
        "Without torque its spin in the lab stays 0, so γ = 1 and s = R_ball/R_container: figure "
        "“ball” simulates it. Rotation also needs a torque.",
    ),
    (
        "Coriolis force",
        "The paper states 0–200 cm/s². A disc that moves with the wall has about 720 cm/s² in the "
        "M-frame.",
        "This program computes it from the velocities in the M-frame (measurement “centre”).",
    ),
    (
        "Which rotation",
        "ϖ is the mean over the discs of (r × v)/r² about the centre of mass. Discs near it, whose "
        "r² is small, have the largest weight, and the variance diverges.",
        "Verdicts use the paper's mean. Every table "
        "also has the rotation of the rigid body that fits the velocities best (rigid_by_event, "
        "rigid_by_time). The two change sign at different N. Figure 5b has N_c for all four rates.",
    ),
    (
        "Which average",
        "Figure 5b averages over events, the experiment over time.",
        "All tables have both averages, and figure “averages” compares them.",
    ),
]

# The question of each figure beyond the paper.
QUESTIONS = {
    "spheres": "The experiment has spheres that roll on the floor of a dish; the simulation of the "
    "paper has discs with "
    "a moment of inertia that no disc has. Do spheres with their own moment of inertia "
    "counterrotate, and at which N?",
    "spheres_ingredients": "Friction of the floor, vertical friction of the contacts, damping, the "
    "inertia of a solid "
    "sphere: each is switched off in turn, for smooth spheres. Which of them causes "
    "counterrotation?",
    "spheres_ingredients_rough": "Does the answer depend on the friction coefficient? This figure "
    "has roughened spheres.",
    "spheres_friction": "Which friction coefficients have the N_c of the experiment, and how do "
    "they depend on what the paper does not state?",
    "averages": "The paper averages over events, but an observer averages over time. Does the "
    "result differ?",
    "transient": "Without disc friction only the wall changes the discs' spins. How long does that "
    "take, and does the paper's average include the end of it?",
    "5b-start": "The paper averages over all events of a run, from the first one on. What are its "
    "curves without one kind of friction, by the same protocol?",
    "settling": "Do the spheres at the wall move as a rigid body, how often do they collide before "
    "they settle, and how do spheres in contact roll?",
    "5b-steady": "What is Figure 5b after a warm-up that is long enough for the spins?",
    "friction": "The paper shows that less friction moves the crossing to higher N. How does N_c "
    "depend on μ?",
    "inertia": "The paper's discs have more inertia than a rigid plane disc can have. Where do "
    "solid discs (I = ½), rings (1) and discs of other inertia change their direction of rotation?",
    "restitution": "The paper's collisions are elastic in the normal direction. What changes if "
    "collisions lose energy?",
    "tangential": "In the paper friction only stops the slip. What changes if friction reverses a "
    "part of it?",
    "polygon": "The paper's container moves along 30 straight sides. What changes with other "
    "numbers of sides, or on a circle?",
    "condensation": "Without disc friction the paper sees a loose, gas-like cluster. How long does "
    "it last, and what follows?",
    "energy": "The paper's program crashes when both friction coefficients are zero. Where does "
    "the energy come from?",
    "map": "Which of the two friction coefficients determines the direction of rotation?",
    "size": "The paper has one container, with R/r = 8.6. Where does the direction of rotation "
    "change in smaller and in larger containers, and what is the state of the cluster there?",
    "critical": "The paper leaves open whether the change of direction is a critical phenomenon. "
    "Do slope, fluctuations "
    "and correlation time at the change grow with the size of the container?",
    "hysteresis": "Does the direction of rotation depend on whether a parameter rises or falls in "
    "a ramp?",
    "lifetimes": "Some points of Figure 5b end in different states for different seeds. How long "
    "do the states last?",
    "coexistence": "Clusters of different shape exist at the same parameters. How long does a "
    "cluster stay round, or not round, in dishes of several sizes?",
    "torque": "Which contacts make the cluster rotate, and which of their torques change sign with "
    "N?",
    "gears": "Do opposite spins of strong contacts predict the rotation better than the slip at "
    "the wall?",
    "gear_order": "Do touching particles stop turning like gears before the slip parameter rises, "
    "with it, or after it?",
    "contacts": "Which kind of contact needs friction for the change of direction?",
    "material_inertia": "Where does the direction change for other moments of inertia and "
    "inelastic discs?",
    "material_friction": "Which of the two friction coefficients shifts the change of direction?",
    "material_tangential": "Where does the direction change if a sticking contact reverses a part "
    "of its slip?",
    "fields": "The paper suggests continuum equations that couple the spins to the vorticity of "
    "the flow. Does the difference between both predict the torque that drives the spins?",
    "closure": "Described as a micropolar fluid, which coefficients does the cluster have, and how "
    "much of the stresses "
    "do they explain? A coefficient of a fluid depends on the packing fraction alone, and not on "
    "the dish.",
    "amplitude": "The paper has one amplitude, A/R = 0.22. Where does the direction of rotation "
    "change for others?",
    "cooling": "Does a gas of rough discs in a container at rest cool as the mean-field theory of "
    "Huthmann and Zippelius (1997) says?",
    "scherer": "Scherer et al. (2000) distinguish rotation, counterrotation and concentric rings "
    "by the sign of dE/dN, "
    "with the mean kinetic energy E of a particle, and see hypocycloids. Does the model agree?",
}

# The description of each figure.
CAPTIONS = {
    "1b": "Above: rotation frequency ϖ of the cluster about its centre of mass, in units of the "
    "swirl's Ω, against the "
    "number of particles; below zero it counterrotates. Dashed: a rigid pancake with the perimeter "
    "of the cluster of "
    "smooth spheres that rolls along the wall without slipping. Below: slip parameter of the "
    "spheres that are pinned "
    "by the SI's criterion. Stars: the numbers that the paper states, N_c = 28 and 36, and s ≈ 0.5 "
    "at N = 25. The "
    "two friction coefficients, 0.33 and 0.69, are fitted to these N_c; restitution, floor "
    "friction and amplitude are "
    "assumptions (docs/results/spheres.md has what depends on them). Averages over time.",
    "1c": "Left: the centre C of the container moves round the centre S of the swirl, and the "
    "container does not rotate. "
    "M is the point of the wall farthest from S. Middle: in the M-frame, which rotates with the "
    "swirl, S, C and M "
    "are at rest and the wall rotates clockwise with −Ω. Right: the inertial forces in the "
    "M-frame, the centrifugal "
    "force away from S (ochre) and, on one disc, the Coriolis force to the right of its velocity "
    "v.",
    "2a": "One instant in the M-frame. By the SI's criterion, pinned discs move along the wall "
    "until they change their "
    "direction sharply. Loose discs cross the container. Shaded: one of the angular slices over "
    "which the profiles of Figure 3 are averaged. M is at the bottom, at θ = 270°.",
    "2b": "Averages in the M-frame for few discs: number density of their centres (colour), and "
    "their mean velocity "
    "relative to the container (arrows), in units of the container's speed. S is the centre of the "
    "swirl, M the "
    "point of the wall farthest from it. Where an arrow is short, discs move with the wall.",
    "2c": "The same as Figure 2b for many particles.",
    "3a": "Mean angular velocity of the discs about the centre of mass of the cluster, in the "
    "M-frame, against the angle "
    "θ; one curve for each number of discs. Dashed: −Ω, that of the wall. Discs move clockwise, to "
    "smaller θ. Slices "
    "are 5° wide. The paper's slice slides around the container and its width is not given "
    "(paper/draw.py draws "
    "slices of any width that slide by 5°). Triangles: mean angle where residences in the wall "
    "layer begin; circles: where they end.",
    "3b": "The angular velocity of Figure 3a, divided by the angular velocity of the wall at this "
    "θ about the same centre of mass: 1 (dashed) is motion with the wall.",
    "pinning": "Distributions of the angle θ at which discs pin (above) and depin (below), for few "
    "discs and for many. "
    "Red, dashed: by the criterion of the SI, a disc is pinned while it moves parallel to the "
    "wall, even far from "
    "it, and pins where it changes its direction sharply. Blue: a disc is pinned while it resides "
    "in the wall layer, "
    "with its rim within half a radius of the wall, for at least 40/511 of a period. Triangles: "
    "mean directions. The "
    "resultant is the length of the mean unit vector: 1 if all angles are equal, 0 if they have no "
    "mean direction. Claims on the pinned region use the residences.",
    "4a": "Slip parameter s: 1 is rolling without slip, 0 free slip. For the particles that are "
    "pinned by the SI's "
    "criterion, for those that reside in the wall layer, and for the whole cluster.",
    "4b": "How particles at the wall are prevented from spinning. Left: mean magnitude of the spin "
    "of those that reside "
    "in the wall layer, in Ω; 0 is a particle that sticks to the wall. Middle: correlation of the "
    "spins of touching "
    "particles, −1 for gears: for contacts that belong to no triangle, and for those in triangles, "
    "which cannot all roll. Right: share of the contacts in triangles.",
    "4c": "Rotation of the cluster against the number of particles. The friction coefficients of "
    "the spheres follow from "
    "N_c of the experiment; those of the discs are a choice. Averages over time.",
    "5a": "A snapshot of the simulation in the lab frame; the line on each disc rotates with it. "
    "The circle is the path of the container's centre C round S.",
    "5b": "Rotation of the cluster against the number of discs for five pairs of friction "
    "coefficients, between discs "
    "(μ_d) and at the wall (μ_w), averaged over events as in the paper. The lower panel enlarges "
    "the range around zero.",
    "5c": "Number density of the discs' centres in the M-frame, counted by event on 100 × 100 "
    "cells as in the paper. Both maps have the same scale.",
    "5d": "Mean velocity of the discs relative to the container, in units of the container's "
    "speed, in the M-frame on 20 × 20 cells. One scale for both numbers of discs.",
    "ball": "The paper's minimal model, simulated: one large disc in the container. γ is its "
    "angular velocity in the "
    "M-frame divided by Ω, so the disc counterrotates if γ > 1. Dashed: γ for rolling without "
    "slip. With e = 0.5 the disc loses energy at the wall, with e = 1 it does not.",
    "states": "Motion in the M-frame with both kinds of friction and without one of them. Left: "
    "the mean speed of the "
    "discs; right: the granular temperature, the mean kinetic energy relative to the local mean "
    "flow. Without disc "
    "friction this is the state after 300 periods; figure “condensation” shows the state before.",
    "condensation": "Without disc friction, from the start. Above: the period in which the cluster "
    "condenses; from then "
    "on the discs hardly move in the M-frame and the cluster rotates with ϖ = Ω. Below: the "
    "granular temperature until then and in the 50 periods after it.",
    "times": "The shortest time between two collisions of a run, which the precision of the event "
    "times must resolve.",
    "spheres": "Rotation of spheres that roll on the floor of a container of the experiment's size "
    "against their number: "
    "smooth and roughened spheres at the amplitude that the paper states, 1.15 cm, and smooth ones "
    "at half of it. "
    "Averages over time. 56 and 57 spheres also fit into the container, but are omitted. Their "
    "rotation depends on the initial packing and not on friction.",
    "spheres_ingredients": "Rotation against the number of spheres with all ingredients of the "
    "model (black), and with "
    "one of them removed. Vertical friction is the part of the contacts' friction that acts on the "
    "vertical slip of rolling spheres.",
    "spheres_ingredients_rough": "Rotation with all ingredients (black), and with one of them "
    "removed, at the N near which the direction of rotation changes.",
    "spheres_friction": "N_c of spheres against the friction coefficient of all contacts. Black: A "
    "= 11.5 mm, e = 0.9, "
    "floor as the contacts. Colours: one of these changed. Dashed: N_c of the experiment, 36 for "
    "smooth and 28 for roughened spheres.",
    "settling": "Left: what is left of the velocities of the resident spheres, and of the loose "
    "ones, if the best rigid motion "
    "of each group is subtracted. Middle: encounters of a sphere in the quarter period before its "
    "residence at the wall "
    "begins; repeated collisions with one partner count once. Right: share of the spheres in "
    "strong contact (gap below 0.003 r) "
    "that roll on the floor, for pairs that move in single file and for pairs side by side. Full "
    "symbols: smooth spheres; open: roughened ones.",
    "spheres_few": "A few spheres after a long warm-up: ϖ (in units of Ω), and the share of them "
    "that resides at the wall. Both are 1 for a row that rolls along the wall with the swirl.",
    "size": "Left: rotation of the cluster against the packing fraction φ = N r²/R² in containers "
    "of different radius, "
    "at A/R = 0.22 and μ = 1. Right: the sign of the rotation at each point (the area of a disc "
    "grows with |ϖ|), and the packing fractions at which the direction changes.",
    "critical": "Slope, fluctuations (the variance of the rotation multiplied by N and by its "
    "correlation time τ) and "
    "correlation time at each change of direction against the size of the container, with power "
    "laws (dashed, "
    "from three sizes on) and laws with a limit (solid, if it is certain). Bars are the errors of "
    "the logarithm.",
    "hysteresis": "Rotation during a ramp of a parameter up (full) and down (open), each as a mean "
    "over an eighth of the ramp, for two ramp rates.",
    "lifetimes": "Mean lifetimes of the states at two points: time spent in the state divided by "
    "the number of exits.",
    "coexistence": "Left: mean lifetimes of clusters that were prepared round (full symbols) and "
    "elongated (open) "
    "against the amplitude; triangles are lower bounds. The elongation alone tells them apart, so "
    "“elongated” contains "
    "a rotating wave and a resting ellipse. Right: distribution of the rotation in windows of five "
    "periods, at one amplitude for each container.",
    "torque": "Torques on the cluster about its centre of mass against N, at μ = 1. (a) The sums: "
    "normal force and "
    "friction of the wall, and friction between discs, which transfers angular momentum to the "
    "spins. (b) The "
    "friction between discs by zone: two pinned discs, a pinned and a loose one, two loose ones. "
    "The line marks the N at which the rotation changes sign.",
    "gears": "Rotation against four possible predictors, for five friction coefficients and six N "
    "each; ρ is the rank correlation over all points.",
    "gear_order": "Correlation of the spins of touching particles, −1 for gears, against N and "
    "against the slip "
    "parameter of the resident particles: contacts in no triangle, and contacts in triangles.",
    "contacts": "Rotation against N if one kind of contact has no friction: with the wall; between "
    "two discs that are both within 1.5 radii of the wall; or all others between discs.",
    "material_inertia": "N_c with its error for pairs of inertia (in units of m r²) and "
    "restitution. In empty cells no change of direction is certain.",
    "material_friction": "N_c with its error for pairs of the two friction coefficients.",
    "material_tangential": "N_c with its error for pairs of tangential restitution and inertia.",
    "fields": "Fields in the M-frame (M is at the bottom), kernel of four radii, means over the "
    "seeds. (a) Packing "
    "fraction and velocity relative to the centre of mass. (b) Spin of the discs and (c) half of "
    "the vorticity: "
    "equal if the discs rotate with the flow. (d) Torque of the stress per area and (e) that of a "
    "micropolar fluid, "
    "where no contact with the wall contributes. (f) Both at each point; the line is equality, "
    "bars are standard errors.",
    "closure": "Coefficients divided by √(mT), with the granular temperature T, in ranges of the "
    "packing fraction; "
    "below, the share of the square of the stress that each explains. Bars are standard errors "
    "over the seeds.",
    "amplitude": "The same as figure “size” for different amplitudes, in containers of two sizes.",
    "cooling": "Temperatures of the translation (full symbols) and of the spins (open) against the "
    "number of collisions "
    "of a disc, with the mean-field theory (lines), which assumes that every contact sticks and "
    "fails if contacts "
    "slide; the relative deviations of both from the theory; and the collision rate in equilibrium "
    "in units of Enskog's, for gases of different size. φ = 0.2.",
    "scherer": "Mean kinetic energy of a particle in units of that of the container's speed, and "
    "rotation, against the "
    "number of particles, for spheres in the paper's experiment and for its discs; the "
    "number density around the centre of mass; and the distance of the particles' paths from "
    "hypotrochoids.",
}

# Sections of the report: headings, and how the description of their figures begins.
SECTIONS = (
    ("The paper’s figures", ""),
    ("Spheres that roll", "spheres that roll"),
    ("Beyond the paper", "beyond the paper"),
    ("Questions that the paper leaves open", "chapter"),
)
SECTION_OF_DESCRIPTION = re.compile(r"^(?:beyond the paper|spheres that roll|chapter): ")


def by_section(figures):
    """[(heading, figures)], without empty sections."""
    found = {heading: [] for heading, _ in SECTIONS}
    for figure in figures:
        heading = [h for h, start in SECTIONS if figure["description"].startswith(start)][-1]
        found[heading].append(figure)
    return [(heading, members) for heading, members in found.items() if members]


def title_of(figure):
    text, name = SECTION_OF_DESCRIPTION.sub("", figure["description"]), figure["name"]
    if name[0].isdigit() and not text.startswith("Figure"):
        return f"Figure {name}: {text}"
    return text[0].upper() + text[1:]


def question_of(figure):
    return QUESTIONS.get(figure["name"], "")


def caption_of(figure):
    return figure.get("caption") or CAPTIONS.get(figure["name"], "")


def image_of(figure):
    return next((file for file in figure["files"] if file.endswith(".png")), None)


# A remark on the runs, not a result.
REMARK = re.compile(
    r"(Steady state not verified|At \d+ of \d+ points the seeds|\d+ of them have fewer|"
    r"\d+ runs? failed|Figure \S+: )"
)


class FirstMentions(dict):
    """{finding: the first figure that has it}. The report prints a finding below that figure
    only."""

    def of(self, figure):
        """(findings, remarks on the runs, name of an earlier figure that has more of them)"""
        new = [
            f for f in figure["findings"] if self.setdefault(f, figure["name"]) == figure["name"]
        ]
        earlier = [self[f] for f in figure["findings"] if self[f] != figure["name"]]
        words = [sentence(point_names.in_words(f)) for f in new]
        return (
            [w for f, w in zip(new, words) if not REMARK.match(f)],
            [w for f, w in zip(new, words) if REMARK.match(f)],
            earlier[0] if earlier else "",
        )


def reference_to(name, figures):
    figure = next(f for f in figures if f["name"] == name)
    return f"Figure {name}" if name[0].isdigit() else f"“{title_of(figure)}”"


def figure_texts(about):
    """{name: (caption, findings, remarks)}, in the order of the page."""
    mentions, texts = FirstMentions(), {}
    for _, figures in by_section(about["figures"]):
        for figure in figures:
            findings, remarks, earlier = mentions.of(figure)
            if earlier:
                remarks.append(f"More on its runs: {reference_to(earlier, about['figures'])}.")
            texts[figure["name"]] = (caption_of(figure), findings, remarks)
    return texts


def sentence(text):
    """Starts with a capital, except ϖ, whose capital is Π, and the e of "e = 1"."""
    return text[:1].upper() + text[1:] if text[:1].isascii() and text[1:2] != " " else text
