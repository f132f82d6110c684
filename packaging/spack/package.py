# Spack package. Not tested. `url` and the checksum are placeholders.
from spack.package import *


class Swirl(CMakePackage):
    """Exact event-driven simulation of discs and spheres in a swirled container."""

    homepage = "https://doi.org/10.1103/PhysRevE.100.012903"
    url = "https://example.org/swirl-1.0.0.tar.gz"

    license("MIT")

    version("1.0.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    variant("program", default=True, description="Build the program in addition to the library")
    variant("camera", default=False, when="+program", description="Build `swirl track` (OpenCV)")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    with when("+program"):
        depends_on("pkgconfig", type="build")
        depends_on("cli11", type="build")
        depends_on("nlohmann-json", type="build")
        depends_on("tomlplusplus", type="build")
        depends_on("fmt")
        depends_on("hdf5~mpi+hl")
        depends_on("cairo+png")
    depends_on("opencv+imgproc", when="+camera")

    def cmake_args(self):
        return [
            self.define_from_variant("SWIRL_PROGRAM", "program"),
            self.define_from_variant("SWIRL_CAMERA", "camera"),
            self.define("SWIRL_TESTS", False),
        ]
