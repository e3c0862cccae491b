"""The implicit integrator at large steps, on fine sheets, on both backends and against verlet (tools/validate implicit).
Each check writes report/data/implicit_NAME.csv anew, a line a run, with the command that made it."""
import csv, datetime, json, os, pathlib, shlex, statistics, subprocess, sys, tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
program = os.environ.get("CLOTHSIM", str(root / "build/release/clothsim"))


def clothsim(*words):
    """What a command says with --json, and the command as one would type it."""
    words = [str(word) for word in words]
    done = subprocess.run([program, *words, "--json"], capture_output=True, text=True, cwd=root,
                          env={"OMP_WAIT_POLICY": "passive", **os.environ})
    command = "clothsim " + " ".join(shlex.quote(word) for word in words)
    if not done.stdout.strip():
        sys.exit(f"tools/validate: {command} failed:\n{done.stderr}")
    return json.loads(done.stdout), command


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


class Table:
    def __init__(self, name, columns, commit):
        self.path = root / f"report/data/implicit_{name}.csv"
        self.columns, self.lines = columns.split() + ["command", "commit", "date"], []
        self.last = [commit, datetime.date.today().isoformat()]

    def add(self, *values):
        self.lines.append([f"{value:.6g}" if isinstance(value, float) else value for value in values] + self.last)
        print("  ".join(str(value) for value in self.lines[-1][:-3]), flush=True)

    def write(self):
        with open(self.path.with_suffix(".part"), "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([self.columns, *self.lines])
        os.replace(self.path.with_suffix(".part"), self.path)


# --- Rest shapes: wherever steps of 0.01 to 0.1 s lead, it is where small explicit steps lead.
rest_scenes = {"pinned2": ("cloth.ks", [5e3, 5e4, 1e6]), "cs171": ("cloth.stiffness_reference", [40, 5e3, 1e6])}
free_of_contact = {"solver.strain_limit": "false", "solver.self_collision": "false"}
allowed = 0.002  # m


def rest_shapes(commit):
    table = Table("rest_shapes", "scene key value integrator step seconds centroid_x centroid_y centroid_z lowest kinetic_energy "
                                 "centroid_off lowest_off demand met", commit)
    for scene, (key, stiffness) in rest_scenes.items():
        for value in stiffness:
            def run(**more):
                # Damping changes how a cloth comes to rest, not where.
                fixed = {key: value, "cloth.damping": 0.2 if scene == "pinned2" else 0, **free_of_contact}
                return clothsim("run", "-f", scene, "--backend", "cpu", "--frames", round(40 * more["rate"]),
                                *settings({**fixed, "solver.frames_per_sec": more["rate"], **more["solver"]}))
            expected, command = run(rate=50, solver={"solver.integrator": "verlet", "solver.simulation_steps": "auto"})
            def add(integrator, result, command, rest):
                off = sum((a - b) ** 2 for a, b in zip(result["centroid"], rest["centroid"])) ** 0.5
                lower = abs(result["min_y"] - rest["min_y"])
                met = result["finite"] and off <= allowed and lower <= allowed
                table.add(scene, key, value, integrator, result["dt"], result["sim_seconds"], *result["centroid"], result["min_y"],
                          result["kinetic_energy"], off, lower, f"<={allowed}", "yes" if met else "no", command)
            add("verlet", expected, command, expected)
            for rate in (100, 60, 20, 10):
                add("implicit", *run(rate=rate, solver={"solver.integrator": "implicit", "solver.simulation_steps": 1}), expected)
    table.write()


# --- Resolution: a finer lattice of a material is the same sheet.
def stretches(path, columns):
    """l/L - 1 of the threads of a square sheet of 1 m, in ascending order."""
    with open(path, newline="") as file:
        points = [tuple(float(line[axis]) for axis in "xyz") for line in csv.DictReader(file)]
    length = 1 / (columns - 1)
    ends = [(i, i + 1) for i in range(len(points)) if (i + 1) % columns] + [(i, i + columns) for i in range(len(points) - columns)]
    return sorted(sum((a - b) ** 2 for a, b in zip(points[i], points[j])) ** 0.5 / length - 1 for i, j in ends)


def resolution(commit):
    table = Table("resolution", "hung_from points seconds fall_of_lowest fall_of_centroid mean_stretch p999_stretch kinetic_energy",
                  commit)
    cotton = {"cloth.material": "cotton", "cloth.material.damping": 3, "cloth.width": 1, "cloth.height": 1, "cloth.orientation": "vertical",
              "cloth.position": "[0,0,0]", "solver.integrator": "implicit", "solver.frames_per_sec": 60, "solver.simulation_steps": 1,
              **free_of_contact}
    for name, pins, seconds in (("top edge", '["top"]', 4), ("two corners", None, 12)):
        for points in (64, 128, 256, 512):
            pinned = pins or f"[[0,{points - 1}],[{points - 1},{points - 1}]]"
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "cloth.csv"
                start = {**cotton, "cloth.num_width_points": points, "cloth.num_height_points": points, "cloth.pinned": pinned}
                at_start, _ = clothsim("run", "-f", "pinned2", "--backend", "cpu", "--frames", 0, *settings(start))
                result, command = clothsim("run", "-f", "pinned2", "--backend", "cpu", "--frames", 60 * seconds, *settings(start),
                                           "--save", path)
                sorted_stretches = stretches(path, points)
            table.add(name, points, result["sim_seconds"], at_start["min_y"] - result["min_y"],
                      at_start["centroid"][1] - result["centroid"][1], statistics.fmean(sorted_stretches),
                      sorted_stretches[int(0.999 * len(sorted_stretches))], result["kinetic_energy"],
                      command.replace(str(path), "cloth.csv"))
    table.write()


# --- The same bits on both backends, contacts included.
def bits(commit):
    table = Table("bits", "scene frames steps floats differing_floats max_abs_difference self_contacts device", commit)
    for scene in ("pinned2", "sphere", "drape_box", "fold", "skirt"):
        result, command = clothsim("compare", "-f", scene, "--frames", 120, *settings({
            "solver.integrator": "implicit", "solver.frames_per_sec": 60, "solver.simulation_steps": 1}))
        table.add(*[result[key] for key in table.columns[:-3]], command)
    table.write()


# --- Milliseconds for 1/60 s, and for the largest stable steps of verlet.
def speed(commit):
    table = Table("speed", "backend points implicit_ms verlet_steps verlet_ms ratio device", commit)
    common = {"cloth.material": "cotton", "solver.frames_per_sec": 60, **free_of_contact}
    for backend in ("cpu", "gpu"):
        for points in (64, 128, 256, 512):
            size = f"{points}x{points}"
            def bench(integrator, steps):
                values = settings({**common, "solver.integrator": integrator, "solver.simulation_steps": steps})
                result, command = clothsim("bench", "-f", "pinned2", "--resolution", size, "--backend", backend, "--seconds", 0.5, *values)
                return result["steps"][0], command
            explicit, _ = clothsim("run", "-f", "pinned2", "--resolution", size, "--backend", "cpu", "--frames", 0, *settings(
                {**common, "solver.integrator": "verlet", "solver.simulation_steps": "auto"}))
            steps = round(1 / 60 / explicit["dt"])
            implicit, command = bench("implicit", 1)
            verlet, _ = bench("verlet", "auto")
            verlet_ms = steps * verlet["ms_per_step"]
            table.add(backend, points, implicit["ms_per_step"], steps, verlet_ms, verlet_ms / implicit["ms_per_step"],
                      implicit["device"], command + "; and with verlet, auto")
    table.write()


checks = {"rest_shapes": rest_shapes, "resolution": resolution, "bits": bits, "speed": speed}


def run(commit, names):
    for name in names:
        checks[name](commit)
