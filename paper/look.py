"""The colours with a meaning, on paper: the light theme of movies and images.

tests/render/look_test.cpp writes this file.
"""

WITH = "#c04e08"
AGAINST = "#1f63a6"
PINNED = "#00795c"
LOOSE = "#98a3af"
NEUTRAL = "#d3d8de"
CENTRIFUGAL = "#b87400"
CORIOLIS = "#c2548f"
ACCENT = "#b0007a"
