# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Which map of a file is meant, and what its numbers mean: every format that holds several, what a user says against what
the file says, points without a height, and what may be wrong with a scan."""

import re
import sys
import types
from pathlib import Path

import h5py
import numpy as np
import pytest

import asperity
from asperity.errors import Error, InputOutputError
from asperity.maps import height_map
from asperity.maps.channels import Channel
from asperity.maps.convert import convert, read_heights
from asperity.running import program
from conftest import command

N, EDGE = 16, 32.0  # points, nm
Y, X = np.indices((N, N))
HEIGHT = np.round(np.sin(0.9 * X + 0.31 * Y) + 0.5 * np.cos(0.7 * Y), 4)  # nm
PHASE = np.round(40 + 3 * np.cos(0.5 * X - 0.2 * Y), 4)  # degrees
SIZES = f"# Width: {EDGE} nm\n# Height: {EDGE} nm\n"


def rows(map_, between="\t"):
    return "".join(between.join(f"{v}" for v in row) + "\n" for row in map_)


def table(*columns, heading="", between=" "):
    return heading + "".join(between.join(f"{v}" for v in (2 * x, 2 * y, *(c[y, x] for c in columns))) + "\n"
                             for y in range(N) for x in range(N))


def text(content, encoding="utf-8"):
    return lambda path: path.write_text(content, encoding=encoding)


def hdf5(fill):
    def write(path):
        with h5py.File(path, "w") as file:
            fill(file)
    return write


def two_sets(file):
    file["scan/z"], file["phase"], file["line"] = HEIGHT, PHASE, np.arange(3.0)
    file["scan/z"].attrs.update(unit="nm", size_x=EDGE, size_y=EDGE)
    file["phase"].attrs["units"] = "deg"


def stack(file):
    file["frames"] = np.stack([HEIGHT, PHASE])
    file.attrs.update(unit="nm", size_x=EDGE)  # of all that is in the file


def jpk(file):
    scan = file.create_group("Measurement_000")
    scan.attrs.update({"position-pattern.grid.ilength": N, "position-pattern.grid.jlength": N,
                       "position-pattern.grid.ulength": EDGE * 1e-9, "position-pattern.grid.vlength": EDGE * 1e-9})
    for k, (name, back, values, scale) in enumerate((("height", "false", HEIGHT, 1e-9), ("phase", "false", PHASE, 1.0))):
        group = scan.create_group(f"Channel_{k:03d}")
        group.attrs.update({"channel.name": name, "retrace": back, "net-encoder.scaling.multiplier": 1e-4 * scale,
                            "net-encoder.scaling.offset": 2.0 * scale})
        group[name.capitalize()] = np.rint(1e4 * (values - 2.0)).astype("i4").reshape(-1, 1)


def topostats(file):
    file["image"], file["grain_masks/above"] = HEIGHT, (PHASE > 40).astype("i4")
    file["pixel_to_nm_scaling"], file["topostats_version"] = EDGE / N, "2.3.0"


TWO = "# Channel: Height\n" + SIZES + "# Value units: nm\n" + rows(HEIGHT) + "# Channel: Phase\n" + SIZES + "# Value units: deg\n" + rows(PHASE)
SEVERAL = {  # file: how it is written, its channels, the one that is taken if none is named (from 1)
    "headers.txt": (text(TWO), ["Height", "Phase"], 1),
    "heights.txt": (text(TWO.replace("Value units: deg", "Value units: nm")), ["Height", "Phase"], 1),
    "shared.txt": (text("# Channel: Height\n" + SIZES + "# Value units: nm\n" + rows(HEIGHT) + "\n# Channel: Phase\n# Value units: deg\n"
                        + rows(PHASE)), ["Height", "Phase"], 1),
    "german.txt": (text(re.sub(r"(\d)\.(\d)", r"\1,\2", TWO).replace("Channel", "Kanal").replace("Width", "Breite")
                        .replace("Height:", "Höhe:").replace("Value units", "Wert-Einheiten"), "latin-1"), ["Height", "Phase"], 1),
    "utf-16.txt": (text(TWO, "utf-16"), ["Height", "Phase"], 1),
    "blank.txt": (text(rows(HEIGHT) + "\n" + rows(PHASE)), [f"lines 1 to {N}", f"lines {N + 2} to {2 * N + 1}"], None),
    "comment.csv": (text(rows(HEIGHT, ",") + "# ---\n" + rows(PHASE, ",")), [f"lines 1 to {N}", f"lines {N + 2} to {2 * N + 1}"], None),
    "columns.csv": (text(table(HEIGHT, PHASE, heading="x (nm),y (nm),Height (nm),Phase (deg)\n", between=",")), ["Height", "Phase"], 1),
    "semicolon.csv": (text(table(HEIGHT, PHASE, heading="X/nm;Y/nm;z_nm;phase_deg\n", between=";").replace(".", ",")),
                      ["z", "phase_deg"], 1),
    "unnamed.txt": (text(table(HEIGHT, PHASE)), ["column 3", "column 4"], None),
    "two.h5": (hdf5(two_sets), ["phase", "scan/z"], 2),
    "stack.h5": (hdf5(stack), ["frames[1]", "frames[2]"], None),
    "scan.h5-jpk": (hdf5(jpk), ["height_trace", "phase_trace"], 1),
    "scan.topostats": (hdf5(topostats), ["grain_masks/above", "image"], 2),
    "two.npz": (lambda path: np.savez(path, z=HEIGHT, phase=PHASE), ["z", "phase"], 1),
    "stack.npy": (lambda path: np.save(path, np.stack([HEIGHT, PHASE])), ["map[1]", "map[2]"], None),
}


@pytest.fixture(params=SEVERAL)
def several(request, tmp_path):
    write, channels, first = SEVERAL[request.param]
    path = tmp_path / request.param
    write(path)
    return path, channels, first


def test_of_several_maps_one_is_taken_by_name(several, tmp_path):
    """By name and by number, by convert and adhesion alike, and the others are listed."""
    path, channels, first = several
    for k, name in enumerate(channels, 1):
        if k != 1 + (channels[0] in ("phase", "grain_masks/above")):
            continue  # the heights
        for wanted in (name, str(k), None):
            out = tmp_path / f"{wanted}.h5".replace("/", "-")
            if wanted is None and first is None:
                with pytest.raises(InputOutputError, match=r"holds 2 maps\n.*its channels: 1 .*, 2 .*\n.*channel=\"1\""):
                    convert(path, out)
                with pytest.raises(InputOutputError, match="holds 2 maps"):
                    height_map.read_map(str(path), "nm", 10 * EDGE)
                continue
            assert wanted is not None or first == k
            said = convert(path, out, wanted)
            assert f"note: channel {k} ({name}) was taken; --channel takes another: {3 - k} {channels[2 - k]}" in said
            found = height_map.read_map(str(path), "nm" if found_unit(path) is None else None, 10 * EDGE, wanted)
            np.testing.assert_allclose(found.heights, 10 * HEIGHT, rtol=1e-9, atol=1e-9)
            assert found.size == pytest.approx((10 * EDGE, 10 * EDGE))
            again = height_map.read_map(str(out), None if found_unit(path) else "nm", 10 * EDGE)
            np.testing.assert_array_equal(again.heights, found.heights)
    for wrong in ("Adhesion", "0", "3", "-1", ""):
        with pytest.raises(InputOutputError, match=f"has no channel '{wrong}'\n.*1 .*, 2 .*\n.*channel=\"2\""):
            convert(path, tmp_path / "no.h5", wrong)


def gwyddion(*channels):
    """A text of several maps, each with its unit: the map of number k is k everywhere but for its first height."""
    return text("".join(f"# Channel: {name}\n{SIZES}# Value units: {unit}\n" + rows(numbered(k)) for k, (name, unit) in enumerate(channels)))


def numbered(k):
    return np.full((N, N), float(k)) + (np.indices((N, N)).sum(0) == 0)


def datasets(*channels):
    def fill(file):
        for k, (name, unit) in enumerate(channels):
            file[name] = numbered(k)
            file[name].attrs.update({"size_x": EDGE, "size_y": EDGE, "size_unit": "nm"} | ({"unit": unit} if unit else {}))
    return hdf5(fill)


def instrument(*channels):
    """A file that SurfaceTopography reads, here a double of it."""
    def write(path):
        path.write_bytes(b"GWYP\0\0" + repr(channels).encode())
    return write


def open_topography(path):
    found = []
    for k, (name, unit) in enumerate(eval(Path(path).read_bytes()[6:])):
        found.append(types.SimpleNamespace(index=k, name=name, dim=2, unit=unit, physical_sizes=(EDGE, EDGE), heights=lambda k=k: numbered(k).T))
    return types.SimpleNamespace(channels=found, topography=lambda channel_index: found[channel_index], default_channel=found[0])


ASKED = None
WHICH = [  # file, channels with their units, the one that is taken (from 0), or that must be asked for
    (instrument, (("Deflection", "m"), ("Height", "m")), 1),
    (instrument, (("Amplitude", "V"), ("Phase", "deg"), ("Topography", "m")), 2),
    (instrument, (("Deflection", "m"), ("Z-Axis", "m"), ("Z-Axis Sensor", "m")), 1),
    (instrument, (("DeflectionTrace", "m"), ("ZSensorRetrace", "m"), ("AmplitudeTrace", "m")), 1),
    (instrument, (("Deflection", "m"), ("Deformation", "m")), ASKED),
    (instrument, (("Deflection", "m"),), ASKED),
    (instrument, (("PeakForce Error", "m"), ("Plane 1", "m")), 1),
    (instrument, (("Plane 1", "m"), ("Plane 2", "m")), ASKED),
    (gwyddion, (("Deflection", "nm"), ("Height", "nm")), 1),
    (gwyddion, (("Höhe Rückwärts", "nm"), ("Auslenkung", "nm")), 0),
    (gwyddion, (("Current", "nA"), ("Z", "nm"), ("Error", "nm")), 1),
    (gwyddion, (("Lateral Force", "nm"), ("Adhesion", "nm")), ASKED),
    (gwyddion, (("Deflection", "m"),), ASKED),
    (datasets, (("deflection", "nm"), ("scan/measuredHeight_trace", "nm"), ("tip_sample_separation", "nm")), 1),
    (datasets, (("amplitude", None), ("topography", None)), 1),
    (datasets, (("a", "nm"), ("b", "nm")), ASKED),
    (datasets, (("deflection", "nm"),), ASKED),
    (datasets, (("Height Error", "nm"), ("Height", "V"), ("surface", "nm")), 2),
]


@pytest.mark.parametrize("case", WHICH, ids=range(len(WHICH)))
def test_one_rule_says_which_map_is_the_height(case, tmp_path, monkeypatch):
    """For all readers; a map that is called another quantity is never taken without being asked for, and can be asked for."""
    monkeypatch.setitem(sys.modules, "SurfaceTopography", types.SimpleNamespace(open_topography=open_topography))
    made, channels, taken = case
    path = tmp_path / {instrument: "m.gwy", gwyddion: "m.txt", datasets: "m.h5"}[made]
    made(*channels)(path)
    order = sorted(range(len(channels)), key=lambda k: channels[k][0]) if made is datasets else range(len(channels))
    try:
        found = height_map.read_map(str(path), assumed="nm")
        assert taken is not ASKED and found.heights[-1, -1] / (found.heights[0, 0] - found.heights[-1, -1]) == pytest.approx(taken)
    except InputOutputError as error:
        assert taken is ASKED and " --channel " in str(error), error
        said = str(error).rpartition("--channel ")[2].split()[0]
        assert height_map.read_map(str(path), channel=said, assumed="nm").heights.shape == (N, N)
        others = [Channel(name, dict).is_other for name, _ in channels]
        assert not others[order[int(said) - 1]] or all(others), error


def found_unit(path):
    return None if path.name in ("blank.txt", "comment.csv", "unnamed.txt", "two.npz", "stack.npy") else "known"


def test_what_is_no_length_is_no_height(tmp_path):
    for name in ("headers.txt", "columns.csv", "two.h5", "scan.h5-jpk", "scan.topostats"):
        write, channels, first = SEVERAL[name]
        write(tmp_path / name)
        with pytest.raises(InputOutputError, match="no heights in channel"):
            convert(tmp_path / name, tmp_path / "no.h5", str(3 - first))
        # Whoever says the unit may have it.
        assert height_map.read_map(str(tmp_path / name), "nm", 100.0, str(3 - first)).heights.shape == (N, N)


ONE = {"plain.txt": text(rows(HEIGHT)), "double.txt": text(rows(HEIGHT).replace("\n", "\n\n")),
       "footer.txt": text(rows(HEIGHT) + "\n# Width: 32 nm\n# Height: 32 nm\n# Value units: nm\n"),
       "middle.txt": text(rows(HEIGHT[:7]) + "\n" + rows(HEIGHT[7:])),
       "points.txt": text("".join(table(HEIGHT).splitlines(True)[k] + ("\n" if k % N == N - 1 else "") for k in range(N * N))),
       "names.csv": text(table(HEIGHT, heading="x,y,z\n", between=",")),
       "map.npy": lambda path: np.save(path, HEIGHT), "map.npz": lambda path: np.savez(path, z=HEIGHT),
       "map.h5": hdf5(lambda file: file.create_dataset("z", data=HEIGHT))}


@pytest.mark.parametrize("name", ONE)
def test_one_map_stays_one(tmp_path, name):
    ONE[name](tmp_path / name)
    file = str(tmp_path / name)
    for channel in (None, "1"):
        np.testing.assert_allclose(height_map.read_map(file, "nm", None, channel).heights, 10 * HEIGHT, rtol=1e-12)
    with pytest.raises(InputOutputError, match="has no channel 'Phase'\n.*it holds one map\n.*leave --channel out"):
        read_heights(file, "Phase")


def test_what_the_user_says_holds_over_the_file_and_is_said(tmp_path):
    """The same for a scene and for adhesion: heights, width, and one note for each that differs."""
    file = tmp_path / "map.h5"
    for told_unit, told_size, scale in (("nm", EDGE, 1.0), ("µm", 0.1, 0.5), (None, None, 1.0), ("V", EDGE, 1.0),
                                          ("nm", 0.0, 2.0), ("nm", -3.0, 1.0)):
        with h5py.File(file, "w") as opened:
            attributes = opened.create_dataset("heights", data=HEIGHT).attrs
            for key, value in (("unit", told_unit), ("size_x", told_size), ("scale", scale)):
                if value is not None:
                    attributes[key] = value
        for unit in (None, "nm", "Å"):
            for size in (None, 320.0, 500.0):
                case = f"{told_unit} {told_size} {scale} | {unit} {size}"
                sets = ["surface.kind=file", f"surface.file={file}", f"surface.sites={N}", f"surface.spacing={(size or 320.0) / N!r}"]
                sets += ([f"surface.file_unit={unit}"] if unit else []) + ([f"surface.file_size={size}"] if size else [])
                (tmp_path / "empty.toml").write_text("")
                try:
                    in_scene = program.surface(str(tmp_path / "empty.toml"), sets)
                except Error as error:
                    in_scene = error
                try:
                    here = height_map.read_map(str(file), unit, size, assumed="Å")
                except Error as error:
                    here = error
                if isinstance(in_scene, Error) or isinstance(here, Error):
                    if not any(words in str(in_scene) for words in ("covers", "wide, the box", "larger than the box")):  # the box, which a scene has
                        assert isinstance(in_scene, Error) and isinstance(here, Error), f"{case}\n{in_scene}\n{here}"
                    continue
                assert in_scene["rms"] == pytest.approx(here.heights.std(), rel=1e-9), case
                doubts = [d for d in in_scene["doubts"] if "the file says" in d]
                plain = [re.sub(r" \(.*\)$", "", d) for d in doubts]
                assert sorted(plain) == sorted(re.sub(r" \(.*\)$", "", n) for n in here.notes), case
                if unit and told_unit in ("nm", "µm", "V") and told_unit != unit:
                    assert any(f"in {told_unit}, and {unit} is taken" in d for d in doubts), case


def test_scale_is_a_factor_everywhere(tmp_path):
    (tmp_path / "empty.toml").write_text("")
    for scale in (0.0, -1.0, float("nan"), float("inf")):
        with h5py.File(tmp_path / "map.h5", "w") as file:
            file["heights"] = HEIGHT
            file["heights"].attrs.update(unit="nm", size_x=EDGE, scale=scale)
        with pytest.raises(Error, match="scale = .* is no factor"):
            height_map.read_map(str(tmp_path / "map.h5"))
        with pytest.raises(Error, match="scale = .* is no factor"):
            program.surface(str(tmp_path / "empty.toml"), ["surface.kind=file", f"surface.file={tmp_path}/map.h5"])


HOLES = (np.nan, np.inf, 1.7976931348623157e308, -3.4028234663852886e38, 1.70141e38)


@pytest.mark.parametrize("hole", HOLES)
def test_points_without_a_height_in_every_format(tmp_path, hole):
    holed = HEIGHT.copy()
    holed[3, 4] = holed[9, 9] = hole
    write = {"m.txt": text(rows(holed)), "m.csv": text(table(holed, heading="x,y,z\n", between=",")), "m.npz": lambda p: np.savez(p, z=holed),
             "m.npy": lambda p: np.save(p, holed), "m.h5": hdf5(lambda f: f.create_dataset("heights", data=holed)),
             "esri.asc": text(f"ncols {N}\nnrows {N}\ncellsize 2\n" + rows(holed, " ")),
             "m.topostats": hdf5(lambda f: (f.create_dataset("image", data=holed), f.create_dataset("pixel_to_nm_scaling", data=2.0)))}
    for name, make in write.items():
        make(tmp_path / name)
        found = height_map.read_map(str(tmp_path / name), "nm", 320.0).heights
        assert np.isnan(found).sum() == 2 and np.nanmax(abs(found)) < 20, name
        if name not in ("m.npy", "m.h5"):
            assert "points without a height: 2" in convert(tmp_path / name, tmp_path / f"{name}.h5"), name
            with h5py.File(tmp_path / f"{name}.h5") as file:
                assert np.isnan(file["heights"][()]).sum() == 2
        else:
            (tmp_path / "s.toml").write_text(f'[surface]\nkind = "file"\nfile = "{name}"\nfile_unit = "nm"\nsites = {N}\nfile_missing = "fill"\n')
            command("surface", tmp_path / "s.toml", "--out", tmp_path / f"{name}-out", says="2 points of the map (0.78 %) had no height")


def lined(n=64, amplitude=0.6):
    """A smooth map with noise within its lines, nm."""
    draw = np.random.default_rng(2)
    y, x = np.indices((n, n))
    noise = np.array([np.convolve(draw.normal(size=n + 8), np.ones(9) / 3.0, "valid") for _ in range(n)])
    return np.sin(2 * np.pi * (2 * x + y) / n) * 3 + np.cos(2 * np.pi * (x - 3 * y) / n) * 2 + amplitude * noise + 0.02 * draw.normal(size=(n, n))


def test_what_may_be_wrong_is_said_by_convert_surface_and_adhesion(tmp_path):
    from asperity.studies.map_scene import scene_of

    header = "# Width: 100 nm\n# Height: 100 nm\n# Value units: nm\n"
    (tmp_path / "lines.txt").write_text(header + rows(lined()))
    (tmp_path / "clean.txt").write_text(header + rows(lined(amplitude=0.0)))
    assert "line noise" not in convert(tmp_path / "clean.txt", tmp_path / "clean.h5")
    said = convert(tmp_path / "lines.txt", tmp_path / "lines.h5")
    assert "note: line noise of the scan: neighbours along y differ" in said and 'surface.line_noise = "isotropic" takes it off' in said
    scene = tmp_path / "s.toml"
    scene.write_text('[surface]\nkind = "file"\nfile = "lines.h5"\nsites = 64\nspacing = 15.625\n')
    command("surface", scene, "--out", tmp_path / "a", says="note: line noise of the scan")
    done = command("surface", scene, "--out", tmp_path / "b", "--set", "surface.line_noise=isotropic", says='"isotropic" changed the rms height from')
    assert "takes it off" not in done
    assert '"line_noise":"isotropic"' in (tmp_path / "b/result.json").read_text().replace(" ", "")
    given = ("5 GPa", 0.3, "0.2 J/m^2")
    for treatment, says in ((None, '--line-noise "isotropic" takes it off'), ("isotropic", '--line-noise "isotropic" changed')):
        made, notes = scene_of(str(tmp_path / "lines.txt"), *given, tmp_path / f"{treatment}", line_noise=treatment)[:2]
        assert any(says in note for note in notes), notes
        assert ('line_noise = "isotropic"' in made.read_text()) == (treatment is not None)
    (tmp_path / "wide.txt").write_text(header.replace("100 nm", "160 m") + rows(lined(amplitude=0.0)))
    assert "the map is 160 m wide" in convert(tmp_path / "wide.txt", tmp_path / "wide.h5")
    spoilt = lined(amplitude=0.0)
    spoilt[5, 6] = -9999
    (tmp_path / "hole.txt").write_text(header + rows(spoilt))
    assert "1 points have the height -99990 Å" in convert(tmp_path / "hole.txt", tmp_path / "hole.h5")


def test_numbers_that_are_none_are_refused_by_name(place):
    from asperity.studies.map_scene import scene_of

    np.save("map.npy", lined())
    for name, value in (("size", "0nm"), ("size", "-5nm"), ("size", "nan nm"), ("poisson", float("nan")), ("poisson", float("inf")),
                        ("young", "nan GPa"),
                        ("adhesion", "nan mJ/m2"), ("range", "0Å"), ("range", "nan Å")):
        given = {"young": "1GPa", "poisson": 0.3, "adhesion": "50mJ/m2", "size": "100nm", "range": None, name: value}
        with pytest.raises(Error, match=f"^{name} = ") as raised:
            scene_of("map.npy", given["young"], given["poisson"], given["adhesion"], place / "out", size=given["size"], unit="nm",
                     reach=given["range"])
        assert "TOML" not in str(raised.value)
    said = command("adhesion", "map.npy", "--E=1GPa", "--nu=nan", "--work=50mJ/m2", "--unit=nm", "--size=100nm", expect=2)
    assert said.startswith("poisson = nan") and not (place / "out").exists()


def test_nonsense_ends_in_a_map_or_a_sentence(tmp_path):
    """Files of every kind with bytes changed or cut off."""
    draw, kinds = np.random.default_rng(62), set()
    for name, (write, *_) in SEVERAL.items():
        path = tmp_path / name
        write(path)
        whole = path.read_bytes()
        for trial in range(12):
            damaged = bytearray(whole if trial % 3 else whole[:draw.integers(len(whole))])
            for at in draw.integers(0, max(1, len(damaged)), 6):
                damaged[at:at + 1] = bytes([draw.integers(256)])
            path.write_bytes(damaged)
            try:
                found = height_map.read_map(str(path), "nm", 100.0, "1")
                kinds.add(found.heights.ndim)
            except Error as error:
                assert str(error).count("\n") >= 1, error
                kinds.add("refused")
    assert kinds == {2, "refused"}


def test_a_map_with_holes_is_scaled_to_an_rms(place):
    heights = np.round(10 * HEIGHT, 3)
    heights[:3, :2] = np.nan
    np.save("m.npy", heights)
    scene = {"surface": {"kind": "file", "file": "m.npy", "file_missing": "hole", "sites": N, "file_unit": "Å"}, "interface": {"kind": "wall"},
             "drive": {"mode": "quasistatic"}}
    found = asperity.surface(scene, {"surface.rms": 2.5, "surface.detrend": "none"})
    assert np.isnan(found.heights).sum() == 6 and np.nanstd(found.heights) == pytest.approx(2.5, rel=1e-9)
