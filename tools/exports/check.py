"""Exports against readers that nobody on this project wrote, and against kills and full disks (tools/validate exports)."""
import csv, datetime, json, os, pathlib, random, resource, shutil, signal, subprocess, sys, tempfile, time

from tree import program, root

last_frame, frames = 119, [0, 60, 119]
columns = "date commit check tool measured demand met unit".split()


def clothsim(folder, *words, scene="pinned2", **options):
    return subprocess.run([program, "run", "-f", scene, "--backend", "cpu", *words], cwd=folder, text=True,
                          capture_output=True, **options)


# Our own positions at a frame, from the CSV of the same run.
def ours(folder, frame):
    with open(folder / f"frame_{frame:04d}.csv", newline="") as file:
        return [[float(line[axis]) for axis in "xyz"] for line in csv.DictReader(file)]


def largest_difference(a, b):
    assert len(a) == len(b), f"{len(a)} points, expected {len(b)}"
    return max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))


def export(folder):
    done = clothsim(folder, "--frames", str(last_frame), "--save", "cloth.pc2", "--save", "cloth.usda", "--save",
                    "frame_%04d.csv")
    assert done.returncode == 0, done.stderr


def blender(folder):
    if not shutil.which("blender"):
        sys.exit("tools/validate: blender is missing (Debian: apt-get install blender)")
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                           root / "tools/exports/blender_positions.py", "--", folder / "cloth_rest.obj",
                           folder / "cloth.pc2", ",".join(map(str, frames)), folder / "blender.json"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    result = json.loads((folder / "blender.json").read_text())
    assert result["uvs"] == 3 * result["faces"] > 0, "a uv at each corner of each triangle"
    for frame, positions in zip(frames, result["frames"]):
        difference = largest_difference(positions, ours(folder, frame))
        yield f"OBJ + PC2, frame {frame}: largest difference of a coordinate", f'Blender {result["version"]}', difference, 1e-6, "m"


def usd(folder):
    try:
        from pxr import Usd, UsdGeom
    except ImportError:
        sys.exit("tools/validate: Pixar's USD library is missing (pip install usd-core, in a virtual environment, and run "
                 "tools/validate with its python3)")
    stage = Usd.Stage.Open(str(folder / "cloth.usda"))
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/clothsim/cloth"))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1 and UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetTimeCodesPerSecond() == 90 and stage.GetEndTimeCode() == last_frame
    assert UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").GetInterpolation() == "vertex"
    valid, reason = UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(),
                                                  mesh.GetFaceVertexCountsAttr().Get(), len(mesh.GetPointsAttr().Get(0)))
    assert valid, reason
    version = ".".join(map(str, Usd.GetVersion()))
    for frame in frames:
        difference = largest_difference(mesh.GetPointsAttr().Get(frame), ours(folder, frame))
        yield f"USDA, frame {frame}: largest difference of a coordinate", f"usd-core {version}", difference, 1e-6, "m"


# Four napkins, a ball and a floor, in each format that knows of several meshes.
pieces, piece_points, several_frames = 4, 29 * 29, 30


def export_several(folder):
    files = ["all.usda", "last.obj", "last.ply", "last.glb", "frame_%04d.csv"]
    try:
        import pxr
        files.append("all.usdc")
    except ImportError:
        pass
    done = clothsim(folder, "--frames", str(several_frames), *(word for name in files for word in ("--save", name)), scene="stack",
                    env={**os.environ, "CLOTHSIM_PYTHON": sys.executable})
    assert done.returncode == 0, done.stderr
    last = ours(folder, several_frames)
    return [last[k * piece_points:(k + 1) * piece_points] for k in range(pieces)]


# The largest distance from one of our points to the nearest of the others, where a reader orders or merges points anew.
def farthest_from(points, others):
    import numpy
    a, b = numpy.array(points), numpy.array(others)
    return max(float(numpy.sqrt(((b - p) ** 2).sum(axis=1).min())) for p in a)


