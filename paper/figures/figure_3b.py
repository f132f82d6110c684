"""Figure 3b: angular velocity of the discs about the centre of mass, relative to that of the wall."""

import style


def draw(table, slice_width=0.0):
    style.profiles(table, slice_width, "normalised", 1,
                   r"$\langle\varpi_{M,i}\rangle/\langle\varpi_{\rm wall}\rangle$")
