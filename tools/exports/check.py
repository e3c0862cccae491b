"""Exports against readers that nobody on this project wrote, and against kills and full disks (tools/validate exports)."""
import csv, datetime, json, os, pathlib, random, resource, shutil, signal, subprocess, sys, tempfile, time

root = pathlib.Path(__file__).resolve().parent.parent.parent
program = os.environ.get("CLOTHSIM", str(root / "build/release/clothsim"))
last_frame, frames = 119, [0, 60, 119]
columns = "date commit check tool measured demand met unit".split()


def clothsim(folder, *words, **options):
    return subprocess.run([program, "run", "-f", "pinned2", "--backend", "cpu", *words], cwd=folder, text=True,
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
    mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
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


# On a file system of 1 MiB where one can be mounted, else with files of 1 MiB at most.
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
            for what, tool, measured, demand, unit in {"blender": blender, "usd": usd, "kills": kills,
                                                       "disk": full_disk}[check](folder):
                met = measured <= demand
                failed |= not met
                print(f'{what}, {tool}: {measured:.3g} {unit}, demanded <={demand:g}: {"met" if met else "NOT MET"}')
                out.writerow([datetime.date.today().isoformat(), commit, what, tool, f"{measured:.3g}", f"<={demand:g}",
                              "yes" if met else "no", unit])
    sys.exit(1 if failed else 0)