def blender_several(folder):
    cloths = export_several(folder)
    files = [str(folder / name) for name in ["last.obj", "last.ply", "all.usda", "all.usdc", "last.glb"] if (folder / name).exists()]
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                           root / "tools/exports/blender_meshes.py", "--", folder / "several.json", *files],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    result = json.loads((folder / "several.json").read_text())
    for extension, read in result["files"].items():
        meshes = [mesh for mesh in read["meshes"] if extension == "ply" or mesh["name"].startswith("cloth")]
        assert len(meshes) == (1 if extension == "ply" else pieces), (extension, [mesh["name"] for mesh in read["meshes"]])
        assert sum(mesh["faces"] for mesh in meshes) == pieces * 2 * 28 * 28 and all(mesh["uvs"] for mesh in meshes)
        if extension.startswith("usd"):
            assert read["cameras"] == 1 and len(read["meshes"]) >= pieces + 1, "the camera and the floor"
            continue  # at frame 0; usd() compares positions
        each = [sum(cloths, [])] if extension == "ply" else cloths
        difference = max(farthest_from(ours_, mesh["positions"]) for ours_, mesh in zip(each, meshes))
        yield f"{extension.upper()} of four cloths: largest distance of a point", f'Blender {result["version"]}', difference, 1e-6, "m"


def trimesh_several(folder):
    try:
        import numpy, trimesh
    except ImportError:
        sys.exit("tools/validate: trimesh is missing (pip install trimesh, in a virtual environment, and run tools/validate with its "
                 "python3)")
    cloths = export_several(folder)
    tool = f"trimesh {trimesh.__version__}"
    obj = trimesh.load(folder / "last.obj", split_objects=True, group_material=False, process=False)
    read = [mesh for _, mesh in sorted(obj.geometry.items())]
    assert len(read) == pieces and all(len(mesh.faces) == 2 * 28 * 28 for mesh in read), obj.geometry
    yield "OBJ of four cloths: largest distance of a point", tool, \
        max(farthest_from(c, mesh.vertices) for c, mesh in zip(cloths, read)), 1e-6, "m"
    ply = trimesh.load(folder / "last.ply", process=False)
    whose = ply.metadata["_ply_raw"]["face"]["data"]["cloth"]
    assert [int((whose == k).sum()) for k in range(pieces)] == [2 * 28 * 28] * pieces
    assert all((ply.faces[numpy.ravel(whose) == k] // piece_points == k).all() for k in range(pieces))
    yield "PLY of four cloths: largest difference of a coordinate", tool, \
        largest_difference(ply.vertices.tolist(), sum(cloths, [])), 1e-6, "m"


def usd_several(folder):
    from pxr import Gf, Usd, UsdGeom, UsdShade
    cloths = export_several(folder)
    version = ".".join(map(str, Usd.GetVersion()))
    for name in ["all.usda", "all.usdc"]:
        stage = Usd.Stage.Open(str(folder / name))
        assert stage.GetDefaultPrim().GetPath() == "/clothsim"
        worst, skew = 0, 0
        for k, points in enumerate(cloths):
            mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"/clothsim/cloth{k}"))
            read = mesh.GetPointsAttr().Get(several_frames)
            valid, reason = UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(),
                                                          mesh.GetFaceVertexCountsAttr().Get(), len(read))
            assert valid, reason
            worst = max(worst, largest_difference(read, points))
            normals = mesh.GetNormalsAttr().Get(several_frames)
            assert len(normals) == len(read) and mesh.GetNormalsInterpolation() == "vertex"
            skew = max(skew, max(abs(Gf.Vec3f(n).GetLength() - 1) for n in normals))
            extent = UsdGeom.PointBased.ComputeExtent(read)
            assert largest_difference(mesh.GetExtentAttr().Get(several_frames), extent) == 0
            material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
            surface, _, _ = material.ComputeSurfaceSource()
            assert surface.GetIdAttr().Get() == "UsdPreviewSurface" and surface.GetInput("diffuseColor").Get() is not None
        ball = UsdGeom.Sphere(stage.GetPrimAtPath("/clothsim/solids/sphere0"))
        assert ball.GetRadiusAttr().Get() == 0.16 and stage.GetPrimAtPath("/clothsim/solids/plane1")
        camera = UsdGeom.Camera(stage.GetPrimAtPath("/clothsim/camera")).GetCamera(0)
        assert abs(camera.GetFieldOfView(Gf.Camera.FOVVertical) - 34) < 1e-4
        axis = Gf.Vec3d(0, 0.13, 0) - Gf.Vec3d(0.8, 0.85, 1.35)
        assert (camera.frustum.ComputeViewDirection() - axis.GetNormalized()).GetLength() < 1e-6
        kind = "text" if name.endswith("a") else "binary"
        yield f"USD of four cloths, {kind}: largest difference of a coordinate", f"usd-core {version}", worst, 1e-6, "m"
        yield f"USD of four cloths, {kind}: largest difference of a normal's length from 1", f"usd-core {version}", skew, 1e-6, ""


