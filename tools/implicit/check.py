"""The implicit integrator at large steps, on fine sheets and against verlet (tools/validate implicit). Each check writes a table
in report/data anew, a line a figure, with the run of clothsim that it comes from."""
import csv, datetime, json, os, pathlib, shlex, statistics, subprocess, sys, tempfile

from tree import program, root



def clothsim(*words):
    """What a command says with --json, and the command as one would type it."""
    words = [str(word) for word in words]
    done = subprocess.run([program, *words, "--json"], capture_output=True, text=True, cwd=root)
    command = "clothsim " + " ".join(shlex.quote(word) for word in words)
    if not done.stdout.strip():
        sys.exit(f"tools/validate: {command} failed:\n{done.stderr}")
    return json.loads(done.stdout), command


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


class Table:
    def __init__(self, file, check, columns, commit):
        self.path, self.columns, self.lines = root / "report/data" / file, columns.split(), []
        self.common = {"date": datetime.date.today().isoformat(), "commit": commit, "command": f"tools/validate implicit {check}"}

    def add(self, *values, run):
        values = [f"{value:.6g}" if isinstance(value, float) else value for value in values]
        self.lines.append({**self.common, **dict(zip(self.columns, values, strict=True)), "run": run})
        print("  ".join(str(value) for value in values), flush=True)

    def write(self):
        part = self.path.with_suffix(".part")
        with open(part, "w", newline="") as file:
            out = csv.DictWriter(file, [*self.common, *self.columns, "run"], lineterminator="\n")
            out.writeheader()
            out.writerows(self.lines)
        os.replace(part, self.path)


free_of_contact = {"solver.strain_limit": "false", "solver.self_collision": "false"}
verdict = {True: "yes", False: "no"}


# --- Wherever steps of 0.01 to 0.1 s lead, it is where small explicit steps lead.
rest_scenes = {"pinned2": ("cloth.ks", [5e3, 5e4, 1e6]), "cs171": ("cloth.stiffness_reference", [40, 5e3, 1e6])}
seconds_to_rest = {"pinned2": 40, "cs171": 200}  # CS171's sheet is slowed by the air alone
allowed_mm = 2
rests_below = 1e-3  # the last update: what is not solved moves too little, and only looks as if it rested (docs/physics.md)


def rest_shapes(commit):
    table = Table("rest_shapes.csv", "rest_shapes", "scene ks time_step centroid_mm lowest_mm demand met kinetic_energy "
                  "unconverged_steps last_update seconds", commit)
    for scene, (key, stiffness) in rest_scenes.items():
        for ks in stiffness:
            def simulate(seconds, rate, more):
                return clothsim("run", "-f", scene, "--backend", "cpu", "--frames", round(seconds * rate),
                                *settings({key: f"{ks:g}", **free_of_contact, "solver.frames_per_sec": rate, **more}))
            # Where a sheet rests does not depend on its damping, and with 4/s it gets there soonest.
            small_steps = {"solver.integrator": "verlet", "solver.simulation_steps": "auto"}
            step = simulate(0, 50, small_steps)[0]["dt"]
            rest, _ = simulate(20, 50, {**small_steps, "cloth.damping": f"{400 * step:.6g}"})
            for rate in (100, 60, 20, 10):
                result, run = simulate(seconds_to_rest[scene], rate, {"solver.integrator": "implicit", "solver.simulation_steps": 1})
                centroid = 1000 * sum((a - b) ** 2 for a, b in zip(result["centroid"], rest["centroid"])) ** 0.5
                lowest = 1000 * abs(result["min_y"] - rest["min_y"])
                ends = result["convergence"]
                met = (result["finite"] and centroid <= allowed_mm and lowest <= allowed_mm
                       and ends["last_update"] < rests_below)
                table.add(scene, f"{ks:g}", result["dt"], centroid, lowest, f"<={allowed_mm} mm", verdict[met], result["kinetic_energy"],
                          ends["unconverged_steps"], ends["last_update"], result["sim_seconds"], run=run)
    table.write()


# --- A finer lattice of a material is the same sheet.
def stretches(path, columns):
    """The largest z, and l/L - 1 of the threads of a square sheet of 1 m in ascending order."""
    with open(path, newline="") as file:
        points = [tuple(float(line[axis]) for axis in "xyz") for line in csv.DictReader(file)]
    far = max(z for _, _, z in points)
    ends = [(i, i + 1) for i in range(len(points)) if (i + 1) % columns] + [(i, i + columns) for i in range(len(points) - columns)]
    return far, sorted(sum((a - b) ** 2 for a, b in zip(points[i], points[j])) ** 0.5 * (columns - 1) - 1 for i, j in ends)


