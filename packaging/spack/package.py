# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     mkdir -p REPO/packages/asperity && cp packaging/spack/package.py REPO/packages/asperity/
#     spack repo add REPO
#     spack dev-build asperity@0.2.0          # in the source tree
#
# REPO is a repository of packages of yours (`spack repo create`).
from spack.package import *
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Asperity(CMakePackage):
    """Adhesion between randomly rough elastic solids, from the atoms up: molecular dynamics of an elastic block on a
    rough substrate, quasi-static paths and states at rest."""

    version("0.2.0")

    license("MIT")

    variant("cuda", default=False, description="Steps on CUDA devices")
    variant("python", default=True, description="The Python package: sweeps, reports, exports, the engine by steps")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.11:", type=("build", "run"))

    depends_on("mpi@3:")
    depends_on("hdf5@1.10:")
    depends_on("zlib-api")
    depends_on("fftw@3.3: precision=double,float")
    depends_on("boost@1.74:")
    depends_on("fmt@9:")
    depends_on("tomlplusplus@3.3:")
    depends_on("cli11@2.3:")
    depends_on("nlohmann-json@3.11:")
    depends_on("random123@1.14:")
    depends_on("cuda@12:", when="+cuda")

    with when("+python"):
        depends_on("py-pybind11@2.10:", type="build")
        depends_on("py-numpy", type="run")
        depends_on("py-scipy", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-jinja2", type="run")

    conflicts("%gcc@:11", msg="Asperity needs g++ 12 or newer")
    conflicts("%clang@:13", msg="Asperity needs clang 14 or newer")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("ASPERITY_TESTS", False),
            self.define("ASPERITY_PERF", False),
            self.define_from_variant("ASPERITY_CUDA", "cuda"),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_pybind11", self.spec.satisfies("~python")),
        ]

    def setup_run_environment(self, env):
        env.set("ASPERITY_PYTHON", self.spec["python"].command.path)
        env.prepend_path("PYTHONPATH", self.prefix.share.asperity.python)

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_a_scene(self):
        Executable(self.prefix.bin.asperity)("check", self.prefix.share.asperity.scenes.join("first-contact.toml"))