sequence = ["--resolution", "40x40", "--frames", "60", "--save", "frame_%04d.ply", "--save", "cloth.pc2", "--save",
            "cloth.usda", "--save", "last.obj"]
streamed = ["cloth.pc2", "cloth.usda", "cloth_rest.obj", "last.obj"]


# Files that are neither whole nor, where one was there before, the old one. Hidden ones are the temporary files.
def torn_files(folder, whole):
    return [path.name for path in folder.iterdir() if not path.name.startswith(".")
            and path.read_bytes() not in (whole.get(path.name), b"old")]


# The whole files by name, and how long making them takes [s].
def reference(folder):
    folder = folder / "reference"
    folder.mkdir(exist_ok=True)
    start = time.monotonic()
    done = clothsim(folder, *sequence, "--save", "frame_%04d.obj")
    assert done.returncode == 0, done.stderr
    return {path.name: path.read_bytes() for path in folder.iterdir()}, time.monotonic() - start


def kills(folder):
    whole, duration = reference(folder)
    torn, interrupted = [], 0
    for moment in range(50):
        attempt = folder / f"kill{moment}"
        attempt.mkdir()
        for name in streamed:
            (attempt / name).write_bytes(b"old")
        process = subprocess.Popen([program, "run", "-f", "pinned2", "--backend", "cpu", *sequence], cwd=attempt,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(random.Random(moment).uniform(0, 1) * duration)
        process.kill()
        interrupted += process.wait() == -signal.SIGKILL
        torn += torn_files(attempt, whole)
        shutil.rmtree(attempt)
    print(f"kill -9: {interrupted} of 50 runs were still at work")
    yield f"torn files after kill -9 at 50 moments of a run ({interrupted} still at work)", "kill -9", len(torn), 0, "files"


# On a file system of 1 MiB where one can be mounted, else with files of 64 KiB at most.
def full_disk(folder):
    whole, _ = reference(folder)
    disk = folder / "disk"
    disk.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", disk], capture_output=True).returncode == 0
    tool = "tmpfs of 1 MiB" if mounted else "ulimit -f of 64 KiB"
    limit = None if mounted else lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))
    try:
        for save in ["frame_%04d.ply", "cloth.pc2", "cloth.usda", "frame_%04d.obj"]:
            name = save.replace("%04d", "0000")
            if "%" not in save:
                (disk / name).write_bytes(b"old")
            done = clothsim(disk, "--resolution", "40x40", "--frames", "60", "--save", save, preexec_fn=limit)
            message = done.stderr.strip().splitlines()[-1]
            print(f"{tool}, {save}: exit code {done.returncode}, {message}")
            assert done.returncode == 5 and "cannot be written" in message, done.stderr
            torn = [name for name in torn_files(disk, whole) if name in whole]
            torn += [path.name for path in disk.iterdir() if path.name.startswith(".")]
            if "%" not in save and (disk / name).read_bytes() != b"old":
                torn.append(name)
            for path in disk.iterdir():
                path.unlink()
            yield f"torn or temporary files left by {save}", tool, len(torn), 0, "files"
    finally:
        if mounted:
            subprocess.run(["umount", disk], check=True)