def hang(points, more, seconds):
    """What `run` measured, the mean and the 99.9th percentile of the stretch [%], the run, and the largest z [m]."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "cloth.csv"
        result, run = clothsim("run", "-f", "pinned2", "--backend", "cpu", "--resolution", f"{points}x{points}", "--frames", 60 * seconds,
                               *settings({"cloth.material": "cotton", "cloth.material.damping": 3, "solver.integrator": "implicit",
                                          "solver.frames_per_sec": 60, "solver.simulation_steps": 1, **free_of_contact, **more}),
                               "--save", path)
        far, sorted_stretches = stretches(path, points)
    return (result, 100 * statistics.fmean(sorted_stretches), 100 * sorted_stretches[int(0.999 * len(sorted_stretches))],
            run.replace(str(path), "cloth.csv"), far)


def resolution(commit):
    table = Table("resolution.csv", "resolution", "case points value unit demand met", commit)
    sizes = (64, 128, 256, 512)
    # Soft, for cotton's sag of 0.05 mm is 800 units in binary32's last place; with gravity along the sheet, so that nothing wrinkles.
    soft = {"cloth.material.stretch": 280, "cloth.material.shear": 100, "cloth.material.density": 0.1}
    hung = {points: hang(points, {**soft, "cloth.pinned": '["top"]', "gravity": "[0,0,9.81]"}, 4) for points in sizes}
    swung = {points: hang(points, {}, 8) for points in sizes}
    sag = {points: 1000 * (far - 1) for points, (*_, far) in hung.items()}
    fall = {points: 1 - result["min_y"] for points, (result, *_) in swung.items()}
    for points in sizes:
        met = abs(sag[points] / sag[512] - 1) <= 1e-3
        table.add("hung, Y = 280 N/m: sag", points, sag[points], "mm", "0.1 %", verdict[met], run=hung[points][3])
    for points in sizes:
        met = points < 128 or abs(fall[points] / fall[512] - 1) <= 0.02
        table.add("two corners: fall", points, fall[points], "m", "2 %, from 128", verdict[met],
                  run=swung[points][3])
    for points in sizes:
        table.add("two corners: mean stretch", points, swung[points][1], "%", "<=0.1 %", verdict[swung[points][1] <= 0.1], run=swung[points][3])
    for points in sizes:
        table.add("two corners: 99.9th percentile of stretch", points, swung[points][2], "%", "<=1 %", verdict[swung[points][2] <= 1],
                  run=swung[points][3])
    table.write()


# --- Milliseconds for 1/60 s, and for the largest stable steps of verlet.
def speed(commit):
    table = Table("implicit_bench.csv", "speed", "device backend integrator points steps ms", commit)
    for backend in ("cpu", "gpu"):
        for points in (64, 128, 256, 512):
            sheet = ["-f", "pinned2", "--resolution", f"{points}x{points}", "--backend", backend]
            for integrator, steps in (("implicit", 1), ("verlet", "auto")):
                chosen = settings({"cloth.material": "cotton", "solver.frames_per_sec": 60, **free_of_contact, "solver.integrator": integrator,
                                   "solver.simulation_steps": steps})
                count = round(1 / 60 / clothsim("run", *sheet[:-1], "cpu", "--frames", 0, *chosen)[0]["dt"])
                result, run = clothsim("bench", *sheet, "--seconds", 0.5, *chosen)
                plain = result["steps"][0]  # without limiter and self-collision
                table.add(plain["device"], backend, integrator, points, count, count * plain["ms_per_step"], run=run)
    table.write()


# --- Frames of 1/60 s of the first half second, in which a sheet of cotton falls and swings: at the defaults, with contact and the
# steps that the program chooses, and in one step of four Newton steps of ten iterations, all of which are done. Both backends spend
# the same.
def cost(commit):
    table = Table("implicit_cost.csv", "cost", "device backend solver points steps_a_frame ms_a_frame newton_steps_a_step iterations_a_step "
                  "unconverged_steps steps", commit)
    solvers = {"implicit": {}, "bdf2": {"solver.integrator": "bdf2"},
               "implicit, 4 x 10": {"solver.simulation_steps": 1, "solver.newton_steps": 4, "solver.cg_iterations": 10, "solver.tolerance": 1e-6}}
    frames = 30
    for points in (64, 128, 256, 512):
        for name, more in solvers.items():
            chosen = settings({"cloth.material": "cotton", "solver.frames_per_sec": 60, "solver.integrator": "implicit", **more})
            # llvmpipe takes minutes for finer sheets.
            for backend in ("cpu", "gpu") if points == 64 or (points == 128 and name == "implicit") else ("cpu",):
                result, run = clothsim("run", "-f", "pinned2", "--resolution", f"{points}x{points}", "--backend", backend, "--frames", frames,
                                       *chosen)
                spent = result["convergence"]
                table.add(result["device"], backend, name, points, spent["steps"] // frames, 1000 * result["seconds"] / frames,
                          spent["newton_steps"] / spent["steps"], spent["cg_iterations"] / spent["steps"], spent["unconverged_steps"],
                          spent["steps"], run=run)
    table.write()


checks = {"rest_shapes": rest_shapes, "resolution": resolution, "speed": speed, "cost": cost}


def run(commit, names):
    for name in names:
        checks[name](commit)
