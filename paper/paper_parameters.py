"""The numbers of the paper that the claims and the figures use. Lengths are in disc radii, times in
units of radius over container speed, angles in degrees.

Source: L. Lee, J. P. Ryan, Y. Lahini, M. Holmes-Cerfon, S. M. Rubinstein, Physical Review E 100,
012903 (2019), main text and Supplementary Information (SI).
"""

import math

# SI, "Simulation parameters".
PERIOD = 11.866071
OMEGA = 2 * math.pi / PERIOD
CONTAINER_RADIUS = 8.6
AMPLITUDE = 1.892
SIDES = 30  # "a polygonal path with 30 sides"
EVENTS = 1e6  # "number of events calculated"
LAST_N = 48  # "for each N between 5 and 48"

# Caption of Figure 5: "for a rotating (N = 28) and counterrotating (N = 48) case".
ROTATING_N, COUNTERROTATING_N = 28, 48

# Main text, the experiment: "N (ranging from 24 to 48)"; Figure 4c: N of the change of direction.
EXPERIMENT_N = (24, 48)
SMOOTH_CHANGE_N, ROUGH_CHANGE_N = 36, 28
# Amplitude by setting of a figure: 1.15 cm of the experiment in radii of 3 mm, and half of it.
AMPLITUDES = {"smooth": 11.5 / 3, "rough": 11.5 / 3, "half": 5.75 / 3}
# Figure 4a: N, and the slip parameter of the pinned spheres there.
SLIP_AT_25 = (25, 0.5)
# "Amplitude 1.15 cm", "5.1 cm in diameter": R and A, in radii of its spheres of 3 mm.
EXPERIMENT_DISH = (25.5 / 3, 11.5 / 3)
# r Ω² in cm/s², with discs of 3 mm radius and Ω = 11.81 rad/s.
EXPERIMENT_R_OMEGA_SQUARED = 0.3 * 11.81**2
# Main text: centrifugal force "0–460", Coriolis force "0–200", in cm/s².
MAX_FORCES = {"centrifugal": 460.0, "coriolis": 200.0}

# SI, "Finding the next event": the shortest time between collisions, by friction coefficient.
SHORTEST_TIMES = {1.0: 1e-11, 0.0: 1e-9}

# Figure 1c: M is "always positioned at the bottom".
M_ANGLE = 270.0
