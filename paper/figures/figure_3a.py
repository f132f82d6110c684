"""Figure 3a: angular velocity of the discs about the centre of mass against the angle."""

import style


def draw(table, slice_width=0.0):
    style.profiles(table, slice_width, "varpi_m", -1, r"$\langle\varpi_{M,i}\rangle/\Omega$")
