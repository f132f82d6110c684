"""Opens a file with a program that is not ours and compares it with the frames of the test.

independent_readers.py READER FILE DISCS FRAMES discs|spheres; exit code 77 where the reader is not
installed. The numbers are those of known_frame() and known_frame_of_spheres() in scratch.hpp,
written again, independently.
"""

import importlib
import sys

READER, FILE, DISCS, FRAMES = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
SPHERES = sys.argv[5] == "spheres"
PACKAGE = {
    "h5py": "python3-h5py",
    "MDAnalysis": "python3-mdanalysis",
    "xarray": "python3-xarray",
    "netCDF4": "python3-netcdf4",
    "pandas": "python3-pandas",
    "gsd": "python3-gsd",
    "vtkmodules": "python3-vtk9",
    "numpy": "python3-numpy",
}


def need(*modules):
    for module in modules:
        try:
            importlib.import_module(module)
        except ImportError:
            name = module.split(".")[0]
            print(f"{name} is not installed; Debian's package {PACKAGE[name]} provides it.")
            sys.exit(77)


need("numpy")
import numpy as np  # noqa: E402

PERIOD, RADIUS = 11.866071, 8.6


def u(k):
    return np.arange(DISCS) + k / 3.0


def time(k):
    return (k // 8) * PERIOD + PERIOD * (k % 8) / 8.0


def expected(k):
    """x, y, vx, vy, angle, spin of all discs at frame k."""
    return [u(k) / 7.0, -u(k) / 11.0, u(k) / 13.0, u(k) / 17.0, u(k) / 19.0, -u(k) / 23.0]


def rolling(k):
    """Spin about x and y."""
    return [u(k) / 29.0, -u(k) / 31.0]


def turned(k):
    """Unit quaternions w, x, y, z; a row for each sphere."""
    w, y = 1.0 + u(k), 3.0 - u(k)
    x, z = np.full(DISCS, -2.0), np.full(DISCS, 4.0)
    length = np.sqrt(w * w + x * x + y * y + z * z)
    return np.stack([w, x, y, z], axis=1) / length[:, None]


SIZES = np.where(np.arange(DISCS) % 2 == 1, 1.0, 1.25)
MASSES = SIZES**2
REACH = RADIUS + max(0.1 * (FRAMES - 1), 0.2)


def same(found, wanted, what):
    """Requires bitwise identical values."""
    found, wanted = np.asarray(found), np.asarray(wanted)
    assert found.shape == wanted.shape, f"{what}: shape {found.shape} instead of {wanted.shape}"
    assert (found == wanted).all(), f"{what}: {found} instead of {wanted}"


def almost(found, wanted, what, tolerance=1e-15):
    """To a few roundings: a quaternion is made of length 1 again when it is written."""
    assert np.allclose(found, wanted, rtol=0.0, atol=tolerance), f"{what}: {found} not {wanted}"


def close(found, wanted, what):
    """To the precision of a float32."""
    assert np.allclose(found, wanted, rtol=2e-7, atol=2e-6), f"{what}: {found} not {wanted}"


def read_h5py():
    need("h5py")
    import h5py

    with h5py.File(FILE, "r") as f:
        same(f["h5md"].attrs["version"], [1, 1], "H5MD version")
        assert f["h5md/creator"].attrs["name"] == b"swirl"
        assert f["h5md/creator"].attrs["version"]
        assert list(f["particles"]) == ["trajectory"]
        p = f["particles/trajectory"]
        assert p["box"].attrs["dimension"] == 3
        assert [b.decode() for b in p["box"].attrs["boundary"]] == ["none"] * 3
        assert "edges" not in p["box"]
        assert f["parameters"].attrs["complete"] == 1
        assert f["parameters"].attrs.get("floor") == (1 if SPHERES else None)
        assert ("orientation" in p) == ("rolling_spin" in p) == SPHERES
        for name in ["velocity", "angle", "angular_velocity"]:
            assert p[name + "/time"].id == p["position/time"].id, "time is not a hard link"
            assert p[name + "/step"].id == p["position/step"].id, "step is not a hard link"
        same(p["position/step"], np.arange(FRAMES), "step")
        same(p["position/time"], [time(k) for k in range(FRAMES)], "time")
        same(p["mass"], MASSES, "mass")
        same(p["radius"], SIZES, "radius")
        same(p["moment_of_inertia"], 10.0 + np.arange(DISCS), "moment of inertia")
        same(p["id"], np.arange(DISCS), "id")
        same(p["species"], np.arange(DISCS) % 2, "species")
        for k in range(FRAMES):
            x, y, vx, vy, angle, spin = expected(k)
            zero = np.zeros(DISCS)
            same(p["position/value"][k], np.stack([x, y, zero], axis=1), f"position {k}")
            same(p["velocity/value"][k], np.stack([vx, vy, zero], axis=1), f"velocity {k}")
            same(p["angle/value"][k], angle, f"angle {k}")
            same(p["angular_velocity/value"][k], spin, f"spin {k}")
            if SPHERES:
                same(p["rolling_spin/value"][k], np.stack(rolling(k), axis=1), f"rolling {k}")
                same(p["orientation/value"][k], turned(k), f"orientation {k}")
            assert f["observables/swirls/value"][k] == k // 8
            assert f["observables/clock/value"][k] == PERIOD * (k % 8) / 8.0
            assert f["observables/events/value"][k] == 10 * k
            assert f["observables/container_x/value"][k] == 0.1 * k
            assert f["observables/container_vy/value"][k] == 0.4 + k


def read_mdanalysis():
    need("MDAnalysis")
    import MDAnalysis

    universe = MDAnalysis.Universe.empty(DISCS, trajectory=False)
    universe.load_new(FILE, format="H5MD", convert_units=False)
    assert len(universe.trajectory) == FRAMES
    for k, frame in enumerate(universe.trajectory):
        x, y, vx, vy, _, spin = expected(k)
        close(frame.time, time(k), "time")
        close(frame.positions[:, 0], x, "x")
        close(frame.positions[:, 1], y, "y")
        close(frame.velocities[:, 0], vx, "vx")
        close(frame.velocities[:, 1], vy, "vy")
        assert not frame.positions[:, 2].any()
        assert frame.dimensions is None


def read_xarray():
    need("xarray", "netCDF4")
    import xarray

    with xarray.open_dataset(
        FILE, group="/particles/trajectory/position", engine="netcdf4", decode_times=False
    ) as d:
        assert d["value"].dims == ("time", "particle", "xyz"), d["value"].dims
        same(d["time"], [time(k) for k in range(FRAMES)], "time")
        for k in range(FRAMES):
            same(d["value"][k, :, 0], expected(k)[0], "x")
    with xarray.open_dataset(
        FILE, group="/particles/trajectory/angular_velocity", engine="netcdf4", decode_times=False
    ) as d:
        assert d["value"].dims == ("time", "particle"), d["value"].dims
        same(d["value"][FRAMES - 1], expected(FRAMES - 1)[5], "spin")
    with xarray.open_dataset(
        FILE, group="/observables/container_x", engine="netcdf4", decode_times=False
    ) as d:
        assert d["value"].dims == ("time",), d["value"].dims
        same(d["value"], [0.1 * k for k in range(FRAMES)], "container_x")


def read_lammps():
    need("MDAnalysis")
    import MDAnalysis

    universe = MDAnalysis.Universe(FILE, format="LAMMPSDUMP", topology_format="LAMMPSDUMP")
    assert len(universe.trajectory) == FRAMES
    assert len(universe.atoms) == DISCS
    for k, frame in enumerate(universe.trajectory):
        x, y = expected(k)[:2]
        assert frame.data["step"] == k
        # This reader puts the corner of the box at the origin.
        close(frame.positions[:, 0] - REACH, x, "x")
        close(frame.positions[:, 1] - REACH, y, "y")
    # The other columns by their names, which it does not read.
    with open(FILE) as lines:
        for k in range(FRAMES):
            while not (line := next(lines)).startswith("ITEM: ATOMS "):
                pass
            names = line.split()[2:]
            table = np.array([next(lines).split() for _ in range(DISCS)], dtype=float)
            assert len(names) == table.shape[1] == (17 if SPHERES else 11), names
            column = dict(zip(names, table.T))
            _, _, vx, vy, _, spin = expected(k)
            for name, values in {
                "id": 1 + np.arange(DISCS),
                "vx": vx,
                "vy": vy,
                "radius": SIZES,
                "mass": MASSES,
                "omegaz": spin,
            }.items():
                same(column[name], values, name)
            if SPHERES:
                for name, values in zip(("omegax", "omegay"), rolling(k)):
                    same(column[name], values, name)
                almost([column["quat" + part] for part in "wijk"], turned(k).T, "quaternion")


def read_xyz():
    # MDAnalysis reads the plain columns; the comment lists the names of the others.
    need("MDAnalysis")
    import MDAnalysis

    universe = MDAnalysis.Universe(FILE, format="XYZ", topology_format="XYZ")
    assert len(universe.trajectory) == FRAMES
    assert list(universe.atoms.names[:2]) == ["H", "He"]
    for k, frame in enumerate(universe.trajectory):
        close(frame.positions[:, 0], expected(k)[0], "x")
        close(frame.positions[:, 1], expected(k)[1], "y")
    with open(FILE) as lines:
        assert next(lines) == f"{DISCS}\n"
        comment = next(lines)
        assert (
            "Properties=species:S:1:pos:R:3:velo:R:3:omega:R:"
            + ("3:radius:R:1:id:I:1:orientation:R:4 " if SPHERES else "1:radius:R:1:id:I:1 ")
        ) in comment, comment
        for name in ("container_x", "container_y", "container_radius"):
            assert f" {name}=" in comment, comment
        table = np.array([next(lines).split()[1:] for _ in range(DISCS)], dtype=float).T
    x, y, vx, vy, _, spin = expected(0)
    zero = np.zeros(DISCS)
    omega = [*rolling(0), spin] if SPHERES else [spin]
    known = [x, y, zero, vx, vy, zero, *omega, SIZES, 1 + np.arange(DISCS)]
    same(table[: len(known)], known, "frame 0")
    # x y z w, as OVITO reads it.
    rest = np.roll(turned(0), -1, axis=1).T if SPHERES else np.empty((0, DISCS))
    assert table.shape[0] == len(known) + len(rest)
    almost(table[len(known) :], rest, "orientation")


def read_vtp():
    need("vtkmodules")
    import os
    import xml.etree.ElementTree as tree
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    parts = tree.parse(FILE).getroot().findall("Collection/DataSet")
    sets = [entry for entry in parts if entry.attrib["part"] == "0"]
    walls = [entry for entry in parts if entry.attrib["part"] == "1"]
    assert len(sets) == len(walls) == FRAMES
    for k, entry in enumerate(walls):
        assert float(entry.attrib["timestep"]) == time(k)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(os.path.dirname(FILE), entry.attrib["file"]))
        reader.Update()
        wall = reader.GetOutput()
        assert wall.GetNumberOfLines() == 1 and wall.GetNumberOfVerts() == 0
        points = vtk_to_numpy(wall.GetPoints().GetData())
        # The points are at equal distances, so their mean is the centre.
        distances = np.hypot(*(points - points.mean(axis=0)).T[:2])
        # Coordinates near 10 have rounding errors of 2e-15, and so does their mean.
        almost(distances, np.full(len(points), distances[0]), "wall", tolerance=2e-14)
    for k, entry in enumerate(sets):
        assert float(entry.attrib["timestep"]) == time(k)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(os.path.dirname(FILE), entry.attrib["file"]))
        reader.Update()
        data = reader.GetOutput()
        assert data.GetNumberOfPoints() == DISCS and data.GetNumberOfVerts() == DISCS
        x, y, vx, vy, angle, spin = expected(k)
        points = vtk_to_numpy(data.GetPoints().GetData())
        same(points[:, 0], x, "x")
        same(points[:, 1], y, "y")
        values = {
            name: vtk_to_numpy(data.GetPointData().GetArray(name))
            for name in ["velocity", "angle", "spin", "radius", "mass", "id"]
        }
        same(values["velocity"][:, 1], vy, "vy")
        same(values["angle"], angle, "angle")
        same(values["spin"], spin, "spin")
        same(values["radius"], SIZES, "radius")
        same(values["mass"], MASSES, "mass")
        for name in ("spin_x", "spin_y", "turned"):
            assert bool(data.GetPointData().HasArray(name)) == SPHERES, name
        if SPHERES:
            for name, wanted in zip(("spin_x", "spin_y"), rolling(k)):
                same(vtk_to_numpy(data.GetPointData().GetArray(name)), wanted, name)
            almost(vtk_to_numpy(data.GetPointData().GetArray("turned")), turned(k), "turned")


