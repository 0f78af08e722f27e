# Spack recipe. From the folder of the sources:
#
#     spack repo create ~/elastokin-repo elastokin
#     mkdir ~/elastokin-repo/packages/elastokin && cp packaging/spack/package.py ~/elastokin-repo/packages/elastokin
#     spack repo add ~/elastokin-repo
#     spack dev-build elastokin@main        (the sources of this folder: there is no archive to download)
from spack.package import *


class Elastokin(CMakePackage):
    """Kinematics and compliance of vehicle suspensions: curves, compliance matrices,
    gradients and studies from a namelist deck."""

    license("BSD-3-Clause")

    version("main")

    variant("mpi", default=False, description="Studies by mpirun or srun")
    variant("netcdf", default=False, description="Results of studies as NetCDF-4")
    variant("plots", default=True, description="Figures by gnuplot")
    variant("native", default=False, description="Compile for this processor")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("lapack")
    depends_on("mpi", when="+mpi")
    depends_on("netcdf-fortran", when="+netcdf")
    depends_on("gnuplot", when="+plots", type="run")

    conflicts("%gcc@:11", msg="gfortran 12 or newer is required")

    def cmake_args(self):
        return [
            self.define_from_variant("EK_MPI", "mpi"),
            self.define_from_variant("EK_NETCDF", "netcdf"),
            self.define_from_variant("EK_NATIVE", "native"),
            self.define("BUILD_TESTING", self.run_tests),
            # Spack says which BLAS runs
            self.define("EK_STATIC_BLAS", False),
            # Spack's compiler wrappers and fat objects of another binutils do not mix
            self.define("EK_IPO", False),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        elastokin = Executable(join_path(self.prefix.bin, "elastokin"))
        elastokin("--version")
        deck = join_path(self.prefix.share, "elastokin", "input", "mcpherson", "mcpherson.nml")
        elastokin("check", deck)
