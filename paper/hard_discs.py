"""Smooth elastic hard discs of radius 1 and mass 1 at the temperature T, by the packing fraction φ.

    pressure             p = ρ T Z,  Z = 1 + 2φ χ,  χ of Henderson 1975
                         (doi:10.1080/00268977500102511)
    speed of sound       c² = T (Z + φ Z′ + Z²), at constant entropy: a disc has the heat capacity 1
    kinematic viscosity  Enskog's theory (Gass 1971, J. Chem. Phys. 54, 1898), y = 2φ χ:
                         ν = η/ρ,  η = η_0 2φ (1/y + 1 + 0.8729 y),  η_0 = 1.022 √(T/π)/4
"""

import math


def contact_correlation(packing):
    """χ, the pair correlation at contact."""
    return (1 - 7 / 16 * packing) / ((1 - packing) * (1 - packing))


def pressure_ratio(packing):
    """Z"""
    return 1 + 2 * packing * contact_correlation(packing)


def sound_speed(packing, temperature):
    step = 1e-5
    slope = (pressure_ratio(packing + step) - pressure_ratio(packing - step)) / (2 * step)
    ratio = pressure_ratio(packing)
    return math.sqrt(temperature * (ratio + packing * slope + ratio * ratio))


def kinematic_viscosity(packing, temperature):
    y = 2 * packing * contact_correlation(packing)
    viscosity = (
        1.022 * math.sqrt(temperature / math.pi) / 4 * 2 * packing * (1 / y + 1 + 0.8729 * y)
    )
    return viscosity / (packing / math.pi)