def read_csv():
    need("pandas")
    import pandas

    table = pandas.read_csv(FILE, float_precision="round_trip")
    assert list(table.columns) == ["frame", "particle", "x", "y"]
    assert len(table) == DISCS * FRAMES
    for k, frame in table.groupby("frame"):
        x, y = expected(k)[:2]
        same(frame["particle"], np.arange(DISCS), "particle")
        same(frame["x"], (REACH + x) * 20.0, "x in pixels")
        same(frame["y"], (REACH - y) * 20.0, "y in pixels, downwards")


def read_table():
    need("pandas")
    import pandas

    table = pandas.read_csv(FILE, float_precision="round_trip")
    assert len(table) == DISCS * FRAMES
    # The units are those of the first disc, and the speed of the container in the first frame.
    r, v, m = SIZES[0], 0.5, MASSES[0]
    for k, frame in table.groupby("frame"):
        x, y, vx, vy, angle, spin = expected(k)
        same(frame["disc"], np.arange(DISCS), "disc")
        almost(frame["time (r/v)"], np.full(DISCS, time(k)) * v / r, "time")
        almost(frame["container x (r)"], np.full(DISCS, 0.1 * k) / r, "container")
        for name, values in {
            "x (r)": x / r,
            "y (r)": y / r,
            "v_x (v)": vx / v,
            "v_y (v)": vy / v,
            "angle (rad)": angle,
            "spin (v/r)": spin * r / v,
            "radius (r)": SIZES / r,
            "mass (m)": MASSES / m,
            "moment of inertia (m r²)": (10.0 + np.arange(DISCS)) / (m * r**2),
        }.items():
            almost(frame[name], values, name)
        assert ("turned w" in table.columns) == SPHERES
        if SPHERES:
            for name, values in zip(("spin x (v/r)", "spin y (v/r)"), rolling(k)):
                almost(frame[name], values * r / v, name)
            almost(frame[["turned " + part for part in "wxyz"]], turned(k), "turned")


