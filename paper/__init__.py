"""`swirl paper`: runs, tables, drawings, movies, claims and report, on the Python module swirl.

/usr/bin/python3 paper NAME runs a module of this package (__main__.py)."""
