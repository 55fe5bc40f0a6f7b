# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same map in every format gives the same statistics, and they are SurfaceTopography's own."""

import json
import re

import numpy
import pytest
from conftest import command

SurfaceTopography = pytest.importorskip("SurfaceTopography")

from asperity import maps  # noqa: E402
from asperity.errors import InputOutputError  # noqa: E402

N, PIXEL = 24, 2.5  # nm
X, Y = numpy.meshgrid(numpy.arange(N), numpy.arange(N), indexing="ij")
HEIGHTS = numpy.round(numpy.sin(1 + 0.9 * X + 0.31 * Y * Y / 7) + 0.5 * numpy.cos(0.2 * X * Y / 3), 4)  # [x, y], nm


def rows(separator="\t", number=repr):
    return "".join(separator.join(number(float(h)) for h in HEIGHTS[:, y]) + "\n" for y in range(N))


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The map in eleven formats; those that the program does not read are converted."""
    place = tmp_path_factory.mktemp("maps")
    topography = SurfaceTopography.Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm")
    (place / "gwyddion.txt").write_text(
        f"# Channel: Z\n# Width: {N * PIXEL / 1000} µm\n# Height: {N * PIXEL / 1000} µm\n# Value units: nm\n" + rows())
    (place / "spip.asc").write_text(
        f"# File Format = ASCII\n# x-pixels = {N}\n# y-pixels = {N}\n# x-length = {N * PIXEL}\n"
        f"# y-length = {N * PIXEL}\n# Bit2nm = 0.5\n# Start of Data:\n" + rows(number=lambda h: repr(2 * h)))
    (place / "comma.txt").write_text(rows(";", lambda h: repr(h).replace(".", ",")))
    (place / "grid.asc").write_text(f"ncols {N}\nnrows {N}\ncellsize {PIXEL}\n" + rows(" "))
    (place / "points.xyz").write_text(
        "".join(f"{x * PIXEL} {y * PIXEL} {float(HEIGHTS[x, y])!r}\n" for x in range(N) for y in range(N)))
    numpy.save(place / "map.npy", HEIGHTS.T)
    topography.to_gwy(str(place / "map.gwy"))
    topography.to_netcdf(str(place / "map.nc"))
    topography.to_x3p(str(place / "map.x3p"))
    head = {"ManufacID": "test", "CreateDate": "210120261200", "ModDate": "210120261200", "NumPoints": N,
            "NumProfiles": N, "Xscale": PIXEL * 1e-9, "Yscale": PIXEL * 1e-9, "Zscale": 1e-9, "Zresolution": 1e-12,
            "Compression": 0, "DataType": 7, "CheckType": 0}
    (place / "map.sdf").write_text("aISO-1.0\n" + "".join(f"{k} = {v}\n" for k, v in head.items()) + "*\n"
                                   + rows(" ") + "*\n")
    for name in ("map.gwy", "map.nc", "map.x3p", "map.sdf"):
        maps.convert(place / name, place / (name[4:] + ".h5"))
    return place


@pytest.mark.parametrize("name", ["gwyddion.txt", "spip.asc", "comma.txt", "grid.asc", "points.xyz", "map.npy",
                                  "gwy.h5", "nc.h5", "x3p.h5", "sdf.h5"])
def test_statistics_are_those_of_surface_topography(files, tmp_path, name):
    bare = {"comma.txt", "grid.asc", "points.xyz", "map.npy"}
    (tmp_path / "map.toml").write_text(
        f'[surface]\nkind = "file"\nfile = "{files / name}"\nsites = {N}\nspacing = "{PIXEL} nm"\n'
        + ('file_unit = "nm"\n' if name in bare else "")
        + (f'file_size = "{N * PIXEL} nm"\n' if name in {"comma.txt", "map.npy"} else "")
        + "[interface]\ncutoff = 40\n")
    text = command("surface", tmp_path / "map.toml", "--out", tmp_path / "out")
    of_file = text[: text.index("the surface made")]

    def told(what):
        return float(re.search(rf"{what} +([-+.0-9e]+)", of_file)[1])

    own = SurfaceTopography.Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm")
    assert told("rms height") == pytest.approx(10 * own.rms_height_from_area(), rel=1e-6)
    assert told("rms slope") == pytest.approx(own.rms_gradient(), rel=1e-6)
    assert told("rms curvature") == pytest.approx(own.rms_curvature_from_area() / 10, rel=1e-6)
    assert told("lowest") == pytest.approx(10 * HEIGHTS.min(), rel=1e-6)
    assert re.search(r"size +600 x 600 Å", of_file)

    import h5py

    periodic = SurfaceTopography.Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm", periodic=True)
    with h5py.File(tmp_path / "out/heights.h5") as file:
        assert file["heights"][:] == pytest.approx(10 * HEIGHTS.T, abs=1e-6)
        q, c1d = periodic.power_spectrum_from_profile(window=None, resampling_method=None)
        n = len(q) - 1
        assert 10 * file["spectrum/line_q"][:n] == pytest.approx(numpy.asarray(q)[1:], rel=1e-6)
        assert file["spectrum/c1d"][:n] / 1e3 == pytest.approx(numpy.asarray(c1d)[1:], rel=1e-6, abs=1e-9)
        # SurfaceTopography ends before half the period.
        r, acf = (numpy.asarray(a)[1:N // 2] for a in periodic.autocorrelation_from_profile(resampling_method=None))
        assert file["spectrum/line_r"][:-1] / 10 == pytest.approx(r, rel=1e-6)
        assert file["spectrum/autocorrelation"][:-1] / 100 == pytest.approx(acf, rel=1e-6)
        slope = numpy.asarray(periodic.scale_dependent_slope_from_profile(resampling_method=None)[1])[:N // 2 - 1]
        assert file["spectrum/scale_dependent_slope"][:-1] == pytest.approx(slope, rel=1e-6)
        # C(q) is C2D / (2 pi)^2, averaged over rings that are one q_L wide.
        c2d = periodic.power_spectrum_from_area(window=None, return_map=True)[2]
        k = numpy.fft.fftfreq(N, 1 / N)
        ring = numpy.rint(numpy.hypot(k[:, None], k)).astype(int)
        c = [c2d[ring == i].mean() / (2 * numpy.pi) ** 2 for i in range(1, N // 2 + 1)]
        assert file["spectrum/realised"][:] / 1e4 == pytest.approx(c, rel=1e-6)
    assert json.load(open(tmp_path / "out/result.json"))["surface"]["rms"] == pytest.approx(
        10 * periodic.rms_height_from_area(), rel=1e-6)


def test_the_program_names_what_it_does_not_read(files, tmp_path):
    for name in ("map.gwy", "map.nc", "map.x3p", "map.sdf"):
        (tmp_path / "map.toml").write_text(f'[surface]\nkind = "file"\nfile = "{files / name}"\nsites = {N}\n')
        assert "asperity.maps" in command("check", tmp_path / "map.toml", expect=2), name


def test_what_cannot_be_converted_is_refused(tmp_path):
    (tmp_path / "no.gwy").write_text("no map")
    with pytest.raises(InputOutputError, match="cannot be read"):
        maps.convert(tmp_path / "no.gwy", tmp_path / "no.h5")
    (tmp_path / "there.h5").write_text("")
    with pytest.raises(InputOutputError, match="is there already"):
        maps.convert(tmp_path / "no.gwy", tmp_path / "there.h5")
