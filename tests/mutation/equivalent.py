"""Random mutations (draw.py) that no test can notice: (file, line before, line after, the reason)."""

EQUIVALENT = [
]