# A body that deforms, from USD: the walking figure in centimetres and with z up, as modelling programs have it.
def usd_body(folder):
    from pxr import Gf, Usd, UsdGeom
    def read(path):
        lines = [line.split() for line in path.read_text().splitlines()]
        return ([[float(n) for n in line[1:4]] for line in lines if line[:1] == ["v"]],
                [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[:1] == ["f"]])
    shapes = [read(root / f"assets/meshes/walk/walk_{k:02d}.obj") for k in range(24)]
    stage = Usd.Stage.CreateNew(str(folder / "body.usdc"))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    stage.SetStartTimeCode(1), stage.SetEndTimeCode(len(shapes)), stage.SetTimeCodesPerSecond(22)
    mesh = UsdGeom.Mesh.Define(stage, "/figure/body")
    for k, (points, faces) in enumerate(shapes):
        mesh.GetPointsAttr().Set([Gf.Vec3f(100 * x, -100 * z, 100 * y) for x, y, z in points], k + 1)
    mesh.GetFaceVertexCountsAttr().Set([len(face) for face in faces])
    mesh.GetFaceVertexIndicesAttr().Set([corner for face in faces for corner in face])
    stage.Save()
    made = subprocess.run([sys.executable, str(root / "tools/usd_to_obj"), "body.usdc", "body_%02d.obj"], cwd=folder, text=True,
                          capture_output=True)
    assert made.returncode == 0, made.stderr
    collider = json.loads(made.stdout)
    assert (collider["shapes"], collider["shapes_per_second"]) == (24, 22), made.stdout
    worst = 0
    for k, (points, faces) in enumerate(shapes):
        own_points, own_faces = read(folder / f"body_{k:02d}.obj")
        assert own_faces == faces
        worst = max(worst, largest_difference(own_points, points))
    yield "body of a USD mesh with time samples: largest difference of a coordinate", \
        "usd-core " + ".".join(map(str, Usd.GetVersion())), worst, 1e-6, "m"
    done = clothsim(folder, "--frames", "1", "--set", f"colliders.0.file={folder}/body_%02d.obj", scene="walk")
    assert done.returncode == 0, done.stderr


# One check after the other.
def each_of(*checks):
    return lambda folder: (row for check in checks for row in check(folder))


by_name = {"blender": [blender, blender_several], "usd": [usd, usd_several, usd_body], "trimesh": [trimesh_several], "kills": [kills],
           "disk": [full_disk]}


def run(commit, checks):
    path = root / "report/data/exports.csv"
    if not path.exists():
        path.write_text(",".join(columns) + "\n")
    failed = False
    with tempfile.TemporaryDirectory() as name, open(path, "a", newline="") as file:
        folder = pathlib.Path(name)
        out = csv.writer(file, lineterminator="\n")
        if "blender" in checks or "usd" in checks:
            export(folder)
        for check in checks:
            for what, tool, measured, demand, unit in each_of(*by_name[check])(folder):
                met = measured <= demand
                failed |= not met
                print(f'{what}, {tool}: {measured:.3g} {unit}, demanded <={demand:g}: {"met" if met else "NOT MET"}')
                out.writerow([datetime.date.today().isoformat(), commit, what, tool, f"{measured:.3g}", f"<={demand:g}",
                              "yes" if met else "no", unit])
    sys.exit(1 if failed else 0)