def product(a, b):
    """The products of quaternions in rows."""
    aw, av, bw, bv = a[:, :1], a[:, 1:], b[:, :1], b[:, 1:]
    return np.hstack(
        [aw * bw - np.sum(av * bv, axis=1, keepdims=True), aw * bv + bw * av + np.cross(av, bv)]
    )


def read_gsd():
    need("gsd.hoomd")
    import gsd.hoomd

    with gsd.hoomd.open(FILE) as frames:
        assert len(frames) == FRAMES
        for k, frame in enumerate(frames):
            x, y, vx, vy, angle, spin = expected(k)
            assert frame.configuration.dimensions == 2 and frame.configuration.step == k
            close(frame.configuration.box[:2], 2 * REACH, "box")
            close(frame.particles.position[:, 0], x, "x")
            close(frame.particles.position[:, 1], y, "y")
            close(frame.particles.velocity[:, 0], vx, "vx")
            close(frame.particles.diameter, 2 * SIZES, "diameter")
            close(frame.particles.mass, MASSES, "mass")
            inertia = 10.0 + np.arange(DISCS)
            close(
                frame.particles.moment_inertia,
                np.stack([inertia * SPHERES, inertia * SPHERES, inertia], axis=1),
                "inertia",
            )
            q = frame.particles.orientation
            if SPHERES:
                close(q, turned(k), "orientation")
                same(frame.log["particles/rolling_spin"], np.stack(rolling(k), axis=1), "rolling")
            else:
                close(2 * np.arctan2(q[:, 3], q[:, 0]), angle, "angle")
            # HOOMD reads q̄ p / 2 in the body's axes. Rotated to the lab, this is I ω.
            bar = q * [1, -1, -1, -1]
            body = product(bar, frame.particles.angmom) / 2
            spins = [*(rolling(k) if SPHERES else np.zeros((2, DISCS))), spin]
            momentum = inertia * spins
            # Products of a dozen float32, of up to 10.
            assert np.allclose(product(product(q, body), bar)[:, 1:].T, momentum, atol=2e-5)
            assert np.allclose(body[:, 0], 0.0, atol=2e-5)
            assert frame.particles.types == ["D1", "D2"]
            same(frame.particles.typeid, np.arange(DISCS) % 2, "type")
            same(np.ravel(frame.log["particles/angular_velocity"]), spin, "spin")
            same(np.ravel(frame.log["time"]), [time(k)], "time")


globals()["read_" + READER]()
